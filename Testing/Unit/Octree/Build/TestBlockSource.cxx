// Octrees of voxels that are known, in coordinates of their own; planes of voxels against those of
// fields.
#include "svoBlockSource.h"
#include "svoIntersect.h"
#include "svoLevelSetPlane.h"
#include "svoMorton.h"
#include "svoOctreeBytes.h"
#include "svoPlane.h"
#include "svoTestFields.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <tuple>

#include <glm/gtc/matrix_transform.hpp>

namespace
{
using namespace svotest;
using VoxelAt = std::tuple<int, int, int>;

/// All voxels with a bit are occupied, but for those of `holes`.
struct KnownVoxels : svo::BlockSource
{
  using BlockSource::BlockSource;
  std::set<VoxelAt> holes;
  bool planeOf(const glm::ivec3& voxel, svo::SourcePlane& plane) const override
  {
    plane = { glm::dvec3(0.0, 0.0, 1.0), 0.25 };
    return holes.count({ voxel.x, voxel.y, voxel.z }) == 0;
  }
};

std::vector<svo::VoxelBlock> blocksOf(const std::set<VoxelAt>& voxels)
{
  std::map<std::uint64_t, svo::VoxelBlock> blocks;
  for (const auto& [x, y, z] : voxels)
  {
    const glm::uvec3 at(x / 8, y / 8, z / 8);
    svo::VoxelBlock& block = blocks[svo::mortonKey(at.x, at.y, at.z)];
    block.key = svo::mortonKey(at.x, at.y, at.z);
    block.add({ x % 8, y % 8, z % 8 });
  }
  std::vector<svo::VoxelBlock> sorted;
  for (const auto& [key, block] : blocks)
  {
    sorted.push_back(block);
  }
  return sorted;
}

std::set<VoxelAt> someVoxels(int level, int count, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> at(0, (1 << level) - 1);
  std::set<VoxelAt> voxels;
  for (int i = 0; i < count; ++i)
  {
    voxels.insert({ at(random), at(random), at(random) });
  }
  return voxels;
}

svo::BuildResult buildOf(const svo::SurfaceSource& source, const svo::Cube& cube, int level,
  const glm::dmat4& frame = glm::dmat4(1.0))
{
  svo::BuildOptions options = boxOfInterest(level);
  options.modelLow = cube.origin;
  options.modelHigh = cube.origin + cube.edge;
  options.transform = frame;
  return svo::build(source, cube, options);
}

const glm::dmat4 Sheared = { { 0.2, 0.05, 0.0, 0.0 }, { -0.03, -0.1, 0.02, 0.0 },
  { 0.01, -0.04, 0.3, 0.0 }, { 5.0, -7.0, 11.0, 1.0 } };
}

TEST(BlockSource, TheVoxelsAreThoseOfTheBlocks)
{
  for (const int level : { 3, 4, 5, 7, 9, 12 })
  {
    // An edge that is no power of two, far away: voxels are found by rounding.
    const svo::Cube cube{ { 1e4 + 0.1, -3e3 - 0.7, 0.3 }, std::ldexp(0.1, level) };
    const std::set<VoxelAt> voxels = someVoxels(level, 700, static_cast<unsigned>(level));
    KnownVoxels source(blocksOf(voxels), cube, level);
    int i = 0;
    for (const VoxelAt& voxel : voxels)
    {
      if (++i % 5 == 0)
      {
        source.holes.insert(voxel);
      }
    }
    const svo::Octree octree = openPlanes(buildOf(source, cube, level));
    ASSERT_EQ(octree.header().voxelCount, voxels.size() - source.holes.size());
    for (const VoxelAt& voxel : voxels)
    {
      const auto& [x, y, z] = voxel;
      ASSERT_EQ(octree.occupied({ x, y, z }, level), source.holes.count(voxel) == 0);
    }
    EXPECT_EQ(octree.header().origin[0], cube.origin.x);
    EXPECT_EQ(octree.header().voxelSize, 0.1);
    EXPECT_FALSE(octree.hasTransform());
    const svo::MeanPlane plane = svo::decodePlane(octree.lists()[0]);
    EXPECT_NEAR(0.8660254 * plane.offset, 0.25, 0.001);
  }
  EXPECT_EQ(svo::levelOfVoxels({ 1, 8, 3 }), 3);
  EXPECT_EQ(svo::levelOfVoxels({ 1, 9, 3 }), 4);
  EXPECT_EQ(svo::levelOfVoxels({ 1 << 20, 9, 3 }), 20);
  EXPECT_EQ(svo::levelOfVoxels({ std::int64_t(1) << 33, 9, 3 }), 33);
}

TEST(BlockSource, FramesTravelInTheBuffer)
{
  const svo::Cube cube{ glm::dvec3(-0.5), 32.0 };
  for (const int count : { 0, 1, 2, 3, 500 }) // odd and even numbers of words before the frame
  {
    const KnownVoxels source(blocksOf(someVoxels(5, count, 1)), cube, 5);
    const svo::Octree plain = openPlanes(buildOf(source, cube, 5));
    const svo::Octree framed = openPlanes(buildOf(source, cube, 5, Sheared));
    EXPECT_EQ(plain.transform(), glm::dmat4(1.0));
    EXPECT_FALSE(plain.hasTransform());
    ASSERT_TRUE(framed.hasTransform());
    EXPECT_EQ(framed.transform(), Sheared);
    std::vector<std::byte> a = bytesOf(plain), b = bytesOf(framed);
    EXPECT_EQ(b.size() % 8, 0u);
    EXPECT_EQ(b.size(), (a.size() + 7) / 8 * 8 + svo::TransformBytes);
    reinterpret_cast<svo::Header*>(b.data())->transformed = 0;
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size()), 0) << "nothing else differs";
  }
}

TEST(BlockSource, FramesThatAreNoneAreRefused)
{
  const svo::Cube cube{ glm::dvec3(-0.5), 32.0 };
  const KnownVoxels source(blocksOf(someVoxels(5, 50, 1)), cube, 5);
  const svo::Octree framed = openPlanes(buildOf(source, cube, 5, Sheared));
  const std::vector<std::byte> good = bytesOf(framed);
  const auto opens = [&](const std::function<void(svo::Header&, double*)>& change)
  {
    std::shared_ptr<std::byte> bytes(
      static_cast<std::byte*>(::operator new(good.size())), [](void* p) { ::operator delete(p); });
    std::memcpy(bytes.get(), good.data(), good.size());
    auto& header = *reinterpret_cast<svo::Header*>(bytes.get());
    change(header, reinterpret_cast<double*>(bytes.get() + svo::transformOffset(header)));
    std::string error;
    const bool opened(svo::Octree::open(bytes, good.size(), nullptr, error));
    EXPECT_EQ(opened, error.empty());
    return opened;
  };
  EXPECT_TRUE(opens([](svo::Header&, double*) {}));
  EXPECT_FALSE(opens([](svo::Header& h, double*) { h.transformed = 0; })) << "of another size";
  EXPECT_FALSE(opens([](svo::Header& h, double*) { h.transformed = 2; }));
  EXPECT_FALSE(opens([](svo::Header&, double* m) { m[3] = std::nan(""); }));
  EXPECT_FALSE(
    opens([](svo::Header&, double* m) { m[7] = std::numeric_limits<double>::infinity(); }));
  EXPECT_FALSE(opens([](svo::Header&, double* m) { m[12] = 1e-3; })) << "not affine";
  EXPECT_FALSE(opens([](svo::Header&, double* m) { m[15] = 2.0; }));
  EXPECT_FALSE(opens([](svo::Header&, double* m) { std::fill(m, m + 3, 0.0); })) << "flat";
  EXPECT_FALSE(opens([](svo::Header&, double* m) { std::fill(m, m + 12, 0.0); }));
  EXPECT_TRUE(opens([](svo::Header&, double* m) { m[3] = 1e30; }));
  for (const double scale : { 1e-100, 1e100 })
  {
    EXPECT_TRUE(svo::isTransform(glm::scale(glm::dmat4(1.0), glm::dvec3(scale))));
  }
  EXPECT_FALSE(svo::isTransform(glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, 1.0, 1e-10))));
  EXPECT_FALSE(
    static_cast<bool>(buildOf(source, cube, 5, glm::scale(glm::dmat4(1.0), glm::dvec3(0.0))).data));
}

// The values of a smooth field at the voxels' centres make the planes that the field itself has.
TEST(BlockSource, PlanesOfValuesAreThoseOfTheField)
{
  constexpr double Radius = 15.0;
  const glm::dvec3 centre(0.3, -0.2, 0.4);
  const SphereField field(Radius, centre);
  const svo::FieldSource reference(field, { 0.0, 0.0, 1.0 });
  std::size_t occupied = 0, differ = 0;
  for (int i = 0; i < 40 * 40 * 40; ++i)
  {
    const glm::ivec3 at(i % 40 - 20, i / 40 % 40 - 20, i / 1600 - 20);
    svo::VoxelValues values;
    for (int k = 0; k < svo::VoxelValues::Count; ++k)
    {
      const glm::ivec3 step(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
      values(step.x, step.y, step.z) = field.value(glm::dvec3(at + step));
    }
    svo::SourcePlane own, known;
    const bool has = svo::levelSetPlane(values, own);
    const bool should = reference.planeIn(glm::dvec3(at), 0.5, known);
    occupied += has;
    differ += has != should;
    if (has && should)
    {
      ASSERT_GT(glm::dot(own.normal, known.normal), 0.999);
      ASSERT_NEAR(own.offset, known.offset, 0.75 / Radius) << "second order of a voxel";
    }
  }
  EXPECT_GT(occupied, 2000u);
  // Those that the surface touches with a corner.
  EXPECT_LT(differ, occupied / 20);
}

TEST(BlockSource, ValuesWithoutASurfaceHaveNoPlane)
{
  svo::SourcePlane plane;
  const auto filled = [](double value)
  {
    svo::VoxelValues values;
    std::fill(values.at, values.at + svo::VoxelValues::Count, value);
    return values;
  };
  for (const double value :
    { 0.0, 1.0, -2.0, std::nan(""), std::numeric_limits<double>::infinity() })
  {
    EXPECT_FALSE(svo::levelSetPlane(filled(value), plane));
  }
  // The surface around a single voxel ends in the middle of its way to the next one.
  svo::VoxelValues values = filled(1.0);
  values(1, 0, 0) = -0.99;
  EXPECT_FALSE(svo::levelSetPlane(values, plane));
  values(1, 0, 0) = -1.01;
  EXPECT_TRUE(svo::levelSetPlane(values, plane));
  EXPECT_GT(plane.normal.x, -1.01);
  EXPECT_LT(plane.normal.x, -0.99);
  EXPECT_LE(std::abs(plane.offset), 0.5);
  values = filled(1.0);
  values(0, 0, 0) = -0.1;
  EXPECT_TRUE(svo::levelSetPlane(values, plane));
  values(-1, -1, 1) = std::nan("");
  EXPECT_FALSE(svo::levelSetPlane(values, plane));
  for (const double size : { 1e-300, 1e300 })
  {
    for (int i = 0; i < svo::VoxelValues::Count; ++i)
    {
      values.at[i] = size * (i % 3 - 1.2);
    }
    ASSERT_TRUE(svo::levelSetPlane(values, plane));
    EXPECT_NEAR(plane.normal.x, 1.0, 1e-12);
    EXPECT_NEAR(plane.offset, 0.2, 1e-12);
  }
}
