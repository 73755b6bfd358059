#include "svoUpperLevels.h"

#include "svoMorton.h"
#include "svoNode.h"

#include <algorithm>
#include <cassert>

namespace svo
{
namespace
{
/// Fills a table from the one before it: every entry's cell is divided into 4x4x4.
void refine(const std::vector<std::uint32_t>& coarse, int depth, const Node* nodes,
  std::vector<std::uint32_t>& fine)
{
  const int n = 1 << (2 * (depth - 1)); // entries along an edge of `coarse`
  const std::uint32_t cellExponent = MantissaBits - 2 * depth;
  for (int z = 0; z < 4 * n; ++z)
  {
    for (int y = 0; y < 4 * n; ++y)
    {
      for (int x = 0; x < 4 * n; ++x)
      {
        const std::uint32_t parent = coarse[x / 4 + n * (y / 4 + std::size_t(n) * (z / 4))];
        std::uint32_t entry = parent;
        if (!(parent & UpperLevels::Empty))
        {
          const Node& node = nodes[parent >> 5];
          const int cell = cellIndex(x & 3, y & 3, z & 3);
          if (hasChild(node, cell))
          {
            assert(child(node, cell) < UpperLevels::Empty >> 5);
            entry = child(node, cell) << 5 | (cellExponent - 2);
          }
          else
          {
            const bool emptyGroup = groupCells(node, groupOf(cell)) == 0;
            entry = UpperLevels::Empty | (cellExponent + (emptyGroup ? 1 : 0) - 2);
          }
        }
        fine[x + 4 * n * (y + 4 * std::size_t(n) * z)] = entry;
      }
    }
  }
}
}

std::size_t UpperLevels::bytes() const
{
  std::size_t sum = 0;
  for (const std::vector<std::uint32_t>& table : this->tables)
  {
    sum += table.size() * sizeof(std::uint32_t);
  }
  return sum;
}

UpperLevels makeUpperLevels(const Header& header, const Node* nodes, std::size_t bytes)
{
  UpperLevels upper;
  const bool empty = nodes[0].mask == 0;
  // The root's cells are a quarter of the edge.
  upper.tables[0] = { empty ? UpperLevels::Empty | (MantissaBits - 2) : MantissaBits - 2u };
  upper.tableCount = 1;
  const int depths = empty ? 1 : static_cast<int>(header.depthCount);
  for (int k = 1; k < std::min(UpperLevels::MaximumTables, depths); ++k)
  {
    const std::size_t entries = std::size_t(1) << (6 * k);
    if (k == UpperLevels::MaximumTables - 1 && entries * sizeof(std::uint32_t) > bytes)
    {
      break;
    }
    upper.tables[k].resize(entries);
    refine(upper.tables[k - 1], k, nodes, upper.tables[k]);
    upper.tableCount = k + 1;
  }
  return upper;
}
}
