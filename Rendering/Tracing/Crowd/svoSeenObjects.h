// The objects of a loose octree that a view may see, front to back.
#ifndef svoSeenObjects_h
#define svoSeenObjects_h

#include "svoFrustum.h"
#include "svoLooseOctree.h"

namespace svo
{
/// Bits of the objects of a node that are not outside of the frustum: of one of its planes but
/// those `within` which all of the node lies. In floats, in the steps of the objects' balls: what
/// they round is less than a tenth of a step, and a step is allowed for.
inline std::uint32_t seenOf(
  const Frustum& frustum, std::uint8_t within, const LooseObjects& objects)
{
  const glm::dvec3 first = objects.low + 0.5 * objects.unit;
  const glm::dvec3 size = glm::abs(objects.low) + 65536.0 * objects.unit;
  const double slack = objects.noise + 0x1p-48 * glm::max(glm::max(size.x, size.y), size.z);
  float least[16];
  for (float& l : least)
  {
    l = 0.0f;
  }
  for (int p = 0; p < frustum.planes(); ++p)
  {
    if (within >> p & 1)
    {
      continue;
    }
    const glm::dvec4 plane = frustum.plane(p);
    const float a = static_cast<float>(plane.x), b = static_cast<float>(plane.y),
                c = static_cast<float>(plane.z);
    const double at = glm::dot(glm::dvec3(plane), first) + plane.w + slack;
    const float d = static_cast<float>(at / objects.unit) + 1.0f;
    for (int i = 0; i < 16; ++i)
    {
      const float distance = (a * static_cast<float>(objects.x[i]) + d) +
        (b * static_cast<float>(objects.y[i]) + c * static_cast<float>(objects.z[i])) +
        static_cast<float>(objects.radius[i]);
      least[i] = distance < least[i] ? distance : least[i];
    }
  }
  std::uint32_t seen = 0;
  for (int i = 0; i < 16; ++i)
  {
    seen |= static_cast<std::uint32_t>(!(least[i] < 0.0f)) << i;
  }
  return seen & ((1u << objects.count) - 1u);
}

/// onObject(object) for outsiders first, then for every object whose node and whose ball are not
/// outside of the frustum, in the order of LooseOctree::visit(). Allocates nothing.
template <class OnObject>
void eachSeen(const LooseOctree& objects, const Frustum& frustum, const VisitOrder& order,
  const OnObject& onObject)
{
  objects.visitGroups(
    order,
    [&](const LooseNode& node, std::uint8_t& within)
    {
      const Frustum::Side side = frustum.box(node.centre, glm::dvec3(node.half), within);
      return side == Frustum::Side::Outside ? NodeVisit::Skip
        : side == Frustum::Side::Inside     ? NodeVisit::All
                                            : NodeVisit::Below;
    },
    [&](const LooseObjects& some, bool all, std::uint8_t within)
    {
      if (all || !some.x)
      {
        for (std::uint32_t i = 0; i < some.count; ++i)
        {
          onObject(some.objects[i]);
        }
        return;
      }
      const std::uint32_t seen = seenOf(frustum, within, some);
      for (std::uint32_t i = 0; i < some.count; ++i)
      {
        if (seen >> i & 1)
        {
          onObject(some.objects[i]);
        }
      }
    });
}
}

#endif
