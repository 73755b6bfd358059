#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoTilePlanes.cxx"
#include <hwy/foreach_target.h>

#include "svoTilePlanes.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
void meetPlanes(const SeenPlane* planes, const std::int32_t* plane, double x, double y, float* t,
  std::uint8_t* doubts)
{
  for (int i = 0; i < 64; ++i)
  {
    const SeenPlane& p = planes[plane[i]];
    const double px = x + (i & 7) + 0.5, py = y + (i >> 3) + 0.5;
    const double along = p.d + px * p.dx + py * p.dy;
    const double perAlong = 1.0 / along;
    const double depth = (p.n + px * p.nx + py * p.ny) * perAlong;
    const double slack = p.slack * std::abs(perAlong);
    const float low = static_cast<float>(depth - slack);
    const float high = static_cast<float>(depth + slack);
    t[i] = low;
    doubts[i] = static_cast<std::uint8_t>(
      (low == high ? 0 : CloseToNext) | (along * along > p.edgeOn ? 0 : MayBeEdgeOn));
  }
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(meetPlanes);

void depthsOnPlanes(const SeenPlane* planes, const std::int32_t* plane, double x, double y,
  float* t, std::uint8_t* doubts)
{
  HWY_DYNAMIC_DISPATCH(meetPlanes)
  (planes, plane, x, y, t, doubts);
}
}
#endif
