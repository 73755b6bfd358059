// Coincident topology between traced surfaces is resolved as VTK resolves it: by an offset of the
// window depth, of one mapper or of all.
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkPlaneSource.h"

#include <cmath>
#include <iostream>
#include <string>

namespace
{
using namespace svotest;

/// The static setting of all mappers, put back at the end.
struct PolygonOffset
{
  PolygonOffset() { vtkMapper::SetResolveCoincidentTopologyToPolygonOffset(); }
  ~PolygonOffset() { vtkMapper::SetResolveCoincidentTopologyToDefault(); }
};

struct Offsets
{
  const char* name;
  double factor;        // of the decal
  double decal, ground; // units
  bool parallel;
  int samples; // a pixel
};

std::size_t different(const Picture& a, const Picture& b)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    count += std::abs(a.grey(i) - b.grey(i)) > 10.0;
  }
  return count;
}
}

int TestSVOCoincident(int, char*[])
{
  Checks checks;
  const PolygonOffset offset;
  const Offsets cases[] = { { "a decal in front", -5.0, -50.0, 0.0, false, 0 },
    { "the ground behind", -5.0, 0.0, 50.0, false, 0 },
    { "a decal through what stands on it", -5.0, -2000.0, 0.0, false, 0 },
    { "a parallel projection", -5.0, -50.0, 0.0, true, 0 },
    { "a decal that its slope takes through what stands on it", -40.0, -50.0, 0.0, false, 0 },
    { "samples of a pixel", -5.0, -50.0, 0.0, false, 4 } };
  for (const Offsets& c : cases)
  {
    Stage stage;
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(-1.5, -1.5, 0.0);
    plane->SetPoint1(1.0, -1.5, 0.0);
    plane->SetPoint2(-1.5, 1.0, 0.0);
    plane->SetResolution(7, 5);
    vtkActor* decal = stage.add(plane, 0.2, 0.5, 0.9);
    vtkActor* ground = stage.addGround();
    stage.add(ball(0.5, 0.6, -0.2, 0.5), 0.9, 0.5, 0.3);
    stage.addSun(2.0, -1.5, 4.0);
    decal->GetMapper()->SetRelativeCoincidentTopologyPolygonOffsetParameters(c.factor, c.decal);
    ground->GetMapper()->SetRelativeCoincidentTopologyPolygonOffsetParameters(0.0, c.ground);
    stage.renderer->GetActiveCamera()->SetParallelProjection(c.parallel);
    stage.window->SetMultiSamples(c.samples);
    stage.pass->SetShadowTechniqueToNone();
    stage.usePass(false);
    const Picture raster = capture(stage.window);
    stage.usePass(true);
    const Picture traced = capture(stage.window);
    stage.expectTraced(checks, 3, "everything is traced");
    const std::string name = c.name;
    std::cout << name << ": " << different(raster, traced) << " pixels differ\n";
    checks.expect(different(raster, traced) < 20, name + ": as VTK draws it");
    // Kept layers know nothing of offsets.
    decal->GetMapper()->SetRelativeCoincidentTopologyPolygonOffsetParameters(0.0, -c.decal - 9.0);
    const Picture behind = capture(stage.window);
    stage.usePass(false);
    checks.expect(
      different(capture(stage.window), behind) < 20, name + ": nor does it stay when it changes");
  }
  return checks.exitCode();
}
