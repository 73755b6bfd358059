// A visible point: its position, its normals and its colour.
#ifndef svoSurfacePoint_h
#define svoSurfacePoint_h

#include "svoNodeTriangle.h"
#include "svoRay.h"
#include "svoScene.h"
#include "svoView.h"
#include "svoWorldToOctree.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace svo
{
struct SurfacePoint
{
  glm::dvec3 position; // world
  glm::vec3 facet;     // world, unit, the surface's own plane, towards the viewer
  glm::vec3 normal;    // world, unit, for shading, flipped as VTK's shaders flip it
  glm::vec3 color;     // 0..1, of the mapped scalars; meaningless unless hasColor
  bool hasColor;
};

/// Matrices that all points of an instance share.
struct SurfaceMatrices
{
  SurfaceMatrices() = default; // of an instance without an octree, which is never seen
  explicit SurfaceMatrices(const Instance& i)
    : instance(&i)
    , toOctree(i.octree, i.localToWorld)
  {
    // Only directions of normals matter: without the scale a tiny object's overflow a float.
    glm::dmat3 linear(i.localToWorld);
    double most = 0.0;
    for (int c = 0; c < 3; ++c)
    {
      most = std::max(most, glm::length(linear[c]));
    }
    linear /= most;
    const double side = glm::determinant(linear) < 0.0 ? -1.0 : 1.0;
    const glm::dmat3 cofactor = glm::transpose(stableInverse(linear));
    normalMatrix = glm::mat3(cofactor);
    windingMatrix = glm::mat3(side * cofactor);
  }
  const Instance* instance = nullptr;
  WorldToOctree toOctree;
  glm::mat3 normalMatrix{ 1.0f };  // local normals -> world, to a factor
  glm::mat3 windingMatrix{ 1.0f }; // cross products of local edges -> world, to a factor
};

namespace detail
{
inline glm::vec3 normalized(const glm::vec3& v, const glm::vec3& otherwise)
{
  const float length2 = glm::dot(v, v);
  if (length2 > 1e-30f && length2 < 1e30f)
  {
    return v / std::sqrt(length2);
  }
  const double length = glm::length(glm::dvec3(v));
  return length > 0.0 && std::isfinite(length) ? glm::vec3(glm::dvec3(v) / length) : otherwise;
}
}

/// The triangle of a node; see pickTriangle(). `position` and `towards`, to the viewer: world.
inline NodeTriangle pickTriangle(const SurfaceMatrices& frame, std::uint32_t node,
  const glm::dvec3& position, const glm::vec3& towards)
{
  return pickTriangle(frame.instance->octree, node, frame.toOctree.point(position),
    frame.toOctree.vector(glm::dvec3(towards)),
    [&](const glm::vec3& n)
    { return glm::dot(detail::normalized(frame.windingMatrix * n, -towards), towards); });
}

/// A point of a triangle, with the attributes that the triangle has at `at`, octree coordinates.
inline SurfacePoint pointOfTriangle(const SurfaceMatrices& frame, const glm::dvec3& position,
  const glm::vec3& towards, Primitive primitive, const glm::dvec3& at)
{
  const Instance& instance = *frame.instance;
  const Attributes& attributes = instance.attributes;
  const Surface* surface = instance.octree.surface();
  SurfacePoint point;
  point.position = position;
  point.hasColor = false;
  point.color = glm::vec3(1.0f);
  if (!surface)
  {
    point.facet = point.normal = glm::normalize(towards);
    return point;
  }
  const glm::uvec3 triangle = surface->triangles[primitive];
  const glm::vec3 a = surface->points[triangle.x];
  const glm::vec3 e1 = surface->points[triangle.y] - a;
  const glm::vec3 e2 = surface->points[triangle.z] - a;
  const glm::vec3 winding =
    detail::normalized(frame.windingMatrix * glm::cross(e1, e2), glm::normalize(towards));
  const bool front = glm::dot(winding, towards) > 0.0f;
  point.facet = front ? winding : -winding;
  point.normal = point.facet;
  const bool pointNormals =
    attributes.normals && attributes.normalAssociation == Association::Point;
  const bool cellNormals = attributes.normals && attributes.normalAssociation == Association::Cell;
  const bool smooth = !instance.material.flat && pointNormals;
  const bool pointColors = attributes.colorCoordinates ||
    (attributes.colors && attributes.colorAssociation == Association::Point);
  glm::vec3 weight(1.0f, 0.0f, 0.0f);
  if (smooth || pointColors)
  {
    // Barycentric coordinates; a plane or voxel hit beside its triangle takes the nearest in it.
    weight = nearWeights(glm::vec3(at - glm::dvec3(a)), e1, e2);
  }
  const std::uint32_t cell = surface->cells.empty() ? primitive : surface->cells[primitive];
  if (smooth || cellNormals)
  {
    const glm::vec3 normal = smooth ? weight.x * detail::vectorAt(attributes.normals, triangle.x) +
        weight.y * detail::vectorAt(attributes.normals, triangle.y) +
        weight.z * detail::vectorAt(attributes.normals, triangle.z)
                                    : detail::vectorAt(attributes.normals, cell);
    point.normal = detail::normalized(frame.normalMatrix * normal, point.facet);
    point.normal = front ? point.normal : -point.normal;
  }
  if (attributes.colorCoordinates && attributes.colorTextureSize > 0)
  {
    const glm::vec2 place = weight.x * detail::coordinatesAt(attributes, triangle.x) +
      weight.y * detail::coordinatesAt(attributes, triangle.y) +
      weight.z * detail::coordinatesAt(attributes, triangle.z);
    point.color = detail::colorAt(attributes.colorTexture, detail::texelAt(attributes, place));
    point.hasColor = true;
  }
  else if (attributes.colors && attributes.colorAssociation == Association::Point)
  {
    point.color = weight.x * detail::colorAt(attributes.colors, triangle.x) +
      weight.y * detail::colorAt(attributes.colors, triangle.y) +
      weight.z * detail::colorAt(attributes.colors, triangle.z);
    point.hasColor = true;
  }
  else if (attributes.colors && attributes.colorAssociation == Association::Cell)
  {
    point.color = detail::colorAt(attributes.colors, cell);
    point.hasColor = true;
  }
  return point;
}

/// Turns the normal of a point to the side that VTK's shaders light, where that is not the one that
/// its ray sees: VTK's rule for facets without normals knows nothing of sheared projections, and
/// the rule for others calls the front of a mirrored picture its back. Only for views that are not
/// plain, and not for points without a surface.
VTKSVOTRACING_EXPORT void turnAsShaders(
  const SurfaceMatrices& frame, const View& view, SurfacePoint& point);

/// The triangle of a hit at `position`, and where on it to interpolate; `towards`, to the viewer:
/// world. The octree has a surface.
inline NodeTriangle triangleOfHit(const SurfaceMatrices& frame, const glm::dvec3& position,
  const glm::vec3& towards, Primitive primitive)
{
  if (!(primitive & NodePrimitive))
  {
    return { primitive, frame.toOctree.point(position), true };
  }
  NodeTriangle picked = pickTriangle(frame, primitive & ~NodePrimitive, position, towards);
  if (!picked.faces)
  {
    NodeTriangle* one[] = { &picked };
    const glm::dvec3 local = frame.toOctree.vector(glm::dvec3(towards));
    settleTriangles(frame.instance->octree, one, &local, 1);
  }
  return picked;
}

/// `t` is the linear depth of the hit on the ray of pixel (x, y).
inline SurfacePoint surfacePoint(
  const SurfaceMatrices& frame, const View& view, double x, double y, double t, Primitive primitive)
{
  const glm::dvec3 ray = view.rayDirection(x, y);
  const glm::dvec3 position = view.rayOrigin(x, y) + t * ray;
  const glm::vec3 towards(-ray);
  if (!frame.instance->octree.surface())
  {
    return pointOfTriangle(frame, position, towards, primitive, frame.toOctree.point(position));
  }
  const NodeTriangle hit = triangleOfHit(frame, position, towards, primitive);
  SurfacePoint point = pointOfTriangle(frame, position, towards, hit.triangle, hit.at);
  if (!view.plain)
  {
    turnAsShaders(frame, view, point);
  }
  return point;
}
}

#endif
