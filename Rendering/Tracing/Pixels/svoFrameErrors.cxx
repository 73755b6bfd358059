#include "svoFrameErrors.h"

#include "svoBox.h"
#include "svoLeafError.h"
#include "svoWorldSize.h"

#include <algorithm>

namespace svo
{
namespace
{
/// Linear depth from which on a view may meet the surface. The octree's cube, which
/// ViewedInstance::base belongs to, may be many times as large as what is in it, and reach to the
/// eye.
double nearestSurface(const Instance& instance, const View& view, double nearestCube)
{
  const Header& h = instance.body->octree.header();
  if (h.pointCount == 0)
  {
    return nearestCube;
  }
  const Box seen = boxAround(h.meshBounds, view.worldToView * instance.localToWorld);
  return std::max(-seen.high.z, nearestCube);
}
}

double coarsestVoxel(const Scene& scene, const View& view, const Hits& eye)
{
  double largest = 0.0;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
  {
    const Instance& instance = scene.instances[i];
    if (!eye.instances.rect(i).empty() && !eye.instances.placed(i) &&
      instance.body->octree.level() < instance.body->neededLevel)
    {
      largest = std::max(largest, worldVoxel(instance) / worldPixel(view, eye.base(i)));
    }
  }
  return largest;
}

double largestGap(const Scene& scene, const View& view, const Hits& eye)
{
  double largest = 0.0;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
  {
    const Instance& instance = scene.instances[i];
    if (instance.visible && instance.receiveShadow && !eye.instances.rect(i).empty())
    {
      const double gap =
        worldLeafError(instance, LeafGeometry::Triangle, instance.body->octree.level(), true);
      largest =
        std::max(largest, gap / worldPixel(view, nearestSurface(instance, view, eye.base(i))));
    }
  }
  return largest;
}
}
