// The walk of a ray through a sparse voxel octree: occupied cells, front to back.
//
// CONVENTIONS
//   Coordinates are octree coordinates: the root cube is [1, 2)^3 (svoLayout.h). The current
//   position is kept as integers, the voxel of the root cube's finest grid that the ray is in, so
//   which cell comes next is decided by integer bits and never by an epsilon added to t.
//
//   A ray visits the cells in which it spends more than a point. A ray in the plane between two
//   cells (its direction has a zero there) belongs to the upper one, a ray through an edge or a
//   corner crosses it diagonally. Rounding may let a ray that passes within rounding error of an
//   edge touch the neighbour too; it never makes it jump over a cell.
//
//   Every step moves at least one coordinate by at least one voxel in the direction of the ray, and
//   none back, so the walk ends.
#ifndef svoTraverse_h
#define svoTraverse_h

#include "svoCounters.h"
#include "svoMorton.h"
#include "svoNode.h"
#include "svoOctree.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/vec3.hpp>

namespace svo
{
template <class Real>
using Vector = glm::vec<3, Real>;

/// The part of a ray inside an octree's cube: x(t) = origin + t direction, tMin <= t <= tMax. A
/// component of the direction too small to move the ray anywhere inside the cube is exactly zero.
template <class Real>
struct ClippedRay
{
  Vector<Real> origin;
  Vector<Real> direction;
  Vector<Real> inverse; // 1 / direction, +infinity where it is zero
  Real tMin;
  Real tMax;
  Real tStart; // where the ray itself starts: at tMin, or earlier, before it enters the cube
};

/// A cell where a ray stops, as those from `firstBit` on of a node's that make up one `above` them
/// (svoNode.h): the node's block, one of a level in between, or a voxel.
template <class Real>
struct StopCell
{
  std::uint32_t node;
  int firstBit;
  int above;
  glm::ivec3 cell; // integer coordinates at the level where the ray stops
  Real tEnter;     // tMin of the ray if it starts inside
  Real tExit;      // of the cell; may lie beyond the ray's tMax
};

/// A visitor's answer.
enum class Visit
{
  Stop,
  Continue,
  SkipBrick // nothing more is to be found in this brick
};

/// Why a walk ended.
enum class WalkEnd
{
  Stopped, // by the visitor
  Left,    // the ray left the cube or reached its tMax
  Bound    // the loop's bound; it is there so that a proof is not needed, and never reached
};

/// Names the cell where a ray stops: that of a node's cell i, or `above` it. `voxels`: cells of the
/// node have no nodes of their own.
template <class Real>
void nameCell(const Node& node, int i, int above, bool voxels, StopCell<Real>& cell)
{
  cell.firstBit = i;
  cell.above = above;
  if (above > 0)
  {
    cell.firstBit = firstBelow(i, above);
  }
  else if (!voxels)
  {
    cell.node = child(node, i);
    cell.firstBit = 0;
    cell.above = NodeLevels;
  }
}

/// Clips a ray to the octree's cube. False if nothing is left; NaN and infinite rays are misses.
template <class Real>
bool clip(const Octree& octree, const Vector<Real>& origin, const Vector<Real>& direction,
  Real tMin, Real tMax, ClippedRay<Real>& clipped)
{
  const Real largest =
    std::max({ std::abs(direction.x), std::abs(direction.y), std::abs(direction.z) });
  const Real smallest = std::numeric_limits<Real>::min(); // below it, 1 / direction may overflow
  for (int a = 0; a < 3; ++a)
  {
    if (!std::isfinite(direction[a]) || !std::isfinite(origin[a]))
    {
      return false;
    }
  }
  if (largest < smallest || octree.empty())
  {
    return false;
  }
  const Real low = 1;
  const Real high = Real(1) + Real(1) / Real(1 << octree.rootBits(0));
  const Real negligible =
    std::max(largest * std::numeric_limits<Real>::epsilon() / Real(256), smallest);
  clipped.origin = origin;
  clipped.tStart = tMin;
  for (int a = 0; a < 3; ++a)
  {
    const bool zero = std::abs(direction[a]) < negligible;
    clipped.direction[a] = zero ? Real(0) : direction[a];
    clipped.inverse[a] = zero ? std::numeric_limits<Real>::infinity() : Real(1) / direction[a];
    if (zero)
    {
      if (!(origin[a] >= low && origin[a] < high))
      {
        return false;
      }
      continue;
    }
    const Real toLow = (low - origin[a]) * clipped.inverse[a];
    const Real toHigh = (high - origin[a]) * clipped.inverse[a];
    tMin = std::max(tMin, std::min(toLow, toHigh));
    tMax = std::min(tMax, std::max(toLow, toHigh));
  }
  clipped.tMin = tMin;
  clipped.tMax = tMax;
  return tMin <= tMax;
}

/// Calls visit(const StopCell<Real>&, Real& tMax) -> Visit for every occupied cell of `level`
/// (0..octree.level()) that the ray meets, front to back. The visitor may lower tMax: cells entered
/// after it are not visited. The octree must not be empty.
template <class Real, class Visitor>
WalkEnd walk(const Octree& octree, const ClippedRay<Real>& ray, int level, Visitor&& visit)
{
  assert(!octree.empty());
  assert(ray.tMin <= ray.tMax);
  assert(level >= 0 && level <= octree.level());
  const int bits = octree.rootBits(octree.level()); // of a coordinate in voxels of the root cube
  const int stopShift = octree.level() - level;     // voxel >> stopShift = cell where we stop
  const int edge = 1 << octree.level();             // voxels along the octree's cube
  const Real scale = static_cast<Real>(1 << bits);
  const Real voxel = Real(1) / scale;
  const Node* nodes = octree.nodes();
  Real tMax = ray.tMax;

  // The voxel that the ray is in or about to enter at t, held inside [low, high].
  const auto voxelAt = [&](int a, Real t, int low, int high)
  {
    const Real x = (ray.origin[a] + t * ray.direction[a] - Real(1)) * scale;
    if (!(x > static_cast<Real>(low)))
    {
      return low;
    }
    const int i = static_cast<int>(std::min(x, static_cast<Real>(edge)));
    const bool onFace = static_cast<Real>(i) == x; // about to enter the lower voxel if it goes down
    return std::min(ray.direction[a] < Real(0) && onFace ? i - 1 : i, high);
  };

  Real t = ray.tMin;
  glm::ivec3 at;
  for (int a = 0; a < 3; ++a)
  {
    at[a] = voxelAt(a, t, 0, edge - 1);
  }

  std::array<std::uint32_t, MaximumDepths> path{}; // path[depth]: the node that the ray is in
  int depth = 0;
  const std::uint64_t bound = (3ull << bits) * (MaximumDepths + 1);
  for (std::uint64_t step = 0; step < bound; ++step)
  {
    // A cell of this node is `1 << shift` voxels wide. Find the largest cell around the ray that is
    // empty, or is one where the ray stops; else go down.
    SVO_COUNT(NodesVisited, 1);
    assert(depth < octree.depthCount());
    const std::uint32_t index = path[depth];
    assert(
      index >= octree.header().depthBegin[depth] && index < octree.header().depthBegin[depth + 1]);
    const Node& node = nodes[index];
    const int shift = bits - NodeLevels * (depth + 1);
    const int above = stopShift - shift; // of cells where the ray stops, over the node's
    // Only the root's own block is one: deeper ones are found by their parents.
    assert(node.mask != 0 && above <= NodeLevels);
    const int i = cellAt(at, shift);
    int leave = shift; // the cell to leave is 1 << leave voxels wide
    bool stop = false;
    if (above > 0)
    {
      leave = stopShift;
      stop = occupiedBelow(node, firstBelow(i, above), above) != 0;
    }
    else if (occupiedBelow(node, firstBelow(i, NodeLevels - 1), NodeLevels - 1) == 0)
    {
      leave = shift + NodeLevels - 1;
    }
    else if (hasChild(node, i))
    {
      if (above < 0)
      {
        path[++depth] = child(node, i);
        continue;
      }
      stop = true;
    }

    // Where the ray leaves it, and through which faces.
    glm::ivec3 face;
    Vector<Real> tFace;
    const auto findExit = [&]
    {
      for (int a = 0; a < 3; ++a)
      {
        const bool negative = ray.direction[a] < Real(0);
        face[a] = ((at[a] >> leave) + (negative ? 0 : 1)) << leave;
        tFace[a] = (Real(1) + static_cast<Real>(face[a]) * voxel - ray.origin[a]) * ray.inverse[a];
      }
      return std::min({ tFace.x, tFace.y, tFace.z });
    };
    Real tExit = findExit();

    if (stop)
    {
      StopCell<Real> cell{ index, 0, 0, at >> stopShift, t, std::max(t, tExit) };
      nameCell(node, i, above, shift == 0, cell);
      const Visit answer = visit(static_cast<const StopCell<Real>&>(cell), tMax);
      if (answer == Visit::Stop)
      {
        return WalkEnd::Stopped;
      }
      if (answer == Visit::SkipBrick && leave < NodeLevels)
      {
        leave = NodeLevels;
        tExit = findExit();
      }
    }

    if (!(tExit <= tMax))
    {
      return WalkEnd::Left;
    }
    t = std::max(t, tExit);
    int changed = 0; // bits of the coordinates that differ from the old ones
    for (int a = 0; a < 3; ++a)
    {
      const bool negative = ray.direction[a] < Real(0);
      int next;
      if (tFace[a] <= tExit)
      {
        next = negative ? face[a] - 1 : face[a];
        if (next < 0 || next >= edge)
        {
          return WalkEnd::Left;
        }
      }
      else // stays between the cell's faces, and does not turn back
      {
        const int low = at[a] >> leave << leave;
        next = negative ? voxelAt(a, t, low, at[a]) : voxelAt(a, t, at[a], low + (1 << leave) - 1);
      }
      changed |= next ^ at[a];
      at[a] = next;
    }
    assert(changed != 0);
    // Up to the deepest node that holds both positions.
    while (depth > 0 && changed >> (bits - NodeLevels * depth) != 0)
    {
      --depth;
    }
  }
  return WalkEnd::Bound;
}
}

#endif
