// What a ray meets in the cells where it stops: cubes, planes or triangles.
//
// A walk (svoTraverse.h, or a vector kernel, lane by lane) hands each occupied cell, front to back,
// to meetCell(), which keeps the nearest hit in a LeafHit and says how to go on; finish() then
// settles rays that were refused everywhere. All of it is templated on the precision of the ray.
//
//   voxel      the point where the ray enters the cell.
//   plane      the plane of a representative triangle, where it passes the cell widened by one cell
//              on all sides; else the ray walks on. A ray that finds nothing to its end is given
//              the entry of the first cell that refused it, so that a closed mesh never shows a
//              hole. A ray that starts in a cell, beyond that cell's plane, is not refused: it has
//              left the surface behind.
//   triangle   the triangles that touch the cell's brick, exactly and watertight. All of the
//              brick is settled at its first cell: the rest of it is skipped. A hit behind the
//              brick is kept as the new end of the ray.
//   automatic  triangle in bricks with a list of at most ShortList triangles, plane in the others.
//
// An octree of planes has a plane of its own in each voxel: all leaves but `voxel` are that plane,
// where it passes the voxel widened by Octree::planeReach() on all sides: half a voxel, unless
// neighbouring planes meet better. Neighbouring planes are tangents of one smooth surface: at the
// voxels' border they are apart by less than the bend of the surface within a voxel, so they
// overlap there, and reach little beyond an edge. A ray that all of them
// refuse has passed beside the surface: it gets nothing, and outlines are the surface's own. Rays
// that reach bricks go on to their voxels. Planes end at Header::meshBounds: what a source has
// beyond the border of an image is not known.
//
// Where a ray stops above the bricks (TraceOptions::level below octree.brickLevel()) plane,
// triangle and automatic are the mean plane of the node that is the cell, with the rule of `plane`;
// at an octree level between two depths, of the child node that the ray passes in the middle of the
// cell, or the first that exists.
#ifndef svoLeafGeometry_h
#define svoLeafGeometry_h

#include "svoCounters.h"
#include "svoLeafTraits.h"
#include "svoMorton.h"
#include "svoNode.h"
#include "svoOctree.h"
#include "svoPlane.h"
#include "svoRay.h"
#include "svoTraverse.h"
#include "svoTriangle.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace svo
{
/// Most triangles of a list that are looked at for a representative.
constexpr std::uint32_t RepresentativeCandidates = 32;

/// What all rays of one query share.
struct LeafQuery
{
  LeafQuery(const Octree& o, const TraceOptions& asked)
    : octree(o)
    , options(asked)
    , planes(o.hasPlanes())
    , ownReach(1.0 + 2.0 * o.planeReach())
    , level(stopLevel(o, options.level))
    , bits(o.rootBits(level))
    , inBrick(level >= o.brickLevel())
    , leaf(traitsOf(o.surface() || planes || !inBrick ? options.leafGeometry : LeafGeometry::Voxel))
  {
    if (!inBrick || planes)
    {
      leaf.longestExact = 0; // nodes have a shape, but no list
    }
    if (planes)
    {
      findBox();
    }
    assert(!o.empty());
  }

  static int stopLevel(const Octree& octree, int asked)
  {
    const int level = std::clamp(asked, 0, octree.level());
    return octree.hasPlanes() && level >= octree.brickLevel() ? octree.level() : level;
  }

  /// Header::meshBounds in octree coordinates. A box without thickness leaves out nothing along
  /// that axis, and neither does one that is not finite.
  void findBox()
  {
    const Header& h = octree.header();
    const double scale = 1.0 / std::ldexp(h.voxelSize, octree.rootBits(octree.level()));
    constexpr double Rounding = 0x1p-20; // of floats in [1, 2), and of a hit's
    for (int a = 0; a < 3; ++a)
    {
      if (h.meshBounds[2 * a] < h.meshBounds[2 * a + 1])
      {
        low[a] = 1.0 + (h.meshBounds[2 * a] - h.origin[a]) * scale - Rounding;
        high[a] = 1.0 + (h.meshBounds[2 * a + 1] - h.origin[a]) * scale + Rounding;
      }
    }
  }
  template <class Real>
  bool inBox(const Vector<Real>& x) const
  {
    return !planes ||
      !(x.x < Real(low.x) || x.y < Real(low.y) || x.z < Real(low.z) || x.x > Real(high.x) ||
        x.y > Real(high.y) || x.z > Real(high.z));
  }

  const Octree& octree;
  TraceOptions options;
  glm::dvec3 low{ 0.0 }; // of an octree of planes: where its surface ends, octree coordinates
  glm::dvec3 high{ 3.0 };
  bool planes;     // of its own, see Octree::hasPlanes()
  double ownReach; // of those from a voxel's centre, in halves of its edge
  int level;       // where rays stop
  int bits;        // of a cell's coordinate in the root cube
  bool inBrick;    // cells are parts of a brick, or a brick
  LeafTraits leaf; // in a brick without triangles: a voxel's
};

/// The nearest hit so far.
template <class Real>
struct LeafHit
{
  Real t = 0;
  Primitive primitive = NoPrimitive;
  glm::ivec3 cell{ -1 };
  // The first cell that refused the ray; its primitive is NoPrimitive if there is none.
  Real refusedT = 0;
  Primitive refused = NoPrimitive;
  glm::ivec3 refusedCell{ -1 };
};

/// Centre and half of the edge of a cell whose coordinates have `bits` bits, in octree coordinates.
template <class Real>
Vector<Real> cellCentre(glm::ivec3 cell, int bits)
{
  return Real(1) + (Vector<Real>(cell) + Real(0.5)) / static_cast<Real>(1 << bits);
}
inline double cellHalf(int bits)
{
  return 0.5 / static_cast<double>(1 << bits);
}

/// Half of the edge of the box that a triangle meets if it touches a cell: the builder's voxels are
/// grown by 1/256 of their edge, and its vertices snapped by half of that.
inline double touchedHalf(int bits)
{
  return 1.02 * cellHalf(bits);
}

/// The triangle of the brick whose plane is nearest to the centre of one of its cells, preferably
/// one that touches the cell. Without a surface, the first of the list.
template <class Real>
Primitive nearestPlaneTriangle(const LeafQuery& query, std::uint32_t brick, const glm::ivec3& cell)
{
  std::uint32_t count = 0;
  std::uint32_t inlineId = 0;
  const std::uint32_t* list = query.octree.brickTriangles(brick, count, inlineId);
  const Surface* surface = query.octree.surface();
  if (count == 1 || surface == nullptr)
  {
    return list[0];
  }
  const Vector<Real> centre = cellCentre<Real>(cell, query.bits);
  const Real half = static_cast<Real>(touchedHalf(query.bits));
  Primitive best = list[0];
  bool bestTouches = false;
  Real bestDistance = std::numeric_limits<Real>::max(); // squared
  const std::uint32_t looked = std::min(count, RepresentativeCandidates);
  for (std::uint32_t k = 0; k < looked; ++k)
  {
    const glm::uvec3 triangle = surface->triangles[list[k]];
    const Vector<Real> a = Vector<Real>(surface->points[triangle.x]) - centre;
    const Vector<Real> b = Vector<Real>(surface->points[triangle.y]) - centre;
    const Vector<Real> c = Vector<Real>(surface->points[triangle.z]) - centre;
    const Vector<Real> normal = glm::cross(b - a, c - a);
    const Real length2 = glm::dot(normal, normal);
    if (!(length2 > Real(0)))
    {
      continue;
    }
    const Real height = glm::dot(normal, a);
    const Real reach = half * (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z));
    const Vector<Real> low = glm::min(a, glm::min(b, c));
    const Vector<Real> high = glm::max(a, glm::max(b, c));
    const bool touches = std::abs(height) <= reach && low.x <= half && low.y <= half &&
      low.z <= half && high.x >= -half && high.y >= -half && high.z >= -half;
    const Real distance = height * height / length2;
    if (touches > bestTouches || (touches == bestTouches && distance < bestDistance))
    {
      best = list[k];
      bestTouches = touches;
      bestDistance = distance;
    }
  }
  return best;
}

/// The node whose mean plane stands for a cell above the bricks.
template <class Real>
std::uint32_t representativeNode(
  const LeafQuery& query, const ClippedRay<Real>& ray, const StopCell<Real>& cell)
{
  if (cell.above == NodeLevels)
  {
    return cell.node;
  }
  assert(cell.above == 1);
  const Node& node = query.octree.nodes()[cell.node];
  const Vector<Real> centre = cellCentre<Real>(cell.cell, query.bits);
  // Of the cell, not of the ray: what is hit must not depend on where the ray was cut.
  const Real middle = (cell.tEnter + cell.tExit) * Real(0.5);
  const Vector<Real> x = ray.origin + middle * ray.direction;
  int bit =
    cell.firstBit | int(x.x >= centre.x) | int(x.y >= centre.y) << 1 | int(x.z >= centre.z) << 2;
  if (!hasChild(node, bit))
  {
    bit = cell.firstBit | lowestBit(occupiedBelow(node, cell.firstBit, 1));
  }
  return child(node, bit);
}

/// Where the line of the ray meets the plane of a triangle or of a node. NaN or infinite if
/// parallel.
template <class Real>
Real intersectPlane(const LeafQuery& query, const ClippedRay<Real>& ray, const StopCell<Real>& cell,
  Primitive primitive)
{
  const bool ofNode = primitive & NodePrimitive;
  if (!ofNode && !query.planes)
  {
    const Surface& surface = *query.octree.surface();
    assert(primitive < surface.triangles.size());
    const glm::uvec3 triangle = surface.triangles[primitive];
    const Vector<Real> a(surface.points[triangle.x]);
    const Vector<Real> normal = glm::cross(
      Vector<Real>(surface.points[triangle.y]) - a, Vector<Real>(surface.points[triangle.z]) - a);
    return glm::dot(normal, a - ray.origin) / glm::dot(normal, ray.direction);
  }
  // The block is the voxel, or the node's: the cell, or (at a level in between) one of the cell's
  // eight children.
  const std::uint32_t index = primitive & ~NodePrimitive;
  assert(index < (ofNode ? query.octree.header().nodeCount : query.octree.header().listWords));
  glm::ivec3 block = cell.cell;
  int bits = query.bits;
  if (cell.above == 1)
  {
    const Node& node = query.octree.nodes()[cell.node];
    std::uint64_t octet = occupiedBelow(node, cell.firstBit, 1);
    std::uint32_t at = node.first + childrenBefore(node, cell.firstBit);
    for (; at < index; ++at)
    {
      octet &= octet - 1;
    }
    const int bit = lowestBit(octet);
    block = 2 * block + glm::ivec3(bit & 1, bit >> 1 & 1, bit >> 2);
    ++bits;
  }
  const MeanPlane plane =
    decodePlane(ofNode ? query.octree.nodes()[index].plane : query.octree.lists()[index]);
  const Vector<Real> normal(plane.normal);
  const Real halfDiagonal = static_cast<Real>(std::sqrt(3.0) * cellHalf(bits));
  const Vector<Real> toCentre = cellCentre<Real>(block, bits) - ray.origin;
  return (glm::dot(normal, toCentre) + static_cast<Real>(plane.offset) * halfDiagonal) /
    glm::dot(normal, ray.direction);
}

template <class Real>
Visit meetPlane(const LeafQuery& query, const ClippedRay<Real>& ray, const StopCell<Real>& cell,
  Primitive primitive, Real& tMax, LeafHit<Real>& hit)
{
  const Real t = intersectPlane(query, ray, cell, primitive);
  const Vector<Real> at = ray.origin + t * ray.direction;
  const Vector<Real> x = glm::abs(at - cellCentre<Real>(cell.cell, query.bits));
  const bool own = query.planes && !(primitive & NodePrimitive);
  const Real reach = static_cast<Real>((own ? query.ownReach : 3.0) * cellHalf(query.bits));
  const bool near = x.x <= reach && x.y <= reach && x.z <= reach; // false for NaN
  if (near && !query.inBox(at))
  {
    return Visit::Continue;
  }
  // A plane may pass the cell on the outside of the octree's cube, where the ray has begun.
  if (near && t >= ray.tStart && t <= tMax)
  {
    hit.t = t;
    hit.primitive = primitive;
    hit.cell = cell.cell;
    tMax = t;
    return Visit::Stop;
  }
  const bool leftBehind = near && t < ray.tStart && cell.tEnter <= ray.tMin;
  if (hit.refused == NoPrimitive && !leftBehind && !own)
  {
    hit.refusedT = cell.tEnter;
    hit.refused = primitive;
    hit.refusedCell = cell.cell;
  }
  return Visit::Continue;
}

template <class Real>
Visit meetTriangles(const LeafQuery& query, const ClippedRay<Real>& ray,
  const ShearedRay<Real>& sheared, const std::uint32_t* list, std::uint32_t count, Real& tMax,
  LeafHit<Real>& hit)
{
  SVO_COUNT(TrianglesTested, count);
  assert(count > 0 && query.octree.surface() != nullptr);
  const Surface& surface = *query.octree.surface();
  for (std::uint32_t k = 0; k < count; ++k)
  {
    const glm::uvec3 triangle = surface.triangles[list[k]];
    Real t;
    if (intersectTriangle(sheared, surface.points[triangle.x], surface.points[triangle.y],
          surface.points[triangle.z], t) &&
      t >= ray.tMin && t <= tMax &&
      (hit.primitive == NoPrimitive || t < hit.t || list[k] > hit.primitive))
    {
      hit.t = t;
      hit.primitive = list[k];
      tMax = t; // cells that are entered behind the hit need not be visited
    }
  }
  return Visit::SkipBrick;
}

/// Tests the shape of one occupied cell, of which `primitive` is the representative.
template <class Real>
Visit meetShape(const LeafQuery& query, const ClippedRay<Real>& ray, const StopCell<Real>& cell,
  Primitive primitive, Real& tMax, LeafHit<Real>& hit)
{
  if (query.leaf.shape == CellShape::Plane)
  {
    return meetPlane(query, ray, cell, primitive, tMax, hit);
  }
  hit.t = cell.tEnter;
  hit.primitive = primitive;
  hit.cell = cell.cell;
  return Visit::Stop;
}

/// Tests one occupied cell. tMax is the ray's end so far and is lowered to a hit.
template <class Real>
Visit meetCell(const LeafQuery& query, const ClippedRay<Real>& ray, const ShearedRay<Real>& sheared,
  const StopCell<Real>& cell, Real& tMax, LeafHit<Real>& hit)
{
  if (!query.inBrick)
  {
    const Primitive node = NodePrimitive | representativeNode(query, ray, cell);
    return meetShape(query, ray, cell, node, tMax, hit);
  }
  if (query.planes)
  {
    assert(cell.above == 0);
    return meetShape(query, ray, cell, query.octree.planeOf(cell.node, cell.firstBit), tMax, hit);
  }
  if (query.leaf.exact())
  {
    std::uint32_t count = 0;
    std::uint32_t inlineId = 0;
    const std::uint32_t* list = query.octree.brickTriangles(cell.node, count, inlineId);
    if (count <= query.leaf.longestExact)
    {
      return meetTriangles(query, ray, sheared, list, count, tMax, hit);
    }
  }
  const Primitive triangle = nearestPlaneTriangle<Real>(query, cell.node, cell.cell);
  return meetShape(query, ray, cell, triangle, tMax, hit);
}

/// To be called when the walk is over: a ray that hit nothing gets the first cell that refused it.
template <class Real>
void finish(LeafHit<Real>& hit)
{
  if (hit.primitive == NoPrimitive && hit.refused != NoPrimitive)
  {
    hit.t = hit.refusedT;
    hit.primitive = hit.refused;
    hit.cell = hit.refusedCell;
  }
}

/// The nearest hit of a clipped ray; anyHit: any one.
template <class Real>
LeafHit<Real> intersectLeaves(const LeafQuery& query, const ClippedRay<Real>& ray, bool anyHit)
{
  LeafHit<Real> hit;
  const ShearedRay<Real> sheared(ray.origin, ray.direction);
  walk(query.octree, ray, query.level,
    [&](const StopCell<Real>& cell, Real& tMax)
    {
      const Visit answer = meetCell(query, ray, sheared, cell, tMax, hit);
      return anyHit && hit.primitive != NoPrimitive ? Visit::Stop : answer;
    });
  finish(hit);
  return hit;
}
}

#endif
