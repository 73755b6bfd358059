// What the pixels of a view, or some of them, may see: boxes against planes.
//
// Never says "outside" of what a ray of the view can meet. At one depth, the points of all rays are
// a parallelogram whose corners are those of the four corner rays; so what these are inside of, all
// are. Planes are laid along the sides, and then moved out until the corner rays are inside of them
// with all roundings, of which there are: 2^-48 of the sums of the magnitudes that make up origin
// and direction of a ray, and 2^-49 of the largest coordinate of what is tested.
#ifndef svoFrustum_h
#define svoFrustum_h

#include "svoView.h"
#include "vtkSVOTracingModule.h"

#include <cstdint>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace svo
{
class VTKSVOTRACING_EXPORT Frustum
{
public:
  /// Of the view's crop. `margin`: pixels that are added on all sides; one is what the tracer's
  /// float rays need (svoLocalView.h).
  explicit Frustum(const View& view, double margin = 1.0);

  /// True if no ray of the view meets a box along the world's axes; `half`: half its edges, 0 of a
  /// point. `within`: bits of planes that it is known to lie within; those that it is found to lie
  /// within are added, for boxes in it.
  bool outside(const glm::dvec3& centre, const glm::dvec3& half, std::uint8_t& within) const
  {
    const double rounding = Rounding * (largest(centre) + largest(half));
    for (int i = 0; i < this->Count; ++i)
    {
      if (within >> i & 1)
      {
        continue;
      }
      const double reach = glm::dot(glm::abs(this->Normal[i]), half) + rounding;
      const double at = glm::dot(this->Normal[i], centre) + this->Offset[i];
      if (at < -reach)
      {
        return true;
      }
      if (at >= reach)
      {
        within |= static_cast<std::uint8_t>(1u << i);
      }
    }
    return false;
  }
  /// Planes in use: six at most. Fewer where a view has no far end, or rays that part.
  int planes() const { return this->Count; }
  /// Its normal, of length 1, and its offset: dot(normal, p) + offset is the distance of a point of
  /// the world, positive inside.
  glm::dvec4 plane(int i) const { return glm::dvec4(this->Normal[i], this->Offset[i]); }

private:
  static constexpr double Rounding = 0x1p-49;
  static double largest(const glm::dvec3& v)
  {
    const glm::dvec3 a = glm::abs(v);
    return glm::max(glm::max(a.x, a.y), a.z);
  }

  int Count = 0;
  glm::dvec3 Normal[6];
  double Offset[6];
};
}

#endif
