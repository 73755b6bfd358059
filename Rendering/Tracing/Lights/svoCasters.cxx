#include "svoCasters.h"

#include "svoBox.h"
#include "svoWorldToOctree.h"

#include <cmath>
#include <limits>
#include <optional>

#include <glm/mat3x3.hpp>

namespace svo
{
namespace
{
/// Around all receivers, world. Infinite if one may be anywhere, empty if there are none.
Box boxOfReceivers(const std::vector<Outline>& outlines)
{
  Box box;
  for (const Outline& receiver : outlines)
  {
    if (!receiver.receives)
    {
      continue;
    }
    for (const glm::dvec3& corner : worldCorners(receiver, 0.0))
    {
      if (!std::isfinite(corner.x + corner.y + corner.z))
      {
        constexpr double Infinity = std::numeric_limits<double>::infinity();
        return { glm::dvec3(-Infinity), glm::dvec3(Infinity) };
      }
      box.add(corner);
    }
  }
  return box;
}

/// True if `caster` is flat and the light and all receivers are on one side of it. `all`: around
/// them, once it was asked for.
bool isOnlyBackdrop(const std::vector<Outline>& outlines, std::optional<Box>& all,
  const Outline& caster, const Light& light)
{
  int axis = 0;
  while (axis < 3 && caster.mesh.low[axis] != caster.mesh.high[axis])
  {
    ++axis;
  }
  if (axis == 3 || !caster.mesh.known())
  {
    return false;
  }
  const glm::dmat3 inverse = stableInverse(glm::dmat3(caster.localToWorld));
  const glm::dvec3 translation(caster.localToWorld[3]);
  const auto height = [&](const glm::dvec3& x) { return (inverse * (x - translation))[axis]; };
  const double plane = caster.mesh.low[axis];
  const double lightSide =
    light.atInfinity() ? -(inverse * light.direction)[axis] : height(light.position) - plane;
  const double side = lightSide < 0.0 ? -1.0 : 1.0;
  // Of many flat casters, glyphs for instance, each would ask all receivers.
  all = all ? all : boxOfReceivers(outlines);
  bool allOnOneSide = true;
  for (int i = 0; i < 8; ++i)
  {
    allOnOneSide =
      allOnOneSide && side * (height(all->corner(i)) - plane) >= -0.5 * caster.smallestVoxel;
  }
  if (allOnOneSide)
  {
    return true;
  }
  for (const Outline& receiver : outlines)
  {
    if (&receiver == &caster || !receiver.receives)
    {
      continue;
    }
    for (const glm::dvec3& corner : worldCorners(receiver, 0.0))
    {
      const double local = height(corner) - plane;
      if (!(side * local >= -0.5 * caster.smallestVoxel))
      {
        return false;
      }
    }
  }
  return true;
}
}

std::vector<std::uint8_t> castersOf(const std::vector<Outline>& outlines, const Light& light)
{
  std::optional<Box> all;
  std::vector<std::uint8_t> casters;
  casters.reserve(outlines.size());
  for (const Outline& outline : outlines)
  {
    casters.push_back(outline.casts && !isOnlyBackdrop(outlines, all, outline, light));
  }
  return casters;
}
}
