// The objects of a loose octree that a view may see, front to back.
#ifndef svoSeenObjects_h
#define svoSeenObjects_h

#include "svoFrustum.h"
#include "svoLooseOctree.h"
#include "vtkSVOTracingModule.h"

#include <cstdint>

namespace svo
{
/// Bits of the objects of a node that are not outside of the frustum: of one of its planes but
/// those `within` which all of the node lies. In floats, in the steps of the objects' balls: what
/// they round is less than a tenth of a step, and a step is allowed for. Not for outsiders.
VTKSVOTRACING_EXPORT std::uint32_t seenOf(
  const Frustum& frustum, std::uint8_t within, const LooseObjects& objects);

/// onObject(object) for outsiders first, then for every object whose node and whose ball are not
/// outside of the frustum, in the order of LooseOctree::visit(). Before its objects,
/// onNode(const LooseNode&) for every such node. Allocates nothing.
template <class OnNode, class OnObject>
void eachSeen(const LooseOctree& objects, const Frustum& frustum, const VisitOrder& order,
  const OnNode& onNode, const OnObject& onObject)
{
  const auto allPlanes = static_cast<std::uint8_t>((1u << frustum.planes()) - 1u);
  objects.visitGroups(
    order,
    [&](const LooseNode& node, std::uint8_t& within)
    {
      if (frustum.outside(node.centre, glm::dvec3(node.half), within))
      {
        return false;
      }
      onNode(node);
      return true;
    },
    [&](const LooseObjects& some, std::uint8_t within)
    {
      if (within == allPlanes || !some.x)
      {
        for (std::uint32_t i = 0; i < some.count; ++i)
        {
          onObject(some.objects[i]);
        }
        return;
      }
      for (std::uint32_t seen = seenOf(frustum, within, some); seen != 0; seen &= seen - 1)
      {
        onObject(some.objects[__builtin_ctz(seen)]);
      }
    });
}
}

#endif
