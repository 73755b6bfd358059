#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoSeenObjects.cxx"
#include <hwy/foreach_target.h>

#include "svoSeenObjects.h"

#include "svoLaneBits-inl.h"

#include <cassert>

#include <hwy/highway.h>

#ifndef svoSeenObjects_cxx
#define svoSeenObjects_cxx
namespace svo
{
/// Planes in the steps of a node's balls: the distance of a ball that just touches is not negative.
struct StepPlanes
{
  int count = 0;
  float x[6], y[6], z[6], offset[6];
};
}
#endif

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
inline hn::Vec<Floats> load(const std::uint16_t* from)
{
  const hn::Rebind<std::uint16_t, Floats> shorts;
  const hn::RebindToSigned<Floats> integers;
  return hn::ConvertTo(Floats(), hn::PromoteTo(integers, hn::LoadU(shorts, from)));
}

std::uint32_t touching(const StepPlanes& planes, const LooseObjects& objects)
{
  const Floats floats;
  const std::size_t width = hn::Lanes(floats);
  std::uint32_t seen = 0;
  for (std::size_t i = 0; i < LooseObjects::Most + 1; i += width)
  {
    const auto x = load(objects.x + i), y = load(objects.y + i), z = load(objects.z + i),
               radius = load(objects.radius + i);
    auto least = hn::Zero(floats);
    for (int p = 0; p < planes.count; ++p)
    {
      const auto offset = hn::Add(radius, hn::Set(floats, planes.offset[p]));
      least = hn::Min(least,
        hn::MulAdd(hn::Set(floats, planes.x[p]), x,
          hn::MulAdd(
            hn::Set(floats, planes.y[p]), y, hn::MulAdd(hn::Set(floats, planes.z[p]), z, offset))));
    }
    seen |= static_cast<std::uint32_t>(bitsOf(floats, hn::Ge(least, hn::Zero(floats))) << i);
  }
  return seen;
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(touching);

std::uint32_t seenOf(const Frustum& frustum, std::uint8_t within, const LooseObjects& objects)
{
  assert(objects.x && objects.count <= LooseObjects::Most);
  const glm::dvec3 first = objects.low + 0.5 * objects.unit;
  const glm::dvec3 size = glm::abs(objects.low) + 65536.0 * objects.unit;
  const double slack = objects.noise + 0x1p-48 * glm::max(glm::max(size.x, size.y), size.z);
  const double perUnit = 1.0 / objects.unit;
  StepPlanes planes;
  for (int p = 0; p < frustum.planes(); ++p)
  {
    if (!(within >> p & 1))
    {
      const glm::dvec4 plane = frustum.plane(p);
      const int i = planes.count++;
      planes.x[i] = static_cast<float>(plane.x);
      planes.y[i] = static_cast<float>(plane.y);
      planes.z[i] = static_cast<float>(plane.z);
      const double at = glm::dot(glm::dvec3(plane), first) + plane.w + slack;
      planes.offset[i] = static_cast<float>(at * perUnit) + 1.0f;
    }
  }
  return HWY_DYNAMIC_DISPATCH(touching)(planes, objects) & ((1u << objects.count) - 1u);
}
}
#endif
