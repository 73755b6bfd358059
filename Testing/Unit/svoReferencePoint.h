// A visible point from its pixel and its depth alone: the oracle of the points of a tile.
#ifndef svoReferencePoint_h
#define svoReferencePoint_h

#include "svoSurfacePoint.h"

namespace svo
{
/// `t` is the linear depth of the hit on the ray of pixel (x, y).
inline SurfacePoint surfacePoint(const SurfaceMatrices& matrices, const View& view, double x,
  double y, double t, Primitive primitive)
{
  const glm::dvec3 ray = view.rayDirection(x, y);
  const glm::dvec3 position = view.rayOrigin(x, y) + t * ray;
  const glm::vec3 towards(-ray);
  const NodeTriangle hit = matrices.instance->body->octree.surface()
    ? triangleOfHit(matrices, position, towards, primitive)
    : NodeTriangle{};
  return pointOfTriangle(matrices, view, position, towards, hit.triangle, hit.at);
}
}

#endif
