// Who is in front: surfaces that have the same vertices, of whatever octrees, are equally deep, and
// the later one is seen, as in VTK. Octrees round the vertices and stop at nodes; so where hits lie
// within their errors of each other, their depths are found again from the mesh's own points.
#include "svoLayeredView.h"

#include "svoDepthSlope.h"
#include "svoIntersect.h"
#include "svoLeafError.h"
#include "svoPlaceOnTriangles.h"

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

LayeredView::DepthRefinement LayeredView::refinementOf(
  const Instance& instance, const VisibleInstance& visible, double& error) const
{
  const Octree& octree = instance.body->octree;
  const LeafTraits traits = traitsOf(visible.key.leafGeometry);
  if (!this->Exact || traits.shape == CellShape::Cube || !octree.surface() ||
    !instance.body->points || instance.body->points.count != octree.surface()->points.size())
  {
    return DepthRefinement::Never;
  }
  const int level = visible.key.level;
  const bool nodes = stopsAtNodes(instance, level);
  error = edgeOnReach(visible.local);
  if (visible.tiles || (!nodes && octree.longestList() <= traits.longestExact))
  {
    return DepthRefinement::OnTriangle;
  }
  error = std::max(error, (nodes ? MeanPlaneError : CubeError) * worldVoxel(instance, level));
  return DepthRefinement::Traced;
}

bool LayeredView::settle(const SeenHit& a, const SeenHit& b) const
{
  const double errorA = this->Errors[a.instance], errorB = this->Errors[b.instance];
  if (this->Shifted && !this->Sloped)
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

double LayeredView::exactRank(const SeenHit& hit) const
{
  Primitive primitive = hit.primitive;
  const double t = this->exactDepth(hit, primitive);
  const double rank = this->rank(hit.instance, t);
  const double factor = this->Offsets[hit.instance].factor;
  if (!this->Sloped || factor == 0.0)
  {
    return rank;
  }
  const Entry& entry = this->Instances[this->EntryOf[hit.instance]];
  return rank +
    factor * steepness(*entry.octree, entry.local.toOctree, this->Seen, hit.x, hit.y, t, primitive);
}

double LayeredView::exactDepth(const SeenHit& hit, Primitive& primitive) const
{
  const Entry& entry = this->Instances[this->EntryOf[hit.instance]];
  if (entry.refinement == DepthRefinement::Never)
  {
    return hit.t;
  }
  const LocalView& local = entry.local;
  const double error = this->Errors[hit.instance];
  if (entry.refinement == DepthRefinement::Traced)
  {
    const Ray ray{ local.origin + hit.y * local.originY + hit.x * local.originX,
      local.direction + hit.y * local.directionY + hit.x * local.directionX,
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
    toLocal * (this->Seen.rayOrigin(hit.x, hit.y) - local.toOctree.translation);
  const glm::dvec3 direction = toLocal * this->Seen.rayDirection(hit.x, hit.y);
  const double t = withoutNoise(glm::dot(normal, p[0] - origin) / glm::dot(normal, direction));
  return std::abs(t - hit.t) <= error ? t : hit.t; // t may be not a number
}
}
