// Voxelisation: which voxels of which bricks a triangle touches.
#ifndef svoVoxelize_h
#define svoVoxelize_h

#include "vtkSVOOctreeModule.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>

#include <glm/vec3.hpp>

namespace svo
{
/// A triangle whose vertices are on the lattice of svoLattice.h.
struct LatticeTriangle
{
  /// [vertex][axis], lattice units. Plain arrays: indexing a glm vector with a variable is a
  /// branch.
  std::int32_t vertices[3][3];
  glm::dvec3 normal;   // unit length, of the triangle before it was snapped
  double offset = 0.0; // normal . vertex, in voxels
  std::uint32_t id = 0;
};

/// One triangle in one brick.
struct BrickRecord
{
  std::uint64_t key;      // Morton key of the brick
  std::uint64_t mask;     // the brick's voxels that the triangle touches, never 0
  std::uint32_t triangle; // id
  float offset; // of the triangle's plane from the brick's centre along its normal, voxels
};

/// Records one after another. Unlike std::vector it grows without clearing, and a push is inlined
/// into code of any instruction set.
class RecordList
{
public:
  void reserve(std::size_t capacity)
  {
    if (capacity > this->Capacity)
    {
      this->grow(capacity);
    }
  }
  void push(const BrickRecord& record)
  {
    assert(record.mask != 0);
    if (this->Size == this->Capacity)
    {
      this->grow(2 * this->Capacity + 64);
    }
    this->Items[this->Size++] = record;
  }
  std::size_t size() const { return this->Size; }
  const BrickRecord* begin() const { return this->Items.get(); }
  const BrickRecord* end() const { return this->Items.get() + this->Size; }

private:
  void grow(std::size_t capacity)
  {
    std::unique_ptr<BrickRecord[]> items(new BrickRecord[capacity]);
    std::copy(this->begin(), this->end(), items.get());
    this->Items = std::move(items);
    this->Capacity = capacity;
  }

  std::unique_ptr<BrickRecord[]> Items;
  std::size_t Size = 0;
  std::size_t Capacity = 0;
};

/// Appends the records of a triangle, in any order, each brick at most once; returns how many
/// voxels they name. Exact: a voxel is named if its closed box, grown by one lattice unit, has a
/// point in common with the triangle. Costs time in proportion to the bricks that are touched. A
/// large triangle can be done in `parts` disjoint parts.
VTKSVOOCTREE_EXPORT std::uint64_t voxelizeTriangle(const LatticeTriangle& triangle, int level,
  RecordList& records, std::uint32_t part = 0, std::uint32_t parts = 1);
}

#endif
