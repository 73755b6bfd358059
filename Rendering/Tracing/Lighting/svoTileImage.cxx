#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoTileImage.cxx"
#include <hwy/foreach_target.h>

#include "svoTileImage.h"

#include "svoDepthSlope.h"
#include "svoLaneBits-inl.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
/// The window depths of a patch's points, in double as everybody who compares them has them, and
/// offsetOf(number of the point) more.
template <class OffsetOf>
void windowDepths(const TilePatch& p, const OffsetOf& offsetOf, float* HWY_RESTRICT depths)
{
  const View view = *p.view;
  const double base = p.base;
  for (int i = 0; i < TilePatch::Most; i += TilePatch::Step)
  {
    if (!p.has(i))
    {
      continue;
    }
    for (int k = i; k < i + TilePatch::Step; ++k)
    {
      const double depth = view.windowDepth(base + static_cast<double>(p.hits->t[k])) + offsetOf(k);
      const double low = depth < 0.0 ? 0.0 : depth;
      depths[k] = static_cast<float>(1.0 < low ? 1.0 : low);
    }
  }
}

/// How they change from pixel to pixel on the points' facets.
void depthSlopes(const TilePatch& p, float* HWY_RESTRICT across, float* HWY_RESTRICT up)
{
  const View view = *p.view;
  const double x0 = p.hits->x0, y0 = p.hits->y0, base = p.base;
  const float *x = p.hits->x, *y = p.hits->y, *t = p.hits->t;
  for (int i = 0; i < TilePatch::Most; i += TilePatch::Step)
  {
    if (!p.has(i))
    {
      continue;
    }
    for (int k = i; k < i + TilePatch::Step; ++k)
    {
      const glm::dvec2 slope = depthSlope(view, x0 + static_cast<double>(x[k]),
        y0 + static_cast<double>(y[k]), base + static_cast<double>(t[k]), p.facet(k));
      across[k] = static_cast<float>(slope.x);
      up[k] = static_cast<float>(slope.y);
    }
  }
}

void putWhere(std::uint64_t mask, const float* HWY_RESTRICT depths,
  const std::uint32_t* HWY_RESTRICT colors, float* HWY_RESTRICT depthTo,
  std::uint32_t* HWY_RESTRICT colorTo)
{
  const Floats floats;
  const Words words;
  for (int i = 0; i < TilePatch::Most; i += width())
  {
    const auto wanted = maskOf(floats, mask >> i);
    const auto depth =
      hn::IfThenElse(wanted, hn::Load(floats, depths + i), hn::Load(floats, depthTo + i));
    const auto color = hn::IfThenElse(
      hn::RebindMask(words, wanted), hn::Load(words, colors + i), hn::Load(words, colorTo + i));
    hn::Store(depth, floats, depthTo + i);
    hn::Store(color, words, colorTo + i);
  }
}

void put(const TilePatch& patch, const TileColors& colors, double offset, double factor,
  float* depthTo, std::uint32_t* colorTo)
{
  alignas(64) float depths[TilePatch::Most];
  if (factor == 0.0)
  {
    windowDepths(
      patch, [offset](int) { return offset; }, depths);
  }
  else
  {
    alignas(64) float across[TilePatch::Most] = {}, up[TilePatch::Most] = {};
    depthSlopes(patch, across, up);
    windowDepths(
      patch, [&](int k) { return offset + factor * std::hypot(across[k], up[k]); }, depths);
  }
  putWhere(patch.mask, depths, colors.rgba, depthTo, colorTo);
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(put);
HWY_EXPORT(depthSlopes);

TileImage::TileImage(const TileHits& hits, Frame& frame)
  : Hits(hits)
  , Picture(frame)
{
  for (int row = 0; row < 8 && hits.y0 + row < frame.height; ++row)
  {
    const std::size_t at = static_cast<std::size_t>(hits.y0 + row) * frame.width + hits.x0;
    __builtin_prefetch(frame.color.data() + 4 * at, 1);
    __builtin_prefetch(frame.depth.data() + at, 1);
    if (!frame.instance.empty())
    {
      __builtin_prefetch(frame.instance.data() + at, 1);
      __builtin_prefetch(frame.primitive.data() + at, 1);
    }
  }
  if (hits.mask != ~std::uint64_t(0))
  {
    std::fill_n(this->Color, TileHits::Most, 0u);
    std::fill_n(this->Depth, TileHits::Most, 1.0f);
    std::fill_n(this->Slopes, 2 * TileHits::Most, 0.0f);
  }
}

void TileImage::put(const TilePatch& patch, const TileColors& colors, double offset, double factor)
{
  HWY_DYNAMIC_DISPATCH(put)(patch, colors, offset, factor, this->Depth, this->Color);
}

void TileImage::putSlopes(const TilePatch& patch, bool tilted)
{
  alignas(64) float across[TilePatch::Most] = {}, up[TilePatch::Most] = {};
  if (tilted)
  {
    HWY_DYNAMIC_DISPATCH(depthSlopes)(patch, across, up);
  }
  eachBit(patch.mask,
    [&](int i)
    {
      this->Slopes[2 * i] = across[i];
      this->Slopes[2 * i + 1] = up[i];
    });
}

void TileImage::write() const
{
  const TileHits& hits = this->Hits;
  Frame& frame = this->Picture;
  const int columns = std::min(frame.width - hits.x0, 8);
  const int rows = std::min(frame.height - hits.y0, 8);
  for (int row = 0; row < rows; ++row)
  {
    const std::size_t to = static_cast<std::size_t>(hits.y0 + row) * frame.width + hits.x0;
    const int from = 8 * row;
    if (columns == 8)
    {
      std::memcpy(frame.color.data() + 4 * to, this->Color + from, 32);
      std::memcpy(frame.depth.data() + to, this->Depth + from, 32);
    }
    else
    {
      std::memcpy(frame.color.data() + 4 * to, this->Color + from, 4 * columns);
      std::copy_n(this->Depth + from, columns, frame.depth.data() + to);
    }
    if (!frame.slopes.empty())
    {
      std::copy_n(this->Slopes + 2 * from, 2 * columns, frame.slopes.data() + 2 * to);
    }
    if (!frame.instance.empty())
    {
      std::copy_n(hits.instance + from, columns, frame.instance.data() + to);
      std::copy_n(hits.primitive + from, columns, frame.primitive.data() + to);
    }
  }
  const std::uint64_t misses = pixelsInside(columns, rows) & ~hits.mask;
  const std::size_t tilesX = (frame.width + 7) / 8;
  frame.tiles[hits.y0 / 8 * tilesX + hits.x0 / 8] = {
    misses == 0 ? FrameTile::Kind::Whole : FrameTile::Kind::Mixed, frame.version
  };
  eachBit(frame.normals.empty() ? 0 : misses,
    [&](int i)
    {
      const std::size_t pixel =
        static_cast<std::size_t>(hits.y0 + (i >> 3)) * frame.width + hits.x0 + (i & 7);
      std::fill_n(frame.normals.data() + 3 * pixel, 3, 0.0f);
    });
}
}
#endif
