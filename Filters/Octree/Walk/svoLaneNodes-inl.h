// Nodes of an octree, one a lane.
#if defined(SVO_LANE_NODES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SVO_LANE_NODES_INL
#undef SVO_LANE_NODES_INL
#else
#define SVO_LANE_NODES_INL
#endif

#include "svoLaneTriples-inl.h"

#include <cstdint>

#include <hwy/highway.h>

#if HWY_TARGET != HWY_SCALAR
HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
using DU = hn::ScalableTag<std::uint32_t>;
using U = hn::Vec<DU>;
using Lanes = hn::Mask<DI>;

/// The lanes' nodes, of four words each: their masks' halves and their first children.
HWY_INLINE LaneTriples<U> loadNodes(const std::uint32_t* words, I node)
{
  // An empty block has no node to look at; any will do.
  return loadThree(DU(), words, hn::ShiftLeft<2>(hn::Max(node, hn::Zero(DI()))));
}

/// Set bits of two masks together, of at most 63.
HWY_INLINE U countBoth(U a, U b)
{
  const DU du;
#if HWY_TARGET <= HWY_AVX3_DL
  return hn::Add(hn::PopulationCount(a), hn::PopulationCount(b));
#else
  // Of bytes by halves, from a table; then the sum of a lane's four bytes.
  const hn::Repartition<std::uint8_t, DU> bytes;
  alignas(
    16) constexpr std::uint8_t counts[16] = { 0, 1, 1, 2, 1, 2, 2, 3, 1, 2, 2, 3, 2, 3, 3, 4 };
  const auto table = hn::LoadDup128(bytes, counts);
  const U nibbles = hn::Set(du, 0x0f0f0f0f);
  const auto count = [&](U v)
  {
    return hn::Add(hn::TableLookupBytes(table, hn::BitCast(bytes, hn::And(v, nibbles))),
      hn::TableLookupBytes(table, hn::BitCast(bytes, hn::And(hn::ShiftRight<4>(v), nibbles))));
  };
  const U sums = hn::BitCast(du, hn::Add(count(a), count(b)));
  return hn::ShiftRight<24>(hn::Mul(sums, hn::Set(du, 0x01010101)));
#endif
}
}
}
HWY_AFTER_NAMESPACE();
#endif

#endif
