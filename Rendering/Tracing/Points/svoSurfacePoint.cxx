#include "svoSurfacePoint.h"

namespace svo
{
// Not inline: where two doubles that lie side by side become floats, and these doubles again, GCC
// 12
// (-ftree-slp-vectorize) leaves the rounding out. Here `towards` is read as the floats that it is,
// whether they come from a tile or have just been computed.
NodeTriangle triangleOfHit(const SurfaceMatrices& matrices, const glm::dvec3& position,
  const glm::vec3& towards, Primitive primitive)
{
  if (!(primitive & NodePrimitive))
  {
    return { primitive, matrices.toOctree.point(position), true };
  }
  NodeTriangle picked = pickTriangle(matrices, primitive & ~NodePrimitive, position, towards);
  if (!picked.faces)
  {
    NodeTriangle* one[] = { &picked };
    const glm::dvec3 local = matrices.toOctree.vector(glm::dvec3(towards));
    settleTriangles(matrices.instance->body->octree, one, &local, 1);
  }
  return picked;
}
}
