// Boxes around casters, and around points that ask: where the one is not on the way from the other
// to a light, a caster need not be looked at.
#ifndef svoCasterBox_h
#define svoCasterBox_h

#include "svoBox.h"
#include "svoInverse.h"
#include "svoScene.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace svo
{
/// The way that a box takes, and with it all points in it: `share` times `along` from its middle,
/// its half edges growing by `spread` for each unit of the way; world.
struct BoxWay
{
  glm::dvec3 middle, half, along;
  double share, spread;
};

/// From a box of points to a light, all of it.
inline BoxWay wayToLight(const Light& light, const Box& from)
{
  const glm::dvec3 middle = 0.5 * (from.low + from.high);
  // A box that gets narrower towards the light, or wider if the light is larger.
  const glm::dvec3 half = glm::max(0.5 * (from.high - from.low), glm::dvec3(light.radius()));
  return { middle, half, -light.along(middle), light.atInfinity() ? 1e300 : 1.0, light.spread() };
}

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
      const double half = 0.5 * (high[i] - low[i]);
      for (int axis = 0; axis < 3; ++axis)
      {
        this->Inverse[axis][i] = inverse[axis][i] / half;
      }
      this->Extent += half * glm::abs(glm::dvec3(instance.localToWorld[i]));
    }
    this->Centre = glm::dvec3(instance.localToWorld * glm::dvec4(0.5 * (low + high), 1.0));
  }

  /// Around a cube along the world's axes.
  CasterBox(const glm::dvec3& centre, double half)
    : Casts(true)
    , Centre(centre)
    , Extent(half)
    , Inverse(1.0 / half)
  {
  }

  /// Of a box along the world's axes around it; `extent`: half its edges.
  const glm::dvec3& centre() const { return this->Centre; }
  const glm::dvec3& extent() const { return this->Extent; }

  /// Adds its corners; nothing if it is around nothing.
  void addTo(Box& all) const
  {
    if (this->Casts)
    {
      all.add(this->Centre, this->Extent);
    }
  }
  /// False if no way from a point of `from` to the light meets the box.
  bool mayBlock(const Light& light, const Box& from) const
  {
    return from.known() && this->mayMeet(wayToLight(light, from));
  }
  /// False if the box is not on the way.
  bool mayMeet(const BoxWay& way) const
  {
    if (!this->Casts)
    {
      return false;
    }
    glm::dvec3 half = way.half;
    if (way.spread > 0.0)
    {
      // As long as any way is from one of the points to one of the box.
      half += way.spread *
        (glm::distance(way.middle, this->Centre) + glm::length(this->Extent) +
          glm::length(way.half));
    }
    const glm::dvec3 begin = this->Inverse * (way.middle - this->Centre);
    const glm::dvec3 along = this->Inverse * way.along;
    double first = 0.0, last = way.share;
    for (int i = 0; i < 3; ++i)
    {
      const double others = std::abs(this->Inverse[0][i]) * half.x +
        std::abs(this->Inverse[1][i]) * half.y + std::abs(this->Inverse[2][i]) * half.z;
      const double reach = 1.000001 * (1.0 + others);
      if (along[i] == 0.0)
      {
        if (std::abs(begin[i]) > reach)
        {
          return false;
        }
        continue;
      }
      const double a = (-reach - begin[i]) / along[i], b = (reach - begin[i]) / along[i];
      first = std::max(first, std::min(a, b));
      last = std::min(last, std::max(a, b));
    }
    return !(first > last * (1.0 + 1e-9));
  }

private:
  bool Casts = false;
  glm::dvec3 Centre{ 0.0 };  // world
  glm::dvec3 Extent{ 0.0 };  // along the world's axes, from the centre
  glm::dmat3 Inverse{ 1.0 }; // of the box's half edges
};
}

#endif
