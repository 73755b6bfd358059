// A box along the axes of a frame of reference.
#ifndef svoBox_h
#define svoBox_h

#include <limits>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// Empty at first: what is not known has such a box.
struct Box
{
  glm::dvec3 low{ std::numeric_limits<double>::infinity() };
  glm::dvec3 high{ -std::numeric_limits<double>::infinity() };

  bool known() const { return low.x <= high.x && low.y <= high.y && low.z <= high.z; }
  /// Widens it to a point, of finite coordinates.
  void add(const glm::dvec3& point)
  {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  void add(const Box& other)
  {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
};
}

#endif
