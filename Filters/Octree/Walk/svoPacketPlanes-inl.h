// Planes that cells have of their own, one ray a lane: the mean planes of nodes where rays stop
// above the bricks, and the planes of voxels. The same operations in the same order as meetPlane()
// of svoLeafGeometry.h, so that the results are the same bits.
#if defined(SVO_PACKET_PLANES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SVO_PACKET_PLANES_INL
#undef SVO_PACKET_PLANES_INL
#else
#define SVO_PACKET_PLANES_INL
#endif

#include "svoIntersectBlock.h"
#include "svoLaneNodes-inl.h"
#include "svoLaneTriples-inl.h"
#include "svoPacketWalk-inl.h"

#include <cmath>

#if HWY_TARGET != HWY_SCALAR
HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
/// A plane for each lane: where its word is, and the middle of its block.
struct OwnPlanes
{
  I primitive;
  I word; // index from the nodes
  Vec3 middle;
};

/// Of the cells themselves: voxels, or child nodes.
HWY_INLINE OwnPlanes planesOfCells(const WalkTarget& target, bool voxels, const Packet& p)
{
  const DI di;
  const I first = hn::Add(firstChild(target.words, p.node), p.below);
  OwnPlanes planes;
  planes.primitive = voxels ? first : hn::Or(first, hn::Set(di, static_cast<int>(NodePrimitive)));
  planes.word = voxels ? hn::Add(first, hn::Set(di, target.listBegin))
                       : hn::Add(hn::ShiftLeft<2>(first), hn::Set(di, 3));
  planes.middle = { middleOf(p.atX(), target.cellSize), middleOf(p.atY(), target.cellSize),
    middleOf(p.atZ(), target.cellSize) };
  return planes;
}

/// Of cells that are groups of eight: those of the child node that the ray passes in the middle of
/// its way through the group, or of the first one that exists. As representativeNode().
HWY_INLINE OwnPlanes planesOfGroups(const WalkTarget& target, F tExit, const Packet& p)
{
  const DF df;
  const DI di;
  const DU du;
  const auto [low, high, first] = loadNodes(target.words, p.node);
  const I firstBit = hn::And(cellOf(p), hn::Set(di, 56));
  const auto upper = hn::RebindMask(du, hn::Gt(firstBit, hn::Set(di, 31)));
  const U half = hn::IfThenElse(upper, high, low);
  const U at = hn::BitCast(du, hn::And(firstBit, hn::Set(di, 31)));
  const U octet = hn::And(hn::Shr(half, at), hn::Set(du, 255));

  const F middle = hn::Mul(hn::Add(p.t, tExit), hn::Set(df, 0.5f));
  const auto side = [&](F o, F d, I position, int bit)
  {
    const F x = hn::Add(o, hn::Mul(middle, d));
    const auto beyond = hn::Ge(x, middleOf(position, target.cellSize));
    return hn::IfThenElseZero(hn::RebindMask(di, beyond), hn::Set(di, bit));
  };
  const I passed = hn::Or(hn::Or(side(p.ox, p.dx, p.atX(), 1), side(p.oy, p.dy, p.atY(), 2)),
    side(p.oz, p.dz, p.atZ(), 4));
  const U one = hn::Set(du, 1), none = hn::Zero(du);
  const auto exists = hn::Ne(hn::And(octet, hn::Shl(one, hn::BitCast(du, passed))), hn::Zero(du));
  const U lowest = hn::And(octet, hn::Sub(none, octet));
  const U bit =
    hn::IfThenElse(exists, hn::BitCast(du, passed), countBoth(hn::Sub(lowest, one), none));

  const U before = hn::And(half, hn::Sub(hn::Shl(one, hn::Add(at, bit)), one));
  const U index = hn::Add(first, countBoth(before, hn::IfThenElseZero(upper, low)));
  OwnPlanes planes;
  planes.primitive = hn::Or(hn::BitCast(di, index), hn::Set(di, static_cast<int>(NodePrimitive)));
  planes.word = hn::Add(hn::ShiftLeft<2>(hn::BitCast(di, index)), hn::Set(di, 3));
  const int child = target.cellSize - 1;
  const auto centre = [&](I position, int axis)
  {
    const I lower = hn::And(position, hn::Set(di, -(1 << target.cellSize)));
    const I which = hn::And(hn::Shr(hn::BitCast(di, bit), hn::Set(di, axis)), hn::Set(di, 1));
    return middleOf(hn::Or(lower, hn::Shl(which, hn::Set(di, child))), child);
  };
  planes.middle = { centre(p.atX(), 0), centre(p.atY(), 1), centre(p.atZ(), 2) };
  return planes;
}

/// As meetCell() for lanes that have arrived, of a query with WalkTarget::ownPlanes. Returns those
/// that walk on.
HWY_INLINE Lanes meetOwnPlanes(const LeafQuery& query, const WalkTarget& target,
  const RayBlock& rays, int first, Lanes arrived, I leave, const Packet& p, BlockHits& hits)
{
  const DF df;
  const DI di;
  const DU du;
  const bool voxels = query.inBrick;
  const OwnPlanes planes =
    target.groups ? planesOfGroups(target, exitOf(p, leave), p) : planesOfCells(target, voxels, p);
  const U bits = gather(du, target.words, hn::IfThenElseZero(arrived, planes.word));

  // decodePlane().
  const F one = hn::Set(df, 1.0f), two = hn::Set(df, 2.0f), zero = hn::Zero(df);
  const auto share = [&](U steps, float all)
  {
    const F v = hn::ConvertTo(df, hn::BitCast(di, steps));
    return hn::Sub(hn::Mul(hn::Div(v, hn::Set(df, all)), two), one);
  };
  const U elevenBits = hn::Set(du, 2047);
  const F u = share(hn::And(bits, elevenBits), 2047.0f);
  const F v = share(hn::And(hn::ShiftRight<11>(bits), elevenBits), 2047.0f);
  const F offset = share(hn::ShiftRight<22>(bits), 1023.0f);
  const auto signOf = [&](F x) { return hn::IfThenElse(hn::Lt(x, zero), hn::Set(df, -1.0f), one); };
  const F up = hn::Sub(hn::Sub(one, hn::Abs(u)), hn::Abs(v));
  const auto folded = hn::Lt(up, zero);
  const F nx = hn::IfThenElse(folded, hn::Mul(hn::Sub(one, hn::Abs(v)), signOf(u)), u);
  const F ny = hn::IfThenElse(folded, hn::Mul(hn::Sub(one, hn::Abs(u)), signOf(v)), v);
  const Vec3 along{ nx, ny, up };
  const F scale = hn::Div(one, hn::Sqrt(dot(along, along)));
  const Vec3 normal{ hn::Mul(nx, scale), hn::Mul(ny, scale), hn::Mul(up, scale) };

  // intersectPlane().
  const F halfDiagonal = hn::Set(
    df, static_cast<float>(std::sqrt(3.0) * cellHalf(query.bits + (target.groups ? 1 : 0))));
  const F toCentre = dot(normal, subtract(planes.middle, { p.ox, p.oy, p.oz }));
  const F t =
    hn::Div(hn::Add(toCentre, hn::Mul(offset, halfDiagonal)), dot(normal, { p.dx, p.dy, p.dz }));

  // meetPlane().
  const F reach =
    hn::Set(df, static_cast<float>((voxels ? query.ownReach : 3.0) * cellHalf(query.bits)));
  auto near = hn::RebindMask(df, arrived);
  auto inBox = near;
  const auto look = [&](F o, F d, I position, int axis)
  {
    const F at = hn::Add(o, hn::Mul(t, d));
    const F away = hn::Abs(hn::Sub(at, middleOf(position, target.cellSize)));
    near = hn::And(near, hn::Le(away, reach)); // false for NaN
    if (query.planes)
    {
      inBox = hn::And(inBox, hn::Ge(at, hn::Set(df, static_cast<float>(query.low[axis]))));
      inBox = hn::And(inBox, hn::Le(at, hn::Set(df, static_cast<float>(query.high[axis]))));
    }
  };
  look(p.ox, p.dx, p.atX(), 0);
  look(p.oy, p.dy, p.atY(), 1);
  look(p.oz, p.dz, p.atZ(), 2);
  const F start = hn::Load(df, rays.tMin + first);
  const auto met = hn::And(hn::And(near, inBox), hn::And(hn::Ge(t, start), hn::Le(t, p.tMax)));
  hn::BlendedStore(t, met, df, hits.out.t + first);
  hn::BlendedStore(
    hn::BitCast(du, planes.primitive), hn::RebindMask(du, met), du, hits.out.primitive + first);
  const Lanes again = hn::AndNot(hn::RebindMask(di, met), arrived);
  if (!voxels && !hn::AllFalse(di, again))
  {
    const auto cut = hn::AndNot(inBox, near);
    const auto leftBehind = hn::And(near, hn::And(hn::Lt(t, start), hn::Le(p.t, p.tMin)));
    const auto asked = hn::AndNot(hn::Or(cut, leftBehind), hn::RebindMask(df, again));
    const U refused = hn::LoadU(du, hits.refused + first);
    const auto firstTime =
      hn::And(hn::RebindMask(du, asked), hn::Eq(refused, hn::Set(du, NoPrimitive)));
    hn::BlendedStore(p.t, hn::RebindMask(df, firstTime), df, hits.refusedT + first);
    hn::BlendedStore(hn::BitCast(du, planes.primitive), firstTime, du, hits.refused + first);
    hits.anyRefused = hits.anyRefused || !hn::AllFalse(du, firstTime);
  }
  return again;
}
}
}
HWY_AFTER_NAMESPACE();
#endif

#endif
