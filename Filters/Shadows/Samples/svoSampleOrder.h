// Places in Morton order, so that neighbours are asked together.
#ifndef svoSampleOrder_h
#define svoSampleOrder_h

#include "svoMorton.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// The numbers 0 .. points - 1 in the Morton order of their points, which are finite; of equal ones
/// the lower number first.
inline std::vector<std::uint32_t> mortonOrder(const std::vector<glm::dvec3>& points)
{
  constexpr double Cells = 2097151.0; // 21 bits
  glm::dvec3 low(0.0), high(0.0);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    low = i == 0 ? points[i] : glm::min(low, points[i]);
    high = i == 0 ? points[i] : glm::max(high, points[i]);
  }
  const glm::dvec3 size = high - low;
  const double longest = std::max({ size.x, size.y, size.z });
  const double scale = longest > 0.0 && std::isfinite(longest) ? Cells / longest : 0.0;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const glm::uvec3 cell(glm::clamp((points[i] - low) * scale, 0.0, Cells));
    keys[i] = { mortonKey(cell.x, cell.y, cell.z), static_cast<std::uint32_t>(i) };
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order(points.size());
  std::transform(
    keys.begin(), keys.end(), order.begin(), [](const auto& key) { return key.second; });
  return order;
}
}

#endif
