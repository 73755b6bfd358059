#include "svoHitOrder.h"

#include "svoDepthSlope.h"
#include "svoIntersect.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
/// t without the digits that rounding spoils on the way to it: 32 are left. Surfaces that are no
/// further apart are equally deep; VTK's floats tell 24 digits.
double withoutNoise(double t)
{
  const double big = t * 2097153.0; // 2^21 + 1: the splitting of Veltkamp, 1968
  return big - (big - t);
}

bool lessInSpace(const glm::dvec3& a, const glm::dvec3& b)
{
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}
}

void HitOrder::merge(const TracedInstance& entry, const float* t, const Primitive* primitive,
  const TilePoints& at, MergedTile& merged) const
{
  // A NaN compares false and never wins.
  if (!merged.any)
  {
    std::uint32_t any = 0;
    for (int i = 0; i < 64; ++i)
    {
      any |= static_cast<std::uint32_t>(primitive[i] != NoPrimitive);
    }
    if (any)
    {
      merged.any = true;
      for (int i = 0; i < 64; ++i)
      {
        merged.t[i] = t[i];
        merged.primitive[i] = primitive[i];
        merged.instance[i] = primitive[i] == NoPrimitive ? NoInstance : entry.index;
      }
    }
    return;
  }
  for (int i = 0; i < 64; ++i)
  {
    if (primitive[i] == NoPrimitive)
    {
      continue;
    }
    const std::uint32_t winner = merged.instance[i];
    if (winner == NoInstance ||
      this->inFront({ entry.index, primitive[i], entry.local.base + t[i], at.x[i], at.y[i] },
        { winner, merged.primitive[i], this->linearDepth(winner, merged.t[i]), at.x[i], at.y[i] }))
    {
      merged.t[i] = t[i];
      merged.primitive[i] = primitive[i];
      merged.instance[i] = entry.index;
    }
  }
}

bool HitOrder::settle(const SeenHit& a, const SeenHit& b) const
{
  const double errorA = this->Instances.error(a.instance),
               errorB = this->Instances.error(b.instance);
  if (this->Instances.shifted() && !this->Instances.sloped())
  {
    if (this->rank(a.instance, a.t + errorA) < this->rank(b.instance, b.t - errorB))
    {
      return true;
    }
    if (this->rank(b.instance, b.t + errorB) < this->rank(a.instance, a.t - errorA))
    {
      return false;
    }
  }
  const double rankA = this->exactRank(a);
  const double rankB = this->exactRank(b);
  return rankA < rankB || (rankA == rankB && a.instance > b.instance);
}

double HitOrder::exactRank(const SeenHit& hit) const
{
  Primitive primitive = hit.primitive;
  const double t = this->exactDepth(hit, primitive);
  const double rank = this->rank(hit.instance, t);
  const double factor = this->Instances.offset(hit.instance).factor;
  if (!this->Instances.sloped() || factor == 0.0)
  {
    return rank;
  }
  const TracedInstance& entry = this->Instances.of(hit.instance);
  return rank +
    factor *
    steepness(
      *entry.octree, entry.local.toOctree, this->Instances.view(), hit.x, hit.y, t, primitive);
}

double HitOrder::exactDepth(const SeenHit& hit, Primitive& primitive) const
{
  const TracedInstance& entry = this->Instances.of(hit.instance);
  if (entry.refinement == DepthRefinement::Never)
  {
    return hit.t;
  }
  const LocalView& local = entry.local;
  const double error = this->Instances.error(hit.instance);
  if (entry.refinement == DepthRefinement::Traced)
  {
    const Ray ray{ local.originAt(hit.x, hit.y), local.directionAt(hit.x, hit.y),
      hit.t - local.base - error, hit.t - local.base + error };
    const Primitive triangle = intersect(*entry.octree, ray, { LeafGeometry::Triangle }).primitive;
    if (triangle == NoPrimitive)
    {
      return hit.t + error; // nodes reach beyond the mesh's borders: what has triangles there wins
    }
    primitive = triangle;
  }
  // In an order that does not depend on the triangle's winding.
  const glm::uvec3 triangle = entry.octree->surface()->triangles[primitive];
  glm::dvec3 p[3] = { entry.points.at(triangle.x), entry.points.at(triangle.y),
    entry.points.at(triangle.z) };
  std::sort(p, p + 3, lessInSpace);
  const glm::dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
  const glm::dmat3& toLocal = local.toOctree.inverse;
  const glm::dvec3 origin =
    toLocal * (this->Instances.view().rayOrigin(hit.x, hit.y) - local.toOctree.translation);
  const glm::dvec3 direction = toLocal * this->Instances.view().rayDirection(hit.x, hit.y);
  const double t = withoutNoise(glm::dot(normal, p[0] - origin) / glm::dot(normal, direction));
  return std::abs(t - hit.t) <= error ? t : hit.t; // t may be not a number
}
}
