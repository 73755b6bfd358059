#include "svoMeanPlanes.h"

#include "svoMorton.h"
#include "svoNode.h"
#include "svoPlane.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace svo
{
namespace
{
constexpr float LeastArea = 1e-20f; // of what has none: its place still counts

/// Sums vectors, all turned to the side of the largest.
template <typename VectorAt>
glm::vec3 sumOnOneSide(std::size_t count, const VectorAt& at)
{
  glm::vec3 largest(0.0f);
  glm::vec3 plain(0.0f);
  float square = -1.0f;
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::vec3 n = at(i);
    const float s = glm::dot(n, n);
    plain += n;
    if (s > square)
    {
      square = s;
      largest = n;
    }
  }
  glm::vec3 sum(0.0f);
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::vec3 n = at(i);
    sum += glm::dot(n, largest) < 0.0f ? -n : n;
  }
  return glm::dot(sum, plain) < 0.0f ? -sum : sum;
}

/// Set bits of each byte. Plain C++: without the processor's own instruction the compiler would
/// call a function.
std::uint64_t bitsOfBytes(std::uint64_t m)
{
  m -= m >> 1 & 0x5555555555555555ull;
  m = (m & 0x3333333333333333ull) + (m >> 2 & 0x3333333333333333ull);
  return (m + (m >> 4)) & 0x0f0f0f0f0f0f0f0full;
}

float sumOfBytes(std::uint64_t bytes)
{
  return static_cast<float>(static_cast<int>(bytes * 0x0101010101010101ull >> 56));
}

/// Voxels of a mask, and the middle of their centres from the brick's centre.
glm::vec3 middleOfVoxels(std::uint64_t mask, float& count)
{
  const std::uint64_t bytes = bitsOfBytes(mask);
  // The odd coordinates by bits, the upper halves by bytes.
  const std::uint64_t x = bitsOfBytes(mask & 0xaaaaaaaaaaaaaaaaull);
  const std::uint64_t y = bitsOfBytes(mask & 0xccccccccccccccccull);
  const std::uint64_t z = bitsOfBytes(mask & 0xf0f0f0f0f0f0f0f0ull);
  count = sumOfBytes(bytes);
  const glm::vec3 sums(sumOfBytes(x + 2 * (bytes & 0x0f000f000f000f00ull)),
    sumOfBytes(y + 2 * (bytes & 0x0f0f00000f0f0000ull)),
    sumOfBytes(z + 2 * (bytes & 0x0f0f0f0f00000000ull)));
  return sums / count - 1.5f;
}
}

SurfaceMoment brickMoment(
  const BrickRecord* records, std::size_t count, std::uint64_t mask, const TriangleShape* shapes)
{
  assert(count > 0 && mask != 0);
  float voxels = 0.0f;
  const glm::vec3 middle = middleOfVoxels(mask, voxels);
  if (count == 1)
  {
    const TriangleShape& shape = shapes[records->triangle];
    const float area = std::max(shape.areaPerVoxel * voxels, LeastArea);
    return { shape.normal * area, area,
      middle + shape.normal * (records->offset - glm::dot(shape.normal, middle)) };
  }
  const auto area = [&](std::size_t i)
  {
    return std::max(
      shapes[records[i].triangle].areaPerVoxel * sumOfBytes(bitsOfBytes(records[i].mask)),
      LeastArea);
  };
  SurfaceMoment moment{ glm::vec3(0.0f), 0.0f, glm::vec3(0.0f) };
  glm::vec3 plain(0.0f);
  glm::vec3 largest(0.0f);
  float largestArea = 0.0f;
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::vec3& n = shapes[records[i].triangle].normal;
    const float a = area(i);
    moment.area += a;
    moment.centre += n * (a * (records[i].offset - glm::dot(n, middle)));
    plain += a * n;
    if (a > largestArea)
    {
      largestArea = a;
      largest = n;
    }
  }
  moment.centre = middle + moment.centre / moment.area;
  // Mostly all face one way: then the plain sum is the answer.
  bool opposed = false;
  for (std::size_t i = 0; i < count; ++i)
  {
    opposed = opposed || glm::dot(shapes[records[i].triangle].normal, largest) < 0.0f;
  }
  moment.normal = plain;
  if (opposed)
  {
    moment.normal = sumOnOneSide(
      count, [&](std::size_t i) { return shapes[records[i].triangle].normal * area(i); });
  }
  return moment;
}

SurfaceMoment blockMoment(const SurfaceMoment* children, std::uint64_t mask, float childEdge)
{
  SurfaceMoment moment{ glm::vec3(0.0f), 0.0f, glm::vec3(0.0f) };
  std::size_t count = 0;
  for (; mask != 0; mask &= mask - 1, ++count)
  {
    const SurfaceMoment& child = children[count];
    const glm::vec3 cell(cellOfIndex(lowestBit(mask)));
    moment.area += child.area;
    moment.centre += ((cell - 0.5f * (NodeEdge - 1)) * childEdge + child.centre) * child.area;
  }
  assert(moment.area > 0.0f);
  moment.centre /= moment.area;
  moment.normal = sumOnOneSide(count, [&](std::size_t i) { return children[i].normal; });
  return moment;
}

std::uint32_t planeOfMoment(const SurfaceMoment& moment, float edge)
{
  const float square = glm::dot(moment.normal, moment.normal);
  const glm::vec3 normal =
    square > 0.0f ? moment.normal * (1.0f / std::sqrt(square)) : glm::vec3(0.0f, 0.0f, 1.0f);
  const float halfDiagonal = edge * 0.8660254f;
  float offset = glm::dot(normal, moment.centre) / halfDiagonal;
  // A face of the octree's cube is the outer face of blocks. Rounded outwards, its plane would lie
  // where no ray is followed; so planes along a face stay two steps of quantisation inside.
  constexpr float Face = 0.5773503f - 2.0f * 2.0f / 1023.0f;
  const glm::vec3 along = glm::abs(normal);
  if (std::max({ along.x, along.y, along.z }) > 0.9999f)
  {
    offset = std::clamp(offset, -Face, Face);
  }
  return encodePlane({ normal, offset });
}
}
