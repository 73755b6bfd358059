#include "svoCasters.h"

#include "svoWorldToOctree.h"

#include <glm/mat3x3.hpp>

namespace svo
{
namespace
{
/// True if `caster` is flat and the light and all receivers are on one side of it.
bool isOnlyBackdrop(const std::vector<Outline>& outlines, const Outline& caster, const Light& light)
{
  int axis = 0;
  while (axis < 3 && caster.meshLow[axis] != caster.meshHigh[axis])
  {
    ++axis;
  }
  if (axis == 3 || !knowsMeshBox(caster))
  {
    return false;
  }
  const glm::dmat4 localToWorld = matrixOf(caster);
  const glm::dmat3 inverse = stableInverse(glm::dmat3(localToWorld));
  const glm::dvec3 translation(localToWorld[3]);
  const auto height = [&](const glm::dvec3& x) { return (inverse * (x - translation))[axis]; };
  const double plane = caster.meshLow[axis];
  const double lightSide =
    light.atInfinity() ? -(inverse * light.direction)[axis] : height(light.position) - plane;
  const double side = lightSide < 0.0 ? -1.0 : 1.0;
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
  std::vector<std::uint8_t> casters;
  for (const Outline& outline : outlines)
  {
    casters.push_back(outline.casts && !isOnlyBackdrop(outlines, outline, light));
  }
  return casters;
}
}
