#include "svoVoxelLook.h"

#include "svoMorton.h"
#include "svoNode.h"
#include "svoPlane.h"

#include <cassert>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace svo
{
namespace
{
constexpr std::uint32_t NoBrick = 0xffffffffu;

/// The brick that holds a voxel of the root cube, or NoBrick.
std::uint32_t brickAt(const Octree& octree, const glm::ivec3& voxel)
{
  const Node* nodes = octree.nodes();
  std::uint32_t node = 0;
  for (int shift = NodeLevels * (octree.depthCount() - 1); shift > 0; shift -= NodeLevels)
  {
    const int i = cellAt(voxel, shift);
    if (!hasChild(nodes[node], i))
    {
      return NoBrick;
    }
    node = child(nodes[node], i);
  }
  return node;
}
}

VoxelsAround voxelsAround(const Octree& octree, const glm::dvec3& at, const glm::vec3& own)
{
  assert(octree.hasPlanes());
  constexpr float SameSide = 0.5f; // cosine
  const int bits = octree.rootBits(octree.level());
  const glm::dvec3 place = (at - 1.0) * std::ldexp(1.0, bits) - 0.5;
  const glm::dvec3 corner = glm::floor(place);
  const glm::ivec3 low(corner);
  const glm::vec3 upper(place - corner);
  VoxelsAround around;
  // The eight are in up to eight bricks; most often in one.
  std::uint32_t bricks[8];
  for (int i = 0; i < 8; ++i)
  {
    const glm::ivec3 step(i & 1, i >> 1 & 1, i >> 2);
    const glm::ivec3 voxel = low + step;
    const glm::ivec3 outside = voxel >> bits; // 0 inside of the root cube
    if (outside != glm::ivec3(0))
    {
      bricks[i] = NoBrick;
      continue;
    }
    // Where the step along its highest axis stays in the brick it is that of the voxel before.
    const int axis = i >= 4 ? 2 : i >= 2 ? 1 : 0;
    const int before = i & ~(1 << axis);
    const bool same = i > 0 && low[axis] % NodeEdge != NodeEdge - 1 && low[axis] >= 0;
    bricks[i] = same ? bricks[before] : brickAt(octree, voxel);
    if (bricks[i] == NoBrick)
    {
      continue;
    }
    const int cell = cellAt(voxel);
    if (!hasChild(octree.nodes()[bricks[i]], cell))
    {
      continue;
    }
    const std::uint32_t plane = octree.planeOf(bricks[i], cell);
    const glm::vec3 normal = decodePlane(octree.lists()[plane]).normal;
    if (glm::dot(normal, own) > SameSide)
    {
      const glm::vec3 share(step.x ? upper.x : 1.0f - upper.x, step.y ? upper.y : 1.0f - upper.y,
        step.z ? upper.z : 1.0f - upper.z);
      around.planes[around.count] = plane;
      around.normals[around.count] = normal;
      around.shares[around.count++] = share.x * share.y * share.z;
    }
  }
  return around;
}

glm::vec3 smoothNormal(const VoxelsAround& around, const glm::vec3& own)
{
  glm::vec3 sum(0.0f);
  for (int i = 0; i < around.count; ++i)
  {
    sum += around.shares[i] * around.normals[i];
  }
  const float square = glm::dot(sum, sum);
  return square > 1e-12f ? sum / std::sqrt(square) : own;
}

std::uint32_t nearestVoxel(const Octree& octree, std::uint32_t node, const glm::dvec3& at)
{
  assert(octree.hasPlanes() && node < octree.header().nodeCount);
  // Where the node lies is found from the root: `at` may be a little outside of it.
  int depth = 0;
  while (node >= octree.header().depthBegin[depth + 1])
  {
    ++depth;
  }
  const double blocks = std::ldexp(1.0, NodeLevels * depth);
  // Cells of the node that `at` would be in, were the octree of its edge repeated everywhere.
  glm::dvec3 inside = (at - 1.0) * blocks;
  inside = double(NodeEdge) * glm::clamp(inside - glm::floor(inside), 0.0, 1.0);
  while (true)
  {
    const Node& here = octree.nodes()[node];
    int best = 0;
    double least = 1e30;
    for (std::uint64_t mask = here.mask; mask != 0; mask &= mask - 1)
    {
      const int i = lowestBit(mask);
      const glm::dvec3 way = inside - (glm::dvec3(cellOfIndex(i)) + 0.5);
      const double square = glm::dot(way, way);
      best = square < least ? i : best;
      least = std::min(square, least);
    }
    if (node >= octree.brickBegin())
    {
      return octree.planeOf(node, best);
    }
    inside = double(NodeEdge) * (inside - glm::dvec3(cellOfIndex(best)));
    node = child(here, best);
  }
}
}
