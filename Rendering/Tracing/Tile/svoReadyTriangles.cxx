// Makes triangles ready for a group of tiles, many at a time.
//
// Corners are projected onto pixels; then edges and depth are linear in the pixel. Floats are
// enough, since what they leave open is known:
//
// What float rays hit (svoIntersectTile.h) is what counts, and rays and pixels are computed
// differently. Whatever either is off by can be put down to corners that are not where they should
// be. Ray and corner as the test computes them differ from the true ones by the same vectors that a
// corner a little aside would bring about (svoPixelFunctions.h says how far); from there on its
// signs are exact. The pixel of a corner is off by the roundings of its projection, and as if by
// those of the edge functions, which are relative to how far away corners are. Together these are a
// corner's `shift`, of the order of 1e-3 pixels. Shifting both ends of an edge by so much changes
// its function, at a point of the box around the triangle, by no more than
//
//   doubt = 2 shift (width + height of the box + 4 shift).
//
// So edge functions are divided by that: beyond 1 and -1 the test agrees. Likewise, weights of the
// corners are off by 2.5 of `share`, the sum of the three edges' doubts in parts of the area;
// depths by 3 share of the triangle's own range, and by what its corners' depths are off.
//
// A triangle of less area than four times its doubts may as well be wound the other way round. A
// ray can miss it for certain only where edges disagree with either winding.
//
// Triangles of a few pixels are looked at at once. Others become slots, which the tiles draw
// (svoNearestTriangles.cxx).
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoReadyTriangles.cxx"
#include <hwy/foreach_target.h>

#include "svoLaneMoves-inl.h"
#include "svoLaneTriples-inl.h"
#include "svoTriangleGroup.h"

#include <algorithm>
#include <limits>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
HWY_INLINE F linear(const glm::vec4& f, F x, F y, F z)
{
  const DF d;
  return hn::MulAdd(hn::Set(d, f.x), x,
    hn::MulAdd(hn::Set(d, f.y), y, hn::MulAdd(hn::Set(d, f.z), z, hn::Set(d, f.w))));
}

HWY_INLINE F least(F a, F b, F c)
{
  return hn::Min(hn::Min(a, b), c);
}

HWY_INLINE F most(F a, F b, F c)
{
  return hn::Max(hn::Max(a, b), c);
}

/// Corners of some triangles. Where gathers would do they are written here number by number, which
/// is faster.
struct ReadCorners
{
  static constexpr std::size_t Most = 64; // a multiple of the lanes

  HWY_ALIGN float x[3][Most], y[3][Most], z[3][Most];

  HWY_INLINE void read(const Surface& surface, const std::uint32_t* ids, std::size_t count)
  {
#if SVO_TRANSPOSES_TRIPLES
    const DF df;
    const DI di;
    const auto* triangles = reinterpret_cast<const std::int32_t*>(&surface.triangles[0].x);
    for (std::size_t i = 0; i < count; i += hn::Lanes(df))
    {
      const auto id = hn::LoadU(di, reinterpret_cast<const std::int32_t*>(ids) + i);
      const auto corners = loadTriples(di, triangles, id);
      const I points[3] = { corners.x, corners.y, corners.z };
      for (int corner = 0; corner < 3; ++corner)
      {
        const auto point = loadTriples(df, &surface.points[0].x, points[corner]);
        hn::Store(point.x, df, this->x[corner] + i);
        hn::Store(point.y, df, this->y[corner] + i);
        hn::Store(point.z, df, this->z[corner] + i);
      }
    }
#else
    for (std::size_t i = 0; i < count; ++i)
    {
      const glm::uvec3& triangle = surface.triangles[ids[i]];
      for (int corner = 0; corner < 3; ++corner)
      {
        const glm::vec3& point = surface.points[triangle[corner]];
        this->x[corner][i] = point.x;
        this->y[corner][i] = point.y;
        this->z[corner][i] = point.z;
      }
    }
#endif
  }
};

/// One corner of as many triangles as there are lanes.
struct ProjectedCorners
{
  F x, y, w; // times w
  F k;

  HWY_INLINE ProjectedCorners(
    const GroupView& view, const ReadCorners& read, int corner, std::size_t first)
  {
    const DF df;
    const F one = hn::Set(df, 1.0f);
    const F vx = hn::Sub(hn::Load(df, read.x[corner] + first), one);
    const F vy = hn::Sub(hn::Load(df, read.y[corner] + first), one);
    const F vz = hn::Sub(hn::Load(df, read.z[corner] + first), one);
    x = linear(view.x, vx, vy, vz);
    y = linear(view.y, vx, vy, vz);
    w = linear(view.w, vx, vy, vz);
    k = linear(view.k, vx, vy, vz);
  }
};

/// Of triangles that are not known well enough to be made ready: true where all of one lies beside
/// the group, or before the rays begin.
HWY_INLINE hn::Mask<DF> beside(const GroupView& view, const ProjectedCorners& a,
  const ProjectedCorners& b, const ProjectedCorners& c)
{
  // A side of the group, and a pixel more, is linear in the corners as long as w is not divided by.
  const DF df;
  const F side = hn::Set(df, 0.5f * GroupView::Pixels + 1.0f);
  const F error = hn::Set(df, view.error + (0.5f * GroupView::Pixels + 1.0f) * view.errorFar);
  const auto beyond = [&](F p, F q, F r) { return hn::Gt(least(p, q, r), error); };
  const F aw = hn::Mul(side, a.w), bw = hn::Mul(side, b.w), cw = hn::Mul(side, c.w);
  auto out = hn::Lt(most(a.w, b.w, c.w), hn::Set(df, view.beforeRays));
  out = hn::Or(out, beyond(hn::Sub(a.x, aw), hn::Sub(b.x, bw), hn::Sub(c.x, cw)));
  out = hn::Or(out, beyond(hn::Sub(a.y, aw), hn::Sub(b.y, bw), hn::Sub(c.y, cw)));
  const auto other = [](F v, F w) { return hn::Neg(hn::Add(v, w)); };
  out = hn::Or(out, beyond(other(a.x, aw), other(b.x, bw), other(c.x, cw)));
  return hn::Or(out, beyond(other(a.y, aw), other(b.y, bw), other(c.y, cw)));
}

/// One bit for each of 4x4 tiles: those of columns and rows of pixels.
HWY_INLINE I tilesOf(I x0, I x1, I y0, I y1)
{
  const DI d;
  const I one = hn::Set(d, 1), two = hn::Set(d, 2);
  const auto range = [&](I first, I last) {
    return hn::Sub(hn::Shl(two, hn::ShiftRight<3>(last)), hn::Shl(one, hn::ShiftRight<3>(first)));
  };
  const I columns = range(x0, x1);
  const I rows = range(y0, y1);
  // Bit r of rows becomes bit 4 r.
  const I spread = hn::And(hn::Set(d, 0x1111),
    hn::Or(hn::Or(rows, hn::ShiftLeft<3>(rows)),
      hn::Or(hn::ShiftLeft<6>(rows), hn::ShiftLeft<9>(rows))));
  return hn::Mul(columns, spread);
}

/// Triangles that are made ready for a group; pixels are counted from its middle.
struct ReadyLanes
{
  using M = hn::Mask<DF>;

  F px0, px1, py0, py1; // the pixels that they may cover, from its lower left
  F x[3], y[3];         // a point of each edge
  F nx[3], ny[3];       // what it grows by
  F kx, ky, k;          // the key, at the first point
  F slack, kNear, kFar;
  M thin, unsure, clipped, steep;
};

/// Columns, and rows, of pixels in the box around what is a small triangle. With 4 ordinary meshes
/// take 3 % longer, with 2 meshes of triangles smaller than pixels 5 %.
constexpr float SmallPixels = 3.0f;

/// What may be met of the triangles of `mask`, whose boxes are that small: looked at at each pixel
/// of the box, a triangle a lane. Their functions are computed from a corner on, which is no
/// further away than the box is wide: that rounds less than what is allowed for.
HWY_INLINE void drawSmall(const ReadyLanes& t, ReadyLanes::M mask, I triangle, SeenPoints& points)
{
  const DF df;
  const DI di;
  const F one = hn::Set(df, 1.0f), none = hn::Set(df, -1.0f);
  const F infinity = hn::Set(df, std::numeric_limits<float>::infinity());
  const F middle = hn::Set(df, 0.5f * (GroupView::Pixels - 1));
  const F x0 = hn::Sub(t.px0, middle), y0 = hn::Sub(t.py0, middle);
  const F width = hn::Sub(t.px1, t.px0), height = hn::Sub(t.py1, t.py0);
  F edge[3];
  for (int e = 0; e < 3; ++e)
  {
    edge[e] = hn::MulAdd(t.nx[e], hn::Sub(x0, t.x[e]), hn::Mul(t.ny[e], hn::Sub(y0, t.y[e])));
  }
  const F first = hn::MulAdd(t.kx, hn::Sub(x0, t.x[0]), hn::MulAdd(t.ky, hn::Sub(y0, t.y[0]), t.k));
  const auto named = hn::Or(triangle,
    hn::IfThenElseZero(
      hn::RebindMask(di, t.steep), hn::Set(di, static_cast<std::int32_t>(SeenPoints::Steep))));
  const auto never = hn::Or(t.thin, t.unsure);
  const bool anyClipped = !hn::AllFalse(df, hn::And(mask, t.clipped));
  const bool anyThin = !hn::AllFalse(df, hn::And(mask, t.thin));
  const auto most = [&](F v)
  { return hn::GetLane(hn::MaxOfLanes(df, hn::IfThenElseZero(mask, v))); };
  const float columns = most(width), rows = most(height);
  points.makeRoom(points.count +
    static_cast<std::size_t>((columns + 1.0f) * (rows + 1.0f) + 1.0f) * hn::Lanes(df));
  for (float r = 0.0f; r <= rows; r += 1.0f)
  {
    const F row = hn::Set(df, r);
    const auto inRow = hn::And(mask, hn::Le(row, height));
    for (float c = 0.0f; c <= columns; c += 1.0f)
    {
      const F column = hn::Set(df, c);
      const auto at = [&](F nx, F ny, F begin)
      { return hn::MulAdd(nx, column, hn::MulAdd(ny, row, begin)); };
      const F e0 = at(t.nx[0], t.ny[0], edge[0]);
      const F e1 = at(t.nx[1], t.ny[1], edge[1]);
      const F e2 = at(t.nx[2], t.ny[2], edge[2]);
      const F inside = hn::Min(hn::Min(e0, e1), e2);
      auto maybe = hn::Ge(inside, none);
      if (anyThin)
      {
        const F outside = hn::Max(hn::Max(e0, e1), e2);
        maybe = hn::Or(maybe, hn::And(t.thin, hn::Le(outside, one)));
      }
      maybe = hn::And(maybe, hn::And(inRow, hn::Le(column, width)));
      if (hn::AllFalse(df, maybe))
      {
        continue;
      }
      auto surely = hn::AndNot(never, hn::Gt(inside, one));
      const F key = at(t.kx, t.ky, first);
      const F low = hn::Sub(key, t.slack), high = hn::Add(key, t.slack);
      if (anyClipped)
      {
        const auto in = hn::And(hn::Ge(high, t.kNear), hn::Le(low, t.kFar));
        const auto all = hn::And(hn::Ge(low, t.kNear), hn::Le(high, t.kFar));
        maybe = hn::And(maybe, hn::Or(hn::Not(t.clipped), hn::Or(t.thin, in)));
        surely = hn::And(surely, hn::Or(hn::Not(t.clipped), all));
      }
      const auto pixel = hn::ConvertTo(di,
        hn::MulAdd(hn::Set(df, static_cast<float>(GroupView::Pixels)), hn::Add(t.py0, row),
          hn::Add(t.px0, column)));
      const LaneCompressor pack(maybe);
      pack.store(pixel, points.pixel.data() + points.count);
      pack.store(low, points.low.data() + points.count);
      pack.store(hn::IfThenElse(surely, high, infinity), points.high.data() + points.count);
      pack.store(named, points.triangle.data() + points.count);
      points.count += pack.size();
    }
  }
}

/// Triangles of a group of which each is drawn on its own.
HWY_INLINE void storeSlots(const ReadyLanes& t, hn::Mask<DF> mask, I triangle, std::uint32_t owner,
  TriangleGroup::Slots& slots)
{
  const DI di;
  const LaneCompressor pack(mask);
  const auto store = [&](F v, std::vector<float>& array)
  { pack.store(v, array.data() + slots.count); };
  for (int e = 0; e < 3; ++e)
  {
    store(t.nx[e], slots.ex[e]);
    store(t.ny[e], slots.ey[e]);
    store(hn::Neg(hn::MulAdd(t.nx[e], t.x[e], hn::Mul(t.ny[e], t.y[e]))), slots.ec[e]);
  }
  store(t.kx, slots.kx);
  store(t.ky, slots.ky);
  store(hn::Sub(t.k, hn::MulAdd(t.kx, t.x[0], hn::Mul(t.ky, t.y[0]))), slots.kc);
  store(t.slack, slots.slack);
  store(t.kNear, slots.kNear);
  store(t.kFar, slots.kFar);
  const auto flag = [&](hn::Mask<DF> lanes, std::int32_t value)
  { return hn::IfThenElseZero(hn::RebindMask(di, lanes), hn::Set(di, value)); };
  const I flags =
    hn::Or(hn::Or(flag(t.thin, TriangleGroup::Thin), flag(t.clipped, TriangleGroup::Clipped)),
      hn::Or(flag(t.unsure, TriangleGroup::Unsure), flag(t.steep, TriangleGroup::Steep)));
  const auto storeI = [&](I v, auto& array)
  { pack.store(v, reinterpret_cast<std::int32_t*>(array.data()) + slots.count); };
  const I ix0 = hn::ConvertTo(di, t.px0), ix1 = hn::ConvertTo(di, t.px1);
  const I iy0 = hn::ConvertTo(di, t.py0), iy1 = hn::ConvertTo(di, t.py1);
  storeI(ix0, slots.x0);
  storeI(ix1, slots.x1);
  storeI(iy0, slots.y0);
  storeI(iy1, slots.y1);
  storeI(tilesOf(ix0, ix1, iy0, iy1), slots.tiles);
  storeI(flags, slots.flags);
  storeI(triangle, slots.id);
  storeI(hn::Set(di, static_cast<std::int32_t>(owner)), slots.owner);
  slots.count += pack.size();
}

/// But for triangles that slots.crossing names then.
void makeReady(const Surface& surface, const std::uint32_t* ids, std::size_t count,
  const GroupView& view, std::uint32_t owner, TriangleGroup::Slots& slots, SeenPoints* points)
{
  const DF df;
  const DI di;
  const F zero = hn::Zero(df), one = hn::Set(df, 1.0f);
  constexpr float Rounding = 1.0f / (1 << 24);
  constexpr float FarthestCorner = 65536.0f; // pixels
  ReadCorners corners;
  slots.makeRoom(slots.count + count + hn::Lanes(df));
  slots.crossingCount = 0;
  for (std::size_t first = 0; first < count; first += hn::Lanes(df))
  {
    const std::size_t left = count - first;
    if (first % ReadCorners::Most == 0)
    {
      // Behind the last id there are zeros.
      corners.read(surface, ids + first,
        std::min(ReadCorners::Most, (left + hn::Lanes(df) - 1) / hn::Lanes(df) * hn::Lanes(df)));
    }
    const auto mine = left >= hn::Lanes(df) ? hn::Eq(zero, zero) : hn::FirstN(df, left);
    const I triangle = hn::LoadU(di, reinterpret_cast<const std::int32_t*>(ids) + first);
    const ProjectedCorners a(view, corners, 0, first % ReadCorners::Most);
    const ProjectedCorners b(view, corners, 1, first % ReadCorners::Most);
    const ProjectedCorners c(view, corners, 2, first % ReadCorners::Most);

    // Pixels.
    const auto seen = hn::Ge(least(a.w, b.w, c.w), hn::Set(df, view.leastW));
    const F ai = hn::Div(one, a.w), bi = hn::Div(one, b.w), ci = hn::Div(one, c.w);
    const F ax = hn::Mul(a.x, ai), ay = hn::Mul(a.y, ai);
    const F bx = hn::Mul(b.x, bi), by = hn::Mul(b.y, bi);
    const F cx = hn::Mul(c.x, ci), cy = hn::Mul(c.y, ci);
    const F x0 = least(ax, bx, cx), x1 = most(ax, bx, cx);
    const F y0 = least(ay, by, cy), y1 = most(ay, by, cy);
    const F far = most(
      hn::Max(hn::Neg(x0), x1), hn::Max(hn::Neg(y0), y1), hn::Set(df, 0.5f * GroupView::Pixels));
    const auto known = hn::And(seen, hn::Le(far, hn::Set(df, FarthestCorner)));
    const auto unknown = hn::AndNot(known, mine);
    if (!hn::AllFalse(df, unknown))
    {
      const auto crossing = hn::AndNot(beside(view, a, b, c), unknown);
      const LaneCompressor pack(crossing);
      pack.store(triangle, slots.crossing.data() + slots.crossingCount);
      slots.crossingCount += pack.size();
    }
    const F nearest = most(ai, bi, ci);
    const F shift =
      hn::MulAdd(nearest, hn::MulAdd(far, hn::Set(df, view.errorFar), hn::Set(df, view.error)),
        hn::Mul(far, hn::Set(df, view.rounding)));

    // The pixels whose centres lie in the box around it.
    const F middle = hn::Set(df, 0.5f * (GroupView::Pixels - 1));
    const F end = hn::Set(df, static_cast<float>(GroupView::Pixels));
    const auto firstOf = [&](F v)
    { return hn::Min(hn::Max(hn::Ceil(hn::Add(hn::Sub(v, shift), middle)), zero), end); };
    const auto lastOf = [&](F v)
    {
      return hn::Max(
        hn::Min(hn::Floor(hn::Add(hn::Add(v, shift), middle)), hn::Sub(end, one)), hn::Neg(one));
    };
    const F px0 = firstOf(x0), px1 = lastOf(x1), py0 = firstOf(y0), py1 = lastOf(y1);
    const auto kept = hn::And(hn::And(mine, known), hn::And(hn::Le(px0, px1), hn::Le(py0, py1)));
    if (hn::AllFalse(df, kept))
    {
      continue;
    }

    // Edges, each across from a corner.
    ReadyLanes ready;
    const F aex = hn::Sub(by, cy), aey = hn::Sub(cx, bx);
    const F bex = hn::Sub(cy, ay), bey = hn::Sub(ax, cx);
    const F cex = hn::Sub(ay, by), cey = hn::Sub(bx, ax);
    const F area = hn::MulAdd(cex, hn::Sub(cx, ax), hn::Mul(cey, hn::Sub(cy, ay)));
    const F box = hn::Add(hn::Sub(x1, x0), hn::Sub(y1, y0));
    const F doubt = hn::Mul(hn::Add(shift, shift), hn::MulAdd(hn::Set(df, 4.0f), shift, box));
    const auto thin =
      hn::Not(hn::Gt(hn::Abs(area), hn::Mul(hn::Set(df, 12.0f), doubt))); // or not a number
    const F toDoubt = hn::Div(hn::CopySign(one, area), doubt);
    const auto setEdge = [&](int e, F ex, F ey, F x, F y)
    {
      ready.nx[e] = hn::Mul(ex, toDoubt);
      ready.ny[e] = hn::Mul(ey, toDoubt);
      ready.x[e] = x;
      ready.y[e] = y;
    };
    setEdge(0, cex, cey, ax, ay);
    setEdge(1, aex, aey, bx, by);
    setEdge(2, bex, bey, cx, cy);

    // Depth.
    const F scale = hn::Set(df, view.scale);
    const F ak = hn::Mul(a.k, hn::Mul(scale, ai));
    const F bk = hn::Mul(b.k, hn::Mul(scale, bi));
    const F ck = hn::Mul(c.k, hn::Mul(scale, ci));
    const F k0 = least(ak, bk, ck), k1 = most(ak, bk, ck);
    const F perArea = hn::Div(one, area);
    const F share = hn::Mul(hn::Set(df, 3.0f), hn::Abs(hn::Mul(doubt, perArea)));
    const F toKey = hn::Mul(scale, nearest); // of a depth; squared: of a change of depth
    const F largest = most(hn::Abs(a.k), hn::Abs(b.k), hn::Abs(c.k));
    const F ofCorners = hn::Mul(toKey,
      hn::MulAdd(
        toKey, hn::Set(df, view.depthError), hn::Mul(hn::Set(df, 4.0f * Rounding), largest)));
    const F three = hn::Set(df, 3.0f);
    const F weights = hn::Mul(three, share);
    const F ofHits = hn::IfThenElse(thin, ofCorners,
      hn::MulAdd(
        weights, hn::Sub(k1, k0), hn::MulAdd(hn::Add(weights, weights), ofCorners, ofCorners)));
    const F slack = hn::MulAdd(hn::Mul(toKey, toKey), hn::Set(df, view.apart), ofHits);
    const F ab = hn::Mul(hn::Sub(bk, ak), perArea), ac = hn::Mul(hn::Sub(ck, ak), perArea);
    ready.kx = hn::IfThenZeroElse(thin, hn::MulAdd(bex, ab, hn::Mul(cex, ac)));
    ready.ky = hn::IfThenZeroElse(thin, hn::MulAdd(bey, ab, hn::Mul(cey, ac)));
    ready.k = hn::IfThenElse(thin, k0, ak);
    ready.slack = slack;
    ready.kNear = hn::Set(df, view.kNear);
    ready.kFar = hn::Set(df, view.kFar);

    // What else there is to know. Errors of keys are larger ones of depths where it is deeper: hits
    // lie in the box of pixels, over which 1 / w is as linear, and as well known, as the key.
    const F wb = hn::Mul(hn::Sub(bi, ai), perArea), wc = hn::Mul(hn::Sub(ci, ai), perArea);
    const F wx = hn::MulAdd(bex, wb, hn::Mul(cex, wc));
    const F wy = hn::MulAdd(bey, wb, hn::Mul(cey, wc));
    const auto leastOver = [&](F slope, F low, F high, F from)
    {
      const F offset = hn::Add(middle, from);
      return hn::Min(hn::Mul(slope, hn::Sub(low, offset)), hn::Mul(slope, hn::Sub(high, offset)));
    };
    const F farthestCorner = least(ai, bi, ci);
    const F atLeast =
      hn::Sub(hn::Add(ai, hn::Add(leastOver(wx, px0, px1, ax), leastOver(wy, py0, py1, ay))),
        hn::MulAdd(weights, hn::Sub(nearest, farthestCorner),
          hn::Mul(hn::Set(df, 8.0f * Rounding), nearest)));
    const F farthest =
      hn::Mul(scale, hn::IfThenElse(thin, farthestCorner, hn::Max(farthestCorner, atLeast)));
    const F depthSlack = hn::Div(ofHits, hn::Mul(farthest, farthest));
    ready.thin = thin;
    ready.clipped =
      hn::Or(hn::Lt(hn::Sub(k0, slack), ready.kNear), hn::Gt(hn::Add(k1, slack), ready.kFar));
    ready.unsure = hn::Not(hn::Le(depthSlack, hn::Set(df, view.reach)));
    ready.steep = hn::Not(hn::Le(depthSlack, hn::Set(df, view.nearReach)));
    ready.px0 = px0;
    ready.px1 = px1;
    ready.py0 = py0;
    ready.py1 = py1;
    auto large = kept;
    if (points)
    {
      const F few = hn::Set(df, SmallPixels - 1.0f);
      const auto small =
        hn::And(kept, hn::And(hn::Le(hn::Sub(px1, px0), few), hn::Le(hn::Sub(py1, py0), few)));
      if (!hn::AllFalse(df, small))
      {
        drawSmall(ready, small, triangle, *points);
      }
      large = hn::AndNot(small, kept);
    }
    if (!hn::AllFalse(df, large))
    {
      storeSlots(ready, large, triangle, owner, slots);
    }
  }
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(makeReady);

void TriangleGroup::project(const Surface& surface, const std::uint32_t* ids, std::size_t count,
  const GroupView& view, std::uint32_t owner, Slots& slots, SeenPoints* points)
{
  HWY_DYNAMIC_DISPATCH(makeReady)(surface, ids, count, view, owner, slots, points);
}
}
#endif
