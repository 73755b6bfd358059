#include "svoCasterTree.h"

#include "svoMorton.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <glm/common.hpp>

namespace svo
{
namespace
{
using Order = std::vector<std::pair<std::uint64_t, std::size_t>>; // with keys

/// Adds the node of boxes [first, last) in this order, at least one, and all below it.
Box add(const std::vector<Box>& boxes, const Order& order, std::size_t first, std::size_t last,
  double margin, std::vector<CasterNode>& nodes)
{
  const std::size_t node = nodes.size();
  nodes.emplace_back();
  Box box;
  float caster = -1.0f;
  if (last - first == 1)
  {
    box = boxes[order[first].second];
    caster = static_cast<float>(order[first].second);
  }
  else
  {
    const std::size_t middle = first + (last - first) / 2;
    box = add(boxes, order, first, middle, margin, nodes);
    box.add(add(boxes, order, middle, last, margin, nodes));
  }
  nodes[node] = { glm::vec3(box.low - margin), static_cast<float>(nodes.size()),
    glm::vec3(box.high + margin), caster };
  return box;
}
}

std::vector<CasterNode> makeCasterTree(const std::vector<Box>& boxes, double margin)
{
  std::vector<CasterNode> nodes;
  if (boxes.empty())
  {
    return nodes;
  }
  Box all;
  for (const Box& box : boxes)
  {
    all.add(box);
  }
  const glm::dvec3 largest = glm::max(glm::abs(all.low), glm::abs(all.high));
  constexpr double Cells = 1024.0;
  const glm::dvec3 size = glm::max(all.high - all.low, glm::dvec3(1e-300));
  Order order;
  for (std::size_t i = 0; i < boxes.size(); ++i)
  {
    const glm::dvec3 centre = (0.5 * (boxes[i].low + boxes[i].high) - all.low) / size;
    const glm::uvec3 cell(glm::clamp(centre * Cells, 0.0, Cells - 1.0));
    order.emplace_back(mortonKey(cell.x, cell.y, cell.z), i);
  }
  std::sort(order.begin(), order.end());
  nodes.reserve(2 * boxes.size());
  add(boxes, order, 0, boxes.size(), margin * std::max({ largest.x, largest.y, largest.z }), nodes);
  return nodes;
}
}
