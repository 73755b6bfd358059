#include "svoCasterTree.h"

#include "svoMorton.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include <glm/common.hpp>

namespace svo
{
namespace
{
class Maker
{
public:
  Maker(const std::vector<Box>& boxes, double margin)
    : Boxes(boxes)
    , Order(boxes.size())
    , Codes(boxes.size())
  {
    Box all;
    for (const Box& box : boxes)
    {
      all.add(box);
    }
    const glm::dvec3 largest = glm::max(glm::abs(all.low), glm::abs(all.high));
    this->Margin = margin * std::max({ largest.x, largest.y, largest.z });
    constexpr double Cells = 1024.0;
    const glm::dvec3 size = glm::max(all.high - all.low, glm::dvec3(1e-300));
    for (std::size_t i = 0; i < boxes.size(); ++i)
    {
      const glm::dvec3 centre = (0.5 * (boxes[i].low + boxes[i].high) - all.low) / size;
      const glm::uvec3 cell(glm::clamp(centre * Cells, 0.0, Cells - 1.0));
      this->Codes[i] = mortonKey(cell.x, cell.y, cell.z);
    }
    std::iota(this->Order.begin(), this->Order.end(), std::size_t(0));
    std::stable_sort(this->Order.begin(), this->Order.end(),
      [this](std::size_t a, std::size_t b) { return this->Codes[a] < this->Codes[b]; });
    this->Nodes.reserve(2 * boxes.size());
  }

  /// Adds the node of boxes [first, last), at least one, and all below it.
  Box add(std::size_t first, std::size_t last)
  {
    const std::size_t node = this->Nodes.size();
    this->Nodes.emplace_back();
    Box box;
    float caster = -1.0f;
    if (last - first == 1)
    {
      box = this->Boxes[this->Order[first]];
      caster = static_cast<float>(this->Order[first]);
    }
    else
    {
      const std::size_t middle = first + (last - first) / 2;
      box = this->add(first, middle);
      box.add(this->add(middle, last));
    }
    this->Nodes[node] = { glm::vec3(box.low - this->Margin), static_cast<float>(this->Nodes.size()),
      glm::vec3(box.high + this->Margin), caster };
    return box;
  }

  std::vector<CasterNode> Nodes;

private:
  const std::vector<Box>& Boxes;
  std::vector<std::size_t> Order;
  std::vector<std::uint64_t> Codes;
  double Margin;
};
}

std::vector<CasterNode> makeCasterTree(const std::vector<Box>& boxes, double margin)
{
  Maker maker(boxes, margin);
  if (!boxes.empty())
  {
    maker.add(0, boxes.size());
  }
  return std::move(maker.Nodes);
}
}
