#include "svoBuildPeers.h"

#include "svoEmbreeScene.h"

#ifdef SVO_OPENVDB
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <tbb/global_control.h>
#endif

namespace svobench
{
std::vector<std::pair<std::string, std::function<void()>>> buildPeers(
  [[maybe_unused]] const Mesh& mesh, [[maybe_unused]] double voxel)
{
  std::vector<std::pair<std::string, std::function<void()>>> peers;
#ifdef SVO_EMBREE
  const std::pair<const char*, RTCBuildQuality> qualities[] = { { "Embree, low quality",
                                                                  RTC_BUILD_QUALITY_LOW },
    { "Embree", RTC_BUILD_QUALITY_MEDIUM }, { "Embree, high quality", RTC_BUILD_QUALITY_HIGH } };
  for (const auto& [name, quality] : qualities)
  {
    peers.emplace_back(name, [&mesh, kind = quality] { buildWithEmbree(mesh, kind); });
  }
#endif
#ifdef SVO_OPENVDB
  openvdb::initialize();
  // Half a band of one voxel holds the voxels that the surface passes through, and their
  // neighbours: nearest to what an octree holds.
  peers.emplace_back("OpenVDB, narrow band",
    [&mesh, voxel]
    {
      const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
      std::vector<openvdb::Vec3s> points;
      for (const glm::dvec3& p : mesh.points)
      {
        points.emplace_back(p.x, p.y, p.z);
      }
      std::vector<openvdb::Vec3I> triangles;
      for (const glm::uvec3& t : mesh.triangles)
      {
        triangles.emplace_back(t.x, t.y, t.z);
      }
      openvdb::tools::meshToUnsignedDistanceField<openvdb::FloatGrid>(
        *openvdb::math::Transform::createLinearTransform(voxel), points, triangles, {}, 1.0f);
    });
#endif
  return peers;
}
}
