// A box along the axes of a frame of reference.
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
  void add(const Box& other)
  {
    low = glm::min(low, other.low);
    high = glm::max(high, other.high);
  }
};

/// Around the corners of a box, in another frame. `bounds`, as VTK and Header have them: from and
/// to along x, y and z.
inline Box boxAround(const double* bounds, const glm::dmat4& matrix)
{
  Box box;
  for (int i = 0; i < 8; ++i)
  {
    const glm::dvec4 at(bounds[i & 1], bounds[2 + (i >> 1 & 1)], bounds[4 + (i >> 2)], 1.0);
    box.add(glm::dvec3(matrix * at));
  }
  return box;
}
}

#endif
