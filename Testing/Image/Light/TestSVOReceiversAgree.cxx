// Shadows fall on a rasterised surface as they fall on the same surface traced: on coarse meshes
// with smooth normals, whose terminators and creases are where tests against a shadow map go wrong.
#include "svoTestStage.h"

#include "vtkProperty.h"
#include "vtkSphereSource.h"

#include <cstdlib>
#include <iostream>

namespace
{
using namespace svotest;

vtkSmartPointer<vtkAlgorithm> coarseBall(double radius, double x, double y, double z)
{
  auto source = vtkSmartPointer<vtkSphereSource>::New();
  source->SetRadius(radius);
  source->SetCenter(x, y, z);
  source->SetThetaResolution(12);
  source->SetPhiResolution(9);
  return source;
}

/// Which pixels a stage's shadows darken.
Mask shadowed(Stage& stage)
{
  const Picture light = stage.unshadowed();
  const Picture dark = stage.shadowed();
  Mask mask(light.size());
  for (std::size_t i = 0; i < mask.size(); ++i)
  {
    mask[i] = light.grey(i) > dark.grey(i) + 3.0;
  }
  return mask;
}

/// `beam`: aside lies a cube that is stretched into a beam of few, long voxels.
void compare(const std::string& name, bool bulb, int resolution, Checks& checks, bool beam = false)
{
  Stage stage(500, 500);
  vtkActor* receivers[] = { stage.addGround(2.5),
    stage.add(coarseBall(0.8, -0.8, 0.2, 0.8), 0.9, 0.8, 0.7),
    stage.add(ring(0.7, 0.9, 0.1, 0.8), 0.7, 0.8, 0.9) };
  // Always rasterised, so that the shadow buffers are the same both times: whole, with all casters.
  vtkSVORenderPass::SetUseSVO(false, stage.add(coarseBall(0.3, 0.5, -0.9, 1.6), 0.5, 0.9, 0.4));
  if (beam)
  {
    vtkActor* actor = stage.add(box(1.0, 0.0, 0.0, 0.0), 0.9, 0.3, 0.3);
    actor->SetPosition(0.0, 2.2, 0.4);
    actor->SetScale(20.0, 0.05, 0.05);
    vtkSVORenderPass::SetUseSVO(false, actor);
  }
  if (bulb)
  {
    stage.addBulb(1.5, -1.0, 3.5);
  }
  else
  {
    stage.addSun(2.0, -1.5, 3.0);
  }
  stage.pass->SetShadowBufferResolution(resolution);
  const Picture surface = stage.unshadowed();
  const Mask traced = shadowed(stage);
  for (vtkActor* actor : receivers)
  {
    vtkSVORenderPass::SetUseSVO(false, actor);
  }
  const Mask rasterized = shadowed(stage);
  stage.expectTraced(checks, 0, name + ": all are rasterised");

  std::size_t pixels = 0, dark = 0, different = 0;
  for (std::size_t i = 0; i < traced.size(); ++i)
  {
    if (surface.depth[i] < 1.0f)
    {
      ++pixels;
      dark += traced[i];
      different += traced[i] != rasterized[i];
    }
  }
  std::cout << name << ": " << dark << " of " << pixels << " pixels in shadow, " << different
            << " differ\n";
  checks.expect(dark > 5000, name + ": shadows are seen");
  checks.expect(different <= dark / 400, name + ": at most one in four hundred differs");
}
}

int TestSVOReceiversAgree(int, char*[])
{
  Checks checks;
  compare("sun", false, 2048, checks);
  compare("sun, few texels", false, 256, checks);
  compare("bulb", true, 2048, checks);
  compare("bulb, few texels", true, 256, checks);
  compare("sun, beside a beam", false, 2048, checks, true);
  return checks.exitCode();
}
