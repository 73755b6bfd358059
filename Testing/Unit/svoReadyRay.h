// A ray against one triangle after the other, as a tile's rays are cast: what tests ask of every
// triangle of a mesh.
#ifndef svoReadyRay_h
#define svoReadyRay_h

#include "svoSurface.h"
#include "svoTriangle.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace svotest
{
/// A ray made ready once. One whose direction is nothing, or is not finite, meets nothing.
class ReadyRay
{
public:
  ReadyRay(const glm::vec3& origin, const glm::vec3& direction)
    : Ray(origin, straight(direction, this->Any))
  {
  }
  /// Where the line of the ray meets a triangle: false if it misses.
  bool meets(const svo::Surface& surface, std::uint32_t triangle, float& t) const
  {
    const glm::uvec3 points = surface.triangles[triangle];
    return this->Any &&
      svo::intersectTriangle(
        this->Ray, surface.points[points.x], surface.points[points.y], surface.points[points.z], t);
  }

private:
  /// Without what is negligible, as clip() of svoTraverse.h has it.
  static glm::vec3 straight(const glm::vec3& direction, bool& any)
  {
    constexpr float Smallest = std::numeric_limits<float>::min();
    const glm::vec3 size = glm::abs(direction);
    const float largest = std::max(std::max(size.x, size.y), size.z);
    any = largest >= Smallest && std::isfinite(size.x) && std::isfinite(size.y) &&
      std::isfinite(size.z);
    if (!any)
    {
      return { 0.0f, 0.0f, 1.0f };
    }
    const float negligible =
      std::max(largest * (std::numeric_limits<float>::epsilon() / 256.0f), Smallest);
    glm::vec3 along;
    for (int a = 0; a < 3; ++a)
    {
      along[a] = size[a] < negligible ? 0.0f : direction[a];
    }
    return along;
  }

  bool Any = false; // before the ray, which is made with it
  svo::ShearedRay<float> Ray;
};
}

#endif
