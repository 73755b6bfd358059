#include "svoLargePolygon.h"

#include "svoBox.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace svo
{
bool canBeHalved(const glm::dvec3* points, const std::vector<std::uint32_t>& polygon)
{
  constexpr double Tolerance = 1e-6; // of the polygon's size: float coordinates are no better
  const std::size_t count = polygon.size();
  const glm::dvec3 origin = points[polygon[0]];
  const auto at = [&](std::size_t i) { return points[polygon[i]] - origin; };
  glm::dvec3 area(0.0);
  Box box{ glm::dvec3(0.0), glm::dvec3(0.0) };
  for (std::size_t i = 1; i < count; ++i)
  {
    const glm::dvec3 p = at(i);
    area += glm::cross(at(i - 1), p);
    box.add(p);
  }
  const double size = glm::length(box.high - box.low);
  const double length = glm::length(area);
  // Points that are not finite end here, too.
  if (count < 3 || !(length > Tolerance * size * size) || !std::isfinite(length))
  {
    return false;
  }
  const glm::dvec3 normal = area / length;
  const double allowed = Tolerance * size;
  bool good = true;
  const auto look = [&](std::size_t i, std::size_t k, std::size_t j)
  {
    const glm::dvec3 a = at(i), b = at(k), c = at(j);
    const double longest = std::max({ glm::length(b - a), glm::length(c - b), glm::length(a - c) });
    const double height = glm::dot(glm::cross(b - a, c - a), normal);
    good = good && height >= -allowed * longest && std::abs(glm::dot(b, normal)) <= allowed;
  };
  for (std::size_t i = 1; i + 1 < count && good; ++i)
  {
    look(0, i, i + 1);
  }
  if (good)
  {
    halve(0, count - 1, look);
  }
  return good && std::abs(glm::dot(at(count - 1), normal)) <= allowed;
}
}
