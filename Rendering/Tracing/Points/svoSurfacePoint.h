// A visible point: its position, its normals and its colour.
#ifndef svoSurfacePoint_h
#define svoSurfacePoint_h

#include "svoNodeTriangle.h"
#include "svoPlane.h"
#include "svoRay.h"
#include "svoScene.h"
#include "svoView.h"
#include "svoVoxelLook.h"
#include "svoWorldToOctree.h"

#include <algorithm>
#include <cassert>
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
  SurfaceMatrices() = default; // of an instance that the eye does not see
  explicit SurfaceMatrices(const Instance& i)
    : instance(&i)
    , toOctree(i.body->octree, i.localToWorld)
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
  if (hasUnitLane(v))
  {
    return unitLane(v);
  }
  const double length = glm::length(glm::dvec3(v));
  return length > 0.0 && std::isfinite(length) ? glm::vec3(glm::dvec3(v) / length) : otherwise;
}
}

/// The triangle of a node; see pickTriangle(). `position` and `towards`, to the viewer: world.
inline NodeTriangle pickTriangle(const SurfaceMatrices& matrices, std::uint32_t node,
  const glm::dvec3& position, const glm::vec3& towards)
{
  return pickTriangle(matrices.instance->body->octree, node, matrices.toOctree.point(position),
    matrices.toOctree.vector(glm::dvec3(towards)),
    [&](const glm::vec3& n)
    { return glm::dot(detail::normalized(matrices.windingMatrix * n, -towards), towards); });
}

/// What the points of a triangle share; the octree of `matrices` has a surface.
struct TriangleLook
{
  TriangleLook(const SurfaceMatrices& matrices, Primitive primitive)
    : attributes(matrices.instance->body->attributes)
  {
    assert(matrices.instance->body->octree.surface());
    const Surface& surface = *matrices.instance->body->octree.surface();
    assert(primitive < surface.triangles.size());
    const glm::uvec3 triangle = surface.triangles[primitive];
    const std::uint32_t cell = surface.cells.empty() ? primitive : surface.cells[primitive];
    a = surface.points[triangle.x];
    e1 = surface.points[triangle.y] - a;
    e2 = surface.points[triangle.z] - a;
    winding = matrices.windingMatrix * glm::cross(e1, e2);
    normal = attributes.normals && attributes.normalAssociation == Association::Cell
      ? matrices.normalMatrix * detail::vectorAt(attributes.normals, cell)
      : winding;
    smooth = !matrices.instance->material.flat && attributes.normals &&
      attributes.normalAssociation == Association::Point;
    textured = attributes.colorCoordinates && attributes.colorTextureSize > 0;
    const Association colored =
      attributes.colors && !textured ? attributes.colorAssociation : Association::None;
    coloredByPoints = colored == Association::Point;
    hasColor = textured || colored != Association::None;
    colors[0] =
      colored == Association::Cell ? detail::colorAt(attributes.colors, cell) : glm::vec3(1.0f);
    for (int i = 0; i < 3; ++i)
    {
      if (smooth)
      {
        normals[i] = detail::vectorAt(attributes.normals, triangle[i]);
      }
      if (textured)
      {
        coordinates[i] = detail::coordinatesAt(attributes, triangle[i]);
      }
      if (coloredByPoints)
      {
        colors[i] = detail::colorAt(attributes.colors, triangle[i]);
      }
    }
  }
  /// True if points differ by more than the side that faces the viewer.
  bool needsWeights() const { return smooth || textured || coloredByPoints; }
  /// `at`: octree coordinates. A plane or voxel hit beside its triangle takes the nearest in it.
  glm::vec3 weights(const glm::dvec3& at) const
  {
    return nearWeights(glm::vec3(at - glm::dvec3(a)), e1, e2);
  }
  glm::vec3 color(const glm::vec3& weight) const
  {
    return textured     ? detail::colorAt(attributes.colorTexture,
                            detail::texelAt(attributes, weighted(weight, coordinates)))
      : coloredByPoints ? weighted(weight, colors)
                        : colors[0];
  }

  const Attributes& attributes;
  glm::vec3 a, e1, e2;  // first corner and the others from there, octree coordinates
  glm::vec3 winding;    // world, to a factor: the triangle's own
  glm::vec3 normal;     // world, to a factor: of all points, unless smooth
  glm::vec3 normals[3]; // local: of the corners, if smooth
  glm::vec2 coordinates[3];
  glm::vec3 colors[3];
  bool smooth, textured, coloredByPoints, hasColor;
};

/// Whether the normal of a point is turned to the side that VTK's shaders light, which is not
/// always the one that its ray sees: VTK's rule for facets without normals knows nothing of sheared
/// projections, and the rule for others calls the front of a mirrored picture its back.
inline bool shadersTurn(const SurfaceMatrices& matrices, const View& view,
  const glm::dvec3& position, const glm::vec3& facet)
{
  const Attributes& attributes = matrices.instance->body->attributes;
  if (view.plain)
  {
    return false;
  }
  if (attributes.normals &&
    (!matrices.instance->material.flat || attributes.normalAssociation == Association::Cell))
  {
    return view.mirrored;
  }
  const glm::dvec3 along = view.facetsFaceAxis ? view.axis : position - view.eye;
  return glm::dot(glm::dvec3(facet), along) > 0.0;
}

/// The normal, octree coordinates, of the face of a voxel that the point is on: of those that face
/// the viewer the nearest.
inline glm::vec3 faceOfVoxel(const Octree& octree, const glm::dvec3& at, const glm::dvec3& towards)
{
  const glm::dvec3 place = (at - 1.0) * std::ldexp(1.0, octree.rootBits(octree.level()));
  const glm::dvec3 beside = glm::abs(place - glm::round(place));
  const int axis = beside.x <= beside.y && beside.x <= beside.z ? 0 : beside.y <= beside.z ? 1 : 2;
  glm::vec3 normal(0.0f);
  normal[axis] = towards[axis] < 0.0 ? -1.0f : 1.0f;
  return normal;
}

/// A point of an octree of planes: on the plane that was hit, of a voxel or of a node, or on the
/// face of a voxel that is a cube. Where a node's mean plane faces away, the line of sight tells a
/// surface that is seen from behind from a node that reaches beyond the outline: there it meets
/// nothing, and the outline's normal is across it. The normal to shade with and the colour are
/// interpolated between voxels, where the material wants it; else they are those of the voxel,
/// colours of a node those of the nearest one in it.
inline SurfacePoint pointOfPlane(const SurfaceMatrices& matrices, const View& view,
  const glm::dvec3& position, const glm::vec3& towards, Primitive primitive)
{
  const Octree& octree = matrices.instance->body->octree;
  const glm::vec3 forwards = glm::normalize(towards);
  const auto inWorld = [&](const glm::vec3& normal)
  { return detail::normalized(matrices.normalMatrix * normal, forwards); };
  const bool node = primitive & NodePrimitive;
  const bool cube = !node && matrices.instance->body->leafGeometry == LeafGeometry::Voxel;
  const glm::dvec3 at = matrices.toOctree.point(position);
  const glm::vec3 own = cube
    ? faceOfVoxel(octree, at, matrices.toOctree.vector(glm::dvec3(towards)))
    : decodePlane(
        node ? octree.nodes()[primitive & ~NodePrimitive].plane : octree.lists()[primitive])
        .normal;
  glm::vec3 outwards = inWorld(own);
  if (const float away = glm::dot(outwards, forwards); node && away < 0.0f)
  {
    const Primitive seen = planeInSight(octree, at, matrices.toOctree.vector(glm::dvec3(towards)));
    outwards = seen != NoPrimitive ? inWorld(decodePlane(octree.lists()[seen]).normal)
                                   : detail::normalized(outwards - away * forwards, forwards);
  }
  const float side = sideLane(outwards, towards);
  const glm::vec3 facet = side * outwards;
  const Attributes& attributes = matrices.instance->body->attributes;
  const bool colored = attributes.colors && attributes.colorAssociation == Association::Leaf;
  const auto colorOf = [&](std::uint32_t plane)
  { return detail::colorAt(attributes.colors, plane); };
  glm::vec3 color = colored
    ? colorOf(node ? nearestVoxel(octree, primitive & ~NodePrimitive, at) : primitive)
    : glm::vec3(1.0f);
  glm::vec3 normal = facet;
  if (!node && !cube && !matrices.instance->material.flatPlanes)
  {
    const VoxelsAround around = voxelsAround(octree, at, own);
    normal = side * inWorld(smoothNormal(around, own));
    color = colored ? smoothColor(around, color, colorOf) : color;
    // On an outline it may turn away although its plane does not.
    if (const float away = glm::dot(normal, forwards); away < 0.0f)
    {
      normal = detail::normalized(normal - away * forwards, facet);
    }
  }
  return { position, facet, shadersTurn(matrices, view, position, facet) ? -normal : normal, color,
    colored };
}

/// A point of a triangle, with the attributes that the triangle has at `at`, octree coordinates;
/// without a surface of the octree's own plane, or whatever faces the viewer. `towards`: to the
/// viewer; world.
inline SurfacePoint pointOfTriangle(const SurfaceMatrices& matrices, const View& view,
  const glm::dvec3& position, const glm::vec3& towards, Primitive primitive, const glm::dvec3& at)
{
  if (matrices.instance->body->octree.hasPlanes())
  {
    return pointOfPlane(matrices, view, position, towards, primitive);
  }
  const glm::vec3 forwards = glm::normalize(towards);
  if (!matrices.instance->body->octree.surface())
  {
    return { position, forwards, forwards, glm::vec3(1.0f), false };
  }
  const TriangleLook look(matrices, primitive);
  const glm::vec3 winding = detail::normalized(look.winding, forwards);
  const glm::vec3 weight = look.needsWeights() ? look.weights(at) : glm::vec3(1.0f, 0.0f, 0.0f);
  const float side = sideLane(winding, towards);
  const glm::vec3 facet = side * winding;
  const glm::vec3 normal = side *
    detail::normalized(
      look.smooth ? matrices.normalMatrix * weighted(weight, look.normals) : look.normal, facet);
  return { position, facet, shadersTurn(matrices, view, position, facet) ? -normal : normal,
    look.color(weight), look.hasColor };
}

/// The triangle of a hit at `position`, and where on it to interpolate; `towards`, to the viewer:
/// world. The octree has a surface.
VTKSVOTRACING_EXPORT NodeTriangle triangleOfHit(const SurfaceMatrices& matrices,
  const glm::dvec3& position, const glm::vec3& towards, Primitive primitive);
}

#endif
