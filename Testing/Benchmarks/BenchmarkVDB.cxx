// Rays against a level set: OpenVDB's own intersector and ours, the same rays, one thread, by
// turns.
//
//   BenchmarkVDB [--levels 7,8,9] [--rays 1000000] [--repeat 5]
//
// A frame's rays, in tiles of 8x8 neighbours, and as many from everywhere. All hits are compared
// while they are timed: where both hit, they have to be within a voxel, but for rays that pass the
// surface closely, one in two hundred. Prints medians of processor time; ends with 1 if not.
#include "svoIntersect.h"
#include "svoMeshOctree.h"
#include "svoVDBLevelSet.h"
#include "svoVDBOctree.h"

#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <openvdb/openvdb.h>
#include <openvdb/tools/RayIntersector.h>

namespace
{
constexpr double None = std::numeric_limits<double>::infinity();

struct Ray
{
  glm::dvec3 from, along;
};

/// A closed surface of half a million triangles, about 2 wide.
vtkSmartPointer<vtkPolyData> waves()
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(720);
  source->SetPhiResolution(360);
  source->SetRadius(1.0);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  vtkPoints* points = source->GetOutput()->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double x[3];
    points->GetPoint(i, x);
    const double f =
      1.0 + 0.3 * std::sin(7.0 * x[2] + 1.0) * std::cos(5.0 * x[0]) * std::cos(3.0 * x[1]);
    points->SetPoint(i, f * x[0], 0.7 * f * x[1], 1.2 * f * x[2]);
  }
  return source->GetOutput();
}

/// Of a camera at a place, so many that the picture is square and made of tiles of 8x8.
std::vector<Ray> frame(int rays)
{
  const int tiles = std::max(1, static_cast<int>(std::sqrt(rays / 64.0)));
  const glm::dvec3 eye(2.2, -2.6, 1.4);
  const glm::dvec3 forward = glm::normalize(-eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0.0, 0.0, 1.0)));
  const glm::dvec3 up = glm::cross(right, forward);
  std::vector<Ray> made;
  for (int i = 0; i < tiles * tiles * 64; ++i)
  {
    const int x = i / 64 % tiles * 8 + i % 8, y = i / 64 / tiles * 8 + i / 8 % 8;
    const double u = 0.8 * ((x + 0.5) / (8 * tiles) - 0.5),
                 v = 0.8 * ((y + 0.5) / (8 * tiles) - 0.5);
    made.push_back({ eye, glm::normalize(forward + u * right + v * up) });
  }
  return made;
}

std::vector<Ray> fromEverywhere(std::size_t count)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::vector<Ray> made;
  while (made.size() < count)
  {
    const glm::dvec3 d(any(random), any(random), any(random));
    if (glm::dot(d, d) < 1.0 && glm::dot(d, d) > 0.01)
    {
      const glm::dvec3 from = 4.0 * glm::normalize(d);
      const glm::dvec3 to(1.3 * any(random), any(random), 1.5 * any(random));
      made.push_back({ from, glm::normalize(to - from) });
    }
  }
  return made;
}

using Distances = std::vector<double>;

void traceTheirs(const openvdb::tools::LevelSetRayIntersector<openvdb::FloatGrid>& theirs,
  const std::vector<Ray>& rays, Distances& found)
{
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    const Ray& r = rays[i];
    openvdb::Vec3d at;
    const bool hit = theirs.intersectsWS(
      { { r.from.x, r.from.y, r.from.z }, { r.along.x, r.along.y, r.along.z } }, at);
    found[i] = hit ? glm::dot(glm::dvec3(at.x(), at.y(), at.z()) - r.from, r.along) : None;
  }
}

void traceAlone(const svo::Octree& octree, const std::vector<Ray>& rays, Distances& found)
{
  const glm::dmat4 toOctree = octree.localToOctree();
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    svo::Ray ray;
    ray.origin = glm::dvec3(toOctree * glm::dvec4(rays[i].from, 1.0));
    ray.direction = glm::dvec3(toOctree * glm::dvec4(rays[i].along, 0.0));
    ray.tMin = 0.0;
    ray.tMax = 100.0;
    const svo::Hit hit = svo::intersect(octree, ray, { svo::LeafGeometry::Plane });
    found[i] = hit ? hit.t : None;
  }
}

void traceBlocks(const svo::Octree& octree, const std::vector<Ray>& rays, Distances& found)
{
  constexpr std::size_t Size = svo::RayBlock::Size;
  const glm::dmat4 toOctree = octree.localToOctree();
  svo::RayBlock block;
  svo::HitBlock hits;
  double moved[Size];
  for (std::size_t first = 0; first + Size <= rays.size(); first += Size)
  {
    for (std::size_t i = 0; i < Size; ++i)
    {
      // Floats begin at the cube, as in frames.
      const glm::dvec3 from(toOctree * glm::dvec4(rays[first + i].from, 1.0));
      const glm::dvec3 along(toOctree * glm::dvec4(rays[first + i].along, 0.0));
      moved[i] =
        std::max(0.0, (glm::length(from - 1.5) - 0.9) / glm::length(along)); // a sphere around it
      const glm::dvec3 start = from + moved[i] * along;
      block.aim(i, start, along);
      block.tMin[i] = 0.0f;
      block.tMax[i] = 100.0f;
    }
    svo::intersect(octree, block, { svo::LeafGeometry::Plane }, hits);
    for (std::size_t i = 0; i < Size; ++i)
    {
      found[first + i] =
        hits.primitive[i] == svo::NoPrimitive ? None : moved[i] + static_cast<double>(hits.t[i]);
    }
  }
}

double processorTime()
{
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Rays for which two disagree by more than a voxel.
std::size_t apart(const Distances& a, const Distances& b, double voxel)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    count += a[i] != b[i] && !(std::abs(a[i] - b[i]) <= voxel);
  }
  return count;
}

bool measure(int level, int count, int repeat)
{
  const auto mesh = waves();
  svo::MeshOctreeOptions options;
  options.level = level;
  svo::Octree ofMesh;
  std::string message;
  svo::buildMeshOctree(mesh, options, ofMesh, message);
  const openvdb::FloatGrid::Ptr grid = svo::levelSetOf(ofMesh, mesh, 3.0, nullptr, message);
  vtkNew<vtkPolyData> hull;
  svo::Octree octree;
  svo::octreeOfGrid(*grid, svo::VDBOptions(), hull);
  if (svo::openAttachedOctree(hull, octree, message) != svo::Attached::Found)
  {
    std::printf("there is no octree: %s\n", message.c_str());
    return false;
  }
  const openvdb::tools::LevelSetRayIntersector<openvdb::FloatGrid> theirs(*grid);
  std::printf("level %d: %llu voxels, %.1f MiB; the level set's %llu, %.1f MiB\n", level,
    static_cast<unsigned long long>(octree.header().voxelCount),
    static_cast<double>(octree.bytes()) / (1 << 20),
    static_cast<unsigned long long>(grid->activeVoxelCount()),
    static_cast<double>(grid->memUsage()) / (1 << 20));
  bool right = true;
  const std::vector<Ray> camera = frame(count), random = fromEverywhere(camera.size());
  for (const auto* rays : { &camera, &random })
  {
    Distances a(rays->size()), b(rays->size()), c(rays->size());
    std::vector<double> seconds[3];
    for (int i = 0; i < repeat; ++i)
    {
      const double start = processorTime();
      traceTheirs(theirs, *rays, a);
      const double second = processorTime();
      traceAlone(octree, *rays, b);
      const double third = processorTime();
      traceBlocks(octree, *rays, c);
      seconds[0].push_back(second - start);
      seconds[1].push_back(third - second);
      seconds[2].push_back(processorTime() - third);
    }
    const std::size_t alone = apart(a, b, octree.header().voxelSize);
    const std::size_t blocks = apart(a, c, octree.header().voxelSize);
    const auto hits = std::count_if(a.begin(), a.end(), [](double t) { return t < None; });
    const auto rate = [&](std::vector<double>& s)
    {
      std::nth_element(s.begin(), s.begin() + static_cast<long>(s.size() / 2), s.end());
      return 1e-6 * static_cast<double>(rays->size()) / s[s.size() / 2];
    };
    std::printf(
      "  %zu rays %s, %.0f %% hit: OpenVDB %.2f Mrays/s, ours one by one %.2f, in blocks of "
      "64 %.2f; %zu and %zu not within a voxel\n",
      rays->size(), rays == &camera ? "of a camera" : "from everywhere",
      100.0 * static_cast<double>(hits) / static_cast<double>(rays->size()), rate(seconds[0]),
      rate(seconds[1]), rate(seconds[2]), alone, blocks);
    right = right && hits > 0 && 200 * std::max(alone, blocks) < rays->size();
  }
  return right;
}
}

int main(int argc, char* argv[])
{
  std::string levels = "7,8,9";
  int rays = 1000000, repeat = 5;
  for (int i = 1; i + 1 < argc; i += 2)
  {
    const std::string name = argv[i];
    levels = name == "--levels" ? argv[i + 1] : levels;
    rays = name == "--rays" ? std::atoi(argv[i + 1]) : rays;
    repeat = name == "--repeat" ? std::max(1, std::atoi(argv[i + 1])) : repeat;
  }
  openvdb::initialize();
  bool right = true;
  std::stringstream list(levels);
  for (std::string level; std::getline(list, level, ',');)
  {
    right = measure(std::atoi(level.c_str()), rays, repeat) && right;
  }
  return right ? 0 : 1;
}
