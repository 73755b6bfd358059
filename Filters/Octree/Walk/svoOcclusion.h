// Rays of any origins and directions of which only is asked whether they meet anything: those of
// soft shadows and of ambient occlusion.
#ifndef svoOcclusion_h
#define svoOcclusion_h

#include "svoOctree.h"
#include "svoRay.h"
#include "vtkSVOOctreeModule.h"

#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

namespace svo
{
/// Rays of any origins and directions; t in [0, tMax]. Rays with a NaN anywhere, or with tMax < 0,
/// meet nothing.
struct OcclusionRays : RayArrays<512>
{
  static constexpr int Most = Size;
  int count = 0;

  void add(const glm::vec3& from, const glm::vec3& along, float end)
  {
    aim(static_cast<std::size_t>(count), from, along);
    tMax[count++] = end;
  }
};

/// Sets bit i % 64 of met[i / 64] for each ray of count that meets anything, clears the others; met
/// has (count + 63) / 64 words. In float. The answers depend neither on the other rays nor on the
/// instruction set: they are those of the block queries of svoIntersect.h. `by`: where not null,
/// what each of these rays meets, of all that it does any; which one may depend on both.
VTKSVOOCTREE_EXPORT void occluded(const Octree& octree, const OcclusionRays& rays,
  const TraceOptions& options, std::uint64_t* met, Primitive* by = nullptr);
}

#endif
