#include "svoFrameErrors.h"

#include "svoLeafError.h"
#include "svoLocalView.h"
#include "svoVisibleInstances.h"
#include "svoWorldSize.h"

#include <algorithm>

namespace svo
{
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
      largest = std::max(largest, gap / worldPixel(view, eye.base(i)));
    }
  }
  return largest;
}
}
