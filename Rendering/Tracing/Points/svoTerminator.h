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
  const Attributes& attributes = instance.body->attributes;
  const Surface* surface = instance.body->octree.surface();
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

/// What the points of a triangle share of the smooth surface: most of what it takes to know where
/// that is. The instance isSmooth().
struct SmoothTriangle
{
  SmoothTriangle() = default;
  SmoothTriangle(const SurfaceMatrices& matrices, Primitive primitive)
  {
    const Instance& instance = *matrices.instance;
    assert(instance.body->octree.surface() && instance.body->attributes.normals);
    const Surface& surface = *instance.body->octree.surface();
    const glm::uvec3 corners = surface.triangles[primitive];
    a = surface.points[corners.x];
    e1 = surface.points[corners.y] - a;
    e2 = surface.points[corners.z] - a;
    winding = matrices.windingMatrix * glm::cross(e1, e2);
    for (int i = 0; i < 3; ++i)
    {
      // Unit unless it is not finite, or 0.
      normals[i] = detail::normalized(
        matrices.normalMatrix * detail::vectorAt(instance.body->attributes.normals, corners[i]),
        glm::vec3(0.0f));
    }
  }

  glm::vec3 a, e1, e2;  // first corner and the others from there, octree coordinates
  glm::vec3 winding;    // world, to a factor
  glm::vec3 normals[3]; // of the corners, world; 0: none
};

/// The triangles of an instance that isSmooth(): made once where points of few triangles ask in
/// turn.
class SmoothTriangles
{
public:
  explicit SmoothTriangles(const SurfaceMatrices& matrices)
    : Matrices(matrices)
    , ToWorld(
        glm::dmat3(matrices.instance->localToWorld) * matrices.instance->body->octree.rootEdge())
  {
    std::fill_n(this->Primitives, Slots, NoPrimitive);
  }
  const SurfaceMatrices& matrices() const { return this->Matrices; }
  /// Octree coordinates -> world, of directions.
  const glm::dmat3& toWorld() const { return this->ToWorld; }
  const SmoothTriangle& operator[](Primitive triangle)
  {
    const Primitive slot = triangle % Slots;
    if (this->Primitives[slot] != triangle)
    {
      this->Primitives[slot] = triangle;
      this->Triangles[slot] = SmoothTriangle(this->Matrices, triangle);
    }
    return this->Triangles[slot];
  }

private:
  static constexpr Primitive Slots = 16;
  const SurfaceMatrices& Matrices;
  const glm::dmat3 ToWorld;
  Primitive Primitives[Slots];
  SmoothTriangle Triangles[Slots];
};

/// `towards`: to the viewer; `primitive`: of the hit.
inline SmoothSurface smoothSurfaceAt(SmoothTriangles& triangles, const SurfacePoint& point,
  const glm::vec3& towards, Primitive primitive)
{
  constexpr double LeastBend = 1e-5; // radians; rounding of normals is less
  SmoothSurface result;
  if (!(glm::dot(point.facet, point.normal) > 0.0f))
  {
    return result; // no normal of this facet
  }
  const NodeTriangle hit = triangleOfHit(triangles.matrices(), point.position, towards, primitive);
  const SmoothTriangle& triangle = triangles[hit.triangle];
  const glm::vec3 &e1 = triangle.e1, &e2 = triangle.e2;
  const glm::vec3 weight = nearWeights(glm::vec3(hit.at - glm::dvec3(triangle.a)), e1, e2);
  const float side = sideLane(triangle.winding, towards);
  const glm::vec3 at = weight.y * e1 + weight.z * e2; // from the first corner
  const glm::vec3 corners[3] = { glm::vec3(0.0f), e1, e2 };
  glm::dvec3 from[3];
  double below = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    const glm::vec3& normal = triangle.normals[i];
    const glm::dvec3 outwards(normal == glm::vec3(0.0f) ? point.facet : side * normal);
    from[i] = triangles.toWorld() * glm::dvec3(at - corners[i]);
    const double over = glm::dot(from[i], outwards); // of the point over the plane of this corner
    result.lift += weight[i] * std::max(0.0, -over) * outwards;
    below += weight[i] * std::max(0.0, over);
  }
  if (result.lift == glm::dvec3(0.0) && below > 0.0)
  {
    double away = 0.0;
    for (int i = 0; i < 3; ++i)
    {
      away += weight[i] * glm::length(from[i]);
    }
    result.hollow = below > LeastBend * away;
  }
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
  int pixel = 0; // of its patch
  SurfacePoint point{};
};

/// `grazing`: see turnsAway(). `dark`: the mesh itself shadows the point.
inline TerminatorPoint atTerminator(SmoothTriangles& triangles, const Light& light, double grazing,
  bool dark, const SurfacePoint& point, const glm::vec3& towards, Primitive primitive)
{
  TerminatorPoint result;
  const bool turned = turnsAway(light, point.position, point.facet, grazing);
  if (!turned && !(dark && turnsAway(light, point.position, point.facet, DoubtfulSine)))
  {
    return result;
  }
  const bool behind = turnsAway(light, point.position, point.facet, 0.0);
  const SmoothSurface smooth = smoothSurfaceAt(triangles, point, towards, primitive);
  if (smooth.lift != glm::dvec3(0.0) || (behind && !smooth.hollow))
  {
    result.kind = turned ? TerminatorPoint::Kind::Raised : TerminatorPoint::Kind::Doubted;
    result.point = point;
    result.point.position += smooth.lift;
    result.point.facet = point.normal;
  }
  else if (behind && triangles.matrices().instance->castShadow)
  {
    result.kind = TerminatorPoint::Kind::Hidden;
  }
  return result;
}
}

#endif
