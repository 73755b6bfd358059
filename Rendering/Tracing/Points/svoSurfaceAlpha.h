// The alpha of the mapped colours at a hit: what translucent casters take of a light.
#ifndef svoSurfaceAlpha_h
#define svoSurfaceAlpha_h

#include "svoSurfacePoint.h"

#include <cstdint>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace svo
{
namespace detail
{
inline float alphaAt(const unsigned char* colors, std::size_t i)
{
  return static_cast<float>(colors[4 * i + 3]) / 255.0f;
}

/// Of a triangle, by weights of its corners; the colour's own rules.
inline float alphaOfTriangle(
  const TriangleLook& look, const Surface& surface, Primitive primitive, const glm::vec3& weight)
{
  const Attributes& attributes = look.attributes;
  if (look.textured)
  {
    return alphaAt(attributes.colorTexture,
      static_cast<std::size_t>(texelAt(attributes, weighted(weight, look.coordinates))));
  }
  if (look.coloredByPoints)
  {
    const glm::uvec3 corners = surface.triangles[primitive];
    return weight.x * alphaAt(attributes.colors, corners.x) +
      weight.y * alphaAt(attributes.colors, corners.y) +
      weight.z * alphaAt(attributes.colors, corners.z);
  }
  return look.hasColor
    ? alphaAt(attributes.colors, surface.cells.empty() ? primitive : surface.cells[primitive])
    : 1.0f;
}

/// At `at`, octree coordinates.
inline float alphaOfTriangle(
  const SurfaceMatrices& matrices, Primitive primitive, const glm::dvec3& at)
{
  const TriangleLook look(matrices, primitive);
  return alphaOfTriangle(
    look, *matrices.instance->body->octree.surface(), primitive, look.weights(at));
}

/// Of an octree of planes.
inline float alphaOfPlane(
  const SurfaceMatrices& matrices, Primitive primitive, const glm::dvec3& position)
{
  const Attributes& attributes = matrices.instance->body->attributes;
  if (!attributes.colors || attributes.colorAssociation != Association::Leaf)
  {
    return 1.0f;
  }
  const std::uint32_t plane = primitive & NodePrimitive
    ? nearestVoxel(matrices.instance->body->octree, primitive & ~NodePrimitive,
        matrices.toOctree.point(position))
    : primitive;
  return alphaAt(attributes.colors, plane);
}
}

/// 0..1; 1 where the surface has no colours. `towards`, to where the ray comes from: world.
inline float surfaceAlpha(const SurfaceMatrices& matrices, const glm::dvec3& position,
  const glm::vec3& towards, Primitive primitive)
{
  const Octree& octree = matrices.instance->body->octree;
  if (octree.hasPlanes())
  {
    return detail::alphaOfPlane(matrices, primitive, position);
  }
  if (!octree.surface())
  {
    return 1.0f;
  }
  const NodeTriangle hit = triangleOfHit(matrices, position, towards, primitive);
  return glm::clamp(detail::alphaOfTriangle(matrices, hit.triangle, hit.at), 0.0f, 1.0f);
}
}

#endif
