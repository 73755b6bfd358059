#include "svoRayCasters.h"

#include "svoIntersect.h"
#include "svoLeafError.h"
#include "svoSurfaceAlpha.h"
#include "svoWorldSize.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
/// Of the edge of the root cube: the roundings of a start and of a triangle's corners, and as much
/// again.
constexpr double FloatError = 1e-6;
}

RayCasters::RayCasters(const Scene& scene, const ViewedInstances& seen, const LooseOctree* tree)
  : Tree(tree)
  , Casting(tree ? scene.instances.size() : 0, None)
{
  for (const Instance& instance : scene.instances)
  {
    if (instance.castShadow && instance.body->octree && !instance.body->octree.empty())
    {
      const Octree& octree = instance.body->octree;
      const auto index = static_cast<std::uint32_t>(&instance - scene.instances.data());
      const LeafGeometry geometry = seen.leafGeometry(index);
      const LeafTraits traits = traitsOf(geometry);
      const bool exact = traits.exact() && octree.surface();
      const bool mixed = traits.exact() && octree.longestList() > traits.longestExact;
      const double planeError = mixed ? CubeError * worldVoxel(instance) : 0.0;
      std::vector<RayCaster>& casters = instance.translucent() ? this->Translucent : this->Opaque;
      if (tree && !instance.translucent())
      {
        this->Casting[index] = static_cast<std::uint32_t>(casters.size());
      }
      const WorldToOctree toOctree(octree, instance.localToWorld);
      casters.push_back({ &instance, index, geometry, toOctree, planeError,
        std::max(planeError, worldLeafError(instance, geometry, octree.level())), exact && !mixed,
        CasterBox(instance, toOctree.inverse),
        instance.mappedOpacity ? SurfaceMatrices(instance) : SurfaceMatrices(),
        FloatError * worldVoxel(instance, 0) });
      this->MostStartOffset =
        std::max(this->MostStartOffset, casters.back().startOffset(0.0, true));
    }
  }
}

float opacityMet(
  const RayCaster& caster, const glm::dvec3& end, const glm::dvec3& towards, double length)
{
  const Instance& instance = *caster.instance;
  if (!instance.mappedOpacity)
  {
    return instance.opacity;
  }
  const glm::dvec3 localEnd = caster.toOctree.point(end);
  const glm::dvec3 local = caster.toOctree.vector(towards);
  const double beyond = glm::distance(localEnd, glm::dvec3(1.5)) + 1.0; // the cube is 1..2
  const double from = length < 1e30 ? length : beyond / glm::length(local);
  const Hit hit = intersect(instance.body->octree, { localEnd + from * local, -local, 0.0, from },
    { caster.geometry, MaximumLevel });
  return hit ? instance.opacity *
      surfaceAlpha(caster.matrices, end + (from - hit.t) * towards,
        glm::vec3(glm::normalize(towards)), hit.primitive)
             : 0.0f;
}
}
