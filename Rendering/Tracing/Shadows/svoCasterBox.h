// Boxes around casters, and around points that ask: where the one is not on the way from the other
// to a light, a caster need not be looked at.
#ifndef svoCasterBox_h
#define svoCasterBox_h

#include "svoInverse.h"
#include "svoScene.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>

namespace svo
{
/// A box around points, world.
struct PointBox
{
  glm::dvec3 low{ 1.0 }, high{ -1.0 };

  bool empty() const { return this->low.x > this->high.x; }
  /// Adds the box of the points that are at most `reach` away from one.
  void add(const glm::dvec3& point, const glm::dvec3& reach)
  {
    const bool first = this->empty();
    this->low = first ? point - reach : glm::min(this->low, point - reach);
    this->high = first ? point + reach : glm::max(this->high, point + reach);
  }
};

/// The box of an instance's mesh, or its octree's cube, in coordinates in which it is -1..1 wide.
class CasterBox
{
public:
  /// Around nothing.
  CasterBox() = default;
  /// Around nothing if the instance casts no shadow.
  explicit CasterBox(const Instance& instance)
    : CasterBox(instance, stableInverse(glm::dmat3(instance.localToWorld)))
  {
  }
  /// `inverse`: of its matrix' linear part.
  CasterBox(const Instance& instance, const glm::dmat3& inverse)
  {
    this->Casts = instance.castShadow && instance.body->octree && !instance.body->octree.empty();
    if (!this->Casts)
    {
      return;
    }
    const Header& h = instance.body->octree.header();
    glm::dvec3 low, high;
    for (int i = 0; i < 3; ++i)
    {
      // Leaves are met a voxel beyond the mesh, planes a cell before theirs.
      low[i] = h.origin[i];
      high[i] = h.origin[i] + h.voxelSize * static_cast<double>(1u << h.level);
      if (h.pointCount > 0 && h.meshBounds[2 * i] <= h.meshBounds[2 * i + 1])
      {
        low[i] = std::max(low[i], h.meshBounds[2 * i] - 2.0 * h.voxelSize);
        high[i] = std::min(high[i], h.meshBounds[2 * i + 1] + 2.0 * h.voxelSize);
      }
    }
    for (int i = 0; i < 3; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        this->Inverse[axis][i] = inverse[axis][i] / (0.5 * (high[i] - low[i]));
      }
    }
    this->Centre = glm::dvec3(instance.localToWorld * glm::dvec4(0.5 * (low + high), 1.0));
  }

  /// Around a cube along the world's axes.
  CasterBox(const glm::dvec3& centre, double half)
    : Casts(true)
    , Centre(centre)
    , Inverse(1.0 / half)
  {
  }

  /// False if no way from a point of `from` to the light meets the box.
  bool mayBlock(const Light& light, const PointBox& from) const
  {
    // The way of the middle, and all others' within a box that gets narrower towards the light.
    const glm::dvec3 middle = 0.5 * (from.low + from.high);
    return !from.empty() &&
      this->mayMeet(middle, 0.5 * (from.high - from.low), -light.along(middle),
        light.atInfinity() ? 1e300 : 1.0);
  }
  /// False if the box is not on the way from a point, `share` times `along` at most, nor nearer to
  /// it than `half` of another box.
  bool mayMeet(
    const glm::dvec3& from, const glm::dvec3& half, const glm::dvec3& along, double share) const
  {
    if (!this->Casts)
    {
      return false;
    }
    const glm::dvec3 begin = this->Inverse * (from - this->Centre);
    const glm::dvec3 way = this->Inverse * along;
    double first = 0.0, last = share;
    for (int i = 0; i < 3; ++i)
    {
      const double others = std::abs(this->Inverse[0][i]) * half.x +
        std::abs(this->Inverse[1][i]) * half.y + std::abs(this->Inverse[2][i]) * half.z;
      const double reach = 1.000001 * (1.0 + others);
      if (way[i] == 0.0)
      {
        if (std::abs(begin[i]) > reach)
        {
          return false;
        }
        continue;
      }
      const double a = (-reach - begin[i]) / way[i], b = (reach - begin[i]) / way[i];
      first = std::max(first, std::min(a, b));
      last = std::min(last, std::max(a, b));
    }
    return !(first > last * (1.0 + 1e-9));
  }

private:
  bool Casts = false;
  glm::dvec3 Centre{ 0.0 };  // world
  glm::dmat3 Inverse{ 1.0 }; // of the box's half edges
};
}

#endif
