// The hits of a tile, and the patches that they are shaded in: points of one instance near to each
// other, in the order of the tile's pixels.
//
// Shading works on all 64 pixels of a tile at once, whatever they show: what differs from triangle
// to triangle is put in a table for the few triangles of a patch (svoTileTriangles.h) and spread
// over the pixels from there, so that loops run over whole vectors even where a triangle is as
// large as a pixel. What differs from instance to instance (matrices, materials) would have to be
// spread as well: instead a tile is cut into patches, each of which is shaded on its own, with the
// numbers of its instance. Loops skip Step pixels where a patch has none of them; of others they
// compute what nobody reads.
//
// Positions are floats from an origin that the patch has in double (svoPointOrigin.h). Points
// of an instance that lie deeper than Reach pixels' widths apart go to different patches. So the
// way to a point is off by less than WayError 2 Reach, a four-thousandth of a pixel's width, in
// every view; today's scenes have such patches at the horizon and at few silhouettes only.
#ifndef svoTilePatch_h
#define svoTilePatch_h

#include "svoDepthBuffer.h"
#include "svoPointOrigin.h"
#include "svoSurfacePoint.h"
#include "svoView.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

#include <glm/vec3.hpp>

namespace svo
{
/// What rays met in a tile of 8x8 pixels: at their centres, or anywhere in the tile.
struct TileHits
{
  static constexpr int Most = 64;
  int x0, y0;         // pixel: the tile's lower left corner
  std::uint64_t mask; // which are hits; of the others nothing is known but their instance
  const float *x, *y; // from the corner, pixels
  const float* t;     // linear depth minus the base of the instance
  const std::uint32_t* instance; // NoInstance: none
  const Primitive* primitive;
  /// Points of the image at whose places on the planes of the hits' triangles attributes are
  /// interpolated, inside of the triangles or not; or null: at the hits.
  const float *lookX = nullptr, *lookY = nullptr;
};

/// Which pixels of a tile are in an image that has `columns` and `rows` of them from its corner on.
inline std::uint64_t pixelsInside(int columns, int rows)
{
  const std::uint64_t row = columns < 8 ? (1u << columns) - 1 : 0xffu;
  const std::uint64_t all = row * 0x0101010101010101u;
  return rows < 8 ? all & ((std::uint64_t(1) << 8 * rows) - 1) : all;
}

/// The hits at the centres of a tile's pixels, as the view merged them.
VTKSVOTRACING_EXPORT TileHits hitsOfTile(
  const DepthBuffer& depth, const View& view, int tileX, int tileY);

/// Hits anywhere in a tile, one by one.
struct TileHitList
{
  alignas(64) float x[TileHits::Most], y[TileHits::Most], t[TileHits::Most];
  alignas(64) float lookX[TileHits::Most], lookY[TileHits::Most];
  alignas(64) std::uint32_t instance[TileHits::Most];
  alignas(64) Primitive primitive[TileHits::Most];
  TileHits hits;

  TileHitList(const TileHitList&) = delete;
  TileHitList() { this->start(0, 0); }
  /// Empties the list. `x0`, `y0`: the pixel at the tile's lower left corner.
  void start(int x0, int y0)
  {
    hits = { x0, y0, 0, x, y, t, instance, primitive };
    std::fill_n(instance, TileHits::Most, NoInstance);
    std::fill_n(primitive, TileHits::Most, NoPrimitive);
  }
  /// Number i: at (atX, atY) of the image; `depth`: linear, less the instance's base.
  void put(int i, double atX, double atY, float depth, std::uint32_t of, Primitive on)
  {
    assert(i >= 0 && i < TileHits::Most && of != NoInstance);
    x[i] = static_cast<float>(atX - hits.x0);
    y[i] = static_cast<float>(atY - hits.y0);
    t[i] = depth;
    instance[i] = of;
    primitive[i] = on;
    hits.mask |= std::uint64_t(1) << i;
  }
  /// Number i has its attributes from (atX, atY) of the image. To be called for all or none.
  void lookAt(int i, double atX, double atY)
  {
    lookX[i] = static_cast<float>(atX - hits.x0);
    lookY[i] = static_cast<float>(atY - hits.y0);
    hits.lookX = lookX;
    hits.lookY = lookY;
  }
};

/// Calls f(i) for the bits of a mask.
template <class F>
void eachBit(std::uint64_t mask, F&& f)
{
  for (; mask != 0; mask &= mask - 1)
  {
    f(__builtin_ctzll(mask));
  }
}

/// A vector for each pixel of a tile; by components, as loops over pixels take them.
struct PixelVectors
{
  alignas(64) float x[TileHits::Most], y[TileHits::Most], z[TileHits::Most];

  glm::vec3 operator()(int i) const { return { x[i], y[i], z[i] }; }
  void set(int i, const glm::vec3& v)
  {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
};

struct TilePatch
{
  static constexpr int Most = TileHits::Most;
  static constexpr int Step = 16;        // pixels that loops take at once
  static constexpr float Reach = 256.0f; // pixels' widths

  const View* view = nullptr;
  const TileHits* hits = nullptr;
  std::uint32_t instance; // of all
  double base;            // of the depths
  std::uint64_t mask;     // the hits that are of the patch
  std::uint64_t nodes;    // those of them that are on nodes above the bricks
  PointOrigin origin;
  glm::vec3 extent; // PointOrigin::extent() of them

  // By pixel; valid where `mask` is set.
  alignas(64) float deeper[Most];    // than the origin
  PixelVectors way;                  // from the origin, world
  PixelVectors facet, normal, color; // as in SurfacePoint
  bool hasColor;

  /// True if some of the pixels from i on, Step of them, are of the patch.
  bool has(int i) const { return (mask >> i & ((1u << Step) - 1)) != 0; }
  double x(int i) const { return hits->x0 + static_cast<double>(hits->x[i]); }
  double y(int i) const { return hits->y0 + static_cast<double>(hits->y[i]); }
  double t(int i) const { return base + static_cast<double>(hits->t[i]); }
  /// In double.
  glm::dvec3 position(int i) const
  {
    return view->rayOrigin(x(i), y(i)) + t(i) * view->rayDirection(x(i), y(i));
  }
  glm::vec3 towards(int i) const { return glm::vec3(-view->rayDirection(x(i), y(i))); }
  SurfacePoint point(int i) const
  {
    return { this->position(i), facet(i), normal(i), color(i), hasColor };
  }
};

/// The patch of the first hit that is in `left`, with the ways to its points. `base`: of that hit's
/// instance.
VTKSVOTRACING_EXPORT void takePatch(
  const View& view, const TileHits& hits, std::uint64_t left, double base, TilePatch& patch);

/// Calls f(patch) for the patches of those hits whose instance is `wanted(instance)`.
template <class Wanted, class BaseOf, class F>
void eachPatch(
  const View& view, const TileHits& hits, Wanted&& wanted, BaseOf&& baseOf, TilePatch& patch, F&& f)
{
  for (std::uint64_t left = hits.mask; left != 0; left &= ~patch.mask)
  {
    const std::uint32_t instance = hits.instance[__builtin_ctzll(left)];
    takePatch(view, hits, left, baseOf(instance), patch);
    if (wanted(instance))
    {
      f(patch);
    }
  }
}
}

#endif
