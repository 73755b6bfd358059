// A box along the axes of some coordinates.
#ifndef svoBox_h
#define svoBox_h

#include <limits>

#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

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
  /// The same of all that is at most `reach` away from one, along each axis.
  void add(const glm::dvec3& point, const glm::dvec3& reach)
  {
    low = glm::min(low, point - reach);
    high = glm::max(high, point + reach);
  }
  void add(const Box& other)
  {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
  /// Corner i lies at the upper end of x if i & 1, of y if i & 2, of z if i & 4.
  glm::dvec3 corner(int i) const
  {
    return { i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z };
  }
};

/// Of bounds as VTK has them.
inline Box boxOf(const double bounds[6])
{
  return { { bounds[0], bounds[2], bounds[4] }, { bounds[1], bounds[3], bounds[5] } };
}

/// Around the corners of a box, in other coordinates. `bounds`: as VTK and Header have them.
inline Box boxAround(const double* bounds, const glm::dmat4& matrix)
{
  const Box box = boxOf(bounds);
  Box around;
  for (int i = 0; i < 8; ++i)
  {
    around.add(glm::dvec3(matrix * glm::dvec4(box.corner(i), 1.0)));
  }
  return around;
}
}

#endif
