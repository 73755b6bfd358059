// From the world into an instance's octree coordinates, as exactly as doubles allow.
#ifndef svoWorldToOctree_h
#define svoWorldToOctree_h

#include "svoInverse.h"
#include "svoOctree.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// The largest coordinate, without its sign.
inline double largestOf(const glm::dvec3& v)
{
  return std::max({ std::abs(v.x), std::abs(v.y), std::abs(v.z) });
}

/// M^-1 and the octree's cube applied to a point, in the order that cancels common parts before
/// any rounding: 1 + (L^-1 (x - translation) - origin) / edge of the root cube. The error is
/// at most some condition(L) 2^-52 |x - translation| in the object (Documentation/Numerics.md).
struct WorldToOctree
{
  glm::dmat3 inverse{ 1.0 }; // L^-1, L being the linear part of the instance's matrix
  glm::dvec3 translation{ 0.0 };
  glm::dvec3 origin{ 0.0 };
  double scale = 1.0;

  WorldToOctree() = default;
  WorldToOctree(const Octree& octree, const glm::dmat4& localToWorld)
    : inverse(stableInverse(glm::dmat3(localToWorld)))
    , translation(localToWorld[3])
    , origin(octree.header().origin[0], octree.header().origin[1], octree.header().origin[2])
    , scale(1.0 / octree.rootEdge())
  {
    assert(octree.rootEdge() > 0.0);
  }
  glm::dvec3 point(const glm::dvec3& x) const
  {
    return 1.0 + (this->inverse * (x - this->translation) - this->origin) * this->scale;
  }
  glm::dvec3 vector(const glm::dvec3& v) const { return this->inverse * v * this->scale; }
  /// By how much what is linear in octree coordinates, as dot(g, x), grows along the world's axes.
  glm::dvec3 gradient(const glm::dvec3& g) const { return g * this->inverse * this->scale; }
};

/// From coordinates of an octree's cube, whose middle is 0 and whose edges are 1, to the world.
inline glm::dmat4 cubeToWorld(const Octree& octree, const glm::dmat4& localToWorld)
{
  const auto& corner = octree.header().origin;
  const double edge = octree.rootEdge();
  glm::dmat4 m(glm::dmat3(localToWorld) * edge);
  m[3] = localToWorld *
    glm::dvec4(corner[0] + 0.5 * edge, corner[1] + 0.5 * edge, corner[2] + 0.5 * edge, 1.0);
  return m;
}
}

#endif
