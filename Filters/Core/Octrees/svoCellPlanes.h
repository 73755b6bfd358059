// The occupied cells of one octree level with their planes, and the blocks of them that lie around
// each other.
#ifndef svoCellPlanes_h
#define svoCellPlanes_h

#include "svoMorton.h"
#include "svoNode.h"
#include "svoOctree.h"
#include "svoParallel.h"
#include "svoRawArray.h"
#include "vtkSVOCoreModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
/// Occupied cells of a level, 0..octree.level().
VTKSVOCORE_EXPORT std::size_t cellsOfLevel(const Octree& octree, int level);

/// The deepest level that has at most that many occupied cells, at least 1.
VTKSVOCORE_EXPORT int deepestLevel(const Octree& octree, std::size_t cells);

/// A node, in blocks of its depth, and the nodes around it, itself among them.
struct CellBlock
{
  static constexpr std::uint32_t None = 0xffffffffu; // no node there
  static constexpr int Middle = 13;                  // of the 27, itself
  glm::ivec3 place;
  std::uint32_t around[27];
};

/// A cell's plane in cells, from the cell's centre.
struct CellPlane
{
  glm::vec3 normal;
  float offset;
};

/// The occupied cells of a level, 1..octree.level(), their planes and where they are stored.
struct CellPlanes
{
  const Octree& octree;
  int level;
  int depth;
  int above; // the cells of those nodes, each time as wide
  std::vector<CellBlock> blocks;
  std::vector<std::uint64_t> masks;  // of the blocks
  std::vector<std::uint32_t> firsts; // cells before them
  std::size_t count = 0;
  RawArray<CellPlane> planes; // of those blocks that were read

  CellPlanes(const Octree& octree, int level, const ParallelFor& parallelFor);

  const Node& node(std::size_t block) const
  {
    return octree.nodes()[octree.header().depthBegin[depth] + block];
  }
  glm::ivec3 cellAt(std::size_t block, int bit) const
  {
    return (NodeEdge >> above) * blocks[block].place + cellOfIndex(bit);
  }

  /// Fills in the planes of the cells of a block.
  void readPlanes(std::size_t block);
};
}

#endif
