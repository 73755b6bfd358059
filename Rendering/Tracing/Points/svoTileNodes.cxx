#include "svoTileNodes.h"

#include "svoSurfacePoint.h"
#include "svoTileLook.h"

#include <cassert>

namespace svo
{
void lookAtNodes(const SurfaceMatrices& frame, std::uint64_t lanes, TilePatch& patch)
{
  assert((lanes & ~patch.mask) == 0 && frame.instance->body->octree.surface());
  NodeTriangle picked[TilePatch::Most];
  NodeTriangle* doubtful[TilePatch::Most];
  glm::dvec3 towards[TilePatch::Most];
  int doubts = 0;
  eachBit(lanes,
    [&](int i)
    {
      const glm::vec3 to = patch.towards(i);
      const Primitive primitive = patch.hits->primitive[i];
      assert(primitive & NodePrimitive);
      picked[i] = pickTriangle(frame, primitive & ~NodePrimitive, patch.position(i), to);
      if (!picked[i].faces)
      {
        towards[doubts] = frame.toOctree.vector(glm::dvec3(to));
        doubtful[doubts++] = &picked[i];
      }
    });
  if (doubts > 0)
  {
    settleTriangles(frame.instance->body->octree, doubtful, towards, doubts);
  }
  eachBit(lanes, [&](int i) { lookAtPoint(frame, picked[i].triangle, picked[i].at, i, patch); });
}
}
