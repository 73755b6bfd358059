#include "svoExpectedCells.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace svo
{
namespace
{
constexpr std::size_t Descents = 2048;

/// SplitMix64 (Steele, Lea and Flood 2014): a number for each descent and level.
std::uint64_t scrambled(std::uint64_t x)
{
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
  x = (x ^ x >> 27) * 0x94d049bb133111ebu;
  return x ^ x >> 31;
}
}

std::vector<double> expectedCells(const std::vector<glm::ivec3>& starts, int startLevel, int level,
  const std::function<bool(const glm::ivec3& cell, int level)>& mayPass, double share,
  Executor& executor)
{
  std::vector<double> cells(static_cast<std::size_t>(level) + 1, 0.0);
  const double all = static_cast<double>(starts.size());
  for (int l = 0; l <= std::min(startLevel, level); ++l)
  {
    cells[l] = std::ldexp(all, 2 * (l - startLevel));
  }
  if (starts.empty() || level <= startLevel)
  {
    return cells;
  }
  const std::size_t levels = static_cast<std::size_t>(level - startLevel);
  std::vector<double> met(Descents * levels, 0.0);
  executor.run(
    Descents, 8, share, 64.0, [](std::size_t) { return 1.0; },
    [&](std::size_t i)
    {
      glm::ivec3 cell = starts[i * starts.size() / Descents];
      double product = 1.0;
      for (std::size_t l = 0; l < levels && product > 0.0; ++l)
      {
        glm::ivec3 children[8];
        std::size_t count = 0;
        for (int c = 0; c < 8; ++c)
        {
          children[count] = 2 * cell + glm::ivec3(c & 1, c >> 1 & 1, c >> 2);
          count += mayPass(children[count], startLevel + static_cast<int>(l) + 1);
        }
        product *= static_cast<double>(count);
        met[i * levels + l] = product;
        cell = count > 0 ? children[scrambled(i * levels + l) % count] : cell;
      }
    });
  for (std::size_t i = 0; i < Descents; ++i)
  {
    for (std::size_t l = 0; l < levels; ++l)
    {
      cells[startLevel + 1 + l] += met[i * levels + l] * all / Descents;
    }
  }
  return cells;
}
}
