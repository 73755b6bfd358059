// A depth buffer gives back pages in which no tile is needed, and no others.
#include "svoDepthBuffer.h"

#include <glm/gtc/matrix_transform.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>

namespace
{
/// By page of an array: it lies in memory.
template <class Array>
std::vector<unsigned char> residentPages(Array& array)
{
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t bytes = array.size() * sizeof(array[0]);
  std::vector<unsigned char> pages((bytes + page - 1) / page);
  EXPECT_EQ(mincore(array.data(), bytes, pages.data()), 0);
  for (unsigned char& one : pages)
  {
    one &= 1;
  }
  return pages;
}
}

TEST(DepthBuffer, HoldsNoMoreThanTwiceWhatItNeeds)
{
  svo::DepthBuffer buffer;
  svo::View view;
  ASSERT_TRUE(svo::makeView(glm::dmat4(1.0), glm::ortho(-1, 1, -1, 1, 1, 2), 1000, 600, view));
  buffer.resize(svo::TileGrid(view));
  const std::size_t tiles = buffer.tiles();
  ASSERT_EQ(tiles, 125u * 75u);
  const std::size_t inPage = static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) / (64 * sizeof(float));
  std::mt19937 random(3);
  std::vector<std::uint8_t> held(tiles), written(tiles), needed(tiles);
  std::vector<unsigned char> pages((tiles + inPage - 1) / inPage);
  int trimmed = 0;
  for (int frame = 0; frame < 40; ++frame)
  {
    const std::size_t from = random() % tiles, to = from + random() % 2000;
    for (std::size_t tile = 0; tile < tiles; ++tile)
    {
      written[tile] = tile >= from && tile < to;
      buffer.hit[tile] = written[tile] ? random() % 10 > 0 : buffer.hit[tile] && random() % 4 > 0;
      held[tile] |= written[tile];
      pages[tile / inPage] |= written[tile];
      for (std::size_t i = 64 * tile; written[tile] && i < 64 * (tile + 1); ++i)
      {
        buffer.t[i] = static_cast<float>(tile);
        buffer.instance[i] = buffer.primitive[i] = static_cast<std::uint32_t>(i);
      }
    }
    buffer.trim([&](std::size_t tile) { return written[tile]; });
    for (std::size_t tile = 0; tile < tiles; ++tile)
    {
      needed[tile] = buffer.hit[tile] | written[tile];
    }
    if (std::count(held.begin(), held.end(), 1) > 2 * std::count(needed.begin(), needed.end(), 1))
    {
      ++trimmed;
      held = needed;
      pages.assign(pages.size(), 0);
    }
    for (std::size_t tile = 0; tile < tiles; ++tile)
    {
      pages[tile / inPage] |= needed[tile];
      for (std::size_t i = 64 * tile; buffer.hit[tile] && i < 64 * (tile + 1); ++i)
      {
        ASSERT_EQ(buffer.t[i], static_cast<float>(tile));
        ASSERT_EQ(buffer.instance[i], i);
        ASSERT_EQ(buffer.primitive[i], i);
      }
    }
    pages.back() = residentPages(buffer.t).back(); // that one is not whole
    EXPECT_EQ(residentPages(buffer.t), pages);
    EXPECT_EQ(residentPages(buffer.instance), pages);
    EXPECT_EQ(residentPages(buffer.primitive), pages);
  }
  EXPECT_GT(trimmed, 5);
  EXPECT_LT(trimmed, 35);
}
#endif
