#include "svoWarpedImage.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <glm/matrix.hpp>

namespace svo
{
namespace
{
constexpr std::uint32_t Nothing = ~0u;
constexpr float Nowhere = std::numeric_limits<float>::infinity();
constexpr int DepthShift = 16; // of keys
constexpr int BandRows = 8;    // rows of tiles that one thread fills
/// Blocks of so many tiles along an edge, as they are traced together, are traced anew after so
/// many frames at last.
constexpr std::size_t Block = 4, Period = 8;

float squared(float a)
{
  return a * a;
}

/// Of two points that come to a pixel the one with the lesser key is seen: whose surface is nearer,
/// by more than depths of one surface differ there (2^-7 of it), else which is nearer to the
/// centre.
std::uint32_t keyOf(float depth, float squaredDistance)
{
  std::uint32_t bits;
  std::memcpy(&bits, &depth, sizeof(bits));
  return (bits & 0xffff0000u) |
    std::min(static_cast<std::uint32_t>(16384.0f * squaredDistance), 0xfffeu);
}
}

void WarpedImage::Points::resize(std::size_t count)
{
  this->x.resize(count);
  this->y.resize(count);
  this->z.resize(count);
  this->color.resize(count);
  this->instance.resize(count);
}

void WarpedImage::forget()
{
  *this = WarpedImage();
}

double WarpedImage::share() const
{
  const auto again = std::count(this->Missing.begin(), this->Missing.end(), 0);
  return static_cast<double>(again) /
    static_cast<double>(std::max<std::size_t>(this->Missing.size(), 1));
}

std::size_t WarpedImage::memory() const
{
  return this->Held.bytes() + this->Next.bytes() +
    sizeof(float) * (this->U.size() + this->V.size() + this->Keys.size() + this->Sources.size());
}

/// The points of a tile, in the new view.
void WarpedImage::place(std::size_t tile, const View& view, const float m[12])
{
  const std::size_t first = 64 * tile;
  float* const x = this->Held.x.data() + first;
  float* const y = this->Held.y.data() + first;
  float* const z = this->Held.z.data() + first;
  float* const u = this->U.data() + first;
  float* const v = this->V.data() + first;
  const std::uint32_t* const instance = this->Held.instance.data() + first;
  const glm::dmat4& p = view.viewToClip;
  // Of a perspective view: w = p[2][3] z.
  const auto halfX = static_cast<float>(0.5 * view.width),
             halfY = static_cast<float>(0.5 * view.height);
  const auto xx = static_cast<float>(p[0][0] / p[2][3]), xy = static_cast<float>(p[1][0] / p[2][3]),
             xz = static_cast<float>(p[2][0] / p[2][3]), yx = static_cast<float>(p[0][1] / p[2][3]),
             yy = static_cast<float>(p[1][1] / p[2][3]), yz = static_cast<float>(p[2][1] / p[2][3]);
  const auto nearest = static_cast<float>(view.tNear), farthest = static_cast<float>(view.tFar);
  float low = Nowhere, high = -Nowhere;
  for (int i = 0; i < 64; ++i)
  {
    const float there = instance[i] == NoInstance ? 0.0f : 1.0f;
    const float a = x[i], b = y[i], c = z[i];
    x[i] = m[0] * a + m[1] * b + m[2] * c + there * m[3];
    y[i] = m[4] * a + m[5] * b + m[6] * c + there * m[7];
    z[i] = m[8] * a + m[9] * b + m[10] * c + there * m[11];
  }
  for (int i = 0; i < 64; ++i)
  {
    const bool there = instance[i] != NoInstance;
    const bool seen = z[i] < 0.0f && (!there || (-z[i] >= nearest && -z[i] <= farthest));
    const float inverse = 1.0f / z[i];
    u[i] = seen ? halfX * ((xx * x[i] + xy * y[i]) * inverse + xz + 1.0f) : -Nowhere;
    v[i] = seen ? halfY * ((yx * x[i] + yy * y[i]) * inverse + yz + 1.0f) : -Nowhere;
    low = std::min(low, seen ? v[i] : Nowhere);
    high = std::max(high, v[i]);
  }
  this->Lowest[tile] = low;
  this->Highest[tile] = high;
}

/// Says which points are nearest to the centres of pixels in rows of tiles of the new view.
void WarpedImage::fill(int firstRow, int endRow, const View& view)
{
  const std::size_t begin = 64 * static_cast<std::size_t>(firstRow) * this->NextX;
  const std::size_t end = 64 * static_cast<std::size_t>(endRow) * this->NextX;
  std::fill(this->Keys.data() + begin, this->Keys.data() + end, Nothing);
  const auto low = static_cast<float>(8 * firstRow);
  const auto high = static_cast<float>(std::min(8 * endRow, view.height));
  const auto width = static_cast<float>(view.width);
  const std::size_t tiles = this->Lowest.size();
  for (std::size_t tile = 0; tile < tiles; ++tile)
  {
    if (this->Highest[tile] < low || this->Lowest[tile] >= high)
    {
      continue;
    }
    for (std::size_t i = 64 * tile; i < 64 * tile + 64; ++i)
    {
      const float u = this->U[i], v = this->V[i];
      if (u >= 0.0f && u < width && v >= low && v < high)
      {
        const int x = static_cast<int>(u), y = static_cast<int>(v);
        const std::size_t pixel = this->at(x, y);
        const std::uint32_t key = keyOf(this->depthOf(i),
          squared(u - static_cast<float>(x) - 0.5f) + squared(v - static_cast<float>(y) - 0.5f));
        if (key < this->Keys[pixel])
        {
          this->Keys[pixel] = key;
          this->Sources[pixel] = static_cast<std::uint32_t>(i);
        }
      }
    }
  }
}

/// Bits of the pixels of a tile that no point comes to, or beside which something nearer is.
std::uint64_t WarpedImage::unsure(std::size_t tile) const
{
  // The upper halves of keys of the tile and of the pixels around it.
  constexpr std::int16_t None = 0x7fff;
  std::int16_t depths[10][16];
  const int x0 = 8 * static_cast<int>(tile % this->NextX) - 1;
  const int y0 = 8 * static_cast<int>(tile / this->NextX) - 1;
  for (int row = 0; row < 10; ++row)
  {
    const bool rowThere = y0 + row >= 0 && y0 + row < 8 * this->NextY;
    const auto depthAt = [&](int column)
    {
      return rowThere && x0 + column >= 0 && x0 + column < 8 * this->NextX
        ? std::min(static_cast<std::int16_t>(
                     this->Keys[this->at(x0 + column, y0 + row)] >> (DepthShift + 1)),
            None)
        : None;
    };
    depths[row][0] = depthAt(0);
    depths[row][9] = depthAt(9);
    const std::uint32_t* const keys =
      rowThere ? this->Keys.data() + this->at(x0 + 1, y0 + row) : nullptr;
    for (int k = 0; k < 8; ++k)
    {
      depths[row][k + 1] = keys ? static_cast<std::int16_t>(keys[k] >> (DepthShift + 1)) : None;
    }
  }
  std::uint64_t bits = 0;
  for (int row = 1; row < 9; ++row)
  {
    std::int16_t across[16];
    for (int k = 0; k < 10; ++k)
    {
      across[k] = std::min(std::min(depths[row - 1][k], depths[row][k]), depths[row + 1][k]);
    }
    for (int k = 1; k < 9; ++k)
    {
      const std::int16_t nearest = std::min(std::min(across[k - 1], across[k]), across[k + 1]);
      const bool missing = this->Keys[64 * tile + 8 * (row - 1) + k - 1] == Nothing;
      bits |= std::uint64_t(missing || nearest + 1 < depths[row][k]) << (8 * (row - 1) + k - 1);
    }
  }
  return bits;
}

/// The outlines of two things that are nearer than what is behind a pixel's point come to it: what
/// lies between these three may have been hidden by both.
bool WarpedImage::isCorner(int x, int y, std::uint32_t own) const
{
  std::uint32_t first = NoInstance;
  for (int k = 0; k < 9; ++k)
  {
    const std::size_t beside = this->at(x + k % 3 - 1, y + k / 3 - 1);
    if ((this->Keys[beside] >> DepthShift) + 1 < own >> DepthShift)
    {
      const std::uint32_t instance = this->Held.instance[this->Sources[beside]];
      if (first != NoInstance && instance != first)
      {
        return true;
      }
      first = instance;
    }
  }
  return false;
}

/// The point that is seen at a pixel; Nothing if there is none within the error. Points of what
/// comes nearer lie further apart than pixels: between two of them nothing behind them is seen, and
/// where nothing is known between two of one surface it goes on. Edges stay where they are.
std::uint32_t WarpedImage::pointAt(int x, int y, const View& view, float error) const
{
  const std::size_t pixel = this->at(x, y);
  const std::uint32_t own = this->Keys[pixel];
  if (std::min(x, y) < 2 || x >= view.width - 2 || y >= view.height - 2)
  {
    return own != Nothing ? this->Sources[pixel] : Nothing;
  }
  if (own != Nothing && this->isCorner(x, y, own))
  {
    return Nothing;
  }
  // By pairs of pixels on opposite sides, and one further.
  constexpr int Across[4][2] = { { 1, 0 }, { 0, 1 }, { 1, 1 }, { 1, -1 } };
  std::uint32_t farthest = Nothing >> DepthShift; // that is seen there
  for (const auto& step : Across)
  {
    const auto depthAt = [&](int steps)
    { return this->Keys[this->at(x + steps * step[0], y + steps * step[1])] >> DepthShift; };
    const std::uint32_t before = depthAt(-1), behind = depthAt(1);
    farthest = std::min({ farthest, 1 + std::max(before, std::min(behind, depthAt(2))),
      1 + std::max(behind, depthAt(-2)) });
  }
  if (own >> DepthShift <= farthest && own != Nothing)
  {
    return this->Sources[pixel];
  }
  std::uint32_t best = Nothing, source = Nothing;
  for (const auto& step : Across)
  {
    const std::size_t sides[2] = { this->at(x - step[0], y - step[1]),
      this->at(x + step[0], y + step[1]) };
    const std::uint32_t one = this->Keys[sides[0]] >> DepthShift;
    const std::uint32_t other = this->Keys[sides[1]] >> DepthShift;
    const bool together = std::max(one, other) <= std::min(one, other) + 1;
    for (const std::size_t side : sides)
    {
      if (!(own != Nothing || together) || this->Keys[side] >> DepthShift > farthest ||
        this->Keys[side] == Nothing)
      {
        continue;
      }
      const std::uint32_t from = this->Sources[side];
      const float dx = this->U[from] - static_cast<float>(x) - 0.5f;
      const float dy = this->V[from] - static_cast<float>(y) - 0.5f;
      const std::uint32_t key = keyOf(this->depthOf(from), squared(dx) + squared(dy));
      if (std::abs(dx) <= error && std::abs(dy) <= error && key < best)
      {
        best = key;
        source = from;
      }
    }
  }
  return source;
}

/// The points of a tile of the new view; false if some are missing.
bool WarpedImage::take(std::size_t tile, const View& view, float error)
{
  const int x0 = 8 * static_cast<int>(tile % this->NextX);
  const int y0 = 8 * static_cast<int>(tile / this->NextX);
  const std::uint64_t unsure = this->unsure(tile);
  bool all = true;
  for (int i = 0; i < 64; ++i)
  {
    const std::size_t pixel = 64 * tile + i;
    const int x = x0 + (i & 7), y = y0 + (i >> 3);
    this->Missing[pixel] = 0;
    const bool inside = x < view.width && y < view.height;
    const std::uint32_t from = !inside ? Nothing
      : unsure >> i & 1                ? this->pointAt(x, y, view, error)
                                       : this->Sources[pixel];
    if (from == Nothing)
    {
      this->Next.instance[pixel] = NoInstance;
      this->Next.x[pixel] = this->Next.y[pixel] = 0.0f;
      this->Next.z[pixel] = 1.0f; // behind the eye
      this->Next.color[pixel] = 0;
      this->Missing[pixel] = inside;
      all = all && !inside;
      continue;
    }
    this->Next.x[pixel] = this->Held.x[from];
    this->Next.y[pixel] = this->Held.y[from];
    this->Next.z[pixel] = this->Held.z[from];
    this->Next.color[pixel] = this->Held.color[from];
    this->Next.instance[pixel] = this->Held.instance[from];
  }
  return all;
}

/// True of the blocks of tiles that are traced in this frame, whatever comes to them.
bool WarpedImage::isDue(std::size_t tile) const
{
  const std::size_t column = tile % this->NextX / Block, row = tile / this->NextX / Block;
  // Neighbours at different times.
  return (column + 3 * row + this->Frames) % Period == 0;
}

bool WarpedImage::warp(const View& view, double error, const ParallelFor& parallelFor)
{
  this->NextX = (view.width + 7) / 8;
  this->NextY = (view.height + 7) / 8;
  const std::size_t tiles = static_cast<std::size_t>(this->NextX) * this->NextY;
  this->Wanted.assign(tiles, 1);
  ++this->Frames;
  this->Missing.assign(64 * tiles, 1);
  this->Next.resize(64 * tiles);
  const bool known = this->Known && error > 0.0 && !view.parallel;
  if (known)
  {
    const std::size_t held = static_cast<std::size_t>(this->TilesX) * this->TilesY;
    this->U.resize(64 * held);
    this->V.resize(64 * held);
    this->Lowest.resize(held);
    this->Highest.resize(held);
    const glm::dmat4 moved = view.worldToView * glm::inverse(this->Seen.worldToView);
    float matrix[12];
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 4; ++column)
      {
        matrix[4 * row + column] = static_cast<float>(moved[column][row]);
      }
    }
    parallelFor(0, held, 512,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t tile = first; tile < last; ++tile)
        {
          this->place(tile, view, matrix);
        }
      });
    this->Keys.resize(64 * tiles);
    this->Sources.resize(64 * tiles);
    const auto reach = static_cast<float>(errorOf(error));
    parallelFor(0, static_cast<std::size_t>((this->NextY + BandRows - 1) / BandRows), 1,
      [&](std::size_t first, std::size_t last)
      {
        for (auto band = static_cast<int>(first); band < static_cast<int>(last); ++band)
        {
          this->fill(BandRows * band, std::min(BandRows * (band + 1), this->NextY), view);
        }
      });
    parallelFor(0, tiles, 512,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t tile = first; tile < last; ++tile)
        {
          this->Wanted[tile] = this->isDue(tile) || !this->take(tile, view, reach);
        }
      });
  }
  this->Known = false; // until add()
  this->Seen = view;
  this->TilesX = this->NextX;
  this->TilesY = this->NextY;
  std::swap(this->Held, this->Next);
  return known;
}

void WarpedImage::addTile(std::size_t tile, const Hits& hits, const Frame& frame)
{
  const View& view = this->Seen;
  const int x0 = 8 * static_cast<int>(tile % this->TilesX),
            y0 = 8 * static_cast<int>(tile / this->TilesX);
  const bool any = hits.depth.hit[tile] != 0;
  const glm::dmat3 turn(view.worldToView);
  const glm::dvec3 start = turn * view.rayDirection(x0 + 0.5, y0 + 0.5);
  const glm::vec3 corner(start), right(turn * view.directionX), up(turn * view.directionY);
  for (int i = 0; i < 64; ++i)
  {
    const std::size_t pixel = 64 * tile + i;
    if (!this->Missing[pixel])
    {
      continue;
    }
    const int x = x0 + (i & 7), y = y0 + (i >> 3);
    const bool inside = x < view.width && y < view.height;
    const std::uint32_t instance = any && inside ? hits.depth.instance[pixel] : NoInstance;
    float t = inside ? 1.0f : -1.0f; // behind the eye
    if (instance != NoInstance)
    {
      t = static_cast<float>(hits.base(instance) + static_cast<double>(hits.depth.t[pixel]));
    }
    const glm::vec3 p =
      t * (corner + static_cast<float>(i & 7) * right + static_cast<float>(i >> 3) * up);
    this->Held.x[pixel] = p.x;
    this->Held.y[pixel] = p.y;
    this->Held.z[pixel] = p.z;
    this->Held.instance[pixel] = instance;
    this->Held.color[pixel] = 0;
    if (inside)
    {
      std::memcpy(&this->Held.color[pixel],
        frame.color.data() + 4 * (static_cast<std::size_t>(y) * frame.width + x), 4);
    }
  }
}

void WarpedImage::add(const Hits& hits, const Frame& frame, const ParallelFor& parallelFor)
{
  parallelFor(0, this->Wanted.size(), 512,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t tile = first; tile < last; ++tile)
      {
        if (this->Wanted[tile])
        {
          this->addTile(tile, hits, frame);
        }
      }
    });
  this->Known = true;
}

void WarpedImage::write(Frame& frame, const ParallelFor& parallelFor) const
{
  std::vector<PixelRect> covered(static_cast<std::size_t>(this->TilesY)); // by row of tiles
  parallelFor(0, covered.size(), 4,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t row = first; row < last; ++row)
      {
        for (int column = 0; column < this->TilesX; ++column)
        {
          const std::size_t tile = row * this->TilesX + column;
          const int x0 = 8 * column, y0 = 8 * static_cast<int>(row);
          const int width = std::min(8, frame.width - x0), height = std::min(8, frame.height - y0);
          int hit = 0;
          for (int y = 0; y < height; ++y)
          {
            const std::size_t to = static_cast<std::size_t>(y0 + y) * frame.width + x0;
            for (int x = 0; x < width; ++x)
            {
              const std::size_t from = 64 * tile + 8 * y + x;
              const bool seen = this->Held.instance[from] != NoInstance;
              hit += seen;
              if (!this->Missing[from])
              {
                const double depth =
                  seen ? this->Seen.windowDepth(-static_cast<double>(this->Held.z[from])) : 1.0;
                frame.depth[to + x] = static_cast<float>(std::clamp(depth, 0.0, 1.0));
                std::memcpy(&frame.color[4 * (to + x)], &this->Held.color[from], 4);
              }
            }
          }
          frame.tiles[tile] = { hit == 0 ? FrameTile::Kind::Empty
              : hit == width * height    ? FrameTile::Kind::Whole
                                         : FrameTile::Kind::Mixed,
            frame.version };
          if (hit > 0)
          {
            covered[row] = around(covered[row], { x0, y0, x0 + width, y0 + height });
          }
        }
      }
    });
  for (const PixelRect& rect : covered)
  {
    frame.covered = around(frame.covered, rect);
  }
}
}
