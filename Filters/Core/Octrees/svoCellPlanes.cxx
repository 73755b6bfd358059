#include "svoCellPlanes.h"

#include "svoPlane.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
/// Depth of the nodes whose masks hold the cells of a level.
int depthOf(const Octree& octree, int level)
{
  return octree.depthCount() - 1 - (octree.level() - level) / NodeLevels;
}

/// How far those are above the nodes' own cells.
int aboveOf(const Octree& octree, int level)
{
  return (octree.level() - level) % NodeLevels;
}

/// The occupied cells of a node, or of those above them, as bits.
std::uint64_t cellsOf(const Node& node, int above)
{
  if (above == 0)
  {
    return node.mask;
  }
  std::uint64_t cells = 0;
  for (int i = 0; i < NodeCells / cellsBelow(above); ++i)
  {
    cells |= std::uint64_t(occupiedBelow(node, i * cellsBelow(above), above) != 0) << i;
  }
  return cells;
}

/// All nodes of a depth, found from the root downwards: neighbours of children are children of
/// neighbours.
std::vector<CellBlock> blocksOf(const Octree& octree, int depth, const ParallelFor& parallelFor)
{
  std::vector<CellBlock> blocks(1);
  blocks[0].place = glm::ivec3(0);
  std::fill(std::begin(blocks[0].around), std::end(blocks[0].around), CellBlock::None);
  blocks[0].around[CellBlock::Middle] = 0;
  const Node* nodes = octree.nodes();
  for (int d = 0; d < depth; ++d)
  {
    const std::uint32_t begin = octree.header().depthBegin[d + 1];
    std::vector<CellBlock> below(octree.header().depthBegin[d + 2] - begin);
    forEach(parallelFor, blocks.size(), 64,
      [&](std::size_t b)
      {
        const CellBlock& block = blocks[b];
        const Node& node = nodes[block.around[CellBlock::Middle]];
        std::uint32_t next = node.first - begin;
        for (std::uint64_t mask = node.mask; mask != 0; mask &= mask - 1)
        {
          CellBlock& child = below[next++];
          const glm::ivec3 cell = cellOfIndex(lowestBit(mask));
          child.place = NodeEdge * block.place + cell;
          int i = 0;
          for (int z = cell.z - 1; z <= cell.z + 1; ++z)
          {
            for (int y = cell.y - 1; y <= cell.y + 1; ++y)
            {
              const int row = 9 * ((z >> NodeLevels) + 1) + 3 * ((y >> NodeLevels) + 1) + 1;
              for (int x = cell.x - 1; x <= cell.x + 1; ++x, ++i)
              {
                const std::uint32_t in = block.around[row + (x >> NodeLevels)];
                const int bit = cellAt({ x, y, z });
                child.around[i] = in != CellBlock::None && hasChild(nodes[in], bit)
                  ? svo::child(nodes[in], bit)
                  : CellBlock::None;
              }
            }
          }
        }
      });
    blocks = std::move(below);
  }
  return blocks;
}

CellPlane planeOfBits(std::uint32_t bits)
{
  const MeanPlane plane = decodePlane(bits);
  return { plane.normal, MeanPlane::HalfDiagonal * plane.offset };
}
}

std::size_t cellsOfLevel(const Octree& octree, int level)
{
  assert(level >= 0 && level <= octree.level());
  const Header& header = octree.header();
  if (octree.empty() || level == octree.level())
  {
    return header.voxelCount;
  }
  const int depth = depthOf(octree, level), above = aboveOf(octree, level);
  if (above == 0)
  {
    return header.depthBegin[depth + 2] - header.depthBegin[depth + 1];
  }
  std::size_t count = 0;
  for (std::uint32_t n = header.depthBegin[depth]; n < header.depthBegin[depth + 1]; ++n)
  {
    count += static_cast<std::size_t>(countBits(cellsOf(octree.nodes()[n], above)));
  }
  return count;
}

int deepestLevel(const Octree& octree, std::size_t cells)
{
  int level = octree.level();
  while (level > 1 && cellsOfLevel(octree, level) > cells)
  {
    --level;
  }
  return level;
}

CellPlanes::CellPlanes(const Octree& o, int l, const ParallelFor& parallelFor)
  : octree(o)
  , level(l)
  , depth(depthOf(o, l))
  , above(aboveOf(o, l))
  , blocks(blocksOf(o, depth, parallelFor))
  , masks(blocks.size())
  , firsts(blocks.size())
{
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    masks[b] = cellsOf(this->node(b), above);
    firsts[b] = static_cast<std::uint32_t>(count);
    count += static_cast<std::size_t>(countBits(masks[b]));
  }
  planes.resize(count);
}

void CellPlanes::readPlanes(std::size_t block)
{
  const Node& node = this->node(block);
  const bool leaves = depth + 1 == octree.depthCount();
  const auto bits = [&](int k)
  { return leaves ? octree.lists()[node.first + k] : octree.nodes()[node.first + k].plane; };
  CellPlane* to = planes.data() + firsts[block];
  int k = 0;
  for (std::uint64_t mask = masks[block]; mask != 0; mask &= mask - 1, ++to)
  {
    if (above == 0)
    {
      *to = planeOfBits(bits(k++));
      continue;
    }
    // The mean of those below it.
    const auto width = static_cast<float>(1 << above);
    std::uint64_t group = occupiedBelow(node, cellsBelow(above) * lowestBit(mask), above);
    const float children = static_cast<float>(countBits(group));
    glm::vec3 normal(0.0f), middle(0.0f);
    for (; group != 0; group &= group - 1)
    {
      const CellPlane plane = planeOfBits(bits(k++));
      normal += plane.normal;
      middle += (glm::vec3(cellOfIndex(lowestBit(group))) - 0.5f * (width - 1.0f) +
                  plane.offset * plane.normal) /
        width;
    }
    const float square = glm::dot(normal, normal);
    normal = square > 1e-6f ? normal / std::sqrt(square) : planeOfBits(bits(k - 1)).normal;
    *to = { normal, glm::dot(normal, middle) / children };
  }
}
}
