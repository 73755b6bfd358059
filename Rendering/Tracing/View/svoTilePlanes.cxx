#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoTilePlanes.cxx"
#include <hwy/foreach_target.h>

#include "svoLaneBits-inl.h"
#include "svoTilePlanes.h"

#include <cmath>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
// Loops vectorise where what they read of all pixels alike has been copied first.

void meetPlanes(const SeenPlane* planes, const std::int32_t* plane, double x, double y, float* t,
  std::uint64_t& doubts)
{
  alignas(64) double depth[64], along[64], slack[64], edgeOn[64];
  const Integers integers;
  const auto first = hn::Set(integers, plane[0]);
  auto one = hn::Eq(first, first);
  for (int i = 0; i < 64; i += width())
  {
    one = hn::And(one, hn::Eq(hn::LoadU(integers, plane + i), first));
  }
  if (hn::AllTrue(integers, one))
  {
    const SeenPlane p = planes[plane[0]];
    for (int i = 0; i < 64; ++i)
    {
      const double px = x + ((i & 7) + 0.5), py = y + ((i >> 3) + 0.5);
      along[i] = p.d + px * p.dx + py * p.dy;
      depth[i] = p.n + px * p.nx + py * p.ny;
      slack[i] = p.slack;
      edgeOn[i] = p.edgeOn;
    }
  }
  else
  {
    for (int i = 0; i < 64; ++i)
    {
      const SeenPlane& p = planes[plane[i]];
      const double px = x + ((i & 7) + 0.5), py = y + ((i >> 3) + 0.5);
      along[i] = p.d + px * p.dx + py * p.dy;
      depth[i] = p.n + px * p.nx + py * p.ny;
      slack[i] = p.slack;
      edgeOn[i] = p.edgeOn;
    }
  }
  alignas(64) float low[64], high[64];
  alignas(64) double certain[64];
  for (int i = 0; i < 64; ++i)
  {
    const double perAlong = 1.0 / along[i];
    const double middle = depth[i] * perAlong;
    const double off = slack[i] * std::abs(perAlong);
    low[i] = static_cast<float>(middle - off);
    high[i] = static_cast<float>(middle + off);
    certain[i] = along[i] * along[i] - edgeOn[i];
  }
  doubts = 0;
  alignas(64) std::int32_t doubtful[64];
  for (int i = 0; i < 64; ++i)
  {
    t[i] = low[i];
    doubtful[i] = (low[i] == high[i] ? 0 : 1);
  }
  for (int i = 0; i < 64; ++i)
  {
    doubtful[i] |= certain[i] > 0.0 ? 0 : 1;
  }
  for (int i = 0; i < 64; i += width())
  {
    const auto sure = hn::Eq(hn::Load(integers, doubtful + i), hn::Zero(integers));
    doubts |= bitsOf(integers, hn::Not(sure)) << i;
  }
}

void fillBlock(const LocalView& from, const double* x, const double* y, RayBlock& rays)
{
  const glm::dvec3 o = from.origin, oX = from.originX, oY = from.originY;
  const glm::dvec3 d = from.direction, dX = from.directionX, dY = from.directionY;
  for (int k = 0; k < RayBlock::Size; ++k)
  {
    rays.originX[k] = static_cast<float>(o.x + y[k] * oY.x + x[k] * oX.x);
    rays.originY[k] = static_cast<float>(o.y + y[k] * oY.y + x[k] * oX.y);
    rays.originZ[k] = static_cast<float>(o.z + y[k] * oY.z + x[k] * oX.z);
    rays.directionX[k] = static_cast<float>(d.x + y[k] * dY.x + x[k] * dX.x);
    rays.directionY[k] = static_cast<float>(d.y + y[k] * dY.y + x[k] * dX.y);
    rays.directionZ[k] = static_cast<float>(d.z + y[k] * dY.z + x[k] * dX.z);
  }
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(meetPlanes);
HWY_EXPORT(fillBlock);

std::uint64_t depthsOnPlanes(
  const SeenPlane* planes, const std::int32_t* plane, double x, double y, float* t)
{
  std::uint64_t doubts;
  HWY_DYNAMIC_DISPATCH(meetPlanes)(planes, plane, x, y, t, doubts);
  return doubts;
}

void fillRays(const LocalView& local, const double* x, const double* y, RayBlock& rays)
{
  HWY_DYNAMIC_DISPATCH(fillBlock)(local, x, y, rays);
}
}
#endif
