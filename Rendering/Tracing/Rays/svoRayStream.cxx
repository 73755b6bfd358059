#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoRayStream.cxx"
#include <hwy/foreach_target.h>

#include "svoRayStream.h"

#include "svoLaneBits-inl.h"

#include <algorithm>
#include <cmath>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
/// Of some rays, which come to a box.
HWY_INLINE hn::Mask<Floats> reachBox(
  const StreamRays& rays, int first, const float* low, const float* high)
{
  const Floats d;
  const auto length = hn::Load(d, rays.length + first);
  auto in = hn::Zero(d), out = length;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto start = hn::Load(d, rays.start[axis] + first);
    const auto inverse = hn::Load(d, rays.inverse[axis] + first);
    const auto a = hn::Mul(hn::Sub(hn::Set(d, low[axis]), start), inverse);
    const auto b = hn::Mul(hn::Sub(hn::Set(d, high[axis]), start), inverse);
    in = hn::Max(in, hn::Min(a, b));
    out = hn::Min(out, hn::Max(a, b));
  }
  // Roundings of the quotients; those of the difference are in the box.
  // Lanes without a ray hold anything, also what is no number, which may come out as any interval.
  return hn::And(hn::Ge(length, hn::Zero(d)), hn::Le(in, hn::Mul(out, hn::Set(d, 1.000001f))));
}

bool anyReaches(const StreamRays& rays, const float* low, const float* high)
{
  for (int i = 0; i < rays.count; i += width())
  {
    if (!hn::AllFalse(Floats(), reachBox(rays, i, low, high)))
    {
      return true;
    }
  }
  return false;
}

void findReaching(
  const StreamRays& rays, const float* low, const float* high, std::uint64_t* reaching)
{
  for (int i = 0; i < rays.count; i += width())
  {
    reaching[i / 64] |= bitsOf(Floats(), reachBox(rays, i, low, high)) << i % 64;
  }
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(anyReaches);
HWY_EXPORT(findReaching);

void RayStream::add(const glm::dvec3& start, const glm::vec3& direction, float length)
{
  assert(this->Rays.count < Most);
  const int i = this->Rays.count++;
  const glm::vec3 from(start - this->Near);
  for (int axis = 0; axis < 3; ++axis)
  {
    // Along an axis that it hardly moves along a ray is in a box all of its way, or never.
    constexpr float Least = 1e-30f;
    const float along = direction[axis];
    this->Rays.start[axis][i] = from[axis];
    this->Rays.inverse[axis][i] = 1.0f / (std::abs(along) < Least ? Least : along);
    this->Reach = std::max(this->Reach, std::abs(from[axis]));
  }
  const bool goes = length > 0.0f;
  this->Rays.length[i] = goes ? length : Ended;
  this->Left += goes;
  // Those of a whole vector are looked at.
  if (i % MostLanes == 0)
  {
    std::fill_n(this->Rays.length + i + 1, MostLanes - 1, Ended);
  }
}

RayStream::Box RayStream::boxOf(const glm::dvec3& centre, const glm::dvec3& extent) const
{
  // A float's roundings of starts, of the box and of their difference.
  constexpr double Rounding = 2.4e-7;
  Box box;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double from = centre[axis] - this->Near[axis];
    const double half =
      extent[axis] + Rounding * (std::abs(from) + extent[axis] + static_cast<double>(this->Reach));
    box.low[axis] = static_cast<float>(from - half);
    box.high[axis] = static_cast<float>(from + half);
  }
  return box;
}

bool RayStream::reach(const glm::dvec3& centre, const glm::dvec3& extent) const
{
  const Box box = this->boxOf(centre, extent);
  return HWY_DYNAMIC_DISPATCH(anyReaches)(this->Rays, box.low, box.high);
}

RayStream::Mask RayStream::reaching(const glm::dvec3& centre, const glm::dvec3& extent) const
{
  const Box box = this->boxOf(centre, extent);
  Mask mask{};
  HWY_DYNAMIC_DISPATCH(findReaching)(this->Rays, box.low, box.high, mask.word);
  return mask;
}
}
#endif
