// The octree level at which an instance's rays stop in a view: no deeper than pixels can show.
#ifndef svoSelectLevel_h
#define svoSelectLevel_h

#include "svoLocalView.h"
#include "svoWorldSize.h"

namespace svo
{
/// The coarsest octree level whose voxels, seen at the nearest point of the octree's cube, are at
/// most `pixelError` pixels long, or Instance::pixelError where the instance has its own; the
/// octree's last level if none is, or if the error is 0.
inline int selectLevel(
  const Instance& instance, const LocalView& local, const View& view, double pixelError)
{
  const int last = instance.octree.level();
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
}

#endif
