// The octree level at which an instance's rays stop in a view: no deeper than pixels can show, or
// at the triangles where these are few.
#ifndef svoSelectLevel_h
#define svoSelectLevel_h

#include "svoLeafTraits.h"
#include "svoLocalView.h"
#include "svoWorldSize.h"

#include <cmath>

namespace svo
{
/// The coarsest octree level whose voxels, seen at the nearest point of the octree's cube, are at
/// most `pixelError` pixels long, or Instance::pixelError where the instance has its own; the
/// octree's last level if none is, or if the error is 0.
inline int selectLevel(
  const Instance& instance, const LocalView& local, const View& view, double pixelError)
{
  const int last = instance.body->octree.level();
  if (instance.pixelError >= 0.0)
  {
    pixelError = instance.pixelError;
  }
  const double allowed = pixelError * worldPixel(view, local.base);
  double voxel = worldVoxel(instance);
  if (!(pixelError > 0.0) || !(allowed > 0.0) || !(voxel > 0.0))
  {
    return last;
  }
  int level = last;
  while (level > 1 && 2.0 * voxel <= allowed)
  {
    voxel *= 2.0;
    --level;
  }
  return level;
}

/// The level for the eye: selectLevel(), but the last one where leaves are exact and nodes of that
/// level have few triangles, about. So an outline is the triangles' own, whatever depth else the
/// octree needs, as for lights; tracing surfaces to few triangles takes no longer than their nodes.
inline int selectEyeLevel(
  const Instance& instance, const LocalView& local, const View& view, double pixelError)
{
  const int level = selectLevel(instance, local, view, pixelError);
  if (!traitsOf(instance.body->leafGeometry).exact() || !instance.body->octree.surface())
  {
    return level;
  }
  constexpr double Few = 64.0;
  const Header& h = instance.body->octree.header();
  const int last = instance.body->octree.level();
  const double nodes = std::ldexp(static_cast<double>(h.voxelCount), 2 * (level - last));
  return static_cast<double>(h.triangleCount) <= Few * nodes ? last : level;
}
}

#endif
