// The objects of a loose octree that a view may see, front to back.
#ifndef svoSeenObjects_h
#define svoSeenObjects_h

#include "svoFrustum.h"
#include "svoLooseOctree.h"

namespace svo
{
/// onObject(object) for outsiders first, then for every object whose node and whose ball are not
/// outside of the frustum, in the order of LooseOctree::visit(). Allocates nothing.
template <class OnObject>
void eachSeen(const LooseOctree& objects, const Frustum& frustum, const VisitOrder& order,
  const OnObject& onObject)
{
  objects.visit(
    order,
    [&](const LooseNode& node, std::uint8_t& within)
    {
      const Frustum::Side side = frustum.box(node.centre, glm::dvec3(node.half), within);
      return side == Frustum::Side::Outside ? NodeVisit::Skip
        : side == Frustum::Side::Inside     ? NodeVisit::All
                                            : NodeVisit::Below;
    },
    [&](std::uint32_t object, bool all)
    {
      if (all)
      {
        onObject(object);
        return;
      }
      const Ball ball = objects.ball(object);
      if (!frustum.outside(ball.centre, ball.radius))
      {
        onObject(object);
      }
    });
}
}

#endif
