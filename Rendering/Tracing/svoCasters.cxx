#include "svoCasters.h"

#include "svoWorldToOctree.h"

#include <glm/common.hpp>

namespace svo
{
namespace
{
bool knowsMeshBox(const Header& h)
{
  return h.pointCount > 0 && h.meshBounds[0] <= h.meshBounds[1] &&
    h.meshBounds[2] <= h.meshBounds[3] && h.meshBounds[4] <= h.meshBounds[5];
}

std::array<glm::dvec3, 8> corners(const Instance& instance, double margin)
{
  const Header& h = instance.octree.header();
  const double edge = h.voxelSize * static_cast<double>(1u << h.level);
  glm::dvec3 low(h.origin[0], h.origin[1], h.origin[2]);
  glm::dvec3 high = low + edge;
  if (knowsMeshBox(h))
  {
    // The mesh is in the middle of the cube: its own box is tighter.
    low = glm::max(low, glm::dvec3(h.meshBounds[0], h.meshBounds[2], h.meshBounds[4]) - margin);
    high = glm::min(high, glm::dvec3(h.meshBounds[1], h.meshBounds[3], h.meshBounds[5]) + margin);
  }
  std::array<glm::dvec3, 8> result;
  for (int i = 0; i < 8; ++i)
  {
    result[i] = glm::dvec3(instance.localToWorld *
      glm::dvec4(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z, 1.0));
  }
  return result;
}

/// True if `caster` is flat and the light and all receivers are on one side of it.
bool isOnlyBackdrop(const Scene& scene, const Instance& caster, const Light& light)
{
  const Header& h = caster.octree.header();
  int axis = 0;
  while (axis < 3 && h.meshBounds[2 * axis] != h.meshBounds[2 * axis + 1])
  {
    ++axis;
  }
  if (axis == 3 || !knowsMeshBox(h))
  {
    return false;
  }
  const glm::dmat3 inverse = stableInverse(glm::dmat3(caster.localToWorld));
  const glm::dvec3 translation(caster.localToWorld[3]);
  const auto height = [&](const glm::dvec3& x) { return (inverse * (x - translation))[axis]; };
  const double plane = h.meshBounds[2 * axis];
  const double lightSide = light.kind == Light::Kind::Directional
    ? -(inverse * light.direction)[axis]
    : height(light.position) - plane;
  const double side = lightSide < 0.0 ? -1.0 : 1.0;
  for (const Instance& receiver : scene.instances)
  {
    if (&receiver == &caster || !receiver.visible || !receiver.receiveShadow || !receiver.octree ||
      !placesSomething(receiver.localToWorld))
    {
      continue;
    }
    for (const glm::dvec3& corner : corners(receiver, 0.0))
    {
      const double local = height(corner) - plane;
      if (!(side * local >= -0.5 * h.voxelSize))
      {
        return false;
      }
    }
  }
  return true;
}
}

std::array<glm::dvec3, 8> worldBox(const Instance& instance)
{
  return corners(instance, instance.octree.header().voxelSize);
}

std::vector<std::uint8_t> castersOf(const Scene& scene, const Light& light, bool unknownReceivers)
{
  std::vector<std::uint8_t> casters(scene.instances.size(), 0);
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
  {
    const Instance& instance = scene.instances[i];
    casters[i] = instance.castShadow && instance.octree && !instance.octree.empty() &&
      placesSomething(instance.localToWorld) &&
      (unknownReceivers || !isOnlyBackdrop(scene, instance, light));
  }
  return casters;
}
}
