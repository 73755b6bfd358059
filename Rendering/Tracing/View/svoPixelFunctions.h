// Pixels and depth as linear functions of octree coordinates, taken from the rays themselves; and
// how far from them the float rays' hits can be.
#ifndef svoPixelFunctions_h
#define svoPixelFunctions_h

#include "svoGroupView.h"
#include "svoLocalView.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

namespace svo
{
/// The depths of a view, on which keys (GroupView::k) are based: so that those of all its instances
/// can be compared.
///
/// Linear in the pixel are depths of parallel rays, and 1 / w of others. Keys of the latter are
/// (w - far) far / w: of the size of what lies between w and the far end. Where depths differ a lot
/// that would have no digits left for what is near; then keys are -far far / w.
struct KeyBase
{
  double far = 1.0;  // of w; of the depth where rays are parallel
  bool deep = false; // depths differ a lot

  /// Of w or, where rays are parallel, of a depth.
  double key(double at, bool parallel) const
  {
    return parallel ? at - this->far : (this->deep ? -this->far : at - this->far) * this->far / at;
  }
};

/// A point of the cube, at depth base + t, is seen at the pixel (x / w, y / w).
struct PixelFunctions
{
  glm::dvec4 x, y, w, t;    // of octree coordinates minus 1
  glm::dvec3 errors{ 0.0 }; // of x, y and t
  double base = 0.0;        // of depths
  double wBase = 1.0;       // w where t is 0
  double beside = 0.0;      // octree coordinates that rays lie beside those of x, y, and w
  bool parallel = false;
  bool valid = false; // else nothing else is

  PixelFunctions() = default;
  PixelFunctions(const LocalView& local, const View& view)
    : base(local.base)
    , parallel(view.parallel)
  {
    const glm::dvec3& columnX = parallel ? local.originX : local.directionX;
    const glm::dvec3& columnY = parallel ? local.originY : local.directionY;
    if (!parallel)
    {
      // Rays come from one point: what starts on the plane of t = 0 spreads like the directions.
      this->wBase = glm::dot(local.originX, columnX) / glm::dot(columnX, columnX);
      this->beside = view.width * largestOf(local.originX - this->wBase * columnX) +
        view.height * largestOf(local.originY - this->wBase * columnY);
    }
    const glm::dmat3 toLocal(columnX, columnY, local.direction);
    const glm::dmat3 inverse = glm::inverse(toLocal);
    const glm::dmat3 rows = glm::transpose(inverse);
    const glm::dvec3 corner = 1.0 - local.origin;
    const auto row = [&](int r) { return glm::dvec4(rows[r], glm::dot(rows[r], corner)); };
    this->x = row(0);
    this->y = row(1);
    this->t = row(2);
    // What the inverse is off by, as far as it changes points of the cube.
    const auto size = [](const glm::dvec4& f)
    { return std::abs(f.x) + std::abs(f.y) + std::abs(f.z) + std::abs(f.w); };
    const glm::dvec3 sizes(size(this->x), size(this->y), size(this->t));
    for (int r = 0; r < 3; ++r)
    {
      for (int c = 0; c < 3; ++c)
      {
        const double noise = 0x1p-50 * glm::dot(glm::abs(rows[r]), glm::abs(toLocal[c]));
        const double off = std::abs(glm::dot(rows[r], toLocal[c]) - (r == c ? 1.0 : 0.0));
        this->errors[r] += 4.0 * (off + noise) * sizes[c];
      }
    }
    this->w =
      parallel ? glm::dvec4(0.0, 0.0, 0.0, 1.0) : this->t + glm::dvec4(0.0, 0.0, 0.0, this->wBase);
    this->valid = this->wBase > 0.0 && std::isfinite(this->beside) &&
      std::isfinite(this->errors.x + this->errors.y + this->errors.z);
  }

  /// Of depth base + t.
  double key(double depth, const KeyBase& keys) const
  {
    return keys.key(depth + (this->parallel ? this->base : this->wBase), this->parallel);
  }
};

/// Where a hit's depth counts on its own, and where it is moved (svoPlaceOnTriangles.h).
struct HitLimits
{
  double error = 0.0; // hits no further apart than their errors are not told apart by depth
  double nearReach = 1e30, reach = 1e30; // of GroupView
};

/// How the group whose lower left tile is (tileX, tileY) sees the cube.
///
/// A float ray and what svoIntersectTile.h makes of it are off like this. u is 2^-24, all numbers
/// are largest absolute values: m of where rays start, a of a corner minus that, s of the shear.
/// Before it is sheared a coordinate of a corner minus the start is off by u m, from rounding the
/// start, and by u a. The shear, a quotient of two rounded numbers, is off by 3 u s, and 0.01 u
/// where it was negligible and is cleared. The product of a coordinate and the shear is rounded as
/// well. So the sheared coordinate, from which that is subtracted, is off by
///
///   aside = u (m + a) + s u (m + a) + (3 s + 0.01) u a + s u a
///
/// and by its own rounding, which is relative to how far the corner lies beside the ray; so are
/// those of the products of such coordinates by which the weights of the corners are found
/// (GroupView::rounding).
///
/// As if the corner were so far aside, across the axis along which the ray is longest, the test
/// decides exactly who is hit. t, a weighted mean of the corners' distances along that axis over
/// the ray's direction, is off by u (m + 9 a) times what t changes along the axis, and by as much
/// as corners aside lie deeper.
inline GroupView makeGroupView(const LocalView& local, const PixelFunctions& functions,
  const KeyBase& keys, const HitLimits& limits, int tileX, int tileY)
{
  assert(functions.valid);
  constexpr double u = 0x1p-24;
  constexpr double half = 0.5 * GroupView::Pixels;
  const double x = 8.0 * tileX + half, y = 8.0 * tileY + half; // the middle
  const auto gradient = [](const glm::dvec4& f)
  { return std::abs(f.x) + std::abs(f.y) + std::abs(f.z); };
  // A linear function in float: coefficients, products and sums are rounded.
  const auto roundings = [&](const glm::dvec4& f)
  { return 6.0 * u * (gradient(f) + std::abs(f.w)); };

  double m = 0.0, a = 0.0, s = 0.0;
  int axis = 0;
  for (int corner = 0; corner < 4; ++corner)
  {
    const double cx = x + (corner & 1 ? half : -half), cy = y + (corner & 2 ? half : -half);
    const glm::dvec3 start = local.originAt(cx, cy);
    m = std::max(m, largestOf(start));
    a = std::max({ a, largestOf(start - 1.0), largestOf(start - 2.0) });
    // Quotients of linear functions are largest at corners, unless the divisor may be 0 in between.
    const glm::dvec3 d = local.directionAt(cx, cy);
    const glm::dvec3 size = glm::abs(d);
    const int longest = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    const int along = 2 * longest + (d[longest] < 0.0);
    const double second = std::max(size[(longest + 1) % 3], size[(longest + 2) % 3]);
    s = corner > 0 && along != axis ? 1.0 : std::max(s, second / size[longest]);
    axis = along;
  }
  const double aside = u * ((1.0 + s) * (m + a) + (4.0 * s + 0.01) * a) + 2.0 * functions.beside;

  GroupView view;
  const glm::dvec4 gx = functions.x - x * functions.w, gy = functions.y - y * functions.w;
  glm::dvec4 k(0.0, 0.0, 0.0, -keys.far);
  if (!keys.deep)
  {
    k = functions.t +
      glm::dvec4(0.0, 0.0, 0.0, (functions.parallel ? functions.base : functions.wBase) - keys.far);
  }
  view.x = gx;
  view.y = gy;
  view.w = functions.w;
  view.k = k;
  // Of t itself, which is the functions' own but for its float.
  view.kOfT[0] = keys.deep ? 0.0f : 1.0f;
  view.kOfT[1] = static_cast<float>(k.w - (keys.deep ? 0.0 : functions.t.w));
  view.wOfT[0] = functions.parallel ? 0.0f : 1.0f;
  view.wOfT[1] = functions.parallel ? 1.0f : static_cast<float>(functions.wBase);
  view.scale = functions.parallel ? 1.0f : static_cast<float>(keys.far);
  // w is off by up to a 16th of itself.
  constexpr double OverW = 16.0 / 15.0;
  const double errorW = functions.parallel ? 0.0 : roundings(functions.w) + functions.errors.z;
  const double farther = functions.parallel ? 0.0 : functions.errors.z;
  view.error = roundUp(OverW *
    (std::max(roundings(gx) + functions.errors.x + std::abs(x) * farther,
       roundings(gy) + functions.errors.y + std::abs(y) * farther) +
      aside * std::max(gradient(gx), gradient(gy))));
  view.errorFar = roundUp(OverW * (errorW + aside * gradient(functions.w)));
  // Roundings that are relative to a distance in octree coordinates are so in pixels, but for how
  // skewed pixels are there: at most 4 of a distance that is at most twice that from the middle. Of
  // the edge functions' own there are 16.
  const double pixel = functions.parallel
    ? largestOf(local.originX) + largestOf(local.originY)
    : largestOf(local.directionX) + largestOf(local.directionY);
  const double skew =
    2.0 * pixel * (std::max(gradient(gx), gradient(gy)) + half * gradient(functions.w));
  view.rounding = roundUp(u * (16.0 + 8.0 * skew));
  const double hits = (aside + u * (m + 9.0 * a)) * gradient(functions.t) + functions.errors.z;
  view.depthError = roundUp(OverW * (roundings(k) + errorW + hits));
  view.apart = roundUp(OverW * (limits.error + 2.0 * u * local.tMax));
  view.leastW = functions.parallel ? 0.5f : roundUp(16.0 * errorW);
  view.beforeRays =
    functions.parallel ? 0.0f : -roundUp(-(functions.wBase - 2.0 * (errorW + hits)));
  view.farW = functions.parallel ? 1.0f : roundUp(functions.wBase + local.tMax);
  view.kNear = static_cast<float>(functions.key(0.0, keys));
  view.kFar = static_cast<float>(functions.key(local.tMax, keys));
  // A float hit that lies further before its node than placing would move it is none:
  // svoIntersectTile.h leaves such hits out as well. k and w are off by a few roundings of their
  // sums, and depths of hits count as equal where they are no further apart than `apart`.
  view.behind = roundUp(1e-3 * local.tMax + view.apart +
    32.0 * u * (local.tMax + std::abs(view.kOfT[1]) + std::abs(view.wOfT[1])));
  view.nearReach = static_cast<float>(limits.nearReach);
  view.reach = static_cast<float>(limits.reach);
  return view;
}
}

#endif
