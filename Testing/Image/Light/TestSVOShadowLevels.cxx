// Shadows do not change when the camera comes closer: lights keep to octrees of the levels that
// their texels ask for, however deep those for the eye become.
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkPolyDataToSVO.h"

#include <iostream>

namespace
{
using namespace svotest;

/// Parallel pictures of one scene: in the larger ones every third pixel of every third row sees
/// what a pixel of the smaller one sees.
struct Scene : Stage
{
  vtkActor* caster;

  explicit Scene(int size)
    : Stage(size, size)
  {
    this->pass->SetLeafGeometryToVoxel();
    this->pass->SetMaximumLevel(11);
    this->pass->SetShadowBufferResolution(64);
    this->caster = this->add(ring(0.9, 0.0, 0.0, 1.2), 0.9, 0.5, 0.3);
    // The ground is the same in all pictures, to the last bit.
    vtkNew<vtkPolyDataToSVO> toOctree;
    vtkMapper* ground = this->addGround()->GetMapper();
    toOctree->SetInputConnection(ground->GetInputConnection(0, 0));
    toOctree->SetLeafGeometryToTriangle();
    ground->SetInputConnection(toOctree->GetOutputPort());
    this->addSun(2.0, -1.5, 4.0);
    vtkCamera* camera = this->renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetParallelScale(2.2);
    camera->SetPosition(-1.5, -3.0, 8.0);
  }
};

struct Seen
{
  std::size_t ground = 0; // pixels at which both pictures show the ground
  std::size_t dark = 0;
  std::size_t different = 0; // light in one of them, dark in the other
};

Seen compare(Scene& small, Scene& large)
{
  Seen seen;
  const Picture dim = small.shadowed();
  const Picture bright = small.unshadowed();
  const Picture dimLarge = large.shadowed();
  const Picture brightLarge = large.unshadowed();
  const auto isGround = [](const Picture& p, std::size_t i)
  { return p.depth[i] < 1.0f && p.rgb[3 * i + 2] > 0.85 * p.rgb[3 * i]; };
  for (int y = 0; y < dim.height; ++y)
  {
    for (int x = 0; x < dim.width; ++x)
    {
      const std::size_t i = static_cast<std::size_t>(y) * dim.width + x;
      const std::size_t k = static_cast<std::size_t>(3 * y + 1) * dimLarge.width + 3 * x + 1;
      if (isGround(bright, i) && isGround(brightLarge, k))
      {
        ++seen.ground;
        const bool dark = dim.grey(i) < 0.5 * bright.grey(i);
        const bool darkLarge = dimLarge.grey(k) < 0.5 * brightLarge.grey(k);
        seen.dark += dark;
        seen.different += dark != darkLarge;
      }
    }
  }
  return seen;
}
}

int TestSVOShadowLevels(int, char*[])
{
  Checks checks;
  Scene small(160);
  Scene large(480);
  const Seen seen = compare(small, large);
  std::cout << seen.ground << " pixels of ground, " << seen.dark << " dark, " << seen.different
            << " different; " << small.pass->GetNumberOfOctreesBuilt() << " and "
            << large.pass->GetNumberOfOctreesBuilt() << " octrees, "
            << small.pass->GetOctreeMemorySize() << " and " << large.pass->GetOctreeMemorySize()
            << " KiB\n";
  checks.expect(seen.ground > 3000 && seen.dark > 500, "there is a shadow to be seen");
  checks.expect(
    drawnByOpenGL() || large.pass->GetOctreeMemorySize() > 2 * small.pass->GetOctreeMemorySize(),
    "octrees differ");
  checks.expect(seen.different == 0, "shadows are the same from near and far");

  if (drawnByOpenGL())
  {
    return checks.exitCode();
  }
  // Automatic is buffers, through octrees of the same levels.
  const Picture buffers = large.shadowed();
  const int built = large.pass->GetNumberOfOctreesBuilt();
  large.pass->SetShadowTechniqueToAutomatic();
  checks.expect(capture(large.window).rgb == buffers.rgb, "automatic shadows are those of buffers");
  checks.expect(large.pass->GetNumberOfLightsWithShadowBuffers() == 1 &&
      large.pass->GetNumberOfLightsWithShadowRays() == 0,
    "automatic shadows have a buffer");
  checks.expect(large.pass->GetNumberOfOctreesBuilt() == built, "of the same octrees");
  return checks.exitCode();
}
