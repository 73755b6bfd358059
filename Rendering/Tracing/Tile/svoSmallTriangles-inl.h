// Triangles of a few pixels, a triangle a lane: looked at at each pixel of the box around them.
// The bounds are those of svoReadyTriangles.cxx. Their functions are computed from a corner on,
// which is no further away than the box is wide: that rounds less than what is allowed for.
#if defined(SVO_SMALL_TRIANGLES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SVO_SMALL_TRIANGLES_INL
#undef SVO_SMALL_TRIANGLES_INL
#else
#define SVO_SMALL_TRIANGLES_INL
#endif

#include "svoGroupPixels.h"
#include "svoLaneMoves-inl.h"

#include <limits>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
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

/// What may be met of the triangles of `mask`, whose boxes are that small.
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
}
}
HWY_AFTER_NAMESPACE();

#endif
