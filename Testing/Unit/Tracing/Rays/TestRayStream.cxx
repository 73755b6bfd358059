// Which rays of a stream come to a box: those that are there, whatever lay in its memory before.
#include "svoInstructionSets.h"
#include "svoRayStream.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <random>
#include <vector>

using namespace svotest;

namespace
{
/// Memory that is anything at all, numbers and what is none.
void scatter(std::vector<float>& memory, std::mt19937& random)
{
  for (float& number : memory)
  {
    const std::uint32_t bits = random() % 3 == 0 ? 0x7fc00000u : random();
    std::memcpy(&number, &bits, sizeof(number));
  }
#if defined(__GNUC__)
  asm volatile("" : : "r"(memory.data()) : "memory"); // it counts although an object begins there
#endif
}
}

TEST(RayStream, LanesWithoutARayReachNothing)
{
  std::mt19937 random(5);
  std::vector<float> memory(2 * sizeof(svo::RayStream) / sizeof(float));
  onEveryInstructionSet(
    [&]
    {
      for (int round = 0; round < 200; ++round)
      {
        scatter(memory, random);
        void* place = memory.data();
        std::size_t space = memory.size() * sizeof(float);
        ASSERT_NE(
          std::align(alignof(svo::RayStream), sizeof(svo::RayStream), place, space), nullptr);
        auto* const stream = new (place) svo::RayStream(glm::dvec3(0.0));
        const int count = 1 + static_cast<int>(random() % 40);
        for (int i = 0; i < count; ++i)
        {
          // Every other one goes to the box.
          stream->add(glm::dvec3(0.01 * i, 0.0, 0.0), glm::vec3(0.0f, 0.0f, i % 2 ? 1.0f : -1.0f),
            std::numeric_limits<float>::infinity());
        }
        const svo::RayStream::Mask mask = stream->reaching({ 0.0, 0.0, 5.0 }, { 1.0, 1.0, 1.0 });
        EXPECT_EQ(stream->reach({ 0.0, 0.0, 5.0 }, { 1.0, 1.0, 1.0 }), count > 1);
        EXPECT_FALSE(stream->reach({ 9.0, 0.0, 5.0 }, { 1.0, 1.0, 1.0 }));
        for (int i = 0; i < svo::RayStream::Most; ++i)
        {
          ASSERT_EQ(mask.word[i / 64] >> (i % 64) & 1, i < count && i % 2 ? 1u : 0u)
            << "ray " << i << " of " << count;
        }
        stream->~RayStream();
      }
    });
}
