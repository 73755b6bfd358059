// The walk of a packet of rays, one ray a lane, through an octree: compiled once per instruction
// set. Each lane has its own node, position and size; nothing that one lane does is seen by
// another.
//
// A lane's position is kept as the bit patterns of its three octree coordinates. Those lie in
// [1, 2), so the mantissa's upper bits are the integer coordinates of the cell at any level, and
// leaving a cell is an integer addition. Where the direction is negative all bits are inverted, so
// that positions grow along every ray and no operation has to ask for the direction's sign; what is
// compared and computed stays the same to the bit. One turn of the loop probes the cell, descends
// into it if it is occupied, else steps over it, and if that leaves the node looks the new node up
// in the table of upper levels. Lanes that have arrived or died keep turning without effect.
#if defined(SVO_PACKET_WALK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SVO_PACKET_WALK_INL
#undef SVO_PACKET_WALK_INL
#else
#define SVO_PACKET_WALK_INL
#endif

#include "svoCounters.h"
#include "svoIntersectBlock.h"
#include "svoLaneNodes-inl.h"
#include "svoMorton.h"
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
struct Packet
{
  F ox, oy, oz;  // origin
  F dx, dy, dz;  // direction
  F ix, iy, iz;  // its inverse
  I nx, ny, nz;  // -1 where the direction is negative, else 0
  F tMin, tClip; // the part of the ray inside the cube
  F tMax;        // at most tClip: where the lane need not go beyond
  F t;           // where the lane entered the cell that it is in
  I x, y, z;     // position, bit patterns of octree coordinates, mirrored by nx, ny, nz
  I cellMirror;  // what that does to cellIndex(),
  I tableMirror; // and to places in the table of upper levels
  I size;        // exponent of the node's cells, in mantissa bits
  I node;        // index; negative: the block is empty
  I below;       // occupied cells of the node before the one that it was in at its last turn
  I ray;         // of the block
  Lanes dead;    // left the cube or passed tMax

  /// Positions as they are.
  HWY_INLINE I atX() const { return hn::Xor(this->x, this->nx); }
  HWY_INLINE I atY() const { return hn::Xor(this->y, this->ny); }
  HWY_INLINE I atZ() const { return hn::Xor(this->z, this->nz); }
};

/// cellIndex() of the cells of 2^p.size where the lanes are.
HWY_INLINE I cellOf(const Packet& p)
{
  const DI di;
  const hn::Repartition<std::uint8_t, DI> bytes;
  // What x and y give, and what z gives; the lanes' upper bytes are 0 and stay it.
  alignas(16) constexpr std::uint8_t fromXY[16] = { 0, 1, 8, 9, 2, 3, 10, 11, 16, 17, 24, 25, 18,
    19, 26, 27 };
  alignas(16) constexpr std::uint8_t fromZ[16] = { 0, 4, 32, 36 };
  const auto part = [&](I position) { return hn::And(hn::Shr(position, p.size), hn::Set(di, 3)); };
  const auto look = [&](const std::uint8_t* table, I index)
  {
    return hn::BitCast(
      di, hn::TableLookupBytes(hn::LoadDup128(bytes, table), hn::BitCast(bytes, index)));
  };
  const I xy = hn::Or(part(p.x), hn::ShiftLeft<2>(part(p.y)));
  return hn::Xor(hn::Or(look(fromXY, xy), look(fromZ, part(p.z))), p.cellMirror);
}

/// What a lane sees where it is: hasChild(), occupiedBelow() and child() of svoNode.h.
struct Probe
{
  Lanes nothing; // the whole block is empty
  Lanes occupied;
  Lanes gap; // nor has the group of eight cells any
  I below;   // occupied cells before this one in the node
  I first;   // the node's first child
};

HWY_INLINE Probe probe(const std::uint32_t* words, const Packet& p)
{
  const DI di;
  const DU du;
  const auto [low, high, first] = loadNodes(words, p.node);
  const I cell = cellOf(p);
  const auto upper = hn::RebindMask(du, hn::Gt(cell, hn::Set(di, 31)));
  const U half = hn::IfThenElse(upper, high, low);
  const U at = hn::BitCast(du, hn::And(cell, hn::Set(di, 31)));
  const U bit = hn::Shl(hn::Set(du, 1), at);
  const U group = hn::And(hn::Shr(half, hn::And(at, hn::Set(du, 24))), hn::Set(du, 255));
  Probe result;
  result.nothing = hn::Lt(p.node, hn::Zero(di));
  result.occupied = hn::AndNot(result.nothing, hn::RebindMask(di, hn::Eq(hn::And(half, bit), bit)));
  result.gap = hn::Or(result.nothing, hn::RebindMask(di, hn::Eq(group, hn::Zero(du))));
  result.below = hn::BitCast(
    di, countBoth(hn::And(half, hn::Sub(bit, hn::Set(du, 1))), hn::IfThenElseZero(upper, low)));
  result.first = hn::BitCast(di, first);
  return result;
}

/// -v where `negative` is -1, v where it is 0: `there` - 1, inverted, is as much as -there, and the
/// face of a mirrored end, which is inverted, is its inverse + 1.
HWY_INLINE I turned(I v, I negative)
{
#if HWY_TARGET == HWY_AVX2
  return I{ _mm256_sign_epi32(v.raw, hn::Or(negative, hn::Set(DI(), 1)).raw) };
#else
  return hn::Sub(hn::Xor(v, negative), negative);
#endif
}

/// The plane, along one axis, through which lanes leave their cells: `end` is the mirrored position
/// behind it.
HWY_INLINE F faceAt(I end, I negative)
{
  return hn::BitCast(DF(), turned(end, negative));
}

/// Where the lanes leave the cell of 2^exponent that they are in.
HWY_INLINE F exitOf(const Packet& p, I exponent)
{
  const DI di;
  const I one = hn::Set(di, 1);
  const I inside = hn::Sub(hn::Shl(one, exponent), one);
  const auto face = [&](F o, F inverse, I negative, I position) {
    return hn::Mul(hn::Sub(faceAt(hn::Add(hn::Or(position, inside), one), negative), o), inverse);
  };
  const F t = hn::Min(
    hn::Min(face(p.ox, p.ix, p.nx, p.x), face(p.oy, p.iy, p.ny, p.y)), face(p.oz, p.iz, p.nz, p.z));
  return hn::Max(p.t, t);
}

/// The middles of the cells of 2^exponent at a position, along an axis.
HWY_INLINE F middleOf(I at, int exponent)
{
  const DI di;
  const I lower = hn::And(at, hn::Set(di, -(1 << exponent)));
  return hn::BitCast(DF(), hn::Or(lower, hn::Set(di, 1 << (exponent - 1))));
}

HWY_INLINE F notANumberWhere(Lanes lanes, F v)
{
  const DF df;
#if HWY_TARGET <= HWY_AVX3
  return hn::IfThenElse(
    hn::RebindMask(df, lanes), hn::Set(df, std::numeric_limits<float>::quiet_NaN()), v);
#else
  return hn::Or(v, hn::VecFromMask(df, hn::RebindMask(df, lanes))); // all bits set
#endif
}

/// Moves the lanes but those of `stays` over the cell of 2^exponent that they are in, exactly as
/// walk() of svoTraverse.h does. Returns those that left their node.
HWY_INLINE Lanes advance(Packet& p, Lanes stays, I exponent)
{
  const DF df;
  const DI di;
  const I one = hn::Set(di, 1);
  // A lane that does not step is in a cell of its own position alone, which it does not leave.
  const I inside = hn::IfThenZeroElse(stays, hn::Sub(hn::Shl(one, exponent), one));
  const I lastX = hn::Or(p.x, inside);
  const I lastY = hn::Or(p.y, inside);
  const I lastZ = hn::Or(p.z, inside);
  const I endX = hn::Add(lastX, one);
  const I endY = hn::Add(lastY, one);
  const I endZ = hn::Add(lastZ, one);
  const F tx = hn::Mul(hn::Sub(faceAt(endX, p.nx), p.ox), p.ix);
  const F ty = hn::Mul(hn::Sub(faceAt(endY, p.ny), p.oy), p.iy);
  const F tz = hn::Mul(hn::Sub(faceAt(endZ, p.nz), p.oz), p.iz);
  const F tFirst = hn::Min(hn::Min(tx, ty), tz);
  // Not a number, which is equal to nothing and greater than nothing. Of such, x86's maximum is its
  // second operand.
  const F tExit = notANumberWhere(stays, tFirst);
  const F t = hn::Max(tExit, p.t);
  // On a face the ray is in the cell that it heads for, hence turned(); between the faces it
  // stays between them, and never turns back.
  const auto move = [&](F o, F d, F tFace, I position, I last, I end, I negative)
  {
    const I there = turned(hn::BitCast(di, hn::Add(o, hn::Mul(t, d))), negative);
    const I between = hn::Min(hn::Max(there, position), last);
    return hn::IfThenElse(hn::RebindMask(di, hn::Eq(tFace, tExit)), end, between);
  };
  const I x = move(p.ox, p.dx, tx, p.x, lastX, endX, p.nx);
  const I y = move(p.oy, p.dy, ty, p.y, lastY, endY, p.ny);
  const I z = move(p.oz, p.dz, tz, p.z, lastZ, endZ, p.nz);
  const I changed = hn::Or(hn::Or(hn::Xor(x, p.x), hn::Xor(y, p.y)), hn::Xor(z, p.z));
  p.x = x;
  p.y = y;
  p.z = z;
  p.t = t;
  const Lanes past = hn::RebindMask(di, hn::Gt(tExit, p.tMax));
  const Lanes outside = hn::Gt(changed, hn::Set(di, (1 << MantissaBits) - 1));
  p.dead = hn::Or(p.dead, hn::Or(past, outside));
  return hn::Gt(hn::Shr(changed, hn::Add(p.size, hn::Set(di, 2))), hn::Zero(di));
}

/// Looks up the nodes of the lanes of `lost`.
HWY_INLINE void find(const WalkTarget& target, Packet& p, Lanes lost)
{
  const DI di;
  const DU du;
  const int bits = target.tableBits;
  const int edge = (1 << bits) - 1;
  // The uppermost bits of each coordinate, brought to where they are in the index at once.
  const auto part = [&](I position, int axis)
  {
    const I there = hn::Shr(position, hn::Set(di, MantissaBits - (axis + 1) * bits));
    return hn::And(there, hn::Set(di, edge << (axis * bits)));
  };
  const I mirrored = hn::Or(hn::Or(part(p.x, 0), part(p.y, 1)), part(p.z, 2));
  const I index = hn::Xor(mirrored, p.tableMirror);
  const I entry = hn::BitCast(di, gather(du, target.table, index));
  const I size = hn::And(entry, hn::Set(di, 31));
  // The sign of an empty entry stays: any negative index says so.
  p.size = hn::IfThenElse(lost, size, p.size);
  p.node = hn::IfThenElse(lost, hn::ShiftRight<5>(entry), p.node);
}

/// The first child of each lane's node.
HWY_INLINE I firstChild(const std::uint32_t* words, I node)
{
  const DI di;
  const DU du;
  const I index = hn::ShiftLeft<2>(hn::Max(node, hn::Zero(di)));
  return hn::BitCast(di, gather(du, words + 2, index));
}

/// One turn. Returns the lanes that are still under way.
template <bool Groups>
HWY_INLINE Lanes turn(const WalkTarget& target, Packet& p)
{
  const DI di;
  const Probe seen = probe(target.words, p);
  const Lanes bottom = hn::Eq(p.size, hn::Set(di, target.stopSize));
  // An empty group of eight, or a whole empty block, is left at once.
  const I beyond = hn::Sub(hn::Set(di, 1), hn::VecFromMask(di, seen.nothing));
  const I exponent = hn::Add(p.size, hn::IfThenElseZero(seen.gap, beyond));
  const Lanes occupied =
    Groups ? hn::Or(seen.occupied, hn::AndNot(seen.gap, bottom)) : seen.occupied;
  const Lanes still = hn::Or(hn::And(occupied, bottom), p.dead);
  const Lanes descend = hn::AndNot(still, occupied);
  const I child = hn::Add(seen.first, seen.below);
  const Lanes lost = advance(p, hn::Or(occupied, p.dead), exponent);
  p.below = seen.below;
  p.node = hn::IfThenElse(descend, child, p.node);
  p.size = hn::Sub(p.size, hn::IfThenElseZero(descend, hn::Set(di, 2)));
  find(target, p, lost);
  return hn::Not(hn::Or(still, p.dead));
}

/// Counts a turn of two packets, of which these lanes are under way.
HWY_INLINE void countTurn([[maybe_unused]] Lanes first, [[maybe_unused]] Lanes second)
{
  SVO_COUNT(NodesVisited, hn::CountTrue(DI(), first) + hn::CountTrue(DI(), second));
  SVO_COUNT(
    IdleLanes, 2 * hn::Lanes(DI()) - hn::CountTrue(DI(), first) - hn::CountTrue(DI(), second));
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
    return hn::Xor(hn::Min(hn::Max(there, low), last), negative);
  };
  p.x = enter(p.ox, p.dx, p.nx);
  p.y = enter(p.oy, p.dy, p.ny);
  p.z = enter(p.oz, p.dz, p.nz);
  const auto mirror = [&](int x, int y, int z)
  {
    return hn::Or(hn::Or(hn::And(p.nx, hn::Set(di, x)), hn::And(p.ny, hn::Set(di, y))),
      hn::And(p.nz, hn::Set(di, z)));
  };
  p.cellMirror = mirror(cellIndex(3, 0, 0), cellIndex(0, 3, 0), cellIndex(0, 0, 3));
  const int bits = target.tableBits;
  const int edge = (1 << bits) - 1;
  p.tableMirror = mirror(edge, edge << bits, edge << (2 * bits));
  p.below = hn::Zero(di);
  p.ray = hn::Iota(di, first);
  p.node = hn::Zero(di);
  p.size = hn::Zero(di);
  find(target, p, hn::Eq(p.node, p.node));
  // Every lane, dead or not, is inside the cube and has a size to turn with.
  assert(hn::AllTrue(di, hn::Eq(hn::ShiftRight<MantissaBits>(p.atX()), hn::Set(di, 127))));
  assert(hn::AllTrue(di, hn::Eq(hn::ShiftRight<MantissaBits>(p.atY()), hn::Set(di, 127))));
  assert(hn::AllTrue(di, hn::Eq(hn::ShiftRight<MantissaBits>(p.atZ()), hn::Set(di, 127))));
  assert(hn::AllFalse(di, hn::Lt(p.size, hn::Set(di, target.stopSize))));
  return p;
}
}
}
HWY_AFTER_NAMESPACE();
#endif

#endif
