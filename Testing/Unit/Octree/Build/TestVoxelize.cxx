// The voxelisation of one triangle, against thirteen separating axes in exact integers.
#include "svoBuildMeshes.h"
#include "svoSeparatingAxes.h"
#include "svoVoxelize.h"

#include <cstring>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace
{
using Vertices = std::array<glm::ivec3, 3>;
using VoxelSet = std::set<std::uint64_t>; // Morton keys

svo::LatticeTriangle triangleOf(const Vertices& v)
{
  svo::LatticeTriangle t;
  std::memcpy(t.vertices, v.data(), sizeof(t.vertices));
  t.normal = { 0.0, 0.0, 1.0 };
  return t;
}

/// The voxels that the builder names; fails if it names a brick twice.
VoxelSet voxelsOf(const svo::RecordList& records)
{
  VoxelSet voxels;
  std::set<std::uint64_t> keys;
  for (const svo::BrickRecord& record : records)
  {
    EXPECT_TRUE(keys.insert(record.key).second) << "a brick is named twice";
    EXPECT_NE(record.mask, 0u);
    for (int i = 0; i < 64; ++i)
    {
      if (record.mask >> i & 1)
      {
        voxels.insert(64 * record.key + i);
      }
    }
  }
  return voxels;
}

VoxelSet voxelize(const Vertices& v, int level)
{
  svo::RecordList records;
  const std::uint64_t count = svo::voxelizeTriangle(triangleOf(v), level, records);
  const VoxelSet voxels = voxelsOf(records);
  EXPECT_EQ(count, voxels.size());
  return voxels;
}

bool touches(const Vertices& v, const glm::ivec3& voxel)
{
  return svotest::overlapBySeparatingAxes(v.data(), voxel * 256 - 1, voxel * 256 + 257);
}

/// All voxels of the triangle's bounding box, and two more around it.
VoxelSet bruteForce(const Vertices& v, int level)
{
  VoxelSet voxels;
  const int size = 1 << level;
  glm::ivec3 low, high;
  for (int i = 0; i < 3; ++i)
  {
    low[i] = std::max((std::min({ v[0][i], v[1][i], v[2][i] }) >> 8) - 2, 0);
    high[i] = std::min((std::max({ v[0][i], v[1][i], v[2][i] }) >> 8) + 2, size - 1);
  }
  for (int z = low.z; z <= high.z; ++z)
  {
    for (int y = low.y; y <= high.y; ++y)
    {
      for (int x = low.x; x <= high.x; ++x)
      {
        if (touches(v, { x, y, z }))
        {
          voxels.insert(svo::mortonKey(x, y, z));
        }
      }
    }
  }
  return voxels;
}

class RandomTriangles
{
public:
  explicit RandomTriangles(unsigned seed)
    : Random(seed)
  {
  }
  int below(int n) { return static_cast<int>(this->Random() % static_cast<unsigned>(n)); }

  /// With extents up to `size`, somewhere in the cube; often on voxel faces, flat or collinear.
  Vertices next(int level, int size)
  {
    const int top = (1 << (level + 8)) - 1;
    size = std::min(size, top - 1);
    glm::ivec3 corner;
    for (int i = 0; i < 3; ++i)
    {
      corner[i] = 1 + this->below(top - size);
    }
    Vertices v;
    const int kind = this->below(8);
    const int step = kind == 0 ? 256 : kind == 1 ? 255 : 1;
    for (glm::ivec3& p : v)
    {
      for (int i = 0; i < 3; ++i)
      {
        p[i] = std::clamp((corner[i] + this->below(size)) / step * step + (kind == 2), 1, top);
      }
    }
    if (kind == 3) // flat
    {
      v[1].x = v[2].x = v[0].x;
    }
    if (kind == 4) // collinear
    {
      const glm::ivec3 half = (v[1] - v[0]) / 2;
      v[1] = v[0] + half * 2;
      v[2] = v[0] + half;
    }
    if (kind == 5) // a needle: one lattice unit wide
    {
      v[2] = v[1] + glm::ivec3(v[1].x > 1 ? -1 : 1, 0, 0);
    }
    return v;
  }

private:
  std::mt19937 Random;
};
}

TEST(Voxelize, NamesExactlyTheTouchedVoxelsOfSmallTriangles)
{
  RandomTriangles random(1);
  for (int i = 0; i < 4000; ++i)
  {
    const int level = 1 + random.below(7);
    const Vertices v = random.next(level, 64 << random.below(6));
    ASSERT_EQ(voxelize(v, level), bruteForce(v, level)) << "triangle " << i;
  }
}

TEST(Voxelize, NamesExactlyTheTouchedVoxelsOfTrianglesOfManyBricks)
{
  RandomTriangles random(2);
  for (int i = 0; i < 12; ++i)
  {
    const Vertices v = random.next(6, 64 * 256);
    ASSERT_EQ(voxelize(v, 6), bruteForce(v, 6)) << "triangle " << i;
  }
}

TEST(Voxelize, TouchingAGrownBoxCounts)
{
  // The voxel's box [256, 512] grows to [255, 513] on every axis.
  for (const int x : { 254, 255, 513, 514 })
  {
    const Vertices point{ glm::ivec3(x, 300, 300), glm::ivec3(x, 300, 300),
      glm::ivec3(x, 300, 300) };
    EXPECT_EQ(voxelize(point, 4).count(svo::mortonKey(1, 1, 1)), x == 255 || x == 513 ? 1u : 0u)
      << x;
  }
}

TEST(Voxelize, OneLatticePointIsEnoughAtTheDeepestLevel)
{
  RandomTriangles random(3);
  for (int i = 0; i < 300; ++i)
  {
    const Vertices v = random.next(20, 256 << random.below(5));
    ASSERT_EQ(voxelize(v, 20), bruteForce(v, 20)) << "triangle " << i;
  }
}

TEST(Voxelize, AHugeTriangleIsExactWhereverOneLooks)
{
  // Too many voxels to compare all: those near random points of its boundary and inside.
  RandomTriangles random(4);
  for (const int level : { 9, 11, 12 })
  {
    for (int i = 0; i < 4; ++i)
    {
      const int top = (1 << (level + 8)) - 1;
      Vertices v;
      for (glm::ivec3& p : v)
      {
        p = { 1 + random.below(top), 1 + random.below(top), 1 + random.below(top >> (2 * i)) };
      }
      svo::RecordList records;
      svo::voxelizeTriangle(triangleOf(v), level, records);
      std::map<std::uint64_t, std::uint64_t> bricks;
      for (const svo::BrickRecord& record : records)
      {
        ASSERT_TRUE(bricks.insert({ record.key, record.mask }).second);
      }
      for (int k = 0; k < 400; ++k)
      {
        const double a = random.below(1001) / 1000.0;
        const double b = k % 3 == 0 ? 0.0 : (1.0 - a) * random.below(1001) / 1000.0;
        const glm::dvec3 p =
          glm::dvec3(v[0]) + a * glm::dvec3(v[1] - v[0]) + b * glm::dvec3(v[2] - v[0]);
        for (int m = 0; m < 8; ++m)
        {
          const glm::ivec3 voxel = glm::clamp((glm::ivec3(p) >> 8) +
              glm::ivec3(random.below(7) - 3, random.below(7) - 3, random.below(7) - 3),
            0, (1 << level) - 1);
          const auto brick = bricks.find(svo::mortonKey(voxel.x >> 2, voxel.y >> 2, voxel.z >> 2));
          const bool named = brick != bricks.end() &&
            (brick->second >> svo::cellIndex(voxel.x & 3, voxel.y & 3, voxel.z & 3) & 1);
          ASSERT_EQ(named, touches(v, voxel)) << "level " << level << " triangle " << i;
        }
      }
    }
  }
}

TEST(Voxelize, ATriangleAcrossALevel20CubeIsExact)
{
  // A needle of the full length of the cube: its products need more than 64 bits.
  const int top = (1 << 28) - 1;
  const Vertices v{ glm::ivec3(1, 2, 3), glm::ivec3(top, 70000, 50000),
    glm::ivec3(top, 70900, 50100) };
  svo::RecordList records;
  svo::voxelizeTriangle(triangleOf(v), 20, records);
  ASSERT_GT(records.size(), std::size_t(1) << 18);
  std::map<std::uint64_t, std::uint64_t> bricks;
  for (const svo::BrickRecord& record : records)
  {
    bricks[record.key] = record.mask;
  }
  RandomTriangles random(5);
  for (int k = 0; k < 500; ++k)
  {
    const double a = random.below(1000001) / 1e6;
    const double b = a * random.below(2);
    const glm::ivec3 p(
      glm::dvec3(v[0]) + (a - b) * glm::dvec3(v[1] - v[0]) + b * glm::dvec3(v[2] - v[0]));
    for (int m = 0; m < 27; ++m)
    {
      const glm::ivec3 voxel =
        glm::clamp((p >> 8) + glm::ivec3(m % 3, m / 3 % 3, m / 9) - 1, 0, (1 << 20) - 1);
      const auto brick = bricks.find(svo::mortonKey(voxel.x >> 2, voxel.y >> 2, voxel.z >> 2));
      const bool named = brick != bricks.end() &&
        (brick->second >> svo::cellIndex(voxel.x & 3, voxel.y & 3, voxel.z & 3) & 1);
      ASSERT_EQ(named, touches(v, voxel));
    }
  }
}

TEST(Voxelize, PartsAddUpToTheWhole)
{
  RandomTriangles random(6);
  for (int i = 0; i < 40; ++i)
  {
    const Vertices v = random.next(7, 100 * 256);
    svo::RecordList records;
    const std::uint32_t parts = 1 + random.below(9);
    std::uint64_t count = 0;
    for (std::uint32_t part = 0; part < parts; ++part)
    {
      count += svo::voxelizeTriangle(triangleOf(v), 7, records, part, parts);
    }
    const VoxelSet whole = voxelize(v, 7);
    EXPECT_EQ(voxelsOf(records), whole);
    EXPECT_EQ(count, whole.size());
  }
}
