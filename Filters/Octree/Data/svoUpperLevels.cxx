#include "svoUpperLevels.h"

#include "svoMorton.h"
#include "svoNode.h"

#include <algorithm>
#include <cassert>

#include <glm/common.hpp>

namespace svo
{
namespace
{
/// The place of an entry of a table whose coordinates have so many bits.
glm::ivec3 placeOf(std::size_t entry, int bits)
{
  const std::size_t last = (std::size_t(1) << bits) - 1;
  return { entry & last, entry >> bits & last, entry >> 2 * bits };
}

/// Fills a table from the one before it: every entry's cell is divided into a node's cells.
void refine(const std::vector<std::uint32_t>& coarse, int depth, const Node* nodes,
  std::vector<std::uint32_t>& fine)
{
  const int n = 1 << (NodeLevels * (depth - 1)); // entries along an edge of `coarse`
  const std::uint32_t cellExponent = MantissaBits - NodeLevels * depth;
  for (std::size_t i = 0; i < fine.size(); ++i)
  {
    const glm::ivec3 at = placeOf(i, NodeLevels * depth);
    const glm::ivec3 above = at >> NodeLevels;
    const std::uint32_t parent = coarse[above.x + n * (above.y + std::size_t(n) * above.z)];
    fine[i] = parent;
    if (!(parent & UpperLevels::Empty))
    {
      const Node& node = nodes[parent >> 5];
      const int cell = cellAt(at);
      if (hasChild(node, cell))
      {
        assert(child(node, cell) < UpperLevels::Empty >> 5);
        fine[i] = child(node, cell) << 5 | (cellExponent - NodeLevels);
      }
      else
      {
        fine[i] = UpperLevels::Empty | (cellExponent + emptyAbove(node, cell) - NodeLevels);
      }
    }
  }
}

void findBox(UpperLevels& upper)
{
  const std::vector<std::uint32_t>& table = upper.tables[upper.tableCount - 1];
  const int bits = NodeLevels * (upper.tableCount - 1);
  const int n = 1 << bits; // entries along an edge
  glm::ivec3 low(n), high(0);
  for (std::size_t i = 0; i < table.size(); ++i)
  {
    if (!(table[i] & UpperLevels::Empty))
    {
      low = glm::min(low, placeOf(i, bits));
      high = glm::max(high, placeOf(i, bits) + 1);
    }
  }
  if (low.x < n)
  {
    upper.low = 1.0f + glm::vec3(low) / static_cast<float>(n);
    upper.high = 1.0f + glm::vec3(high) / static_cast<float>(n);
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
