// The whole trace of rays of which only is asked whether they meet a triangle.
//
// Two packets walk side by side. Lanes that have arrived at a brick wait until enough of a packet's
// lanes do; then the triangles of each are tested side by side. Rays that meet one give their lanes
// to the next rays. The others are told that their bricks are empty and walk on.
#if defined(SVO_PACKET_OCCLUSION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SVO_PACKET_OCCLUSION_INL
#undef SVO_PACKET_OCCLUSION_INL
#else
#define SVO_PACKET_OCCLUSION_INL
#endif

#include "svoCounters.h"
#include "svoOcclusionSupply-inl.h"
#include "svoOcclusionTriangles-inl.h"
#include "svoPacketWalk-inl.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#if SVO_PACKET_LEAVES
HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
class OcclusionTrace
{
public:
  OcclusionTrace(
    const LeafQuery& query, const WalkTarget& t, const OcclusionRays& r, OcclusionAnswers& a)
    : target(t)
    , longestExact(static_cast<int>(query.leaf.longestExact))
    , supply(t, query.octree.upperLevels(), r)
    , answers(a)
  {
  }

  template <bool Groups>
  HWY_INLINE void run()
  {
    const DI di;
    const WalkTarget walkTarget = this->target;
    Packet a = this->supply.none(), b = a;
    this->supply.take(a, hn::Eq(a.ray, a.ray));
    this->supply.take(b, hn::Eq(b.ray, b.ray));
    for (;;)
    {
      const Lanes underWayA = turn<Groups>(walkTarget, a);
      const Lanes underWayB = turn<Groups>(walkTarget, b);
      countTurn(underWayA, underWayB);
      this->settle(a, underWayA);
      this->settle(b, underWayB);
      if (this->supply.empty() && hn::AllTrue(di, hn::And(a.dead, b.dead)))
      {
        return;
      }
    }
  }

private:
  /// If few enough of a packet's lanes are under way: tests those that have arrived, and gives
  /// those that are done to the next rays.
  HWY_INLINE void settle(Packet& p, Lanes underWay)
  {
    const DI di;
    if (hn::CountTrue(di, underWay) > Enough)
    {
      return;
    }
    const Lanes arrived = hn::Not(hn::Or(p.dead, underWay));
    if (!hn::AllFalse(di, arrived))
    {
      HWY_ALIGN std::int32_t brick[hn::MaxLanes(DI())];
      HWY_ALIGN std::int32_t ray[hn::MaxLanes(DI())];
      hn::Store(p.node, di, brick);
      hn::Store(p.ray, di, ray);
      for (std::uint64_t left = bitsOf(di, arrived); left != 0; left &= left - 1)
      {
        this->prefetch(static_cast<std::uint32_t>(brick[lowestBit(left)]));
      }
      std::uint64_t done = 0;
      for (std::uint64_t left = bitsOf(di, arrived); left != 0; left &= left - 1)
      {
        const int lane = lowestBit(left);
        done |= std::uint64_t(this->meets(ray[lane], static_cast<std::uint32_t>(brick[lane])))
          << lane;
      }
      p.dead = hn::Or(p.dead, maskOf(di, done));
      // An empty block is left as a whole.
      p.node = hn::IfThenElse(arrived, hn::Set(di, -1), p.node);
    }
    if (!this->supply.empty() && hn::CountTrue(di, p.dead) > hn::MaxLanes(DI()) / 4)
    {
      this->supply.take(p, p.dead);
    }
  }

  HWY_INLINE void prefetch(std::uint32_t brick) const
  {
    const std::uint32_t* words = this->target.words;
    const std::uint32_t list = words[4 * brick + 2];
    __builtin_prefetch(words + (list & InlineTriangle ? 0 : list + this->target.listBegin));
  }

  /// Whether no more is to be found out about a ray that has come to a brick.
  HWY_INLINE bool meets(int ray, std::uint32_t brick)
  {
    const std::uint32_t* words = this->target.words;
    // A single id stands in the node.
    std::uint32_t list = 4 * brick + 2;
    int count = 1;
    if (!(words[list] & InlineTriangle))
    {
      const std::uint32_t header = words[list] + static_cast<std::uint32_t>(this->target.listBegin);
      list = header + 1;
      count = static_cast<int>(words[header]);
    }
    const std::uint64_t bit = std::uint64_t(1) << ray % 64;
    if (count > this->longestExact)
    {
      this->answers.unknown[ray / 64] |= bit;
      return true;
    }
    constexpr int Width = FetchedTriangles::Width;
    SVO_COUNT(TrianglesTested, count);
    for (; count > 0; count -= Width, list += Width)
    {
      const int some = std::min(count, Width);
      const int met = this->supply[ray].meets(this->fetched.get(this->target, list, some), some);
      if (met >= 0)
      {
        this->answers.met[ray / 64] |= bit;
        this->answers.by[ray] = words[list + static_cast<std::uint32_t>(met)] & ~InlineTriangle;
        return true;
      }
    }
    return false;
  }

  /// Lanes under way while others wait. Between a half and three quarters it makes no difference.
  static constexpr std::size_t Enough = hn::MaxLanes(DI()) * 5 / 8;

  const WalkTarget& target;
  int longestExact;
  OcclusionSupply supply;
  FetchedTriangles fetched;
  OcclusionAnswers& answers;
};
}
}
HWY_AFTER_NAMESPACE();
#endif

#endif
