// Octrees are built no deeper than the picture needs and deepened when the camera comes closer: in
// the background while the user interacts. A still picture never depends on what came before.
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkPolyDataMapper.h"
#include "vtkPolyDataToSVO.h"

#include <chrono>
#include <iostream>
#include <string>
#include <thread>

namespace
{
using namespace svotest;

constexpr double Still = 0.0001; // Hz
constexpr double Interactive = 15.0;
constexpr int Level = 10;

/// A ring under a sun; its octree is the pass's affair, or is made at the full level beforehand.
struct Ring : Stage
{
  explicit Ring(bool fullLevel, int leafGeometry)
    : Stage(240, 240)
  {
    this->pass->SetLeafGeometry(leafGeometry);
    this->pass->SetMaximumLevel(Level);
    this->pass->SetShadowBufferResolution(16);
    // Otherwise the clock decides how far apart rays are.
    this->pass->SetAutoAdjustSampleDistances(false);
    this->addSun(2.0, -1.5, 4.0);
    vtkActor* actor = this->add(ring(0.9, 0.0, 0.0, 1.0), 0.9, 0.5, 0.3);
    if (fullLevel)
    {
      vtkNew<vtkPolyDataToSVO> toOctree;
      toOctree->SetInputConnection(actor->GetMapper()->GetInputConnection(0, 0));
      toOctree->SetMaximumLevel(Level);
      toOctree->SetLeafGeometry(leafGeometry);
      actor->GetMapper()->SetInputConnection(toOctree->GetOutputPort());
    }
    this->look(60.0);
  }

  void look(double distance)
  {
    vtkCamera* camera = this->renderer->GetActiveCamera();
    camera->SetPosition(0.2 * distance, -0.8 * distance, 0.5 * distance + 0.6);
    camera->SetFocalPoint(0.0, 0.0, 0.8);
    camera->SetClippingRange(0.5, 200.0);
  }

  Picture still(double distance)
  {
    this->window->SetDesiredUpdateRate(Still);
    this->look(distance);
    return capture(this->window);
  }

  Picture moving(double distance)
  {
    this->window->SetDesiredUpdateRate(Interactive);
    this->look(distance);
    return capture(this->window);
  }
};

bool same(const Picture& a, const Picture& b)
{
  return a.rgb == b.rgb && a.depth == b.depth;
}

/// Pixels that only one of the two pictures covers, as a share of those that both cover.
double outlineDifference(const Picture& a, const Picture& b)
{
  std::size_t both = 0, one = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const bool inA = a.depth[i] < 1.0f, inB = b.depth[i] < 1.0f;
    both += inA && inB;
    one += inA != inB;
  }
  return static_cast<double>(one) / static_cast<double>(std::max<std::size_t>(both, 1));
}

Mask coveredByBoth(const Picture& a, const Picture& b)
{
  Mask mask(a.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    mask[i] = a.depth[i] < 1.0f && b.depth[i] < 1.0f;
  }
  return mask;
}

/// What a pass shows that has nothing from before, and shares no octree with another one.
Picture afresh(Checks& checks, int leafGeometry, double distance, double pixelError = 1.0)
{
  Ring ring(false, leafGeometry);
  ring.pass->SetPixelError(pixelError);
  const Picture picture = ring.still(distance);
  // Near the eye needs a deeper one than the light.
  checks.expect(ring.pass->GetNumberOfOctreesBuilt() == (distance == 60.0 ? 1 : 2),
    "afresh, no more octrees are built than are needed");
  return picture;
}

void testStill(Checks& checks, int leafGeometry, const std::string& name)
{
  const Picture alone = afresh(checks, leafGeometry, 60.0);
  Ring adaptive(false, leafGeometry);
  Ring full(true, leafGeometry);
  // Shadows are another matter: lights keep to octrees of their own.
  adaptive.pass->SetShadowTechniqueToNone();
  full.pass->SetShadowTechniqueToNone();
  vtkIdType memory = 0;
  for (const double distance : { 60.0, 12.0, 3.0 })
  {
    const Picture picture = adaptive.still(distance);
    const Picture truth = full.still(distance);
    full.usePass(false);
    const Picture raster = capture(full.window);
    full.usePass(true);
    const double outline = outlineDifference(picture, truth);
    const double fatter = outlineDifference(picture, raster);
    const Difference own = difference(picture, raster, coveredByBoth(picture, raster));
    const Difference best = difference(truth, raster, coveredByBoth(truth, raster));
    std::cout << name << " from " << distance << ": " << adaptive.pass->GetNumberOfOctreesBuilt()
              << " octrees, " << adaptive.pass->GetOctreeMemorySize() << " KiB; outline "
              << 100.0 * outline << " % from the full level's, " << 100.0 * fatter
              << " % from the rasteriser's; colours " << own.mean << " and " << best.mean
              << " from the rasteriser's (" << own.pixels << " pixels)\n";
    adaptive.expectTraced(checks, 1, name + ": it is traced");
    checks.expect(adaptive.pass->GetNumberOfOctreesInProgress() == 0, name + ": it waits");
    checks.expect(adaptive.pass->GetAcceptedPixelError() == 1.0, name + ": full quality");
    checks.expect(adaptive.pass->GetOctreeMemorySize() > memory, name + ": it is deepened");
    memory = adaptive.pass->GetOctreeMemorySize();
    // Octrees stop at whole voxels, so that a pixel of the outline may go either way. From afar
    // rays stop at coarse nodes of the full level, and at triangles of a coarse octree.
    checks.expect(outline < 0.05 || fatter < 0.01,
      name + ": the outline is that of the full level, or the rasteriser's");
    checks.expect(own.pixels > 50 && own.mean < best.mean + 2.0, name + ": colours are as good");
  }
  if (leafGeometry == vtkSVORenderPass::LEAF_AUTOMATIC)
  {
    // Near its triangles are exact whatever the level, so that it is not deepened to the end.
    const Difference near = difference(adaptive.still(3.0), full.still(3.0));
    std::cout << name << ": near it is " << near.mean << " from the full level\n";
    checks.expect(near.mean < 1e-3, name + ": near it looks like the full level");
    checks.expect(memory < 1500, name + ": and takes a small part of the memory");
  }
  else
  {
    // Near it is the same octree.
    checks.expect(same(adaptive.still(3.0), full.still(3.0)), name + ": near it is the full level");
  }
  adaptive.pass->SetShadowTechniqueToShadowBuffer();
  // Back again, by way of interaction: nothing remains of it.
  adaptive.moving(30.0);
  checks.expect(same(adaptive.still(60.0), alone), name + ": a still picture has no history");
}

void testInteraction(Checks& checks)
{
  const Picture wanted = afresh(checks, vtkSVORenderPass::LEAF_VOXEL, 3.0);
  Ring stage(false, vtkSVORenderPass::LEAF_VOXEL);
  vtkSVORenderPass* pass = stage.pass;
  stage.still(60.0);
  const int before = pass->GetNumberOfOctreesBuilt();

  // The first frame cannot have the deeper octree: where it is built nobody waits.
  Picture shown = stage.moving(3.0);
  checks.expect(pass->GetNumberOfTracedActors() == 1, "meanwhile the coarser octree is traced");
  checks.expect(pass->GetNumberOfOctreesBuilt() == before, "the first frame does not wait");
  checks.expect(pass->GetNumberOfOctreesInProgress() > 0, "it says that there is more to come");
  checks.expect(pass->GetAcceptedPixelError() > 2.0, "it says how coarse it is");
  std::cout << "voxels of " << pass->GetAcceptedPixelError() << " pixels meanwhile\n";
  checks.expect(outlineDifference(shown, wanted) < 0.5, "it is the same object");
  for (int i = 0; i < 1200 && pass->GetNumberOfOctreesInProgress() > 0; ++i)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(25));
    shown = stage.moving(3.0);
  }
  checks.expect(pass->GetNumberOfOctreesInProgress() == 0, "the build comes to its end");
  checks.expect(pass->GetNumberOfOctreesBuilt() == before + 1, "no octree is built twice");
  checks.expect(pass->GetAcceptedPixelError() == 1.0, "then the picture is what was asked for");
  checks.expect(same(shown, wanted), "then it is that of a still frame");
  checks.expect(same(stage.still(3.0), wanted), "and the still frame's is as well");
  checks.expect(pass->GetNumberOfOctreesBuilt() == before + 1, "the still frame builds none");

  // Coming out needs nothing new.
  stage.moving(60.0);
  checks.expect(pass->GetNumberOfOctreesInProgress() == 0, "coming out builds nothing");
}

void testStillInTheMiddle(Checks& checks)
{
  const Picture wanted = afresh(checks, vtkSVORenderPass::LEAF_PLANE, 3.0);
  Ring stage(false, vtkSVORenderPass::LEAF_PLANE);
  stage.still(60.0);
  stage.moving(3.0); // a build begins
  checks.expect(same(stage.still(3.0), wanted), "a still frame waits for what it needs");
  checks.expect(stage.pass->GetNumberOfOctreesInProgress() == 0, "nothing is left to do");
}

void testZeroError(Checks& checks)
{
  const Picture exact = afresh(checks, vtkSVORenderPass::LEAF_VOXEL, 60.0, 0.0);
  Ring full(true, vtkSVORenderPass::LEAF_VOXEL);
  full.pass->SetPixelError(0.0);
  checks.expect(same(exact, full.still(60.0)), "a pixel error of 0 is the full level");
}

/// The pass goes, and an actor goes, while octrees are built.
void testGoing(Checks& checks)
{
  {
    Ring stage(false, vtkSVORenderPass::LEAF_TRIANGLE);
    stage.still(60.0);
    stage.moving(3.0);
    stage.renderer->RemoveAllViewProps();
    for (int frame = 0; frame < 10; ++frame)
    {
      stage.moving(3.0);
    }
    checks.expect(stage.pass->GetNumberOfOctreesInProgress() == 0, "a build is abandoned");
  }
  Ring stage(false, vtkSVORenderPass::LEAF_TRIANGLE);
  stage.still(60.0);
  stage.moving(3.0);
}
}

int TestSVODeepening(int, char*[])
{
  Checks checks;
  testStill(checks, vtkSVORenderPass::LEAF_VOXEL, "voxel");
  testStill(checks, vtkSVORenderPass::LEAF_PLANE, "plane");
  testStill(checks, vtkSVORenderPass::LEAF_AUTOMATIC, "automatic");
  testInteraction(checks);
  testStillInTheMiddle(checks);
  testZeroError(checks);
  testGoing(checks);
  return checks.exitCode();
}
