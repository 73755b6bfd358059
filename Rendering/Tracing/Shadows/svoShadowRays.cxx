#include "svoShadowRays.h"

#include "svoIntersect.h"
#include "svoLeafError.h"
#include "svoWorldSize.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
/// Where rays to a light end, the light itself being at 1: what the light lies on is not between.
constexpr double BeforeLight = 1.0 - 1e-9;

/// The facet's normal on the light's side.
glm::dvec3 sideOf(const Light& light, const glm::dvec3& position, const glm::vec3& facet)
{
  assert(std::abs(glm::dot(facet, facet) - 1.0f) < 1e-3f); // offsets are along it
  const glm::dvec3 normal(facet);
  return glm::dot(normal, light.along(position)) > 0.0 ? -normal : normal;
}
}

ShadowRays::ShadowRays(const Scene& scene, const LayeredView& eye)
{
  for (const Instance& instance : scene.instances)
  {
    if (instance.castShadow && instance.octree && !instance.octree.empty())
    {
      const std::size_t index = &instance - scene.instances.data();
      const LeafGeometry geometry = eye.leafGeometry(static_cast<std::uint32_t>(index));
      const LeafTraits traits = traitsOf(geometry);
      const bool mixed = traits.exact() && instance.octree.longestList() > traits.longestExact;
      const double planeError = mixed ? CubeError * worldVoxel(instance) : 0.0;
      this->Casters.push_back(
        { &instance, geometry, WorldToOctree(instance.octree, instance.localToWorld), planeError,
          std::max(planeError, worldLeafError(instance, geometry, instance.octree.level())) });
    }
  }
}

bool ShadowRays::shadows(
  const Light& light, const glm::dvec3& position, const glm::vec3& facet, double offset) const
{
  const bool far = light.atInfinity();
  const glm::dvec3 side = sideOf(light, position, facet);
  const glm::dvec3 start = position + offset * side;
  const glm::dvec3 direction = -light.along(start);
  for (const Caster& caster : this->Casters)
  {
    const Ray ray{ caster.toOctree.point(start), caster.toOctree.vector(direction), 0.0,
      far ? 1e300 : BeforeLight };
    const TraceOptions options{ caster.geometry, MaximumLevel };
    if (!occluded(caster.instance->octree, ray, options))
    {
      continue;
    }
    if (caster.planeError <= offset)
    {
      return true;
    }
    // Triangles and planes are mixed: the start may lie behind the planes of its own surface, or in
    // cells that refuse the ray. What is met before the ray can have left them has to be met from
    // outside of them too.
    const double length = glm::length(direction);
    const double slope = std::max(glm::dot(side, direction) / length, 0.05);
    const Hit hit = intersect(caster.instance->octree, ray, options);
    if (hit.t * length > caster.planeError / slope)
    {
      return true;
    }
    const Ray outer{ caster.toOctree.point(position + caster.planeError * side), ray.direction, 0.0,
      ray.tMax };
    if (occluded(caster.instance->octree, outer, options))
    {
      return true;
    }
  }
  return false;
}

glm::dvec3 ShadowRays::start(
  const Light& light, const glm::dvec3& position, const glm::vec3& facet, double offset)
{
  return position + offset * sideOf(light, position, facet);
}

bool ShadowRays::between(const glm::dvec3& from, const glm::dvec3& to, double offset) const
{
  const glm::dvec3 direction = to - from;
  const double length = glm::length(direction);
  for (const Caster& caster : this->Casters)
  {
    const double first = std::max(offset, caster.leafError);
    if (first < length)
    {
      const Ray ray{ caster.toOctree.point(from), caster.toOctree.vector(direction), first / length,
        1.0 };
      if (occluded(caster.instance->octree, ray, { caster.geometry, MaximumLevel }))
      {
        return true;
      }
    }
  }
  return false;
}
}
