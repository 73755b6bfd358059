// Octrees of planes: their voxels and planes against what is known of the surface, and sources that
// have none.
#include "svoBuildMeshes.h"
#include "svoExecutor.h"
#include "svoExpectedCells.h"
#include "svoOctreeBytes.h"
#include "svoPlane.h"
#include "svoTestFields.h"

#include <limits>

namespace
{
using namespace svotest;

/// Calls visit(cell, plane) for every voxel.
template <class Visit>
void visitPlanes(const svo::Octree& octree, const Visit& visit)
{
  for (const Brick& brick : bricksOf(octree))
  {
    for (std::uint64_t mask = octree.nodes()[brick.node].mask; mask != 0; mask &= mask - 1)
    {
      const int i = svo::lowestBit(mask);
      visit(brick.corner + svo::cellOfIndex(i),
        svo::decodePlane(octree.lists()[octree.planeOf(brick.node, i)]));
    }
  }
}

glm::dvec3 centreOf(const svo::Octree& octree, const glm::ivec3& cell)
{
  const svo::Header& h = octree.header();
  return glm::dvec3(h.origin[0], h.origin[1], h.origin[2]) + (glm::dvec3(cell) + 0.5) * h.voxelSize;
}

/// A box as the largest distance from a face: its gradient jumps, and is no longer than 1.
struct BoxField : svo::ScalarField
{
  glm::dvec3 half{ 0.5, 0.3, 0.2 };
  double value(const glm::dvec3& at) const override
  {
    const glm::dvec3 d = glm::abs(at) - half;
    return std::max({ d.x, d.y, d.z });
  }
  glm::dvec3 gradient(const glm::dvec3& at) const override
  {
    const glm::dvec3 d = glm::abs(at) - half;
    const int axis = d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
    glm::dvec3 g(0.0);
    g[axis] = at[axis] < 0.0 ? -1.0 : 1.0;
    return g;
  }
};

/// The same everywhere.
struct ConstantField : svo::ScalarField
{
  explicit ConstantField(double c)
    : constant(c)
  {
  }
  double value(const glm::dvec3&) const override { return constant; }
  glm::dvec3 gradient(const glm::dvec3&) const override { return glm::dvec3(0.0); }
  double constant;
};

/// A sphere whose gradient is wrong: turned, of the other sign, of another length, of another
/// sphere, none.
struct MisledSphere : SphereField
{
  enum Mistake
  {
    Turned,
    Opposite,
    Short,
    Other,
    None,
    Mistakes
  };
  MisledSphere(double r, Mistake m)
    : SphereField(r)
    , mistake(m)
  {
  }
  glm::dvec3 gradient(const glm::dvec3& at) const override
  {
    const glm::dvec3 right = SphereField::gradient(at);
    switch (mistake)
    {
      case Turned:
        return right + glm::dvec3(right.y, -right.x, 0.0);
      case Opposite:
        return -right;
      case Short:
        return 0.1 * right;
      case Other:
        return 2.0 * (at - glm::dvec3(0.6, 0.0, 0.0));
      default:
        return glm::dvec3(0.0);
    }
  }
  Mistake mistake;
};

/// Counts what it is asked.
struct CountingSphere : SphereField
{
  using SphereField::SphereField;
  double value(const glm::dvec3& at) const override
  {
    ++asked;
    return SphereField::value(at);
  }
  mutable std::atomic<std::size_t> asked{ 0 };
};
}

TEST(Source, ASphereFillsTheVoxelsThatItTouches)
{
  const SphereField sphere(0.73, glm::dvec3(0.031, -0.02, 0.057));
  for (const double bound : { 0.0, 2.0 * std::sqrt(3.0) * 1.1 })
  {
    for (int level = 1; level <= 7; ++level)
    {
      SCOPED_TRACE(testing::Message() << "level " << level << ", bound " << bound);
      const svo::Octree octree = octreeOfField(sphere, boxOfInterest(level), bound);
      ASSERT_TRUE(octree);
      ASSERT_EQ(octree.level(), level);
      const double h = octree.header().voxelSize;
      // A tangent plane leaves its sphere by no more than this within a voxel and its diagonal.
      const double bulge = 3.0 * h * h / (2.0 * sphere.radius);
      const int n = 1 << level;
      std::size_t voxels = 0, beyond = 0;
      for (int z = 0; z < n; ++z)
      {
        for (int y = 0; y < n; ++y)
        {
          for (int x = 0; x < n; ++x)
          {
            const glm::ivec3 cell(x, y, z);
            const glm::dvec3 to = glm::abs(centreOf(octree, cell) - sphere.centre);
            const double nearest = glm::length(glm::max(to - 0.5 * h, glm::dvec3(0.0)));
            const double farthest = glm::length(to + 0.5 * h);
            const bool touched = nearest <= sphere.radius && sphere.radius <= farthest;
            const bool occupied = octree.occupied(cell, level);
            voxels += occupied;
            beyond += occupied && !touched;
            ASSERT_TRUE(occupied || !touched) << x << " " << y << " " << z;
            ASSERT_TRUE(
              !occupied || (nearest <= sphere.radius + bulge && sphere.radius - bulge <= farthest))
              << x << " " << y << " " << z;
          }
        }
      }
      EXPECT_EQ(voxels, octree.header().voxelCount);
      if (level >= 5)
      {
        EXPECT_LT(beyond, voxels / 20) << "planes reach little beyond their sphere";
      }
    }
  }
}

TEST(Source, PlanesAreTangentToTheSphere)
{
  const SphereField sphere(0.8, glm::dvec3(0.01, 0.02, 0.03));
  const svo::Octree octree = octreeOfField(sphere, boxOfInterest(7));
  const double h = octree.header().voxelSize;
  // A step of the quantised offset and of the normal, and what the foot's second order leaves out.
  const double steps = (std::sqrt(0.75) / 1023.0 + std::sqrt(0.75) * 2.5e-3) * h;
  const double rest = 3.0 * h * h * h / (sphere.radius * sphere.radius);
  std::size_t seen = 0;
  visitPlanes(octree,
    [&](const glm::ivec3& cell, const svo::MeanPlane& plane)
    {
      ++seen;
      const glm::dvec3 from = centreOf(octree, cell) - sphere.centre;
      const glm::dvec3 outwards = glm::normalize(from);
      ASSERT_GT(glm::dot(outwards, glm::dvec3(plane.normal)), 1.0 - 1e-5);
      const double distance = sphere.radius - glm::length(from); // from the voxel's centre
      ASSERT_NEAR(plane.offset * std::sqrt(0.75) * h, distance, steps + rest);
    });
  EXPECT_EQ(seen, octree.header().voxelCount);
}

TEST(Source, WrongGradientsChangeNothing)
{
  const svo::Octree right = octreeOfField(SphereField(0.8), boxOfInterest(7));
  const double h = right.header().voxelSize;
  for (int mistake = 0; mistake < MisledSphere::Mistakes; ++mistake)
  {
    SCOPED_TRACE(testing::Message() << "mistake " << mistake);
    const MisledSphere sphere(0.8, MisledSphere::Mistake(mistake));
    const svo::Octree octree = octreeOfField(sphere, boxOfInterest(7));
    // No field turns a sphere's normals everywhere: near the poles the turned ones are off by less
    // than the 20 degrees that are let pass.
    const double voxels = static_cast<double>(right.header().voxelCount);
    EXPECT_NEAR(
      octree.header().voxelCount, voxels, mistake == MisledSphere::Turned ? 0.01 * voxels : 0.0);
    visitPlanes(octree,
      [&](const glm::ivec3& cell, const svo::MeanPlane& plane)
      {
        const glm::dvec3 from = centreOf(octree, cell);
        const double same = glm::dot(glm::normalize(from), glm::dvec3(plane.normal));
        if (mistake == MisledSphere::Turned && std::hypot(from.x, from.y) < 0.36 * 0.8)
        {
          ASSERT_GT(same, 0.93);
          return;
        }
        ASSERT_GT(same, 1.0 - 1e-5);
        ASSERT_NEAR(plane.offset * std::sqrt(0.75) * h, 0.8 - glm::length(from), 4e-3 * h);
      });
  }
}

TEST(Source, RightGradientsAreKept)
{
  struct Asked : SphereField
  {
    using SphereField::SphereField;
    glm::dvec3 gradient(const glm::dvec3& at) const override
    {
      return 1.01 * SphereField::gradient(at); // differences would be the sphere's own
    }
  };
  const Asked sphere(0.8);
  const svo::FieldOptions trusting{ 0.0, 0.0, 0.03, false }, checking{ 0.0, 0.0, 0.03, true };
  const svo::BuildOptions options = boxOfInterest(6);
  const auto bytes = [&](const svo::FieldOptions& how)
  { return bytesOf(openPlanes(svo::build(svo::FieldSource(sphere, how), options))); };
  EXPECT_EQ(bytes(trusting), bytes(checking));
}

TEST(Source, NodesHaveMeanPlanesOfTheSphere)
{
  const SphereField sphere(0.8);
  const svo::Octree octree = octreeOfField(sphere, boxOfInterest(8));
  for (std::uint32_t i = octree.brickBegin(); i < octree.header().nodeCount; ++i)
  {
    const svo::MeanPlane mean = svo::decodePlane(octree.nodes()[i].plane);
    const svo::MeanPlane one =
      svo::decodePlane(octree.lists()[octree.planeOf(i, svo::lowestBit(octree.nodes()[i].mask))]);
    ASSERT_GT(glm::dot(mean.normal, one.normal), 0.99f);
  }
}

TEST(Source, ABoxWithEdgesHasNoGapsAndEndsAtItsFaces)
{
  const BoxField box;
  const svo::Octree octree = octreeOfField(box, boxOfInterest(6), 1.0);
  const double h = octree.header().voxelSize;
  const int n = 1 << 6;
  for (int z = 0; z < n; ++z)
  {
    for (int y = 0; y < n; ++y)
    {
      for (int x = 0; x < n; ++x)
      {
        const glm::dvec3 at = glm::abs(centreOf(octree, { x, y, z }));
        const bool inside = glm::all(glm::lessThan(at + 0.5 * h, box.half));
        const bool outside = glm::any(glm::greaterThan(at - 0.5 * h, box.half));
        ASSERT_EQ(octree.occupied({ x, y, z }, 6), !inside && !outside)
          << x << " " << y << " " << z;
      }
    }
  }
}

TEST(Source, TheSameBytesForAnyExecutor)
{
  const SphereField sphere(0.7);
  svo::BuildOptions options = boxOfInterest(8);
  const auto serial = bytesOf(octreeOfField(sphere, options));
  options.parallelFor = raggedExecutor(3, 7);
  EXPECT_EQ(bytesOf(octreeOfField(sphere, options)), serial);
  options.progress = [](double) { return true; };
  EXPECT_EQ(bytesOf(octreeOfField(sphere, options)), serial);
}

TEST(Source, WorkGoesWithTheSurface)
{
  std::size_t asked[2];
  for (int i = 0; i < 2; ++i)
  {
    const CountingSphere sphere(0.7);
    octreeOfField(sphere, boxOfInterest(7 + i));
    asked[i] = sphere.asked;
  }
  EXPECT_LT(asked[1], 5 * asked[0]) << "a level more is four times the surface";
}

TEST(Source, OnlyTheBoxOfInterest)
{
  const SphereField sphere(0.9);
  svo::BuildOptions options = boxOfInterest(6);
  options.modelLow.z = 0.0;
  const svo::Octree octree = octreeOfField(sphere, options);
  EXPECT_GT(octree.header().voxelCount, 0u);
  visitPlanes(octree,
    [&](const glm::ivec3& cell, const svo::MeanPlane&)
    { ASSERT_GE(centreOf(octree, cell).z + 0.51 * octree.header().voxelSize, 0.0); });
}

TEST(Source, FieldsWithoutASurfaceAreEmptyAndQuick)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double constant : { 1.0, -1.0, 0.0, nan, infinity })
  {
    for (const double bound : { 0.0, 1.0 })
    {
      const svo::Octree octree = octreeOfField(ConstantField(constant), boxOfInterest(12), bound);
      ASSERT_TRUE(octree) << constant;
      EXPECT_TRUE(octree.empty()) << constant << " " << bound;
      EXPECT_TRUE(octree.hasPlanes());
    }
  }
  EXPECT_TRUE(octreeOfField(SphereField(9.0), boxOfInterest(12)).empty()) << "it never crosses";
}

TEST(Source, WhatCannotBeBuiltIsSaid)
{
  const SphereField sphere(0.7);
  const svo::FieldSource source(sphere, { 0.0, 0.0, 0.1 });
  svo::BuildOptions options = boxOfInterest(10);
  options.memoryLimit = 100000;
  svo::BuildResult result = svo::build(source, options);
  EXPECT_EQ(result.status, svo::BuildStatus::TooLarge);
  EXPECT_NE(result.message.find("level 10"), std::string::npos);
  EXPECT_EQ(result.data, nullptr);

  options = boxOfInterest(21);
  EXPECT_EQ(svo::build(source, options).status, svo::BuildStatus::BadInput);
  options = boxOfInterest(5);
  options.modelHigh.x = -2.0;
  EXPECT_EQ(svo::build(source, options).status, svo::BuildStatus::BadInput);
  options.modelHigh.x = std::numeric_limits<double>::infinity();
  EXPECT_EQ(svo::build(source, options).status, svo::BuildStatus::BadInput);

  options = boxOfInterest(10);
  int reports = 0;
  double last = 0.0;
  options.progress = [&](double progress)
  {
    EXPECT_GE(progress, last);
    last = progress;
    return ++reports < 20;
  };
  EXPECT_EQ(svo::build(source, options).status, svo::BuildStatus::Aborted);
  EXPECT_EQ(reports, 20);
}

/// The level that a message names as one that fits.
int namedLevel(const std::string& message)
{
  const std::size_t at = message.find("; level ");
  return at == std::string::npos ? 0 : std::stoi(message.substr(at + 8));
}

TEST(Source, WhatIsTooDeepIsSaidBeforeItIsBuilt)
{
  const CountingSphere sphere(0.9);
  for (const double bound : { 0.0, 1.0 })
  {
    const svo::FieldSource source(sphere, { 0.0, bound, 0.05 });
    svo::BuildOptions options = boxOfInterest(20);
    options.memoryLimit = std::size_t(20) << 20;
    sphere.asked = 0;
    const svo::BuildResult deep = svo::build(source, options);
    EXPECT_EQ(deep.status, svo::BuildStatus::TooLarge);
    EXPECT_NE(deep.message.find("level 20 would need about "), std::string::npos) << deep.message;
    EXPECT_LT(sphere.asked, 15000000u) << "of more than 10^12 voxels";
    // The level that it names can be built, and none much deeper.
    options.level = namedLevel(deep.message);
    EXPECT_EQ(svo::build(source, options).status, svo::BuildStatus::Built) << deep.message;
    options.level += 2;
    const svo::BuildResult deeper = svo::build(source, options);
    EXPECT_EQ(deeper.status, svo::BuildStatus::TooLarge);
    EXPECT_EQ(namedLevel(deeper.message), options.level - 2) << deeper.message;
  }
}

TEST(Source, ExpectedMemoryIsThatOfTheVoxels)
{
  const SphereField sphere(0.9);
  const svo::FieldSource source(sphere, { 0.0, 0.0, 0.05 });
  constexpr int Start = 5, Level = 9;
  const svo::Cube cube = svo::boundingCube(glm::dvec3(-1.0), glm::dvec3(1.0), Level);
  const auto mayPass = [&](const glm::ivec3& cell, int level)
  {
    const double half = std::ldexp(cube.edge, -level - 1);
    return source.mayPass(cube.origin + (2.0 * glm::dvec3(cell) + 1.0) * half, half);
  };
  std::vector<glm::ivec3> starts;
  for (int i = 0; i < 1 << 3 * Start; ++i)
  {
    const glm::ivec3 cell(i & 31, i >> 5 & 31, i >> 10);
    if (mayPass(cell, Start))
    {
      starts.push_back(cell);
    }
  }
  const svo::ParallelFor serial = svo::serialFor;
  const std::function<bool(double)> none;
  svo::Executor executor(serial, none);
  const std::vector<double> cells =
    svo::expectedCells(starts, Start, Level, mayPass, 0.1, executor);
  for (int level = Start + 1; level <= Level; ++level)
  {
    const double voxels =
      static_cast<double>(octreeOfField(sphere, boxOfInterest(level)).header().voxelCount);
    EXPECT_GT(cells[level], 0.9 * voxels) << level;
    EXPECT_LT(cells[level], 2.2 * voxels) << level;
  }
}

TEST(Source, DamagedPlanesAreRefused)
{
  const SphereField sphere(0.7);
  const svo::FieldSource source(sphere, { 0.0, 0.0, 0.1 });
  const svo::BuildResult good = svo::build(source, boxOfInterest(5));
  std::string error;
  const auto opensAfter = [&](const std::function<void(svo::Header&, svo::Node*)>& damage)
  {
    std::shared_ptr<std::byte> copy(static_cast<std::byte*>(::operator new(good.size)),
      [](std::byte* p) { ::operator delete(p); });
    std::copy(good.data.get(), good.data.get() + good.size, copy.get());
    auto& header = *reinterpret_cast<svo::Header*>(copy.get());
    damage(header, reinterpret_cast<svo::Node*>(copy.get() + sizeof(svo::Header)));
    return static_cast<bool>(svo::Octree::open(copy, good.size, nullptr, error));
  };
  EXPECT_TRUE(opensAfter([](svo::Header&, svo::Node*) {}));
  EXPECT_FALSE(opensAfter([](svo::Header& h, svo::Node*) { h.leafWords = 2; }));
  EXPECT_FALSE(opensAfter([](svo::Header& h, svo::Node*) { h.leafWords = 0; }));
  EXPECT_FALSE(opensAfter([](svo::Header& h, svo::Node*) { h.triangleCount = 1; }));
  for (std::uint32_t reach = 0; reach <= 9; ++reach)
  {
    const bool opens = opensAfter([&](svo::Header& h, svo::Node*) { h.planeReach = reach; });
    EXPECT_EQ(opens, reach <= svo::LongestReach) << reach;
  }
  EXPECT_FALSE(opensAfter(
    [](svo::Header& h, svo::Node* nodes) { nodes[h.nodeCount - 1].first = 0x7fffffffu; }));
  EXPECT_FALSE(
    opensAfter([](svo::Header& h, svo::Node* nodes) { nodes[h.nodeCount - 1].first += 1; }));
  EXPECT_FALSE(
    opensAfter([](svo::Header& h, svo::Node* nodes) { nodes[h.nodeCount - 1].mask |= ~0ull; }));
  const auto surface = std::make_shared<svo::Surface>();
  EXPECT_FALSE(svo::Octree::open(good.data, good.size, surface, error)) << "planes need no surface";
}
