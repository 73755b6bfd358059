// The triangle, or plane, that stands for a node above the bricks, where a ray stopped for level of
// detail.
//
// The point that is shaded lies on the node's mean plane, which is no normal to shade with: the
// node has faces in it that the viewer does not see. So a triangle of the node is taken that faces
// the viewer. At a silhouette there may be none: the widened node reaches beyond the edge of the
// object, and holds what lies behind it. On a sheet that is seen from behind there is none either,
// and the triangle is right. A ray to the triangle tells the two apart: what it meets first is what
// the viewer sees there. (A closed mesh that is wound the wrong way round is the harder case: what
// its silhouettes hide seems to face the viewer, and is believed.)
#ifndef svoNodeTriangle_h
#define svoNodeTriangle_h

#include "svoLeafGeometry.h"
#include "svoNode.h"
#include "svoOctree.h"
#include "svoPointLane.h"
#include "svoRay.h"
#include "vtkSVOTracingModule.h"

#include <cassert>
#include <cstdint>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// A triangle that stands for a node, and where on it.
struct NodeTriangle
{
  Primitive triangle;
  glm::dvec3 at; // where to interpolate, octree coordinates
  bool faces;    // the triangle faces the viewer; if not, it is to be settled
};

namespace detail
{
/// The brick of a node that is nearest to the viewer, roughly. `towards`: to the viewer, octree
/// coordinates.
inline std::uint32_t nearestBrick(
  const Octree& octree, std::uint32_t node, const glm::dvec3& towards)
{
  // Cell indices in this order come nearest first along each axis.
  const int flip =
    (towards.x > 0.0 ? 011 : 0) | (towards.y > 0.0 ? 022 : 0) | (towards.z > 0.0 ? 044 : 0);
  assert(node < octree.header().nodeCount);
  while (node < octree.brickBegin())
  {
    const Node& inner = octree.nodes()[node];
    int i = 0;
    while (!hasChild(inner, i ^ flip))
    {
      ++i;
    }
    node = child(inner, i ^ flip);
  }
  return node;
}

/// The point of a triangle that is near x, a little inside, so that no rounding makes a ray miss.
inline glm::dvec3 pointInside(const Surface& surface, Primitive triangle, const glm::dvec3& x)
{
  const glm::uvec3 corners = surface.triangles[triangle];
  const glm::vec3 a = surface.points[corners.x];
  const glm::vec3 e1 = surface.points[corners.y] - a;
  const glm::vec3 e2 = surface.points[corners.z] - a;
  const glm::vec3 near = nearWeights(glm::vec3(x - glm::dvec3(a)), e1, e2);
  const glm::vec3 weight = glm::mix(near, glm::vec3(1.0f / 3.0f), 0.125f);
  return glm::dvec3(a) + glm::dvec3(weight.y * e1 + weight.z * e2);
}

/// Squared distance of a triangle, near x, from the line through x; `along`: unit, of the line.
inline float distanceFromLine(const glm::vec3& a, const glm::vec3& e1, const glm::vec3& e2,
  const glm::vec3& x, const glm::vec3& along)
{
  const glm::vec3 weight = nearWeights(x - a, e1, e2);
  const glm::vec3 to = a + weight.y * e1 + weight.z * e2 - x;
  const glm::vec3 beside = to - glm::dot(to, along) * along;
  return glm::dot(beside, beside);
}
}

/// Of the brick of a node that is nearest to the viewer, the triangle nearest to the line of sight
/// that faces the viewer; where none does, the one that is turned away least. `x`: where the ray
/// met the node; `towards`: to the viewer, of any length; both in octree coordinates. `cosine(n)`:
/// of the viewer with the side that a triangle winds to; n: cross product of its edges, octree
/// coordinates. The octree has a surface.
template <class Cosine>
NodeTriangle pickTriangle(const Octree& octree, std::uint32_t node, const glm::dvec3& x,
  const glm::dvec3& towards, const Cosine& cosine)
{
  std::uint32_t count, inlineId;
  const std::uint32_t* list =
    octree.brickTriangles(detail::nearestBrick(octree, node, towards), count, inlineId);
  assert(count > 0 && octree.surface());
  const Surface& surface = *octree.surface();
  const glm::vec3 along(glm::normalize(towards));
  NodeTriangle picked{ list[0], x, false };
  float nearest = std::numeric_limits<float>::max();
  float most = -std::numeric_limits<float>::max();
  for (std::uint32_t k = 0; k < count && !(picked.faces && k >= RepresentativeCandidates); ++k)
  {
    const glm::uvec3 corners = surface.triangles[list[k]];
    const glm::vec3 a = surface.points[corners.x];
    const glm::vec3 e1 = surface.points[corners.y] - a;
    const glm::vec3 e2 = surface.points[corners.z] - a;
    const float c = cosine(glm::cross(e1, e2));
    if (c > 0.0f)
    {
      const float distance = detail::distanceFromLine(a, e1, e2, glm::vec3(x), along);
      if (!picked.faces || distance < nearest)
      {
        picked = { list[k], x, true };
        nearest = distance;
      }
    }
    else if (!picked.faces && c > most)
    {
      picked.triangle = list[k];
      most = c;
    }
  }
  if (!picked.faces)
  {
    picked.at = detail::pointInside(surface, picked.triangle, x);
  }
  return picked;
}

/// Of an octree of planes: what the line of sight through `x` meets first, or NoPrimitive.
/// `towards`: to the viewer, of any length; both in octree coordinates.
VTKSVOTRACING_EXPORT Primitive planeInSight(
  const Octree& octree, const glm::dvec3& x, const glm::dvec3& towards);

/// Settles up to 64 triangles that do not face the viewer: each becomes the first hit of the line
/// of sight that passes through it. The answer to one does not depend on the others. `towards`: as
/// of pickTriangle(), one each.
VTKSVOTRACING_EXPORT void settleTriangles(
  const Octree& octree, NodeTriangle* const* picked, const glm::dvec3* towards, int count);
}

#endif
