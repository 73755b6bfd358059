// A sparse voxel octree, ready to be traced: a layout buffer and the triangles it refers to, if it
// does.
#ifndef svoOctree_h
#define svoOctree_h

#include "svoBrickRepresentatives.h"
#include "svoLayout.h"
#include "svoNode.h"
#include "svoShortLists.h"
#include "svoSurface.h"
#include "svoUpperLevels.h"
#include "vtkSVOOctreeModule.h"

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// The root of the sum of a matrix's squares.
VTKSVOOCTREE_EXPORT double frobeniusNorm(const glm::dmat3& m);

/// Whether a matrix may be an octree's transform: see svoLayout.h.
VTKSVOOCTREE_EXPORT bool isTransform(const glm::dmat4& matrix);

/// A handle to an immutable octree: copies share it, and keep the memory that it points into alive.
class VTKSVOOCTREE_EXPORT Octree
{
public:
  Octree() = default;

  /// Opens `size` bytes at `data` (8-byte aligned). Every index is checked, so that a corrupt or
  /// hostile buffer is refused here and traversal needs no checks. On failure the result is empty
  /// and `error` says why. `surface` is null for an octree of planes, and may be null for one that
  /// is only queried, not traced with plane or triangle leaves. `data`'s owner stays alive as long
  /// as any copy does.
  static Octree open(std::shared_ptr<const std::byte> data, std::size_t size,
    std::shared_ptr<const Surface> surface, std::string& error);

  explicit operator bool() const { return this->Whole != nullptr; }
  const Header& header() const
  {
    assert(this->Whole);
    return *reinterpret_cast<const Header*>(this->Buffer);
  }
  const Node* nodes() const { return reinterpret_cast<const Node*>(this->Buffer + sizeof(Header)); }
  const std::uint32_t* lists() const
  {
    return reinterpret_cast<const std::uint32_t*>(this->nodes() + this->header().nodeCount);
  }
  const Surface* surface() const { return this->Whole ? this->Whole->surface.get() : nullptr; }
  /// True if it has a plane for each voxel instead of triangles; it never has a surface then.
  bool hasPlanes() const { return this->header().leafWords != 0; }
  /// How far the planes of voxels are seen beyond their voxels, in voxels.
  double planeReach() const
  {
    const std::uint32_t reach = this->header().planeReach;
    return (reach != 0 ? reach : LongestReach) / 16.0;
  }

  int level() const { return static_cast<int>(this->header().level); }
  int depthCount() const { return static_cast<int>(this->header().depthCount); }
  /// Bits of a cell's coordinate in the root cube, of a level.
  int rootBits(int ofLevel) const
  {
    return ofLevel + NodeLevels * this->depthCount() - this->level();
  }
  /// The level whose cells are the bricks; negative where the only brick is larger than the cube.
  int brickLevel() const { return this->level() - NodeLevels; }
  bool empty() const { return this->nodes()[0].mask == 0; }
  std::uint32_t brickBegin() const
  {
    return this->header().depthBegin[this->header().depthCount - 1];
  }
  /// Dense tables of the upper levels, for the block queries.
  const UpperLevels& upperLevels() const { return this->Whole->upper; }
  /// The highest nodes with few triangles, for the tile queries; only where there is a surface.
  const ShortLists& shortLists() const { return this->Whole->shortLists; }
  /// What rays have found out about voxels; keeps none where there is no surface.
  const BrickRepresentatives& representatives() const { return this->Whole->representatives; }
  /// Bytes of the buffer, the surface and all that is derived from them; 0 of no octree.
  std::size_t bytes() const;

  /// Edge of the root cube (octree coordinates [1, 2)) in the local coordinates.
  double rootEdge() const
  {
    return this->header().voxelSize * static_cast<double>(1u << this->rootBits(this->level()));
  }
  /// True if the octree has coordinates of its own: what is said below of local ones holds of
  /// these.
  bool hasTransform() const { return this->header().transformed != 0; }
  /// The octree's own coordinates -> the local coordinates of the object; affine, invertible, 1 if
  /// they are one. Whoever leaves octree coordinates for the object's applies it.
  glm::dmat4 transform() const;
  /// local coordinates -> octree coordinates: x -> 1 + (x - origin) / rootEdge. Affine.
  glm::dmat4 localToOctree() const;

  /// True if `cell` (integer coordinates at `level`, 0..level()) is occupied. False outside.
  bool occupied(glm::ivec3 cell, int level) const;

  /// Index in lists() of the plane of voxel `i` of a brick, which is the voxel's number; of an
  /// octree of planes.
  std::uint32_t planeOf(std::uint32_t brick, int i) const
  {
    assert(this->hasPlanes() && brick >= this->brickBegin() && brick < this->header().nodeCount);
    const Node& node = this->nodes()[brick];
    assert(hasChild(node, i));
    return node.first + PlaneWords * static_cast<std::uint32_t>(childrenBefore(node, i));
  }

  /// The same of the first voxel below a node.
  std::uint32_t firstPlane(std::uint32_t node) const
  {
    assert(this->hasPlanes() && !this->empty());
    while (node < this->brickBegin())
    {
      node = this->nodes()[node].first;
    }
    return this->nodes()[node].first;
  }

  /// The triangles of a brick (index of a node of the last depth): begin and count. A single
  /// inline id is written to `inlineId` and pointed at. Not of an octree of planes.
  const std::uint32_t* brickTriangles(
    std::uint32_t brick, std::uint32_t& count, std::uint32_t& inlineId) const
  {
    assert(!this->hasPlanes());
    assert(brick >= this->brickBegin() && brick < this->header().nodeCount);
    const std::uint32_t reference = this->nodes()[brick].first;
    if (reference & InlineTriangle)
    {
      inlineId = reference & ~InlineTriangle;
      count = 1;
      return &inlineId;
    }
    const std::uint32_t* list = this->lists() + reference;
    count = list[0];
    return list + 1;
  }

  /// Triangles of the brick that has most; 0 in an empty octree.
  std::uint32_t longestList() const { return this->Whole ? this->Whole->longest : 0; }

  /// Where the buffer lies: of two octrees that are open, those with the same key are the same.
  const void* key() const { return this->Whole ? this->Buffer : nullptr; }
  /// Identity for caches that may outlive the octree: copies share it, and it is never given twice.
  /// 0 of no octree.
  std::uint64_t id() const { return this->Whole ? this->Whole->id : 0; }
  /// The buffer and its owner, to share them. Not of no octree.
  const std::shared_ptr<const std::byte>& data() const { return this->Whole->data; }

private:
  friend class WeakOctree;
  struct Parts
  {
    std::shared_ptr<const std::byte> data;
    std::size_t size = 0; // of the data
    std::uint64_t id = 0;
    std::uint32_t longest = 0;
    std::shared_ptr<const Surface> surface;
    // What is not stored.
    UpperLevels upper;
    ShortLists shortLists;
    BrickRepresentatives representatives;
  };

  std::shared_ptr<const Parts> Whole;
  const std::byte* Buffer = nullptr; // of the whole; rays ask for nothing else as often
};

/// Finds an open octree that has a surface, or planes, again, for as long as somebody keeps it.
class WeakOctree
{
public:
  WeakOctree() = default;
  explicit WeakOctree(const Octree& octree)
    : Whole(octree.Whole)
  {
  }
  bool expired() const { return this->Whole.expired(); }
  /// Empty once no copy of the octree is left.
  Octree lock() const
  {
    Octree octree;
    octree.Whole = this->Whole.lock();
    if (!octree.Whole)
    {
      return {};
    }
    octree.Buffer = octree.Whole->data.get();
    return octree.Whole->surface || octree.hasPlanes() ? octree : Octree();
  }

private:
  std::weak_ptr<const Octree::Parts> Whole;
};
}

#endif
