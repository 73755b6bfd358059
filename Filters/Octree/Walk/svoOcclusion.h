// Rays of any origins and directions of which only is asked whether they meet anything: those of
// soft shadows and of ambient occlusion.
#ifndef svoOcclusion_h
#define svoOcclusion_h

#include "svoOctree.h"
#include "svoRay.h"
#include "vtkSVOOctreeModule.h"

#include <cstdint>

#include <glm/vec3.hpp>

namespace svo
{
/// Rays of any origins and directions, octree coordinates ([1,2)^3), as a structure of arrays; t in
/// [0, tMax]. Rays with a NaN anywhere, or with tMax < 0, meet nothing.
struct OcclusionRays
{
  static constexpr int Most = 512;
  int count = 0;
  alignas(64) float originX[Most], originY[Most], originZ[Most];
  alignas(64) float directionX[Most], directionY[Most], directionZ[Most];
  alignas(64) float tMax[Most];

  void add(const glm::vec3& origin, const glm::vec3& direction, float end)
  {
    originX[count] = origin.x;
    originY[count] = origin.y;
    originZ[count] = origin.z;
    directionX[count] = direction.x;
    directionY[count] = direction.y;
    directionZ[count] = direction.z;
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
