#include "svoNodeTriangle.h"

#include "svoIntersect.h"

#include <cassert>

namespace svo
{
namespace
{
constexpr double FromOutside = 2.0; // more than the diagonal of the root cube
}

Primitive planeInSight(const Octree& octree, const glm::dvec3& x, const glm::dvec3& towards)
{
  assert(octree.hasPlanes());
  const glm::dvec3 direction = -glm::normalize(towards);
  const Ray ray{ x - FromOutside * direction, direction, 0.0, 2.0 * FromOutside };
  return intersect(octree, ray, { LeafGeometry::Plane }).primitive;
}

void settleTriangles(
  const Octree& octree, NodeTriangle* const* picked, const glm::dvec3* towards, int count)
{
  assert(count > 0 && count <= RayBlock::Size);
  RayBlock rays;
  for (int i = 0; i < RayBlock::Size; ++i)
  {
    const int k = std::min(i, count - 1);
    const glm::vec3 direction(-glm::normalize(towards[k]));
    const glm::vec3 origin(picked[k]->at - FromOutside * glm::dvec3(direction));
    rays.aim(i, origin, direction);
    rays.tMin[i] = i < count ? 0.0f : 1.0f;
    rays.tMax[i] = i < count ? static_cast<float>(2.0 * FromOutside) : 0.0f;
  }
  HitBlock hits;
  intersect(octree, rays, { LeafGeometry::Triangle }, hits);
  for (int i = 0; i < count; ++i)
  {
    if (hits.primitive[i] != NoPrimitive)
    {
      picked[i]->triangle = hits.primitive[i];
      picked[i]->at = glm::dvec3(rays.originX[i], rays.originY[i], rays.originZ[i]) +
        static_cast<double>(hits.t[i]) *
          glm::dvec3(rays.directionX[i], rays.directionY[i], rays.directionZ[i]);
    }
  }
}
}
