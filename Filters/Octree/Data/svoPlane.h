// A plane in 32 bits: the mean surface of a node's block.
//
//   bits  0..10  octahedral normal, u   (11 bits)
//   bits 11..21  octahedral normal, v   (11 bits)
//   bits 22..31  offset of the plane from the block's centre along the normal (10 bits), as a
//                share of the block's half diagonal, from -1 to 1
//
// The octahedral map is that of Cigolle et al., "A Survey of Efficient Representations for
// Independent Unit Vectors", JCGT 2014.
#ifndef svoPlane_h
#define svoPlane_h

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace svo
{
struct MeanPlane
{
  glm::vec3 normal; // unit length
  float offset;     // -1..1, in half diagonals of the block

  static constexpr float HalfDiagonal = 0.5f * 1.7320508f; // of a block whose edge is 1
};

inline std::uint32_t encodePlane(const MeanPlane& p)
{
  const glm::vec3 n = p.normal;
  assert(std::abs(glm::dot(n, n) - 1.0f) < 1e-3f);
  const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  glm::vec2 o = sum > 0.0f ? glm::vec2(n.x, n.y) / sum : glm::vec2(0.0f);
  if (n.z < 0.0f)
  {
    o = { (1.0f - std::abs(o.y)) * (o.x < 0.0f ? -1.0f : 1.0f),
      (1.0f - std::abs(o.x)) * (o.y < 0.0f ? -1.0f : 1.0f) };
  }
  const auto quantise = [](float v, float steps)
  { return static_cast<std::uint32_t>(std::clamp(v * 0.5f + 0.5f, 0.0f, 1.0f) * steps + 0.5f); };
  return quantise(o.x, 2047.0f) | quantise(o.y, 2047.0f) << 11 | quantise(p.offset, 1023.0f) << 22;
}

inline MeanPlane decodePlane(std::uint32_t bits)
{
  const auto share = [](std::uint32_t steps, float all)
  { return static_cast<float>(steps) / all * 2.0f - 1.0f; };
  glm::vec2 o(share(bits & 2047u, 2047.0f), share(bits >> 11 & 2047u, 2047.0f));
  glm::vec3 n(o.x, o.y, 1.0f - std::abs(o.x) - std::abs(o.y));
  if (n.z < 0.0f)
  {
    n.x = (1.0f - std::abs(o.y)) * (o.x < 0.0f ? -1.0f : 1.0f);
    n.y = (1.0f - std::abs(o.x)) * (o.y < 0.0f ? -1.0f : 1.0f);
  }
  return { glm::normalize(n), share(bits >> 22, 1023.0f) };
}
}

#endif
