#include "svoShadowBeam.h"

#include "svoIntersectTile.h"
#include "svoPyramidNodes.h"
#include "svoSurface.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
/// Where rays from a light begin, the point being at 1: what the light lies on is not between.
constexpr double BeforeLight = 1e-9;

/// A beam's coordinates: depth along the axis, and two directions across it.
struct BeamBasis
{
  glm::dvec3 origin; // the light, or a point of the beam
  glm::dvec3 axis, u, v;

  BeamBasis(const glm::dvec3& from, const glm::dvec3& along)
    : origin(from)
    , axis(glm::normalize(along))
  {
    const glm::dvec3 size = glm::abs(this->axis);
    const glm::dvec3 other = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
      : size.y <= size.z                                          ? glm::dvec3(0, 1, 0)
                                                                  : glm::dvec3(0, 0, 1);
    this->u = glm::normalize(glm::cross(this->axis, other));
    this->v = glm::cross(this->axis, this->u);
  }
  double depth(const glm::dvec3& x) const { return glm::dot(this->axis, x - this->origin); }
};

/// A ray in double: the point of depth t is origin + t direction.
struct BeamRay
{
  glm::dvec3 origin, direction;
  double end; // depth of the shadowed point
};

glm::dvec4 planeThrough(const glm::dvec3& normal, const glm::dvec3& point)
{
  return { normal, -glm::dot(normal, point) };
}

/// Where the line of a ray meets a plane. NaN or infinite if it is parallel to it.
double depthOfPlane(const BeamRay& ray, const TrianglePlane& plane)
{
  return glm::dot(plane.normal, plane.p - ray.origin) / glm::dot(plane.normal, ray.direction);
}
}

bool traceBeam(const Octree& octree, const WorldToOctree& toOctree, const Light& light,
  const BeamPoints& points, BeamAnswer* answers, Primitive* nearest, std::size_t mostNodes)
{
  assert(points.count > 0 && points.count <= BeamPoints::Most && octree.surface());
  glm::dvec3 centre(0.0);
  for (int i = 0; i < points.count; ++i)
  {
    centre += points.at[i] / static_cast<double>(points.count);
  }
  const bool far = light.atInfinity();
  const glm::dvec3 source = far ? toOctree.vector(light.direction) : toOctree.point(light.position);
  const BeamBasis basis(far ? centre : source, far ? source : centre - source);

  // The cube's depths.
  const double edge = std::ldexp(1.0, -octree.rootBits(0));
  const glm::dvec3 low(1.0);
  const double half =
    0.5 * edge * (std::abs(basis.axis.x) + std::abs(basis.axis.y) + std::abs(basis.axis.z));
  const double middle = basis.depth(low + 0.5 * edge);
  const double base = far ? middle - half : std::max(middle - half, 0.0);
  const double behind = middle + half;

  // The beam's sides: slopes of rays from a light nearby, distances from the axis of others.
  BeamRay rays[BeamPoints::Most];
  const double infinity = std::numeric_limits<double>::infinity();
  double lowU = infinity, highU = -infinity, lowV = infinity, highV = -infinity, last = base;
  bool narrow = true;
  for (int i = 0; i < points.count; ++i)
  {
    const glm::dvec3 to = points.at[i] - basis.origin;
    const double end = glm::dot(basis.axis, to);
    const double u = glm::dot(basis.u, to), v = glm::dot(basis.v, to);
    const double slopeU = far ? u : u / end, slopeV = far ? v : v / end;
    narrow = narrow && (far || (end > 0.0 && std::abs(slopeU) < 1.0 && std::abs(slopeV) < 1.0));
    lowU = std::min(lowU, slopeU);
    highU = std::max(highU, slopeU);
    lowV = std::min(lowV, slopeV);
    highV = std::max(highV, slopeV);
    last = std::max(last, end);
    rays[i].end = end;
    rays[i].direction = far ? basis.axis : basis.axis + slopeU * basis.u + slopeV * basis.v;
    rays[i].origin = far ? points.at[i] - end * basis.axis : basis.origin;
  }
  if (!narrow)
  {
    return false;
  }
  std::fill_n(answers, points.count, BeamAnswer::Lit);
  if (!(last > base))
  {
    return true; // all points are nearer to the light than the octree
  }
  TilePyramid pyramid;
  const auto side = [&](const glm::dvec3& across, double slope, double sign)
  {
    const glm::dvec3 normal = far ? across : across - slope * basis.axis;
    glm::dvec4 plane = planeThrough(normal, basis.origin);
    plane.w -= far ? slope : 0.0;
    plane *= sign;
    plane.w += 2.0 * BeamRounding;
    return plane;
  };
  pyramid.side[0] = side(basis.u, lowU, 1.0);
  pyramid.side[1] = side(basis.u, highU, -1.0);
  pyramid.side[2] = side(basis.v, lowV, 1.0);
  pyramid.side[3] = side(basis.v, highV, -1.0);
  pyramid.t = planeThrough(basis.axis, basis.origin);
  pyramid.t.w -= base;
  const float tFar = static_cast<float>(std::min(last, behind) - base + BeamRounding);
  std::vector<TileNode> nodes;
  if (!findTileNodes(octree, pyramid, 0.0f, tFar, mostNodes, nodes))
  {
    return false;
  }
  if (nodes.empty())
  {
    return true;
  }

  RayBlock block;
  for (int i = 0; i < RayBlock::Size; ++i)
  {
    const BeamRay& ray = rays[std::min(i, points.count - 1)];
    const glm::dvec3 start = ray.origin + base * ray.direction;
    block.aim(i, start, ray.direction);
    block.tMin[i] = static_cast<float>(far ? 0.0 : std::max(BeforeLight * ray.end - base, 0.0));
    block.tMax[i] = i < points.count
      ? static_cast<float>(std::min(ray.end, behind) - base + BeamRounding)
      : -1.0f;
  }
  HitBlock hits;
  intersectTile(octree, pyramid, nodes, block, hits);
  for (int i = 0; i < points.count; ++i)
  {
    if (hits.primitive[i] != NoPrimitive)
    {
      const double plane =
        depthOfPlane(rays[i], TrianglePlane(*octree.surface(), hits.primitive[i]));
      const double t = std::isfinite(plane) ? plane : base + hits.t[i];
      const bool atLight = !far && t < BeforeLight * rays[i].end;
      answers[i] = atLight ? BeamAnswer::Undecided
        : t <= rays[i].end ? BeamAnswer::Dark
                           : BeamAnswer::Lit;
      if (nearest && answers[i] == BeamAnswer::Dark)
      {
        nearest[i] = hits.primitive[i];
      }
    }
  }
  return true;
}
}
