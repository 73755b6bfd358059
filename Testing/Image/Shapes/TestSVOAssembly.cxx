// Assemblies: each path is placed by its own matrix, a part used twice is there twice, and one part
// that cannot be traced leaves the whole assembly to the rasteriser, shadows and all.
#include "svoTestStage.h"

#include "vtkAssembly.h"
#include "vtkProperty.h"
#include "vtkWeakPointer.h"

#include <cmath>
#include <iostream>

using namespace svotest;

namespace
{
/// One that is there by itself, too, has the assembly's keys from the first frame on.
void freePass(Checks& checks)
{
  vtkWeakPointer<vtkSVORenderPass> pass;
  {
    Stage stage(100, 80);
    stage.addGround();
    vtkNew<vtkAssembly> assembly;
    assembly->AddPart(stage.add(ball(0.4, 0.0, 0.0, 0.8), 0.9, 0.3, 0.2));
    stage.renderer->AddActor(assembly);
    stage.addSun(2.0, -1.5, 4.0);
    for (int frame = 0; frame < 3; ++frame)
    {
      stage.shadowed();
    }
    pass = stage.pass;
  }
  checks.expect(!pass, "a pass is freed that a part of an assembly has carried twice");
}
}

int TestSVOAssembly(int, char*[])
{
  Checks checks;
  Stage stage;
  stage.addGround();
  stage.addSun(2.0, -1.5, 4.0);
  vtkActor* part = stage.add(box(0.6, 0.0, 0.0, 0.0), 0.9, 0.5, 0.3);
  vtkActor* other = stage.add(ball(0.3, 0.0, 0.0, 0.8), 0.3, 0.6, 0.9);
  vtkNew<vtkAssembly> pair;
  pair->AddPart(part);
  pair->AddPart(other);
  pair->SetPosition(-1.0, 0.0, 0.5);
  vtkNew<vtkAssembly> turned;
  turned->AddPart(part);
  turned->AddPart(other);
  turned->SetPosition(1.0, 0.3, 0.6);
  turned->RotateX(30.0);
  turned->RotateZ(40.0);
  turned->SetScale(1.2, 0.8, 1.0);
  vtkNew<vtkAssembly> all;
  all->AddPart(pair);
  all->AddPart(turned);
  all->RotateZ(15.0);
  stage.renderer->RemoveActor(part);
  stage.renderer->RemoveActor(other);
  stage.renderer->AddActor(all);

  const Picture traced = stage.unshadowed();
  stage.expectTraced(checks, 5, "two parts twice and the ground");
  const Picture shadowed = stage.shadowed();
  stage.usePass(false);
  const Picture raster = capture(stage.window);
  stage.usePass(true);
  const Difference look = difference(raster, traced, awayFromEdges(raster, 2));
  std::cout << "traced: mean " << look.mean << ", p99 " << look.p99 << "\n";
  checks.expect(look.mean <= 2.0 && look.p99 <= 8, "the assembly looks as VTK draws it");

  all->RotateZ(20.0);
  const Picture moved = stage.unshadowed();
  stage.usePass(false);
  const Picture movedRaster = capture(stage.window);
  stage.usePass(true);
  const Difference after = difference(movedRaster, moved, awayFromEdges(movedRaster, 2));
  checks.expect(after.mean <= 2.0 && after.p99 <= 8, "also when it has been turned");
  all->RotateZ(-20.0);

  part->GetProperty()->SetInterpolationToPBR();
  part->GetProperty()->SetMetallic(0.0);
  const Picture mixed = stage.shadowed();
  stage.expectTraced(checks, 1, "only the ground is traced");
  stage.expectRasterized(checks, 4, "the assembly is rasterised");
  std::size_t dark = 0;
  std::size_t lost = 0;
  const Mask inner = awayFromEdges(raster, 3);
  for (std::size_t i = 0; i < inner.size(); ++i)
  {
    // Grey pixels of the ground, which looks the same in both.
    const bool ground = std::abs(raster.rgb[3 * i] - raster.rgb[3 * i + 1]) < 2;
    if (inner[i] && ground && traced.grey(i) - shadowed.grey(i) > 20.0)
    {
      ++dark;
      lost += mixed.grey(i) - shadowed.grey(i) > 20.0;
    }
  }
  std::cout << dark << " dark pixels of the ground, " << lost << " lost\n";
  checks.expect(dark > 500 && lost < dark / 100, "a rasterised assembly casts the same shadows");
  freePass(checks);
  return checks.exitCode();
}
