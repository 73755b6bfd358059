#include "svoSampleSequence.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace svo
{
namespace
{
/// Ranks of pixels such that those below any rank are spread evenly, as multiples of 2^20.
class BlueNoise
{
public:
  static constexpr int Edge = 64;

  BlueNoise()
  {
    for (int dy = -Reach; dy <= Reach; ++dy)
    {
      for (int dx = -Reach; dx <= Reach; ++dx)
      {
        constexpr double Sigma = 1.5; // Ulichney's
        this->Weights[(dy + Reach) * Width + dx + Reach] = static_cast<std::int64_t>(
          std::lround(1e6 * std::exp(-(dx * dx + dy * dy) / (2.0 * Sigma * Sigma))));
      }
    }
    // A tenth of the pixels, moved from where they are dense to where there is room.
    constexpr int First = Pixels / 10;
    std::uint32_t random = 1;
    for (int count = 0; count < First;)
    {
      random = 1664525u * random + 1013904223u;
      const int pixel = static_cast<int>(random >> 20);
      count += !this->Set[pixel];
      this->put(pixel, true);
    }
    for (;;)
    {
      const int densest = this->extreme<true>();
      this->put(densest, false);
      const int emptiest = this->extreme<false>();
      this->put(emptiest, true);
      if (densest == emptiest)
      {
        break;
      }
    }
    const BlueNoise pattern(*this);
    for (int rank = First - 1; rank >= 0; --rank)
    {
      const int densest = this->extreme<true>();
      this->put(densest, false);
      this->Ranks[densest] = static_cast<std::uint32_t>(rank);
    }
    this->Set = pattern.Set;
    this->Crowd = pattern.Crowd;
    for (int rank = First; rank < Pixels; ++rank)
    {
      const int emptiest = this->extreme<false>();
      this->put(emptiest, true);
      this->Ranks[emptiest] = static_cast<std::uint32_t>(rank);
    }
    for (std::uint32_t& rank : this->Ranks)
    {
      rank = (rank << 20) + (1u << 19);
    }
  }

  std::uint32_t at(unsigned x, unsigned y) const { return this->Ranks[y % Edge * Edge + x % Edge]; }

private:
  static constexpr int Pixels = Edge * Edge;
  static constexpr int Reach = 7, Width = 2 * Reach + 1;

  void put(int pixel, bool set)
  {
    if (this->Set[pixel] == set)
    {
      return;
    }
    this->Set[pixel] = set;
    const int x = pixel % Edge, y = pixel / Edge;
    for (int dy = -Reach; dy <= Reach; ++dy)
    {
      for (int dx = -Reach; dx <= Reach; ++dx)
      {
        const std::int64_t weight = this->Weights[(dy + Reach) * Width + dx + Reach];
        this->Crowd[(y + dy + Edge) % Edge * Edge + (x + dx + Edge) % Edge] +=
          set ? weight : -weight;
      }
    }
  }
  /// Where it is densest around a pixel that is set, or emptiest around one that is not.
  template <bool IsSet>
  int extreme() const
  {
    const auto beyond = [this](int a, int b)
    { return IsSet ? this->Crowd[a] > this->Crowd[b] : this->Crowd[a] < this->Crowd[b]; };
    int best = -1;
    for (int i = 0; i < Pixels; ++i)
    {
      best = this->Set[i] == IsSet && (best < 0 || beyond(i, best)) ? i : best;
    }
    return best;
  }

  std::array<std::int64_t, Width * Width> Weights{};
  std::array<std::int64_t, Pixels> Crowd{};
  std::array<bool, Pixels> Set{};
  std::array<std::uint32_t, Pixels> Ranks{};
};
}

glm::ivec2 noiseShift(const View& view)
{
  std::uint64_t mixed = 0;
  const auto mix = [&](double number)
  {
    constexpr double Digits = 1 << 26;
    const double bounded = std::clamp(number, -4096.0, 4096.0);
    mixed ^= static_cast<std::uint64_t>(std::llround(Digits * bounded));
    // Steele et al., "Fast Splittable Pseudorandom Number Generators", 2014.
    mixed += 0x9e3779b97f4a7c15u;
    mixed = (mixed ^ mixed >> 30) * 0xbf58476d1ce4e5b9u;
    mixed = (mixed ^ mixed >> 27) * 0x94d049bb133111ebu;
    mixed ^= mixed >> 31;
  };
  const auto mixSize = [&](double size) { mix(size > 0.0 ? std::log2(size) : 0.0); };
  const glm::dvec3 eye = glm::abs(view.eye);
  const double far = std::max({ eye.x, eye.y, eye.z });
  mixSize(far);
  for (int i = 0; i < 3; ++i)
  {
    mix(far > 0.0 ? view.eye[i] / far : 0.0);
    for (int k = 0; k < 3; ++k)
    {
      mix(view.worldToView[i][k]);
    }
  }
  for (int i = 0; i < 2; ++i)
  {
    mixSize(std::abs(view.viewToClip[i][i]));
    mix(view.viewToClip[2][i]);
    mix(view.viewToClip[3][i]);
  }
  return { static_cast<int>(mixed & 63u), static_cast<int>(mixed >> 6 & 63u) };
}

SquarePoint pixelRotation(int x, int y, unsigned stream)
{
  static const BlueNoise noise;
  // Places of the mask that far from each other have nothing in common.
  const unsigned left = static_cast<unsigned>(x) + 23 * stream;
  const unsigned low = static_cast<unsigned>(y) + 13 * stream;
  return { noise.at(left, low), noise.at(left + 37, low + 17) };
}
}
