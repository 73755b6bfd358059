#include "svoGroupPixels.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace svo
{
void SeenPoints::makeRoom(std::size_t size)
{
  if (this->pixel.size() < size)
  {
    size += size / 2;
    this->pixel.resize(size);
    this->low.resize(size);
    this->high.resize(size);
    this->triangle.resize(size);
  }
}

void GroupPixels::clear()
{
  this->Points.count = 0;
  this->Parts.clear();
}

bool GroupPixels::hides(int x0, int x1, int y0, int y1, float key) const
{
  assert(x0 >= 0 && x0 <= x1 && x1 < GroupView::Pixels);
  assert(y0 >= 0 && y0 <= y1 && y1 < GroupView::Pixels);
  if (this->empty())
  {
    return false;
  }
  const float* upper = this->Upper.data();
  for (int y = y0; y <= y1; ++y)
  {
    for (int x = x0; x <= x1; ++x)
    {
      if (!(upper[GroupView::Pixels * y + x] < key))
      {
        return false;
      }
    }
  }
  return true;
}

std::uint32_t GroupPixels::ownerOf(std::int32_t point) const
{
  const auto after = [](std::size_t k, const Part& part) { return k < part.end; };
  const auto part = std::upper_bound(
    this->Parts.begin(), this->Parts.end(), static_cast<std::size_t>(point), after);
  assert(part != this->Parts.end());
  return part->owner;
}

void GroupPixels::merge(std::uint32_t owner)
{
  const std::size_t begin = this->Parts.empty() ? 0 : this->Parts.back().end;
  const std::size_t end = this->Points.count;
  if (begin == end)
  {
    return;
  }
  if (this->Parts.empty())
  {
    const float infinity = std::numeric_limits<float>::infinity();
    for (std::vector<float>* keys : { &this->Upper, &this->Lower, &this->Rival })
    {
      keys->assign(Count, infinity);
    }
    this->First.assign(Count, NoPoint);
    this->Triangle.resize(Count);
    this->Owner.resize(Count);
  }
  if (this->Parts.empty() || this->Parts.back().owner != owner)
  {
    this->Parts.push_back({ owner, begin, 0 });
  }
  if (this->Next.size() < end)
  {
    this->Next.resize(end + end / 2);
  }
  float* const upper = this->Upper.data();
  float* const lower = this->Lower.data();
  float* const rival = this->Rival.data();
  std::uint32_t tiles = 0;
  for (std::size_t k = begin; k < end; ++k)
  {
    const std::int32_t pixel = this->Points.pixel[k];
    assert(pixel >= 0 && pixel < Count);
    const float low = this->Points.low[k], high = this->Points.high[k];
    if (!(low <= upper[pixel]))
    {
      continue;
    }
    tiles |= 1u << (pixel >> 8 << 2 | (pixel >> 3 & 3));
    this->Next[k] = this->First[pixel];
    this->First[pixel] = static_cast<std::int32_t>(k);
    // As draw() of svoNearestTriangles.cxx does.
    if (high < upper[pixel])
    {
      rival[pixel] = std::min(rival[pixel], lower[pixel]);
      lower[pixel] = low;
      upper[pixel] = high;
      this->Triangle[pixel] = static_cast<std::uint32_t>(this->Points.triangle[k]);
      this->Owner[pixel] = owner;
    }
    else
    {
      rival[pixel] = std::min(rival[pixel], low);
    }
  }
  this->Parts.back().end = end;
  this->Parts.back().tiles |= tiles;
}
}
