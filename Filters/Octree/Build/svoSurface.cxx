// A mesh's triangles in octree coordinates.
#include "svoBuild.h"

#include "svoLattice.h"

#include <cmath>

namespace svo
{
std::shared_ptr<const Surface> makeSurface(const TriangleMesh& mesh,
  std::vector<std::uint32_t> cells, const Header& header, const ParallelFor& parallelFor)
{
  auto surface = std::make_shared<Surface>();
  surface->points.resize(mesh.pointCount);
  surface->triangles.assign(mesh.triangles, mesh.triangles + mesh.triangleCount);
  surface->cells = std::move(cells);
  const glm::dvec3 origin(header.origin[0], header.origin[1], header.origin[2]);
  const double scale = 1.0 / std::ldexp(header.voxelSize, static_cast<int>(2 * header.depthCount));
  parallelFor(0, mesh.pointCount, 16384,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        const glm::dvec3& p = mesh.points[i];
        surface->points[i] = usable(p) ? glm::vec3(1.0 + (p - origin) * scale) : glm::vec3(1.0f);
      }
    });
  return surface;
}
}
