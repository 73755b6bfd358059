// Rays that wait for a lane.
//
// The rays of a packet walk differently far, and a block has more rays than two packets have lanes.
// So lanes whose rays have arrived or died take the block's next ones: not one by one, since each
// exchange costs about as much as half a turn, but when a packet has several of them.
#if defined(SVO_PACKET_SUPPLY_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SVO_PACKET_SUPPLY_INL
#undef SVO_PACKET_SUPPLY_INL
#else
#define SVO_PACKET_SUPPLY_INL
#endif

#include "svoPacketWalk-inl.h"

#include <cassert>
#include <cstdint>
#include <type_traits>

#if HWY_TARGET != HWY_SCALAR
HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
constexpr int PacketParts = 23; // see forEachPart()

template <class Visit, class... Parts>
HWY_INLINE void visitParts(const Visit& visit, Parts&... parts)
{
  static_assert(sizeof...(parts) == PacketParts);
  int k = 0;
  (visit(k++, parts), ...);
}

/// Calls visit(k, part) for all that a ray takes with it into another lane; the last is `dead`.
template <class Visit>
HWY_INLINE void forEachPart(Packet& p, const Visit& visit)
{
  const DI di;
  I dead = hn::VecFromMask(di, p.dead);
  visitParts(visit, p.ox, p.oy, p.oz, p.dx, p.dy, p.dz, p.ix, p.iy, p.iz, p.nx, p.ny, p.nz, p.tMax,
    p.t, p.x, p.y, p.z, p.cellMirror, p.tableMirror, p.size, p.node, p.ray, dead);
  p.dead = hn::Lt(dead, hn::Zero(di));
}

/// Puts rays that lie side by side, part by part, into these lanes of a packet: each lane takes the
/// ray behind those of the lanes before it. Returns how many.
template <int Room>
HWY_INLINE int takeRays(const float (&parts)[PacketParts][Room], int next, Packet& p, Lanes lanes)
{
  const DF df;
  const DI di;
  const DU du;
  const auto bits = static_cast<std::uint32_t>(bitsOf(di, lanes));
  const U before = hn::Sub(hn::Shl(hn::Set(du, 1), hn::Iota(du, 0)), hn::Set(du, 1));
  const I place = hn::BitCast(di, countBoth(hn::And(hn::Set(du, bits), before), hn::Zero(du)));
  const auto index = hn::IndicesFromVec(df, place);
  forEachPart(p,
    [&](int k, auto& part)
    {
      const hn::DFromV<std::decay_t<decltype(part)>> d;
      const F fresh = hn::TableLookupLanes(hn::LoadU(df, parts[k] + next), index);
      part = hn::IfThenElse(hn::RebindMask(d, lanes), hn::BitCast(d, fresh), part);
    });
  return countBits(bits);
}

/// The rays of a block from one on, each ready to walk.
struct RaySupply
{
  static constexpr int Width = hn::MaxLanes(DI());

  HWY_INLINE RaySupply(const WalkTarget& target, const RayBlock& rays, int first)
    : next(first)
  {
    for (int ray = first; ray < RayBlock::Size; ray += Width)
    {
      Packet p = makePacket(target, rays, ray);
      this->keep(p, ray);
    }
    // Who takes more rays than there are gets dead ones.
    Packet none = makePacket(target, rays, RayBlock::Size - Width);
    none.dead = hn::Eq(none.ray, none.ray);
    this->keep(none, RayBlock::Size);
  }

  bool empty() const { return this->next >= RayBlock::Size; }

  /// Puts the next rays into these lanes of a packet.
  HWY_INLINE void take(Packet& p, Lanes lanes)
  {
    assert(!this->empty());
    this->next += takeRays(this->parts, this->next, p, lanes);
  }

private:
  HWY_INLINE void keep(Packet& p, int ray)
  {
    const DF df;
    forEachPart(
      p, [&](int k, auto& part) { hn::StoreU(hn::BitCast(df, part), df, this->parts[k] + ray); });
  }

  int next;
  HWY_ALIGN float parts[PacketParts][RayBlock::Size + Width];
};
}
}
HWY_AFTER_NAMESPACE();
#endif

#endif
