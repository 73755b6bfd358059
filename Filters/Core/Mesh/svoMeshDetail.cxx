#include "svoMeshDetail.h"

#include "svoBuild.h"
#include "svoLayout.h"
#include "svoMeshTriangles.h"
#include "svoMorton.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/common.hpp>

namespace svo
{
namespace
{
constexpr int Coarsest = 4;                    // smaller ones take no less time to build
constexpr std::size_t MostTriangles = 1 << 17; // whose octree would be that deep anyway
constexpr std::size_t Few = 4; // in a brick: as many again reach into it from its neighbours
constexpr std::size_t CrowdedOneIn = 100; // triangles, as those around the poles of a sphere
constexpr int Bits = 16;                  // of a centre's coordinate

/// Morton keys of the triangles' centres in the mesh's bounding cube, sorted.
std::vector<std::uint64_t> sortedCentres(const TriangleMesh& mesh, const Cube& cube)
{
  const double scale = std::ldexp(1.0 / cube.edge, Bits);
  std::vector<std::uint64_t> keys;
  keys.reserve(mesh.triangleCount);
  for (std::size_t i = 0; i < mesh.triangleCount; ++i)
  {
    const glm::uvec3& t = mesh.triangles[i];
    const glm::dvec3 x = ((mesh.points[t.x] - cube.origin) + (mesh.points[t.y] - cube.origin) +
                           (mesh.points[t.z] - cube.origin)) *
      (scale / 3.0);
    if (std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z))
    {
      const glm::ivec3 cell(glm::clamp(x, 0.0, std::ldexp(1.0, Bits) - 1.0));
      keys.push_back(mortonKey(cell.x, cell.y, cell.z));
    }
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

/// How many of the keys share their first bits with more than a few others.
std::size_t crowded(const std::vector<std::uint64_t>& keys, int shift)
{
  std::size_t sum = 0;
  for (std::size_t i = 0, end = 0; i < keys.size(); i = end)
  {
    for (end = i; end < keys.size() && keys[end] >> shift == keys[i] >> shift; ++end)
    {
    }
    sum += end - i > Few ? end - i : 0;
  }
  return sum;
}

int levelOf(vtkPolyData* mesh, double& edge)
{
  const MeshTriangles triangles(mesh);
  const TriangleMesh view = triangles.view();
  if (!triangles.addressable() || view.triangleCount > MostTriangles)
  {
    return MaximumLevel;
  }
  const Cube cube = boundingCube(view, Bits);
  edge = cube.edge;
  const std::vector<std::uint64_t> keys = sortedCentres(view, cube);
  for (int level = Coarsest; level <= Bits + NodeLevels; ++level)
  {
    const int brickBits = level - NodeLevels;
    if (crowded(keys, 3 * (Bits - brickBits)) * CrowdedOneIn <= keys.size())
    {
      return level;
    }
  }
  return MaximumLevel;
}
}

int detailLevel(vtkPolyData* mesh)
{
  double edge;
  return levelOf(mesh, edge);
}

double detailVoxel(vtkPolyData* mesh)
{
  double edge = 0.0;
  const int level = levelOf(mesh, edge);
  return level < MaximumLevel ? std::ldexp(edge, -level) : 0.0;
}

int levelOfVoxel(const double bounds[6], double voxel, int maximum)
{
  const double edge =
    std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
  if (!(voxel > 0.0) || !(edge > 0.0))
  {
    return maximum;
  }
  constexpr double Margin = 1e-3; // cubes are a little larger than what is in them
  const double level = std::ceil(std::log2(edge / voxel) - Margin);
  return static_cast<int>(std::clamp(level, 1.0, static_cast<double>(maximum)));
}
}
