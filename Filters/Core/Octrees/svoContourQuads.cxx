#include "svoContourQuads.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace svo
{
namespace
{
constexpr std::size_t ChunkBlocks = 128; // fixed, so that threads do not matter

/// countBits() of what is below a bit. Plain C++: without the processor's own instruction the
/// compiler would call a function.
std::uint32_t bitsBelow(std::uint64_t mask, int bit)
{
  std::uint64_t m = mask & (cellBit(bit) - 1);
  m -= m >> 1 & 0x5555555555555555ull;
  m = (m & 0x3333333333333333ull) + (m >> 2 & 0x3333333333333333ull);
  m = (m + (m >> 4)) & 0x0f0f0f0f0f0f0f0full;
  return static_cast<std::uint32_t>(m * 0x0101010101010101ull >> 56);
}

/// The cells of a block and those around it, in rows of six.
class Neighbourhood
{
public:
  static constexpr int Steps[3] = { 1, 6, 36 };

  explicit Neighbourhood(const CellPlanes& cells)
    : All(cells)
  {
    std::fill(std::begin(this->Index), std::end(this->Index), -1);
    std::fill(std::begin(this->Planes), std::end(this->Planes), CellPlane{ glm::vec3(0.0f), 0.0f });
    std::fill(std::begin(this->Signs), std::end(this->Signs), 0);
    for (int i = 0; i < 8; ++i)
    {
      const glm::ivec3 step(i & 1, i >> 1 & 1, i >> 2);
      this->Below[i] = step.x + Steps[1] * step.y + Steps[2] * step.z;
      this->Corners[i] = glm::vec3(step) - 0.5f;
    }
    const int edge = NodeEdge >> cells.above;
    for (int i = 0; i < 27; ++i)
    {
      const glm::ivec3 step(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      this->Near[i] = 0;
      for (int bit = 0; bit < edge * edge * edge; ++bit)
      {
        const glm::ivec3 at = edge * step + cellOfIndex(bit) + 1;
        const glm::ivec3 inside = glm::min(at, edge + 1 - at);
        const bool near = inside.x >= 0 && inside.y >= 0 && inside.z >= 0;
        this->Near[i] |= near ? cellBit(bit) : 0;
        this->Position[i][bit] = near ? at.x + Steps[1] * at.y + Steps[2] * at.z : 0;
      }
    }
  }

  void move(std::size_t block)
  {
    for (int i = 0; i < this->Count; ++i)
    {
      this->Index[this->Filled[i]] = -1;
      this->Planes[this->Filled[i]] = { glm::vec3(0.0f), 0.0f };
    }
    std::fill(std::begin(this->Signs), std::end(this->Signs), 0);
    this->Count = 0;
    std::uint32_t own = this->All.firsts[block];
    const std::uint32_t begin = this->All.octree.header().depthBegin[this->All.depth];
    for (int i = 0; i < 27; ++i)
    {
      const std::uint32_t node = this->All.blocks[block].around[i];
      if (node == CellBlock::None)
      {
        continue;
      }
      const std::uint64_t mask = this->All.masks[node - begin];
      const std::uint32_t first = this->All.firsts[node - begin];
      for (std::uint64_t left = mask & this->Near[i]; left != 0; left &= left - 1)
      {
        const int bit = lowestBit(left);
        const int at = this->Position[i][bit];
        const std::uint32_t index = i == CellBlock::Middle ? own++ : first + bitsBelow(mask, bit);
        this->Index[at] = static_cast<std::int32_t>(index);
        this->Planes[at] = this->All.planes[index];
        this->Filled[this->Count++] = at;
      }
    }
    this->Own = this->All.masks[block];
  }

  /// Calls visit(quad) for the quads around edges that begin in the block's cells.
  template <class Visit>
  void forEachQuad(const Visit& visit)
  {
    for (std::uint64_t left = this->Own; left != 0; left &= left - 1)
    {
      const int at = this->Position[CellBlock::Middle][lowestBit(left)];
      for (int a = 0; a < 3; ++a)
      {
        const int u = Steps[(a + 1) % 3], v = Steps[(a + 2) % 3];
        const Quad quad{ this->Index[at - u - v], this->Index[at - v], this->Index[at],
          this->Index[at - u] };
        if ((quad[0] | quad[1] | quad[3]) < 0)
        {
          continue;
        }
        const int low = this->sign(at), high = this->sign(at + Steps[a]);
        if (low != high)
        {
          visit(low < 0 ? quad : Quad{ quad[3], quad[2], quad[1], quad[0] });
        }
      }
    }
  }

private:
  /// -1: the lower corner of a cell lies behind the surface; 1: before it. A corner of an empty
  /// cell lies where that cell does, whose middle is further from the surface: cells on all sides
  /// of an empty one agree, and there are four cells around every edge between corners that do not.
  int sign(int at)
  {
    signed char& known = this->Signs[at];
    if (known == 0)
    {
      known = this->value(at) < 0.0f ? -1 : 1;
    }
    return known;
  }

  float value(int at) const
  {
    glm::vec3 normals(0.0f), away(0.0f);
    float sum = 0.0f;
    int empty = 0;
    for (int i = 0; i < 8; ++i)
    {
      const int cell = at - this->Below[i];
      const glm::vec3& corner = this->Corners[i];
      if (this->Index[cell] < 0)
      {
        away -= corner;
        ++empty;
        continue;
      }
      const CellPlane& plane = this->Planes[cell];
      normals += plane.normal;
      sum += glm::dot(plane.normal, corner) - plane.offset;
    }
    return empty > 0 ? sum + glm::dot(normals, away) / static_cast<float>(empty) : sum;
  }

  const CellPlanes& All;
  int Below[8];         // from a corner to the cells around it
  glm::vec3 Corners[8]; // where it lies in those
  std::uint64_t Near[27];
  int Position[27][NodeCells];
  std::int32_t Index[216];
  CellPlane Planes[216];
  signed char Signs[216];
  int Filled[216];
  int Count = 0;
  std::uint64_t Own = 0;
};
}

std::vector<std::vector<Quad>> quadsOf(
  const CellPlanes& cells, const ParallelFor& parallelFor, const CellFlags& used)
{
  std::vector<std::vector<Quad>> chunks((cells.blocks.size() + ChunkBlocks - 1) / ChunkBlocks);
  parallelFor(0, chunks.size(), 1,
    [&](std::size_t first, std::size_t last)
    {
      Neighbourhood near(cells);
      for (std::size_t c = first; c < last; ++c)
      {
        std::vector<Quad>& quads = chunks[c];
        const std::size_t begin = c * ChunkBlocks;
        const std::size_t end = std::min(begin + ChunkBlocks, cells.blocks.size());
        // A quad for each cell, about.
        const std::size_t cellsEnd = end < cells.blocks.size() ? cells.firsts[end] : cells.count;
        quads.reserve((cellsEnd - cells.firsts[begin]) * 9 / 8);
        for (std::size_t b = begin; b < end; ++b)
        {
          near.move(b);
          near.forEachQuad(
            [&](const Quad& quad)
            {
              quads.push_back(quad);
              for (const std::int32_t cell : quad)
              {
                used[cell].store(1, std::memory_order_relaxed);
              }
            });
        }
      }
    });
  return chunks;
}
}
