#include "svoMeanPlanes.h"

#include "svoMorton.h"
#include "svoPlane.h"

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

glm::vec3 middleOfVoxels(std::uint64_t mask)
{
  const auto sum = [mask](std::uint64_t low, std::uint64_t high)
  {
    return static_cast<float>(
      __builtin_popcountll(mask & low) + 2 * __builtin_popcountll(mask & high));
  };
  const glm::vec3 sums(sum(0xaaaaaaaaaaaaaaaaull, 0xff00ff00ff00ff00ull),
    sum(0xccccccccccccccccull, 0xffff0000ffff0000ull),
    sum(0xf0f0f0f0f0f0f0f0ull, 0xffffffff00000000ull));
  return sums / static_cast<float>(__builtin_popcountll(mask)) - 1.5f;
}
}

SurfaceMoment brickMoment(
  const BrickRecord* records, std::size_t count, std::uint64_t mask, const TriangleShape* shapes)
{
  const auto area = [&](std::size_t i)
  {
    return std::max(shapes[records[i].triangle].areaPerVoxel *
        static_cast<float>(__builtin_popcountll(records[i].mask)),
      LeastArea);
  };
  const glm::vec3 middle = middleOfVoxels(mask);
  SurfaceMoment moment{ glm::vec3(0.0f), 0.0f, glm::vec3(0.0f) };
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::vec3& n = shapes[records[i].triangle].normal;
    const float a = area(i);
    moment.area += a;
    moment.centre += n * (a * (records[i].offset - glm::dot(n, middle)));
  }
  moment.centre = middle + moment.centre / moment.area;
  moment.normal = count == 1
    ? shapes[records[0].triangle].normal * moment.area
    : sumOnOneSide(
        count, [&](std::size_t i) { return shapes[records[i].triangle].normal * area(i); });
  return moment;
}

SurfaceMoment blockMoment(const SurfaceMoment* children, std::uint64_t mask, float childEdge)
{
  SurfaceMoment moment{ glm::vec3(0.0f), 0.0f, glm::vec3(0.0f) };
  std::size_t count = 0;
  for (; mask != 0; mask &= mask - 1, ++count)
  {
    const SurfaceMoment& child = children[count];
    const glm::vec3 cell(cellOfIndex(__builtin_ctzll(mask)));
    moment.area += child.area;
    moment.centre += ((cell - 1.5f) * childEdge + child.centre) * child.area;
  }
  moment.centre /= moment.area;
  moment.normal = sumOnOneSide(count, [&](std::size_t i) { return children[i].normal; });
  return moment;
}

std::uint32_t planeOfMoment(const SurfaceMoment& moment, float edge)
{
  const float length = glm::length(moment.normal);
  const glm::vec3 normal = length > 0.0f ? moment.normal / length : glm::vec3(0.0f, 0.0f, 1.0f);
  const float halfDiagonal = edge * 0.8660254f;
  return encodePlane({ normal, glm::dot(normal, moment.centre) / halfDiagonal });
}
}
