#include "svoUpperLevels.h"

#include "svoMorton.h"
#include "svoNode.h"

#include <algorithm>
#include <cassert>

namespace svo
{
namespace
{
/// Fills a table from the one before it: every entry's cell is divided into a node's cells.
void refine(const std::vector<std::uint32_t>& coarse, int depth, const Node* nodes,
  std::vector<std::uint32_t>& fine)
{
  const int n = 1 << (NodeLevels * (depth - 1)); // entries along an edge of `coarse`
  const std::uint32_t cellExponent = MantissaBits - NodeLevels * depth;
  for (int z = 0; z < NodeEdge * n; ++z)
  {
    for (int y = 0; y < NodeEdge * n; ++y)
    {
      for (int x = 0; x < NodeEdge * n; ++x)
      {
        const std::uint32_t parent =
          coarse[x / NodeEdge + n * (y / NodeEdge + std::size_t(n) * (z / NodeEdge))];
        std::uint32_t entry = parent;
        if (!(parent & UpperLevels::Empty))
        {
          const Node& node = nodes[parent >> 5];
          const int cell = cellAt({ x, y, z });
          if (hasChild(node, cell))
          {
            assert(child(node, cell) < UpperLevels::Empty >> 5);
            entry = child(node, cell) << 5 | (cellExponent - NodeLevels);
          }
          else
          {
            entry = UpperLevels::Empty | (cellExponent + emptyAbove(node, cell) - NodeLevels);
          }
        }
        fine[x + NodeEdge * n * (y + NodeEdge * std::size_t(n) * z)] = entry;
      }
    }
  }
}
}

namespace
{
void findBox(UpperLevels& upper)
{
  const std::vector<std::uint32_t>& table = upper.tables[upper.tableCount - 1];
  const int n = 1 << (NodeLevels * (upper.tableCount - 1)); // entries along an edge
  int low[3] = { n, n, n }, high[3] = { 0, 0, 0 };
  std::size_t i = 0;
  for (int z = 0; z < n; ++z)
  {
    for (int y = 0; y < n; ++y)
    {
      for (int x = 0; x < n; ++x)
      {
        if (!(table[i++] & UpperLevels::Empty))
        {
          const int at[3] = { x, y, z };
          for (int a = 0; a < 3; ++a)
          {
            low[a] = std::min(low[a], at[a]);
            high[a] = std::max(high[a], at[a] + 1);
          }
        }
      }
    }
  }
  for (int a = 0; a < 3 && low[0] < n; ++a)
  {
    upper.low[a] = 1.0f + static_cast<float>(low[a]) / static_cast<float>(n);
    upper.high[a] = 1.0f + static_cast<float>(high[a]) / static_cast<float>(n);
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
  constexpr std::uint32_t Root = MantissaBits - NodeLevels; // the size of its cells
  upper.tables[0] = { empty ? UpperLevels::Empty | Root : Root };
  upper.tableCount = 1;
  const int depths = empty ? 1 : static_cast<int>(header.depthCount);
  for (int k = 1; k < std::min(UpperLevels::MaximumTables, depths); ++k)
  {
    const std::size_t entries = std::size_t(1) << (3 * NodeLevels * k);
    if (k == UpperLevels::MaximumTables - 1 && entries * sizeof(std::uint32_t) > bytes)
    {
      break;
    }
    upper.tables[k].resize(entries);
    refine(upper.tables[k - 1], k, nodes, upper.tables[k]);
    upper.tableCount = k + 1;
  }
  findBox(upper);
  return upper;
}
}
