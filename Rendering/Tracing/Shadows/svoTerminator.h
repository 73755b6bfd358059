// The shadow terminator: where a facet has turned its back on a light that the smooth normal still
// faces. The facet itself is dark there, in patches with the outline of facets; the curved surface
// that the normals stand for is not. Shadows are therefore asked for on that surface.
//
// Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021, chapter 4. Here only for
// facets that are turned away, so that shadows on all others stay exact; and only where the surface
// bulges outwards: a hollow is in its own shadow.
#ifndef svoTerminator_h
#define svoTerminator_h

#include "svoScene.h"
#include "svoSurfacePoint.h"

#include <algorithm>
#include <cassert>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace svo
{
/// True if normals of the mesh's points are interpolated and are not just those of its facets; of
/// large meshes the latter is not examined.
inline bool isSmooth(const Instance& instance)
{
  constexpr std::size_t Few = 256; // triangles: few enough to be examined in every frame
  constexpr double Flat = 1e-5;    // radians; rounding of normals is less
  const Attributes& attributes = instance.attributes;
  const Surface* surface = instance.octree.surface();
  if (instance.material.flat || !attributes.normals ||
    attributes.normalAssociation != Association::Point || !surface)
  {
    return false;
  }
  const double side = glm::determinant(glm::dmat3(instance.localToWorld)) < 0.0 ? -1.0 : 1.0;
  const auto bends = [&](const glm::uvec3& triangle)
  {
    const glm::dvec3 a(surface->points[triangle.x]);
    const glm::dvec3 b(surface->points[triangle.y]), c(surface->points[triangle.z]);
    const glm::dvec3 winding = side * glm::cross(b - a, c - a);
    for (int i = 0; i < 3; ++i)
    {
      const glm::dvec3 normal(detail::vectorAt(attributes.normals, triangle[i]));
      const double most = Flat * glm::length(winding) * glm::length(normal);
      if (!(glm::length(glm::cross(winding, normal)) <= most && glm::dot(winding, normal) >= 0.0))
      {
        return true;
      }
    }
    return false;
  };
  return surface->triangles.size() > Few ||
    std::any_of(surface->triangles.begin(), surface->triangles.end(), bends);
}

/// True if light that arrives at a point meets the facet there from behind, or so flat that the
/// sine is at most `grazing`.
inline bool turnsAway(
  const Light& light, const glm::dvec3& position, const glm::vec3& facet, double grazing)
{
  const glm::dvec3 along = light.along(position);
  const double behind = glm::dot(glm::dvec3(facet), along);
  return behind > 0.0 || behind * behind < grazing * grazing * glm::dot(along, along);
}

/// The smooth surface at a point of the mesh.
struct SmoothSurface
{
  glm::dvec3 lift{ 0.0 }; // world; to the smooth surface, where it bulges towards the viewer
  bool hollow = false;    // the smooth surface bends away from the viewer only
};

/// `towards`: to the viewer; `primitive`: of the hit. The instance isSmooth().
inline SmoothSurface smoothSurfaceAt(const SurfaceMatrices& frame, const SurfacePoint& point,
  const glm::vec3& towards, Primitive primitive)
{
  assert(frame.instance->octree.surface() && frame.instance->attributes.normals);
  constexpr double LeastBend = 1e-5; // radians; rounding of normals is less
  SmoothSurface result;
  const Instance& instance = *frame.instance;
  if (!(glm::dot(point.facet, point.normal) > 0.0f))
  {
    return result; // no normal of this facet
  }
  const NodeTriangle hit = triangleOfHit(frame, point.position, towards, primitive);
  const Surface& surface = *instance.octree.surface();
  const glm::uvec3 triangle = surface.triangles[hit.triangle];
  const glm::vec3 a = surface.points[triangle.x];
  const glm::vec3 e1 = surface.points[triangle.y] - a;
  const glm::vec3 e2 = surface.points[triangle.z] - a;
  const glm::vec3 weight = nearWeights(glm::vec3(hit.at - glm::dvec3(a)), e1, e2);
  const bool front = glm::dot(frame.windingMatrix * glm::cross(e1, e2), towards) > 0.0f;
  const glm::dmat3 toWorld = glm::dmat3(instance.localToWorld) * instance.octree.rootEdge();
  const glm::vec3 at = weight.y * e1 + weight.z * e2; // from the first corner
  const glm::vec3 corners[3] = { glm::vec3(0.0f), e1, e2 };
  double away = 0.0, below = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    const glm::vec3 normal = detail::normalized(
      frame.normalMatrix * detail::vectorAt(instance.attributes.normals, triangle[i]),
      front ? point.facet : -point.facet);
    const glm::dvec3 outwards(front ? normal : -normal);
    const glm::dvec3 from = toWorld * glm::dvec3(at - corners[i]);
    const double over = glm::dot(from, outwards); // of the point over the plane of this corner
    result.lift += weight[i] * std::max(0.0, -over) * outwards;
    below += weight[i] * std::max(0.0, over);
    away += weight[i] * glm::length(from);
  }
  result.hollow = result.lift == glm::dvec3(0.0) && below > LeastBend * away;
  return result;
}

/// Sine of the light's angle to a facet up to which facets beside it may have turned away and
/// shadow it: on ridges and saddles, with the outline of facets as well.
constexpr double DoubtfulSine = 0.25;

/// The shadow test that a visible point needs from one light.
struct TerminatorPoint
{
  enum class Kind
  {
    Plain,   // shadows are asked for at the point itself
    Raised,  // ... at `point`: on the smooth surface, its facet the plane that it is shaded with
    Doubted, // the mesh shadows the point; it is lit if rays find `point` lit
    Hidden   // light would have to come through its facet
  };
  Kind kind = Kind::Plain;
  SurfacePoint point{};
};

/// `grazing`: see turnsAway(). `dark`: the mesh itself shadows the point. The instance isSmooth().
inline TerminatorPoint atTerminator(const SurfaceMatrices& frame, const Light& light,
  double grazing, bool dark, const SurfacePoint& point, const glm::vec3& towards,
  Primitive primitive)
{
  TerminatorPoint result;
  const bool turned = turnsAway(light, point.position, point.facet, grazing);
  if (!turned && !(dark && turnsAway(light, point.position, point.facet, DoubtfulSine)))
  {
    return result;
  }
  const bool behind = turnsAway(light, point.position, point.facet, 0.0);
  const SmoothSurface smooth = smoothSurfaceAt(frame, point, towards, primitive);
  if (smooth.lift != glm::dvec3(0.0) || (behind && !smooth.hollow))
  {
    result.kind = turned ? TerminatorPoint::Kind::Raised : TerminatorPoint::Kind::Doubted;
    result.point = point;
    result.point.position += smooth.lift;
    result.point.facet = point.normal;
  }
  else if (behind && frame.instance->castShadow)
  {
    result.kind = TerminatorPoint::Kind::Hidden;
  }
  return result;
}
}

#endif
