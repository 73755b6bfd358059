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

void findErrors(
  const Scene& scene, const View& view, const Hits& eye, bool shadows, FrameStatistics& statistics)
{
  double &voxel = statistics.coarsestVoxel, &gap = statistics.largestGap;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
  {
    if (eye.instances.rect(i).empty())
    {
      continue;
    }
    const Instance& instance = scene.instances[i];
    const int level = instance.body->octree.level();
    if (!eye.instances.placed(i) && level < instance.body->neededLevel)
    {
      voxel = std::max(voxel, worldVoxel(instance) / worldPixel(view, eye.base(i)));
    }
    if (shadows && instance.visible && instance.receiveShadow)
    {
      const double own = worldLeafError(instance, LeafGeometry::Triangle, level, true);
      gap = std::max(gap, own / worldPixel(view, nearestSurface(instance, view, eye.base(i))));
    }
  }
}
}
