#include "svoFrameErrors.h"

#include "svoLeafError.h"
#include "svoLocalView.h"
#include "svoVisibleInstances.h"
#include "svoWorldSize.h"

#include <algorithm>
#include <limits>

namespace svo
{
namespace
{
/// Linear depth from which on a view may meet the surface. The octree's cube, which
/// LayeredView::base belongs to, may be many times as large as what is in it, and reach to the eye.
double nearestSurface(const Instance& instance, const View& view, double nearestCube)
{
  const Header& h = instance.body->octree.header();
  if (h.pointCount == 0)
  {
    return nearestCube;
  }
  const glm::dmat4 toView = view.worldToView * instance.localToWorld;
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 8; ++i)
  {
    const glm::dvec4 corner(
      h.meshBounds[i & 1], h.meshBounds[2 + (i >> 1 & 1)], h.meshBounds[4 + (i >> 2)], 1.0);
    nearest = std::min(nearest, -(toView * corner).z);
  }
  return std::max(nearest, nearestCube);
}
}

double coarsestVoxel(const Scene& scene, const View& view)
{
  double largest = 0.0;
  for (const Instance& instance : scene.instances)
  {
    if (!instance.visible || !instance.body->octree ||
      instance.body->octree.level() >= instance.body->neededLevel)
    {
      continue;
    }
    const LocalView local = makeLocalView(instance.body->octree, instance.localToWorld, view);
    if (!local.rect.empty() && !worthTiles(instance, local, view, true))
    {
      largest = std::max(largest, worldVoxel(instance) / worldPixel(view, local.base));
    }
  }
  return largest;
}

double largestGap(const Scene& scene, const View& view, const LayeredView& eye)
{
  double largest = 0.0;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
  {
    const Instance& instance = scene.instances[i];
    if (instance.visible && instance.receiveShadow && !eye.rect(i).empty())
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
