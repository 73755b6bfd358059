// Rays of any number that wait for a lane, as far as they can meet anything.
#if defined(SVO_OCCLUSION_SUPPLY_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SVO_OCCLUSION_SUPPLY_INL
#undef SVO_OCCLUSION_SUPPLY_INL
#else
#define SVO_OCCLUSION_SUPPLY_INL
#endif

#include "svoIntersectBlock.h"
#include "svoOcclusion.h"
#include "svoOcclusionTriangles-inl.h"
#include "svoPacketSupply-inl.h"

#include <algorithm>

#if SVO_PACKET_LEAVES
HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
/// Rays of any number, of which those that can meet something wait for a lane.
class OcclusionSupply
{
public:
  OcclusionSupply(const WalkTarget& t, const UpperLevels& u, const OcclusionRays& r)
    : target(t)
    , upper(u)
    , rays(r)
  {
    const DI di;
    Packet none = this->none();
    for (int i = 0; i < Room; i += Width)
    {
      this->keep(none, hn::Eq(none.ray, none.ray), i);
    }
    this->more();
  }

  bool empty() const { return this->next == this->end; }

  /// Puts the next rays into these lanes of a packet, or dead ones where there are no more.
  HWY_INLINE void take(Packet& p, Lanes lanes)
  {
    this->next = std::min(this->next + takeRays(this->parts, this->next, p, lanes), this->end);
    if (this->end - this->next < Width)
    {
      this->more();
    }
  }

  const OcclusionRay& operator[](int ray) const { return this->sheared[ray]; }

  /// Dead rays.
  Packet none() const
  {
    const RayBlock dead = blockOf(this->rays, this->rays.count);
    return makePacket(this->target, dead, 0);
  }

private:
  static constexpr int Width = hn::MaxLanes(DI());
  static constexpr int Room = 4 * Width;

  HWY_INLINE void keep(Packet& p, Lanes lanes, int at)
  {
    const LaneCompressor compress(lanes);
    forEachPart(
      p, [&](int k, auto& part) { compress.store(hn::BitCast(DF(), part), this->parts[k] + at); });
  }

  /// Makes rays ready until there are enough for a whole packet.
  void more()
  {
    const DF df;
    const DI di;
    for (auto& part : this->parts)
    {
      hn::StoreU(hn::LoadU(df, part + this->next), df, part);
    }
    this->end -= this->next;
    this->next = 0;
    for (; this->end < Width && this->read < this->rays.count; this->read += Width)
    {
      const int first = this->read % RayBlock::Size;
      if (first == 0)
      {
        this->block = blockOf(this->rays, this->read);
      }
      Packet p = makePacket(this->target, this->block, first);
      p.ray = hn::Iota(di, this->read);
      shear(p, this->sheared + this->read);
      this->endAtBox(p);
      const Lanes alive = hn::Not(p.dead);
      this->keep(p, alive, this->end);
      this->end += static_cast<int>(hn::CountTrue(di, alive));
    }
    hn::StoreU(hn::Set(df, -1.0f), df, this->parts[DeadPart] + this->end);
  }

  /// Lets lanes walk no further than there can be triangles.
  HWY_INLINE void endAtBox(Packet& p) const
  {
    const DF df;
    const DI di;
    F end = p.tClip;
    const auto leave = [&](F o, F inverse, I negative, float low, float high)
    {
      const F face = hn::IfThenElse(
        hn::RebindMask(df, hn::Lt(negative, hn::Zero(di))), hn::Set(df, low), hn::Set(df, high));
      // Along no axis that a ray stands still on: infinity, or not a number on the face itself.
      const F t = hn::Mul(hn::Sub(face, o), inverse);
      end = hn::IfThenElse(hn::Lt(t, end), t, end);
    };
    leave(p.ox, p.ix, p.nx, this->upper.low.x, this->upper.high.x);
    leave(p.oy, p.iy, p.ny, this->upper.low.y, this->upper.high.y);
    leave(p.oz, p.iz, p.nz, this->upper.low.z, this->upper.high.z);
    p.tMax = end;
    p.dead = hn::Or(p.dead, hn::RebindMask(di, hn::Lt(end, p.tMin)));
  }

  static constexpr int DeadPart = PacketParts - 1;

  const WalkTarget& target;
  const UpperLevels& upper;
  const OcclusionRays& rays;
  RayBlock block;
  int read = 0;          // of the rays
  int next = 0, end = 0; // of those that wait
  HWY_ALIGN float parts[PacketParts][Room];
  OcclusionRay sheared[OcclusionRays::Most];
};
}
}
HWY_AFTER_NAMESPACE();
#endif

#endif
