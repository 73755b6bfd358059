#include "svoShadowRays.h"

#include "svoIntersect.h"

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
/// Where rays to a light end, the light itself being at 1: what the light lies on is not between.
constexpr double BeforeLight = 1.0 - 1e-9;
}

ShadowRays::ShadowRays(const Scene& scene, const LayeredView& eye)
{
  for (const Instance& instance : scene.instances)
  {
    if (instance.castShadow && instance.octree && !instance.octree.empty())
    {
      const std::size_t index = &instance - scene.instances.data();
      this->Casters.push_back({ &instance, eye.leafGeometry(static_cast<std::uint32_t>(index)),
        WorldToOctree(instance.octree, instance.localToWorld) });
    }
  }
}

bool ShadowRays::shadows(
  const Light& light, const glm::dvec3& position, const glm::vec3& facet, double offset) const
{
  const bool far = light.kind == Light::Kind::Directional;
  glm::dvec3 direction = far ? -light.direction : light.position - position;
  const glm::dvec3 side =
    glm::dot(glm::dvec3(facet), direction) < 0.0 ? -glm::dvec3(facet) : glm::dvec3(facet);
  const glm::dvec3 start = position + offset * side;
  direction = far ? direction : light.position - start;
  for (const Caster& caster : this->Casters)
  {
    const Ray ray{ caster.toOctree.point(start), caster.toOctree.vector(direction), 0.0,
      far ? 1e300 : BeforeLight };
    if (occluded(caster.instance->octree, ray, { caster.geometry, MaximumLevel }))
    {
      return true;
    }
  }
  return false;
}
}
