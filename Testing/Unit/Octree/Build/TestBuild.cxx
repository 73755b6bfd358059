// The builder as a whole: what the octree of a mesh holds, and how a build ends.
#include "svoBuildMeshes.h"
#include "svoLattice.h"
#include "svoNode.h"
#include "svoSeparatingAxes.h"

#include <cstring>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace
{
using svotest::Mesh;

svo::Octree built(const Mesh& mesh, int level)
{
  const svo::BuildResult result = svotest::buildAt(mesh, level);
  EXPECT_EQ(result.status, svo::BuildStatus::Built) << result.message;
  std::string error;
  const svo::Octree octree = svotest::openResult(mesh, result, error);
  EXPECT_TRUE(octree) << error;
  return octree;
}

using TrianglesOfBrick = std::map<std::uint64_t, std::pair<std::uint64_t, std::set<unsigned>>>;

std::uint64_t keyOf(const glm::ivec3& brick)
{
  return svo::mortonKey(brick.x, brick.y, brick.z);
}

/// Masks and lists of all bricks, voxel by voxel.
TrianglesOfBrick bruteForce(const Mesh& mesh, int level)
{
  const svo::Lattice lattice(svo::boundingCube(mesh.view(), level), level);
  TrianglesOfBrick bricks;
  for (unsigned id = 0; id < mesh.triangles.size(); ++id)
  {
    glm::ivec3 v[3];
    for (int i = 0; i < 3; ++i)
    {
      v[i] = lattice.snap(lattice.place(mesh.points[mesh.triangles[id][i]]));
    }
    const glm::ivec3 low = glm::max((glm::min(v[0], glm::min(v[1], v[2])) >> 8) - 1, 0);
    const glm::ivec3 high =
      glm::min((glm::max(v[0], glm::max(v[1], v[2])) >> 8) + 1, (1 << level) - 1);
    for (int z = low.z; z <= high.z; ++z)
    {
      for (int y = low.y; y <= high.y; ++y)
      {
        for (int x = low.x; x <= high.x; ++x)
        {
          const glm::ivec3 voxel(x, y, z);
          if (svotest::overlapBySeparatingAxes(v, voxel * 256 - 1, voxel * 256 + 257))
          {
            auto& brick = bricks[keyOf(voxel >> 2)];
            brick.first |= 1ull << svo::cellIndex(x & 3, y & 3, z & 3);
            brick.second.insert(id);
          }
        }
      }
    }
  }
  return bricks;
}

TrianglesOfBrick contentOf(const svo::Octree& octree)
{
  TrianglesOfBrick content;
  for (const svotest::Brick& brick : svotest::bricksOf(octree))
  {
    std::uint32_t count = 0;
    std::uint32_t single = 0;
    const std::uint32_t* ids = octree.brickTriangles(brick.node, count, single);
    EXPECT_TRUE(std::is_sorted(ids, ids + count));
    auto& entry = content[keyOf(brick.corner / 4)];
    entry.first = octree.nodes()[brick.node].mask;
    entry.second.insert(ids, ids + count);
    EXPECT_EQ(entry.second.size(), count) << "a list names a triangle twice";
  }
  return content;
}

/// Random points on the triangles as they were given lie in occupied voxels.
void expectConservative(const Mesh& mesh, const svo::Octree& octree, int samples)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const svo::Header& h = octree.header();
  const glm::dvec3 origin(h.origin[0], h.origin[1], h.origin[2]);
  for (int i = 0; i < samples; ++i)
  {
    const glm::uvec3& t = mesh.triangles[random() % mesh.triangles.size()];
    double a = unit(random);
    double b = unit(random);
    if (a + b > 1.0)
    {
      a = 1.0 - a;
      b = 1.0 - b;
    }
    const glm::dvec3 &p = mesh.points[t.x], &q = mesh.points[t.y], &r = mesh.points[t.z];
    const glm::dvec3 place = ((p - origin) + (q - p) * a + (r - p) * b) / h.voxelSize;
    ASSERT_TRUE(octree.occupied(glm::ivec3(glm::floor(place)), octree.level())) << "sample " << i;
  }
}

Mesh pointsAt(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
  Mesh m;
  m.add(a, b, c);
  return m;
}
}

TEST(Build, NamesEveryTouchedVoxelAndTriangleAndNoOther)
{
  for (int level = 1; level <= 5; ++level)
  {
    const Mesh mesh = svotest::randomMesh(level, 60);
    EXPECT_EQ(contentOf(built(mesh, level)), bruteForce(mesh, level)) << "level " << level;
  }
  for (const int level : { 6, 7 })
  {
    const Mesh mesh = svotest::sphere(6 * (level - 5), 0.2);
    EXPECT_EQ(contentOf(built(mesh, level)), bruteForce(mesh, level)) << "level " << level;
  }
}

TEST(Build, EveryLevelOpensAndCountsItsVoxels)
{
  const Mesh mesh = svotest::sphere(20, 0.3);
  for (int level = 1; level <= 10; ++level)
  {
    const svo::Octree octree = built(mesh, level);
    ASSERT_TRUE(octree);
    std::uint64_t voxels = 0;
    for (const svotest::Brick& brick : svotest::bricksOf(octree))
    {
      voxels += svo::childCount(octree.nodes()[brick.node]);
    }
    EXPECT_EQ(octree.header().voxelCount, voxels);
  }
}

TEST(Build, PointsOfTheTrueTrianglesLieInOccupiedVoxels)
{
  for (const int level : { 1, 3, 6, 9, 11 })
  {
    const Mesh mesh = svotest::randomMesh(level, 40);
    expectConservative(mesh, built(mesh, level), 20000);
  }
  // Level 20, where a voxel is 2e-6 of the cube: triangles that small, far apart.
  Mesh small;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 200; ++i)
  {
    const auto vector = [&] { return glm::dvec3(unit(random), unit(random), unit(random)); };
    const glm::dvec3 p = vector();
    small.add(p, p + 5e-5 * vector(), p + 5e-5 * vector());
  }
  expectConservative(small, built(small, 20), 20000);
}

TEST(Build, TheBytesDoNotDependOnTheExecutor)
{
  Mesh mesh = svotest::sphere(40, 0.1);
  const Mesh more = svotest::randomMesh(8, 300);
  for (const glm::uvec3& t : more.triangles)
  {
    mesh.add(more.points[t.x], more.points[t.y], more.points[t.z]);
  }
  svo::BuildOptions options;
  options.level = 9;
  const svo::BuildResult expected = svo::build(mesh.view(), options);
  ASSERT_EQ(expected.status, svo::BuildStatus::Built);
  for (const int threads : { 1, 2, 7 })
  {
    options.parallelFor = svotest::raggedExecutor(threads, threads);
    // Reporting cuts the work into batches.
    options.progress = threads == 2 ? [](double) { return true; } : std::function<bool(double)>();
    const svo::BuildResult result = svo::build(mesh.view(), options);
    ASSERT_EQ(result.size, expected.size);
    EXPECT_EQ(std::memcmp(result.data.get(), expected.data.get(), expected.size), 0);
  }
}

TEST(Build, ReportsOnTheCallingThreadInAscendingOrder)
{
  const Mesh mesh = svotest::sphere(40);
  std::vector<double> reports;
  const std::thread::id caller = std::this_thread::get_id();
  svo::BuildOptions options;
  options.level = 9;
  options.parallelFor = svotest::raggedExecutor(3, 1);
  options.progress = [&](double share)
  {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    reports.push_back(share);
    return true;
  };
  ASSERT_EQ(svo::build(mesh.view(), options).status, svo::BuildStatus::Built);
  EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
  EXPECT_GE(reports.front(), 0.0);
  EXPECT_LE(reports.back(), 1.0);
  EXPECT_GT(reports.back(), 0.8);
}

TEST(Build, StopsWhereverProgressSaysSo)
{
  const Mesh mesh = svotest::sphere(40);
  svo::BuildOptions options;
  options.level = 9;
  int calls = 0;
  options.progress = [&](double)
  {
    ++calls;
    return true;
  };
  svo::build(mesh.view(), options);
  const int all = calls;
  for (int stop = 1; stop <= all; stop += 1 + all / 10)
  {
    calls = 0;
    options.progress = [&](double) { return ++calls < stop; };
    const svo::BuildResult result = svo::build(mesh.view(), options);
    EXPECT_EQ(result.status, svo::BuildStatus::Aborted);
    EXPECT_EQ(calls, stop) << "asked again after it was told to stop";
    EXPECT_FALSE(result.data);
    EXPECT_EQ(result.size, 0u);
  }
}

TEST(Build, RefusesALevelOutOfRange)
{
  const Mesh mesh = svotest::sphere(4);
  for (const int level : { -1, 0, 21 })
  {
    const svo::BuildResult result = svotest::buildAt(mesh, level);
    EXPECT_EQ(result.status, svo::BuildStatus::BadInput);
    EXPECT_FALSE(result.message.empty());
    EXPECT_FALSE(result.data);
  }
}

TEST(Build, RefusesWhatTheMemoryLimitForbidsAndNamesALevelThatFits)
{
  const Mesh mesh = svotest::sphere(20);
  svo::BuildOptions options;
  options.level = 16;
  options.memoryLimit = std::size_t(1) << 30;
  const svo::BuildResult result = svo::build(mesh.view(), options);
  EXPECT_EQ(result.status, svo::BuildStatus::TooLarge);
  EXPECT_FALSE(result.data);
  EXPECT_NE(result.message.find("level 16 would need about "), std::string::npos) << result.message;
  EXPECT_NE(result.message.find(" more than the limit of 1.0 GiB; level "), std::string::npos)
    << result.message;
  int fitting = 15;
  while (svo::estimateBuildMemory(mesh.view(), fitting) > options.memoryLimit)
  {
    --fitting;
  }
  EXPECT_NE(result.message.find("level " + std::to_string(fitting) + " "), std::string::npos)
    << result.message;
}

TEST(Build, RefusesMoreNodesThanAnIndexCanNameAtOnce)
{
  const Mesh mesh = svotest::sphere(20);
  const svo::BuildResult result = svotest::buildAt(mesh, 20);
  EXPECT_EQ(result.status, svo::BuildStatus::TooLarge);
  EXPECT_NE(result.message.find("more nodes than an index can name"), std::string::npos)
    << result.message;
}

TEST(Build, DropsAndCountsTrianglesWithPointsThatAreNotFinite)
{
  Mesh mesh = svotest::sphere(10);
  const svo::Octree expected = built(mesh, 6);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  mesh.add({ nan, 0.0, 0.0 }, { 5.0, 0.0, 0.0 }, { 0.0, 5.0, 0.0 });
  mesh.add({ 0.0, 0.0, 0.0 }, { 0.0, -inf, 0.0 }, { 9.0, 0.0, 0.0 });
  mesh.add({ 0.0, 1e300, 0.0 }, { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 });
  const svo::BuildResult result = svotest::buildAt(mesh, 6);
  EXPECT_EQ(result.droppedTriangles, 3u);
  std::string error;
  const svo::Octree octree = svotest::openResult(mesh, result, error);
  ASSERT_TRUE(octree) << error;
  EXPECT_EQ(contentOf(octree), contentOf(expected));
  for (const glm::vec3& p : octree.surface()->points)
  {
    EXPECT_TRUE(std::isfinite(p.x + p.y + p.z));
  }
}

TEST(Build, AMeshWithoutTrianglesMakesAnEmptyOctree)
{
  for (const int level : { 1, 2, 3, 10, 20 })
  {
    const svo::Octree octree = built(Mesh(), level);
    ASSERT_TRUE(octree);
    EXPECT_TRUE(octree.empty());
    EXPECT_EQ(octree.header().voxelCount, 0u);
    EXPECT_GT(octree.header().voxelSize, 0.0);
  }
}

TEST(Build, DegenerateMeshesAreCoveredLikeAnyOther)
{
  const Mesh zoo[] = {
    pointsAt(glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)),
    pointsAt(glm::dvec3(1e8), glm::dvec3(1e8), glm::dvec3(1e8)),
    pointsAt({ 0.0, 0.0, 0.0 }, { 1.0, 2.0, 3.0 }, { 0.5, 1.0, 1.5 }), // a segment
    pointsAt({ 0.0, 0.0, 0.0 }, { 0.0, 0.0, 3.0 }, { 0.0, 0.0, 3.0 }), // along an axis
    pointsAt({ 0.0, 0.0, 5.0 }, { 4.0, 0.0, 5.0 }, { 0.0, 4.0, 5.0 }), // flat
    pointsAt({ 1e8, 1e8, 1e8 }, { 1e8 + 1e-3, 1e8, 1e8 }, { 1e8, 1e8 + 1e-3, 1e8 }),
    pointsAt({ 0.0, 0.0, 0.0 }, { 1e-310, 0.0, 0.0 }, { 0.0, 3e-310, 0.0 }), // denormals
    pointsAt({ 1.0, 1.0, 1.0 }, { 1.0 + 1e-15, 1.0, 1.0 }, { 1.0, 1.0 + 4e-15, 1.0 }),
    pointsAt({ -1e289, 0.0, 0.0 }, { 1e289, 0.0, 0.0 }, { 0.0, 1e289, 1e280 }),
  };
  for (std::size_t i = 0; i < std::size(zoo); ++i)
  {
    for (const int level : { 1, 2, 7, 10 })
    {
      SCOPED_TRACE("mesh " + std::to_string(i) + ", level " + std::to_string(level));
      const svo::Octree octree = built(zoo[i], level);
      ASSERT_TRUE(octree);
      EXPECT_FALSE(octree.empty());
      EXPECT_TRUE(std::isfinite(octree.header().voxelSize));
      expectConservative(zoo[i], octree, 300);
    }
  }
}

TEST(Build, TheMeshLiesInTheMiddleOfItsCube)
{
  const Mesh mesh = pointsAt({ 10.0, 20.0, 30.0 }, { 14.0, 21.0, 30.0 }, { 12.0, 22.0, 30.5 });
  for (const int level : { 1, 10, 20 })
  {
    const svo::Cube cube = svo::boundingCube(mesh.view(), level);
    const double unit = std::ldexp(cube.edge, -level - 8);
    EXPECT_NEAR(cube.origin.x + 2.0 * unit, 10.0, 0.01 * unit + 1e-14);
    EXPECT_NEAR(cube.edge - 4.0 * unit, 4.0, 0.01 * unit + 1e-14);
    EXPECT_NEAR(cube.origin.y + 0.5 * cube.edge, 21.0, 1e-12);
    EXPECT_NEAR(cube.origin.z + 0.5 * cube.edge, 30.25, 1e-12);
  }
}

TEST(Build, AFlatMeshFillsOneLayerOfVoxels)
{
  const Mesh mesh = pointsAt({ 0.0, 0.0, 3.0 }, { 4.0, 0.0, 3.0 }, { 0.0, 4.0, 3.0 });
  for (const int level : { 2, 5, 8 })
  {
    const svo::Octree octree = built(mesh, level);
    ASSERT_TRUE(octree);
    const int across = 1 << level;
    int layers = 0;
    for (int z = 0; z < across; ++z)
    {
      layers += octree.occupied({ across / 4, across / 4, z }, level);
    }
    EXPECT_EQ(layers, 1);
  }
}

TEST(Build, TheSurfaceIsTheMeshInOctreeCoordinates)
{
  const Mesh mesh = svotest::sphere(8);
  for (const int level : { 5, 6 })
  {
    const svo::Octree octree = built(mesh, level);
    ASSERT_TRUE(octree);
    const glm::dmat4 m = octree.localToOctree();
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
    {
      const glm::dvec3 p(m * glm::dvec4(mesh.points[i], 1.0));
      EXPECT_LE(glm::length(p - glm::dvec3(octree.surface()->points[i])), 1.1e-7);
    }
    EXPECT_EQ(octree.surface()->triangles, mesh.triangles);
  }
}
