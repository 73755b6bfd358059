// The leaf geometry of bricks, one ray a lane: the lanes' triangle lists are gone through side by
// side. The same operations in the same order as nearestPlaneTriangle() and meetTriangles() of
// svoLeafGeometry.h, so that the results are the same bits.
#if defined(SVO_PACKET_LEAF_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SVO_PACKET_LEAF_INL
#undef SVO_PACKET_LEAF_INL
#else
#define SVO_PACKET_LEAF_INL
#endif

#include "svoCounters.h"
#include "svoLaneProducts-inl.h"
#include "svoLaneTriples-inl.h"
#include "svoPacketWalk-inl.h"

// Edges are decided by true fused multiply-adds, which SSE does not have.
#undef SVO_PACKET_LEAVES
#if HWY_TARGET <= HWY_AVX2
#define SVO_PACKET_LEAVES 1

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
HWY_INLINE Vec3 cross(const Vec3& a, const Vec3& b)
{
  return { hn::Sub(hn::Mul(a.y, b.z), hn::Mul(b.y, a.z)),
    hn::Sub(hn::Mul(a.z, b.x), hn::Mul(b.z, a.x)), hn::Sub(hn::Mul(a.x, b.y), hn::Mul(b.x, a.y)) };
}

/// The triangle lists of the lanes' bricks.
struct Lists
{
  I words; // index of the first id, in 32-bit words from the nodes; 0 for a single inline id
  I count; // 0 in lanes that take no part
  I inlineId;
};

HWY_INLINE Lists findLists(const WalkTarget& target, I node, Lanes lanes)
{
  const DI di;
  const DU du;
  const I reference = firstChild(target.words, node);
  const Lanes single = hn::Lt(reference, hn::Zero(di)); // InlineTriangle is the sign
  const I header = hn::IfThenZeroElse(single, hn::Add(reference, hn::Set(di, target.listBegin)));
  const I listed = hn::BitCast(di, gather(du, target.words, hn::IfThenElseZero(lanes, header)));
  const I one = hn::Set(di, 1);
  Lists lists;
  lists.words = hn::IfThenZeroElse(single, hn::Add(header, one));
  lists.count = hn::IfThenElseZero(lanes, hn::IfThenElse(single, one, listed));
  lists.inlineId = hn::And(reference, hn::Set(di, 0x7fffffff));
  return lists;
}

HWY_INLINE int longest(I count)
{
  return hn::GetLane(hn::MaxOfLanes(DI(), count));
}

/// Triangle k of every list that is that long.
HWY_INLINE I triangleId(const WalkTarget& target, const Lists& lists, int k, Lanes lanes)
{
  const DI di;
  const DU du;
  const Lanes single = hn::Eq(lists.words, hn::Zero(di));
  const I index =
    hn::IfThenElseZero(hn::AndNot(single, lanes), hn::Add(lists.words, hn::Set(di, k)));
  const I listed = hn::BitCast(di, gather(du, target.words, index));
  return hn::IfThenElseZero(lanes, hn::IfThenElse(single, lists.inlineId, listed));
}

HWY_INLINE void gatherTriangle(const WalkTarget& target, I id, Vec3& a, Vec3& b, Vec3& c)
{
  const auto corners = loadTriples(DI(), target.triangles, id);
  a = loadTriples(DF(), target.points, corners.x);
  b = loadTriples(DF(), target.points, corners.y);
  c = loadTriples(DF(), target.points, corners.z);
}

/// nearestPlaneTriangle() of svoLeafGeometry.h for the cells at these positions, as places in the
/// lists.
HWY_INLINE I representatives(const WalkTarget& target, I x, I y, I z, const Lists& lists)
{
  const DF df;
  const DI di;
  I best = hn::Zero(di);
  const I count = hn::Min(lists.count, hn::Set(di, static_cast<int>(RepresentativeCandidates)));
  const Vec3 centre{ middleOf(x, target.cellSize), middleOf(y, target.cellSize),
    middleOf(z, target.cellSize) };
  const F half = hn::Set(df, target.touchedHalf);
  const F minusHalf = hn::Set(df, -target.touchedHalf);
  auto bestTouches = hn::RebindMask(df, hn::Ne(best, best));
  F bestDistance = hn::Set(df, std::numeric_limits<float>::max());
  const int steps = longest(count);
  for (int k = 0; k < steps; ++k)
  {
    const Lanes active = hn::Gt(count, hn::Set(di, k));
    const I id = triangleId(target, lists, k, active);
    Vec3 a, b, c;
    gatherTriangle(target, id, a, b, c);
    a = subtract(a, centre);
    b = subtract(b, centre);
    c = subtract(c, centre);
    const Vec3 normal = cross(subtract(b, a), subtract(c, a));
    const F length2 = dot(normal, normal);
    const F height = dot(normal, a);
    const F reach =
      hn::Mul(half, hn::Add(hn::Add(hn::Abs(normal.x), hn::Abs(normal.y)), hn::Abs(normal.z)));
    const auto within = [&](F u, F v, F w)
    {
      return hn::And(
        hn::Le(hn::Min(u, hn::Min(v, w)), half), hn::Ge(hn::Max(u, hn::Max(v, w)), minusHalf));
    };
    const auto touches = hn::And(hn::And(hn::Le(hn::Abs(height), reach), within(a.x, b.x, c.x)),
      hn::And(within(a.y, b.y, c.y), within(a.z, b.z, c.z)));
    const F distance = hn::Div(hn::Mul(height, height), length2);
    const auto nearer =
      hn::And(hn::Lt(distance, bestDistance), hn::Not(hn::Xor(touches, bestTouches)));
    const auto better = hn::Or(hn::AndNot(bestTouches, touches), nearer);
    const auto take =
      hn::And(hn::And(better, hn::Gt(length2, hn::Zero(df))), hn::RebindMask(df, active));
    best = hn::IfThenElse(hn::RebindMask(di, take), hn::Set(di, k), best);
    bestDistance = hn::IfThenElse(take, distance, bestDistance);
    bestTouches = hn::Or(hn::And(take, touches), hn::AndNot(take, bestTouches));
  }
  return best;
}

/// ShearedRay of svoTriangle.h. The axes are chosen lane by lane.
struct Shear
{
  hn::Mask<DF> alongX, alongY, turned;
  F x, y, z;

  HWY_INLINE Vec3 permute(const Vec3& v) const
  {
    const auto choose = [&](F ifX, F ifY, F ifZ)
    { return hn::IfThenElse(this->alongX, ifX, hn::IfThenElse(this->alongY, ifY, ifZ)); };
    const F a = choose(v.y, v.z, v.x);
    const F b = choose(v.z, v.x, v.y);
    return { hn::IfThenElse(this->turned, b, a), hn::IfThenElse(this->turned, a, b),
      choose(v.x, v.y, v.z) };
  }
};

HWY_INLINE Shear makeShear(const Packet& p)
{
  const DF df;
  const F x = hn::Abs(p.dx), y = hn::Abs(p.dy), z = hn::Abs(p.dz);
  Shear shear;
  const auto xOverY = hn::Gt(x, y);
  shear.alongX = hn::And(xOverY, hn::Gt(x, z));
  shear.alongY = hn::AndNot(xOverY, hn::Gt(y, z));
  shear.turned = hn::Lt(hn::Zero(df), hn::Zero(df));
  Vec3 d = shear.permute({ p.dx, p.dy, p.dz });
  shear.turned = hn::Lt(d.z, hn::Zero(df));
  d = shear.permute({ p.dx, p.dy, p.dz });
  shear.x = hn::Div(d.x, d.z);
  shear.y = hn::Div(d.y, d.z);
  shear.z = hn::Div(hn::Set(df, 1.0f), d.z);
  return shear;
}

/// meetTriangles() of svoLeafGeometry.h: lowers p.tMax to the hits.
HWY_INLINE void meetLists(
  const WalkTarget& target, Packet& p, const Lists& lists, Lanes lanes, F& hitT, I& hitId)
{
  const DF df;
  const DI di;
  const F zero = hn::Zero(df);
  const I count = hn::IfThenElseZero(lanes, lists.count);
  const Shear shear = makeShear(p);
  const Vec3 origin{ p.ox, p.oy, p.oz };
  const int steps = longest(count);
  for (int k = 0; k < steps; ++k)
  {
    const Lanes active = hn::Gt(count, hn::Set(di, k));
    SVO_COUNT(TrianglesTested, hn::CountTrue(di, active));
    const I id = triangleId(target, lists, k, active);
    Vec3 a, b, c;
    gatherTriangle(target, id, a, b, c);
    a = shear.permute(subtract(a, origin));
    b = shear.permute(subtract(b, origin));
    c = shear.permute(subtract(c, origin));
    const F ax = hn::Sub(a.x, hn::Mul(shear.x, a.z));
    const F ay = hn::Sub(a.y, hn::Mul(shear.y, a.z));
    const F bx = hn::Sub(b.x, hn::Mul(shear.x, b.z));
    const F by = hn::Sub(b.y, hn::Mul(shear.y, b.z));
    const F cx = hn::Sub(c.x, hn::Mul(shear.x, c.z));
    const F cy = hn::Sub(c.y, hn::Mul(shear.y, c.z));
    const F u = differenceOfProducts(cx, by, cy, bx);
    const F v = differenceOfProducts(ax, cy, ay, cx);
    const F w = differenceOfProducts(bx, ay, by, ax);
    const auto negative = hn::Or(hn::Or(hn::Lt(u, zero), hn::Lt(v, zero)), hn::Lt(w, zero));
    const auto positive = hn::Or(hn::Or(hn::Gt(u, zero), hn::Gt(v, zero)), hn::Gt(w, zero));
    const F determinant = hn::Add(hn::Add(u, v), w);
    const F height = hn::Add(hn::Add(hn::Mul(u, a.z), hn::Mul(v, b.z)), hn::Mul(w, c.z));
    const F t = hn::Div(hn::Mul(height, shear.z), determinant);
    const auto inside = hn::AndNot(hn::And(negative, positive), hn::Ne(determinant, zero));
    const auto within = hn::And(hn::Ge(t, p.tMin), hn::Le(t, p.tMax));
    // Of equal depths the larger id wins; NoPrimitive is -1.
    const auto first = hn::Or(hn::RebindMask(df, hn::Gt(id, hitId)), hn::Lt(t, hitT));
    const auto take = hn::And(hn::And(inside, within), hn::And(first, hn::RebindMask(df, active)));
    hitT = hn::IfThenElse(take, t, hitT);
    hitId = hn::IfThenElse(hn::RebindMask(di, take), id, hitId);
    p.tMax = hn::IfThenElse(take, t, p.tMax);
  }
}
}
}
HWY_AFTER_NAMESPACE();
#else
#define SVO_PACKET_LEAVES 0
#endif

#endif
