// Nodes of an octree, one a lane.
#if defined(SVO_LANE_NODES_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef SVO_LANE_NODES_INL
#undef SVO_LANE_NODES_INL
#else
#define SVO_LANE_NODES_INL
#endif

#include "svoLaneMoves-inl.h"

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

/// The lanes' nodes: their masks' halves and their first children.
struct LaneNodes
{
  U low, high, first;
};

#if HWY_TARGET <= HWY_AVX3
HWY_INLINE LaneNodes loadNodes(const std::uint64_t* nodes, I node)
{
  const DI di;
  const DU du;
  // An empty block has no node to look at; any will do.
  const I at = hn::ShiftLeft<2>(hn::Max(node, hn::Zero(di)));
  const auto* words = reinterpret_cast<const std::uint32_t*>(nodes);
  return { gather(du, words, at), gather(du, words + 1, at), gather(du, words + 2, at) };
}
#else
/// The nodes of every fourth lane, side by side. The indices are volatile since compilers else know
/// the vector that they come from, and taking a vector to pieces is slower than loading them.
template <class D>
HWY_INLINE hn::Vec<D> loadEveryFourth(
  D d, const std::uint64_t* nodes, const volatile std::uint32_t* index)
{
  if constexpr (hn::MaxLanes(D()) == 2)
  {
    return hn::LoadU(d, nodes + *index);
  }
  else
  {
    const hn::Half<D> half;
    return hn::Combine(d, loadEveryFourth(half, nodes, index + hn::MaxLanes(D())),
      loadEveryFourth(half, nodes, index));
  }
}

/// Loads nodes whole, 16 bytes at a time, and transposes: one load a lane where gathers, which take
/// as long as single loads, need three. With AVX-512 it would be slower than they are.
HWY_INLINE LaneNodes loadNodes(const std::uint64_t* nodes, I node)
{
  const DI di;
  const DU du;
  const hn::RepartitionToWide<DU> wide;
  HWY_ALIGN std::uint32_t index[hn::MaxLanes(DI())]; // in words of 64 bits
  hn::Store(hn::BitCast(du, hn::ShiftLeft<1>(hn::Max(node, hn::Zero(di)))), du, index);
  const auto load = [&](int lane)
  { return hn::BitCast(du, loadEveryFourth(wide, nodes, index + lane)); };
  const U a = load(0);
  const U b = load(1);
  const U c = load(2);
  const U d = load(3);
  const auto pairs = [&](U v) { return hn::BitCast(wide, v); };
  const auto masksAB = pairs(hn::InterleaveLower(du, a, b));
  const auto masksCD = pairs(hn::InterleaveLower(du, c, d));
  const auto firstAB = pairs(hn::InterleaveUpper(du, a, b));
  const auto firstCD = pairs(hn::InterleaveUpper(du, c, d));
  return { hn::BitCast(du, hn::InterleaveLower(wide, masksAB, masksCD)),
    hn::BitCast(du, hn::InterleaveUpper(wide, masksAB, masksCD)),
    hn::BitCast(du, hn::InterleaveLower(wide, firstAB, firstCD)) };
}
#endif

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
