// The walk of a packet of rays, one ray a lane, through an octree: compiled once per instruction
// set. Each lane has its own node, position and size; nothing that one lane does is seen by
// another.
//
// A lane's position is kept as the bit patterns of its three octree coordinates. Those lie in
// [1, 2), so the mantissa's upper bits are the integer coordinates of the cell at any level, and
// leaving a cell is an integer addition. One turn of the loop probes the cell, descends into it if
// it is occupied, else steps over it, and if that leaves the node looks the new node up in the
// table of upper levels. Lanes that have arrived or died keep turning without effect.
#if defined(SVO_PACKET_WALK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SVO_PACKET_WALK_INL
#undef SVO_PACKET_WALK_INL
#else
#define SVO_PACKET_WALK_INL
#endif

#include "svoIntersectBlock.h"
#include "svoRay.h"

#include <cassert>
#include <cstdint>
#include <limits>

#include <hwy/highway.h>

#if HWY_TARGET != HWY_SCALAR
HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

using DF = hn::ScalableTag<float>;
using DI = hn::ScalableTag<std::int32_t>;
using DU = hn::ScalableTag<std::uint32_t>;
using F = hn::Vec<DF>;
using I = hn::Vec<DI>;
using U = hn::Vec<DU>;
using Lanes = hn::Mask<DI>;

struct Packet
{
  F ox, oy, oz;  // origin
  F dx, dy, dz;  // direction
  F ix, iy, iz;  // its inverse
  I nx, ny, nz;  // -1 where the direction is negative, else 0
  F tMin, tClip; // the part of the ray inside the cube
  F tMax;        // at most tClip: where the lane need not go beyond
  F t;           // where the lane entered the cell that it is in
  I x, y, z;     // position, bit patterns of octree coordinates
  I size;        // exponent of the node's cells, in mantissa bits
  I node;        // index; negative: the block is empty
  Lanes dead;    // left the cube or passed tMax
};

/// The bits of a 2-bit coordinate, two places apart, of cellIndex().
HWY_INLINE I spreadCoordinate(I position, I size)
{
  const DI di;
  const I v = hn::Shr(position, size);
  return hn::Or(hn::And(v, hn::Set(di, 1)), hn::And(hn::ShiftLeft<2>(v), hn::Set(di, 8)));
}

/// What a lane sees where it is: hasChild(), groupCells() and childrenBefore() of svoNode.h.
struct Probe
{
  Lanes nothing; // the whole block is empty
  Lanes occupied;
  Lanes group; // the group of eight cells has any
  I below;     // occupied cells before this one in the node
};

HWY_INLINE Probe probe(const std::uint64_t* nodes, const Packet& p)
{
  const DI di;
  const DU du;
  const I cell =
    hn::Or(hn::Or(spreadCoordinate(p.x, p.size), hn::ShiftLeft<1>(spreadCoordinate(p.y, p.size))),
      hn::ShiftLeft<2>(spreadCoordinate(p.z, p.size)));
  // An empty block has no node to look at; any will do.
  const I index = hn::ShiftLeft<2>(hn::Max(p.node, hn::Zero(di)));
  const auto* words = reinterpret_cast<const std::uint32_t*>(nodes);
  const U low = hn::GatherIndex(du, words, index);
  const U high = hn::GatherIndex(du, words + 1, index);
  const auto upper = hn::Gt(cell, hn::Set(di, 31));
  const U half = hn::IfThenElse(hn::RebindMask(du, upper), high, low);
  const U at = hn::BitCast(du, hn::And(cell, hn::Set(di, 31)));
  const U bit = hn::Shl(hn::Set(du, 1), at);
  const U group = hn::And(hn::Shr(half, hn::And(at, hn::Set(du, 24))), hn::Set(du, 255));
  const U lower = hn::PopulationCount(hn::And(half, hn::Sub(bit, hn::Set(du, 1))));
  const U before = hn::IfThenElseZero(hn::RebindMask(du, upper), hn::PopulationCount(low));
  Probe result;
  result.nothing = hn::Lt(p.node, hn::Zero(di));
  result.occupied =
    hn::AndNot(result.nothing, hn::RebindMask(di, hn::Ne(hn::And(half, bit), hn::Zero(du))));
  result.group = hn::AndNot(result.nothing, hn::RebindMask(di, hn::Ne(group, hn::Zero(du))));
  result.below = hn::BitCast(di, hn::Add(lower, before));
  return result;
}

/// Where the lanes leave the cell of 2^exponent that they are in.
HWY_INLINE F exitOf(const Packet& p, I exponent)
{
  const DF df;
  const DI di;
  const I size = hn::Shl(hn::Set(di, 1), exponent);
  const I inside = hn::Sub(size, hn::Set(di, 1));
  const auto face = [&](F o, F inverse, I negative, I position)
  {
    const I at = hn::Add(hn::AndNot(inside, position), hn::AndNot(negative, size));
    return hn::Mul(hn::Sub(hn::BitCast(df, at), o), inverse);
  };
  const F t = hn::Min(
    hn::Min(face(p.ox, p.ix, p.nx, p.x), face(p.oy, p.iy, p.ny, p.y)), face(p.oz, p.iz, p.nz, p.z));
  return hn::Max(p.t, t);
}

/// Moves the lanes of `step` over the cell of 2^exponent that they are in, exactly as walk() of
/// svoTraverse.h does. Returns those that left their node.
HWY_INLINE Lanes advance(Packet& p, Lanes step, I exponent)
{
  const DF df;
  const DI di;
  const I size = hn::Shl(hn::Set(di, 1), exponent);
  const I inside = hn::Sub(size, hn::Set(di, 1));
  const I lowX = hn::AndNot(inside, p.x);
  const I lowY = hn::AndNot(inside, p.y);
  const I lowZ = hn::AndNot(inside, p.z);
  const I faceX = hn::Add(lowX, hn::AndNot(p.nx, size));
  const I faceY = hn::Add(lowY, hn::AndNot(p.ny, size));
  const I faceZ = hn::Add(lowZ, hn::AndNot(p.nz, size));
  const F tx = hn::Mul(hn::Sub(hn::BitCast(df, faceX), p.ox), p.ix);
  const F ty = hn::Mul(hn::Sub(hn::BitCast(df, faceY), p.oy), p.iy);
  const F tz = hn::Mul(hn::Sub(hn::BitCast(df, faceZ), p.oz), p.iz);
  const F tExit = hn::Min(hn::Min(tx, ty), tz);
  const F t = hn::Max(p.t, tExit);
  // On a face the ray is in the cell that it heads for, hence `negative`; between the faces it
  // stays between them, and never turns back.
  const auto move = [&](F o, F d, F tFace, I low, I face, I negative, I position)
  {
    const I there = hn::Add(hn::BitCast(di, hn::Add(o, hn::Mul(t, d))), negative);
    const I lower = hn::IfVecThenElse(negative, low, position);
    const I upper = hn::IfVecThenElse(negative, position, hn::Or(low, inside));
    const I stays = hn::Min(hn::Max(there, lower), upper);
    const Lanes leaves = hn::RebindMask(di, hn::Eq(tFace, tExit));
    return hn::IfThenElse(step, hn::IfThenElse(leaves, hn::Add(face, negative), stays), position);
  };
  const I x = move(p.ox, p.dx, tx, lowX, faceX, p.nx, p.x);
  const I y = move(p.oy, p.dy, ty, lowY, faceY, p.ny, p.y);
  const I z = move(p.oz, p.dz, tz, lowZ, faceZ, p.nz, p.z);
  const I changed = hn::Or(hn::Or(hn::Xor(x, p.x), hn::Xor(y, p.y)), hn::Xor(z, p.z));
  p.x = x;
  p.y = y;
  p.z = z;
  p.t = hn::IfThenElse(hn::RebindMask(df, step), t, p.t);
  const Lanes past = hn::RebindMask(di, hn::Gt(tExit, p.tMax));
  const Lanes outside = hn::Gt(changed, hn::Set(di, (1 << MantissaBits) - 1));
  p.dead = hn::Or(p.dead, hn::And(step, hn::Or(past, outside)));
  return hn::Ne(hn::Shr(changed, hn::Add(p.size, hn::Set(di, 2))), hn::Zero(di));
}

/// Looks up the nodes of the lanes of `lost`.
HWY_INLINE void find(const WalkTarget& target, Packet& p, Lanes lost)
{
  const DI di;
  const DU du;
  const I shift = hn::Set(di, MantissaBits - target.tableBits);
  const I edge = hn::Set(di, (1 << target.tableBits) - 1);
  const I tx = hn::And(hn::Shr(p.x, shift), edge);
  const I ty = hn::And(hn::Shr(p.y, shift), edge);
  const I tz = hn::And(hn::Shr(p.z, shift), edge);
  const I bits = hn::Set(di, target.tableBits);
  const I index = hn::Or(tx, hn::Shl(hn::Or(ty, hn::Shl(tz, bits)), bits));
  const I entry = hn::BitCast(di, hn::GatherIndex(du, target.table, index));
  const I size = hn::And(entry, hn::Set(di, 31));
  // The sign of an empty entry stays: any negative index says so.
  p.size = hn::IfThenElse(lost, size, p.size);
  p.node = hn::IfThenElse(lost, hn::ShiftRight<5>(entry), p.node);
}

/// The first child of each lane's node.
HWY_INLINE I firstChild(const std::uint64_t* nodes, I node)
{
  const DI di;
  const DU du;
  const auto* words = reinterpret_cast<const std::uint32_t*>(nodes);
  const I index = hn::ShiftLeft<2>(hn::Max(node, hn::Zero(di)));
  return hn::BitCast(di, hn::GatherIndex(du, words + 2, index));
}

/// One turn. Returns the lanes that are still under way.
template <bool Groups>
HWY_INLINE Lanes turn(const WalkTarget& target, Packet& p)
{
  const DI di;
  const Probe seen = probe(target.nodes, p);
  const Lanes bottom = hn::Eq(p.size, hn::Set(di, target.stopSize));
  // An empty group of eight, or a whole empty block, is left at once.
  const I beyond = hn::IfThenElse(seen.nothing, hn::Set(di, 2), hn::Set(di, 1));
  const I exponent = hn::Add(p.size, hn::IfThenZeroElse(seen.group, beyond));
  const Lanes occupied =
    Groups ? hn::Or(seen.occupied, hn::And(bottom, seen.group)) : seen.occupied;
  const Lanes still = hn::Or(hn::And(occupied, bottom), p.dead);
  const Lanes step = hn::Not(hn::Or(occupied, p.dead));
  const Lanes descend = hn::AndNot(still, occupied);
  const I child = hn::Add(firstChild(target.nodes, p.node), seen.below);
  const Lanes lost = advance(p, step, exponent);
  p.node = hn::IfThenElse(descend, child, p.node);
  p.size = hn::IfThenElse(descend, hn::Sub(p.size, hn::Set(di, 2)), p.size);
  find(target, p, lost);
  return hn::Not(hn::Or(still, p.dead));
}

/// Clips the rays to the octree's cube, exactly as clip() of svoTraverse.h does, and puts every
/// lane where it enters.
HWY_INLINE Packet makePacket(const WalkTarget& target, const RayBlock& rays, int first)
{
  const DF df;
  const DI di;
  const F zero = hn::Zero(df);
  const F one = hn::Set(df, 1.0f);
  const F high = hn::Set(df, target.high);
  const F infinity = hn::Set(df, std::numeric_limits<float>::infinity());
  Packet p;
  p.ox = hn::Load(df, rays.originX + first);
  p.oy = hn::Load(df, rays.originY + first);
  p.oz = hn::Load(df, rays.originZ + first);
  p.dx = hn::Load(df, rays.directionX + first);
  p.dy = hn::Load(df, rays.directionY + first);
  p.dz = hn::Load(df, rays.directionZ + first);
  F tMin = hn::Load(df, rays.tMin + first);
  F tMax = hn::Load(df, rays.tMax + first);
  const F smallest = hn::Set(df, std::numeric_limits<float>::min());
  const F largest = hn::Max(hn::Max(hn::Abs(p.dx), hn::Abs(p.dy)), hn::Abs(p.dz));
  const F negligible = hn::Max(
    hn::Mul(largest, hn::Set(df, std::numeric_limits<float>::epsilon() / 256.0f)), smallest);
  auto alive = hn::Ge(largest, smallest);
  const auto clip = [&](F o, F& d, F& inverse, I& negative)
  {
    const auto finite = [&](F v) { return hn::Lt(hn::Abs(v), infinity); };
    alive = hn::And(alive, hn::And(finite(o), finite(d)));
    const auto still = hn::Lt(hn::Abs(d), negligible);
    d = hn::IfThenElse(still, zero, d);
    inverse = hn::IfThenElse(still, infinity, hn::Div(one, d));
    negative = hn::BitCast(di, hn::VecFromMask(df, hn::Lt(d, zero)));
    const auto within = hn::And(hn::Ge(o, one), hn::Lt(o, high));
    alive = hn::And(alive, hn::Or(hn::Not(still), within));
    const F toLow = hn::Mul(hn::Sub(one, o), inverse);
    const F toHigh = hn::Mul(hn::Sub(high, o), inverse);
    const F near = hn::IfThenElse(still, tMin, hn::Min(toLow, toHigh));
    const F far = hn::IfThenElse(still, tMax, hn::Max(toLow, toHigh));
    // These forms keep a NaN in tMin and tMax.
    tMin = hn::IfThenElse(hn::Lt(tMin, near), near, tMin);
    tMax = hn::IfThenElse(hn::Lt(far, tMax), far, tMax);
  };
  clip(p.ox, p.dx, p.ix, p.nx);
  clip(p.oy, p.dy, p.iy, p.ny);
  clip(p.oz, p.dz, p.iz, p.nz);
  alive = hn::And(alive, hn::Le(tMin, tMax));
  p.dead = hn::Not(hn::RebindMask(di, alive));
  p.t = tMin;
  p.tMin = tMin;
  p.tClip = tMax;
  p.tMax = tMax;
  const I low = hn::BitCast(di, one);
  const I last = hn::Sub(hn::BitCast(di, high), hn::Set(di, 1));
  const auto enter = [&](F o, F d, I negative)
  {
    const I there = hn::Add(hn::BitCast(di, hn::Add(o, hn::Mul(tMin, d))), negative);
    return hn::Min(hn::Max(there, low), last);
  };
  p.x = enter(p.ox, p.dx, p.nx);
  p.y = enter(p.oy, p.dy, p.ny);
  p.z = enter(p.oz, p.dz, p.nz);
  p.node = hn::Zero(di);
  p.size = hn::Zero(di);
  find(target, p, hn::Eq(p.node, p.node));
  // Every lane, dead or not, is inside the cube and has a size to turn with.
  assert(hn::AllTrue(di, hn::Eq(hn::ShiftRight<MantissaBits>(p.x), hn::Set(di, 127))));
  assert(hn::AllTrue(di, hn::Eq(hn::ShiftRight<MantissaBits>(p.y), hn::Set(di, 127))));
  assert(hn::AllTrue(di, hn::Eq(hn::ShiftRight<MantissaBits>(p.z), hn::Set(di, 127))));
  assert(hn::AllFalse(di, hn::Lt(p.size, hn::Set(di, target.stopSize))));
  return p;
}
}
}
HWY_AFTER_NAMESPACE();
#endif

#endif
