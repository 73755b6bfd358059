// The whole trace of a block whose rays stop at cubes: two packets walk side by side, and lanes
// that are done take the block's next rays, until there are none. Which triangles the cubes stand
// for is asked at the end, for all of them together.
#if defined(SVO_PACKET_CUBES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SVO_PACKET_CUBES_INL
#undef SVO_PACKET_CUBES_INL
#else
#define SVO_PACKET_CUBES_INL
#endif

#include "svoPacketCells-inl.h"
#include "svoPacketSupply-inl.h"
#include "svoPacketWalk-inl.h"

#include <cstddef>

#if SVO_PACKET_LEAVES
HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
/// Whether every cell ends its ray as a cube of which only the triangle is not known yet.
inline bool onlyCubes(const LeafQuery& query, const WalkTarget& target)
{
  return target.points != nullptr && query.leaf.shape == CellShape::Cube && !query.leaf.exact();
}

/// Gives a packet the next rays if at most `most` of its lanes are under way.
HWY_INLINE void exchange(
  RaySupply& supply, std::size_t most, Lanes underWay, Packet& p, ArrivedCells& cells)
{
  if (hn::CountTrue(DI(), underWay) <= most && !supply.empty())
  {
    const Lanes idle = hn::Not(underWay);
    note(p, hn::AndNot(p.dead, idle), cells);
    supply.take(p, idle);
  }
}

/// The whole trace of a block where onlyCubes(). `hits`: as of rays that meet nothing.
template <bool Groups>
HWY_INLINE void traceCubes(
  const LeafQuery& query, const WalkTarget& target, const RayBlock& rays, HitBlock& hits)
{
  const DI di;
  const int n = static_cast<int>(hn::Lanes(di));
  // An exchange is worth it as soon as this many lanes would go on idling.
  const std::size_t most = hn::Lanes(di) - hn::Lanes(di) / 4;
  ArrivedCells cells;
  Packet a = makePacket(target, rays, 0);
  Packet b = makePacket(target, rays, n);
  RaySupply supply(target, rays, 2 * n);
  for (;;)
  {
    const Lanes underWayA = turn<Groups>(target, a);
    const Lanes underWayB = turn<Groups>(target, b);
    countTurn(underWayA, underWayB);
    if (!supply.empty())
    {
      exchange(supply, most, underWayA, a, cells);
      exchange(supply, most, underWayB, b, cells);
    }
    else if (hn::AllFalse(di, hn::Or(underWayA, underWayB)))
    {
      break;
    }
  }
  note(a, hn::Not(a.dead), cells);
  note(b, hn::Not(b.dead), cells);
  for (int i = 0; i < cells.count; ++i)
  {
    hits.t[cells.ray[i]] = cells.t[i];
    hits.primitive[cells.ray[i]] = 0;
  }
  representatives(query, target, cells, 0, hits.primitive);
}
}
}
HWY_AFTER_NAMESPACE();
#endif

#endif
