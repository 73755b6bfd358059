// What the packets' walk needs to know of an octree and a query, settled once per call.
#ifndef svoIntersectBlock_h
#define svoIntersectBlock_h

#include "svoBrickRepresentatives.h"
#include "svoLeafGeometry.h"
#include "svoNode.h"
#include "svoOcclusion.h"
#include "svoRay.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

namespace svo
{
/// Cell sizes are exponents: a cell is 2^exponent units of a float's last place in [1, 2) wide.
struct WalkTarget
{
  const std::uint32_t* words = nullptr; // the nodes, four words each, and the lists behind them
  const std::uint32_t* table = nullptr; // one of svoUpperLevels.h, above the stop level
  int tableBits = 0;                    // the table has 2^tableBits entries along an edge
  int stopSize = 0;                     // of the cells of the nodes where rays stop
  bool groups = false;                  // rays stop at those nodes' groups of eight cells
  int brickSize = 0;                    // of a brick
  float high = 2.0f;                    // upper corner of the octree's cube; the lower one is 1

  bool ownPlanes = false; // all cells where rays arrive have planes of their own

  // For leaves that are settled side by side; null pointers where they cannot be.
  const float* points = nullptr;              // of the surface, 3 each
  const std::int32_t* triangles = nullptr;    // likewise
  int listBegin = 0;                          // index of the octree's lists in `words`
  int cellSize = 0;                           // of the cells where rays stop
  float touchedHalf = 0.0f;                   // see touchedHalf()
  const BrickRepresentatives* kept = nullptr; // if the cells are voxels
};

WalkTarget walkTarget(const LeafQuery& query);

/// 64 rays from `first` on; those that there are not end before they begin.
RayBlock blockOf(const OcclusionRays& rays, int first);

/// What the lanes find out about rays, a bit each.
struct OcclusionAnswers
{
  static constexpr int Words = OcclusionRays::Most / 64;
  std::uint64_t met[Words]{};
  std::uint64_t unknown[Words]{};    // they came to bricks that are not met triangle by triangle
  Primitive by[OcclusionRays::Most]; // of those that meet something
};

/// The hits of a block while it is traced, and what LeafHit keeps besides.
struct BlockHits
{
  explicit BlockHits(HitBlock& hits)
    : out(hits)
  {
    std::fill_n(out.t, RayBlock::Size, 0.0f);
    std::fill_n(out.primitive, RayBlock::Size, NoPrimitive);
    std::fill_n(refused, RayBlock::Size, NoPrimitive);
  }

  LeafHit<float> load(int ray) const
  {
    LeafHit<float> hit;
    hit.t = out.t[ray];
    hit.primitive = out.primitive[ray];
    hit.refused = refused[ray];
    return hit;
  }
  void store(int ray, const LeafHit<float>& hit)
  {
    out.t[ray] = hit.t;
    out.primitive[ray] = hit.primitive;
    if (refused[ray] == NoPrimitive && hit.refused != NoPrimitive)
    {
      refused[ray] = hit.refused;
      refusedT[ray] = hit.refusedT;
      anyRefused = true;
    }
  }
  /// As finish() of svoLeafGeometry.h.
  void finish()
  {
    for (int i = 0; anyRefused && i < RayBlock::Size; ++i)
    {
      if (out.primitive[i] == NoPrimitive && refused[i] != NoPrimitive)
      {
        out.primitive[i] = refused[i];
        out.t[i] = refusedT[i];
      }
    }
  }

  HitBlock& out;
  bool anyRefused = false;
  float refusedT[RayBlock::Size];
  Primitive refused[RayBlock::Size];
};

/// The instruction set in use.
struct Chosen
{
  const char* name;
  int lanes;
};

/// The cell where a lane has arrived: `at` are the bit patterns of its position, which lies in
/// [1, 2), `index` is the node.
inline StopCell<float> stopCell(
  const LeafQuery& query, const WalkTarget& target, const glm::ivec3& at, std::uint32_t index)
{
  assert(index < query.octree.header().nodeCount);
  assert(at.x >> MantissaBits == 127 && at.y >> MantissaBits == 127 && at.z >> MantissaBits == 127);
  const Node& node = query.octree.nodes()[index];
  const int cellShift = MantissaBits - query.bits;
  const int mask = (1 << query.bits) - 1;
  StopCell<float> cell{ index, 0, 0,
    glm::ivec3(at.x >> cellShift & mask, at.y >> cellShift & mask, at.z >> cellShift & mask), 0.0f,
    0.0f };
  nameCell(node, cellAt(at, target.stopSize), target.cellSize - target.stopSize,
    target.stopSize < target.brickSize, cell);
  return cell;
}
}

#endif
