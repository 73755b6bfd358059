// Which lanes of eight a mask has, as numbers of four bits: the first lane's in the lowest bits.
#ifndef svoCompressTable_h
#define svoCompressTable_h

#include <array>
#include <cstdint>

namespace svo
{
constexpr std::array<std::int32_t, 256> makeCompressTable()
{
  std::array<std::int32_t, 256> table{};
  for (int mask = 0; mask < 256; ++mask)
  {
    std::uint32_t lanes = 0;
    int count = 0;
    for (std::uint32_t lane = 0; lane < 8; ++lane)
    {
      if (mask >> lane & 1)
      {
        lanes |= lane << 4 * count++;
      }
    }
    table[mask] = static_cast<std::int32_t>(lanes);
  }
  return table;
}

inline constexpr std::array<std::int32_t, 256> CompressTable = makeCompressTable();
}

#endif
