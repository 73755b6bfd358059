// The bounding cube of a mesh, and its triangles in octree coordinates.
#include "svoBuild.h"

#include "svoLattice.h"

#include <limits>

namespace svo
{
Cube boundingCube(const TriangleMesh& mesh, int level)
{
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < mesh.triangleCount; ++i)
  {
    const glm::uvec3& t = mesh.triangles[i];
    const glm::dvec3 &a = mesh.points[t.x], &b = mesh.points[t.y], &c = mesh.points[t.z];
    if (usable(a) && usable(b) && usable(c))
    {
      low = glm::min(low, glm::min(a, glm::min(b, c)));
      high = glm::max(high, glm::max(a, glm::max(b, c)));
    }
  }
  if (!(low.x <= high.x))
  {
    return { glm::dvec3(0.0), 1.0 };
  }
  const glm::dvec3 extents = high - low;
  const double extent = std::max({ extents.x, extents.y, extents.z });
  const glm::dvec3 magnitudes = glm::max(glm::abs(low), glm::abs(high));
  const double magnitude = std::max({ magnitudes.x, magnitudes.y, magnitudes.z });
  // A voxel is never smaller than the steps between doubles at the mesh's distance, nor so small
  // that its inverse overflows.
  const double resolvable = std::ldexp(magnitude, level - 52);
  const double units = std::ldexp(1.0, level + LatticeBits);
  double edge = std::max({ extent * (units / (units - 4.0)), resolvable, 1e-250 });
  if (extent == 0.0)
  {
    edge = magnitude > 0.0 ? std::max(edge, std::ldexp(magnitude, -20)) : 1.0;
  }
  glm::dvec3 origin = low + (extents * 0.5 - edge * 0.5);
  for (int i = 0; i < 3; ++i)
  {
    // Rounding of the origin may eat the margin where a lattice unit is below a double's step.
    while (low[i] - origin[i] < edge / units)
    {
      origin[i] = std::nextafter(origin[i], -std::numeric_limits<double>::infinity());
    }
    edge = std::max(edge, (high[i] - origin[i]) * (units / (units - 1.0)));
  }
  return { origin, edge };
}

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
