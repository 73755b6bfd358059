// The rival of a tree over many objects: every ball against every plane, with all lanes of the
// machine.
#ifndef performanceFlatTest_h
#define performanceFlatTest_h

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec4.hpp>

namespace performance
{
/// Balls as arrays of floats, which end a vector or more after the last ball.
struct FlatBalls
{
  explicit FlatBalls(std::size_t balls)
    : count(balls)
    , x(balls + 64)
    , y(balls + 64)
    , z(balls + 64)
    , radius(balls + 64)
  {
  }
  std::size_t count;
  std::vector<float> x, y, z, radius;
};

/// Writes the numbers of the balls that are not outside of one of six planes, positive inside;
/// `seen` has room for 64 more than there are balls. Returns how many they are.
std::size_t flatTest(const FlatBalls& balls, const glm::vec4 planes[6], std::uint32_t* seen);
}

#endif
