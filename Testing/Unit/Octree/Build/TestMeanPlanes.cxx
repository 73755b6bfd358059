// The mean plane of every node against the surface it stands for.
#include "svoBuildMeshes.h"
#include "svoPlane.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace
{
using svotest::Mesh;

struct Block
{
  glm::dvec3 centre; // local coordinates
  double halfDiagonal;
  svo::MeanPlane plane;
};

void collectBlocks(const svo::Octree& octree, std::uint32_t node, const glm::ivec3& cell, int depth,
  std::vector<std::vector<Block>>& depths)
{
  const svo::Header& h = octree.header();
  const double edge = std::ldexp(h.voxelSize, 2 * (octree.depthCount() - depth));
  const glm::dvec3 origin(h.origin[0], h.origin[1], h.origin[2]);
  depths[depth].push_back({ origin + (glm::dvec3(cell) + 0.5) * edge, edge * std::sqrt(0.75),
    svo::decodePlane(octree.nodes()[node].plane) });
  if (depth + 1 < octree.depthCount())
  {
    std::uint32_t child = octree.nodes()[node].first;
    for (int i = 0; i < 64; ++i)
    {
      if (octree.nodes()[node].mask >> i & 1)
      {
        collectBlocks(octree, child++, cell * 4 + svo::cellOfIndex(i), depth + 1, depths);
      }
    }
  }
}

std::vector<std::vector<Block>> blocksOf(const Mesh& mesh, int level)
{
  std::string error;
  const svo::Octree octree = svotest::openResult(mesh, svotest::buildAt(mesh, level), error);
  EXPECT_TRUE(octree) << error;
  std::vector<std::vector<Block>> depths(octree ? octree.depthCount() : 0);
  if (octree)
  {
    collectBlocks(octree, 0, glm::ivec3(0), 0, depths);
  }
  return depths;
}

constexpr double Quantum = 2.5e-3; // of a normal, and of an offset in half diagonals, with room
}

TEST(MeanPlanes, ASphereIsFollowedAtEveryDepthThatResolvesIt)
{
  const int slices = 60;
  const double facet = std::acos(-1.0) / slices; // angle that one triangle spans
  const auto depths = blocksOf(svotest::sphere(slices), 8);
  ASSERT_EQ(depths.size(), 4u);
  for (std::size_t depth = 1; depth < depths.size(); ++depth)
  {
    for (const Block& block : depths[depth])
    {
      // Within the block no normal differs from that at its centre by more than its half diagonal
      // spans, and no point of the mean surface lies farther from the sphere than that cap is high.
      const double radius = glm::length(block.centre);
      const double angle = block.halfDiagonal / radius + facet;
      const glm::dvec3 outward = block.centre / radius;
      ASSERT_LT(angle, 1.0);
      EXPECT_GT(glm::dot(glm::dvec3(block.plane.normal), outward), std::cos(angle + Quantum));
      EXPECT_NEAR(block.plane.offset * block.halfDiagonal, 1.0 - radius,
        2.0 * angle * angle + Quantum * block.halfDiagonal);
    }
  }
}

TEST(MeanPlanes, AFlatMeshHasItsOwnPlaneInEveryNode)
{
  Mesh mesh;
  mesh.add({ 0.0, 0.0, 0.3 }, { 1.0, 0.0, 0.3 }, { 1.0, 1.0, 0.8 });
  mesh.add({ 0.0, 0.0, 0.3 }, { 1.0, 1.0, 0.8 }, { 0.0, 1.0, 0.8 });
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.0, -0.5, 1.0));
  for (const int level : { 1, 4, 7, 9 })
  {
    for (const auto& blocks : blocksOf(mesh, level))
    {
      for (const Block& block : blocks)
      {
        EXPECT_LT(glm::length(glm::dvec3(block.plane.normal) - normal), Quantum);
        EXPECT_NEAR(block.plane.offset,
          glm::dot(normal, glm::dvec3(0.0, 0.0, 0.3) - block.centre) / block.halfDiagonal,
          2.0 * Quantum);
      }
    }
  }
}

TEST(MeanPlanes, SheetsThatFaceEachOtherDoNotCancel)
{
  // A thin plate: both sides in the same bricks.
  Mesh mesh;
  const double thickness = 1e-4;
  mesh.add({ 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 });
  mesh.add({ 0.0, 0.0, thickness }, { 0.0, 1.0, thickness }, { 1.0, 0.0, thickness });
  for (const auto& blocks : blocksOf(mesh, 7))
  {
    for (const Block& block : blocks)
    {
      EXPECT_GT(std::abs(block.plane.normal.z), 1.0 - Quantum);
    }
  }
}

TEST(MeanPlanes, TheSideThatMostOfTheAreaFacesWins)
{
  Mesh mesh;
  mesh.add({ 0.0, 0.0, 0.0 }, { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 });      // faces +z
  mesh.add({ 0.0, 0.0, 1e-4 }, { 0.0, 0.5, 1e-4 }, { 0.5, 0.0, 1e-4 });   // faces -z, smaller
  mesh.add({ 0.0, 0.0, 2e-4 }, { 0.0, 0.25, 2e-4 }, { 0.25, 0.0, 2e-4 }); // faces -z, smaller
  const auto depths = blocksOf(mesh, 6);
  ASSERT_FALSE(depths.empty());
  EXPECT_GT(depths[0][0].plane.normal.z, 1.0 - Quantum);
}

TEST(MeanPlanes, SegmentsAndPointsHaveAPlaneThroughThem)
{
  Mesh mesh;
  mesh.add({ 0.0, 0.0, 0.0 }, { 1.0, 0.7, 0.3 }, { 0.5, 0.35, 0.15 });
  mesh.add({ 0.2, 0.9, 0.9 }, { 0.2, 0.9, 0.9 }, { 0.2, 0.9, 0.9 });
  for (const auto& blocks : blocksOf(mesh, 7))
  {
    for (const Block& block : blocks)
    {
      EXPECT_NEAR(glm::length(block.plane.normal), 1.0f, 1e-5f);
      EXPECT_LE(std::abs(block.plane.offset), 1.0f);
    }
  }
}
