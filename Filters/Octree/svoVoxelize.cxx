#include "svoVoxelize.h"

#include "svoMorton.h"
#include "svoTriangleBox.h"

namespace svo
{
namespace
{
/// Voxels that the interval [low, high] touches with boxes grown by one unit.
void voxelRange(
  std::int32_t low, std::int32_t high, std::int32_t last, std::int32_t& first, std::int32_t& end)
{
  first = std::max((low - 2) >> LatticeBits, 0);
  end = std::min((high + 1) >> LatticeBits, last) + 1;
}

template <typename Int>
class Walker
{
public:
  Walker(const glm::ivec3 v[3], std::uint32_t id, int level, std::vector<BrickRecord>& records)
    : Test(v[0], v[1], v[2])
    , Id(id)
    , Records(records)
  {
    const std::int32_t last = (1 << level) - 1;
    for (int i = 0; i < 3; ++i)
    {
      voxelRange(this->Test.low()[i], this->Test.high()[i], last, this->First[i], this->End[i]);
    }
    int bits = 2;
    while (((this->End.x - 1) >> bits) - (this->First.x >> bits) > 1 ||
      ((this->End.y - 1) >> bits) - (this->First.y >> bits) > 1 ||
      ((this->End.z - 1) >> bits) - (this->First.z >> bits) > 1)
    {
      ++bits;
    }
    for (int z = this->First.z >> bits; z <= (this->End.z - 1) >> bits; ++z)
      for (int y = this->First.y >> bits; y <= (this->End.y - 1) >> bits; ++y)
        for (int x = this->First.x >> bits; x <= (this->End.x - 1) >> bits; ++x)
          this->visit(glm::ivec3(x, y, z), bits);
  }

private:
  bool touches(const glm::ivec3& cell, int bits) const
  {
    const int shift = bits + LatticeBits;
    const glm::ivec3 low((cell.x << shift) - 1, (cell.y << shift) - 1, (cell.z << shift) - 1);
    return this->Test.overlaps(low, low + ((1 << shift) + 2));
  }

  void visit(const glm::ivec3& cell, int bits)
  {
    if (!this->touches(cell, bits))
    {
      return;
    }
    if (bits > 2)
    {
      for (int i = 0; i < 8; ++i)
      {
        this->visit(cell * 2 + glm::ivec3(i & 1, i >> 1 & 1, i >> 2), bits - 1);
      }
      return;
    }
    std::uint64_t mask = 0;
    for (int i = 0; i < 64; ++i)
    {
      const glm::ivec3 voxel = cell * 4 + cellOfIndex(i);
      if (voxel.x < this->End.x && voxel.y < this->End.y && voxel.z < this->End.z &&
        this->touches(voxel, 0))
      {
        mask |= 1ull << i;
      }
    }
    if (mask)
    {
      this->Records.push_back({ mortonKey(cell.x, cell.y, cell.z), mask, this->Id });
    }
  }

  TriangleBox<Int> Test;
  std::uint32_t Id;
  std::vector<BrickRecord>& Records;
  glm::ivec3 First, End;
};
}

void voxelizeTriangle(
  const glm::ivec3 v[3], std::uint32_t id, int level, std::vector<BrickRecord>& records)
{
  const glm::ivec3 low = glm::min(glm::min(v[0], v[1]), v[2]);
  const glm::ivec3 high = glm::max(glm::max(v[0], v[1]), v[2]);
  const glm::ivec3 extent = high - low;
  if (std::max({ extent.x, extent.y, extent.z }) < 1 << 19)
  {
    Walker<std::int64_t>(v, id, level, records);
  }
  else
  {
    Walker<__int128>(v, id, level, records);
  }
}
}
