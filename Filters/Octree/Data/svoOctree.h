// A sparse voxel octree, ready to be traced: a layout buffer and the triangles it refers to, if it
// does.
#ifndef svoOctree_h
#define svoOctree_h

#include "svoKeptRepresentatives.h"
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

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// Whether a matrix may be an octree's frame: see svoLayout.h.
VTKSVOOCTREE_EXPORT bool isFrame(const glm::dmat4& matrix);

/// An immutable view; copying it is cheap. It keeps the memory it points into alive.
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

  explicit operator bool() const { return this->Data != nullptr; }
  const Header& header() const
  {
    assert(this->Data);
    return *reinterpret_cast<const Header*>(this->Data.get());
  }
  const Node* nodes() const
  {
    return reinterpret_cast<const Node*>(this->Data.get() + sizeof(Header));
  }
  const std::uint32_t* lists() const
  {
    return reinterpret_cast<const std::uint32_t*>(this->nodes() + this->header().nodeCount);
  }
  const Surface* surface() const { return this->Triangles.get(); }
  /// True if it has a plane for each voxel instead of triangles; it never has a surface then.
  bool hasPlanes() const { return this->header().leafWords != 0; }

  int level() const { return static_cast<int>(this->header().level); }
  int depthCount() const { return static_cast<int>(this->header().depthCount); }
  bool empty() const { return this->nodes()[0].mask == 0; }
  std::uint32_t brickBegin() const
  {
    return this->header().depthBegin[this->header().depthCount - 1];
  }
  /// Dense tables of the upper levels, for the block queries.
  const UpperLevels& upperLevels() const { return *this->Upper; }
  /// The highest nodes with few triangles, for the tile queries; only where there is a surface.
  const ShortLists& shortLists() const { return this->Lists->shortLists; }
  /// What rays have found out about voxels; keeps none where there is no surface.
  const KeptRepresentatives& representatives() const { return this->Lists->representatives; }
  /// Bytes of the buffer, the surface and all that is derived from them.
  std::size_t bytes() const;

  /// Edge of the root cube (octree coordinates [1, 2)) in the local frame.
  double rootEdge() const
  {
    return this->header().voxelSize * static_cast<double>(1u << (2 * this->header().depthCount));
  }
  /// True if the octree has a frame of its own: what is said below of the local frame holds there.
  bool hasFrame() const { return this->header().framed != 0; }
  /// The octree's own frame -> the local frame of the object; affine, invertible, 1 without a
  /// frame of its own. Whoever leaves octree coordinates for the object's applies it.
  glm::dmat4 frame() const;
  /// local frame -> octree coordinates: x -> 1 + (x - origin) / rootEdge. Affine.
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
  std::uint32_t longestList() const { return this->Longest; }

  /// Where the buffer lies: of two octrees that are open, those with the same key are the same.
  const void* key() const { return this->Data.get(); }
  /// Identity for caches that may outlive the octree: copies share it, and it is never given twice.
  std::uint64_t id() const { return this->Id; }
  /// The buffer and its owner, to share them.
  const std::shared_ptr<const std::byte>& data() const { return this->Data; }

private:
  friend class WeakOctree;
  struct FromLists
  {
    ShortLists shortLists;
    KeptRepresentatives representatives;
    std::size_t bytes() const { return this->shortLists.bytes() + this->representatives.bytes(); }
  };
  void derive(); // what is not stored

  std::shared_ptr<const std::byte> Data;
  std::size_t Size = 0;
  std::uint64_t Id = 0;
  std::uint32_t Longest = 0;
  std::shared_ptr<const Surface> Triangles;
  std::shared_ptr<const UpperLevels> Upper;
  std::shared_ptr<const FromLists> Lists;
};

/// Finds an open octree that has a surface, or planes, again, for as long as somebody keeps it.
class WeakOctree
{
public:
  WeakOctree() = default;
  explicit WeakOctree(const Octree& octree)
    : Data(octree.Data)
    , Size(octree.Size)
    , Id(octree.Id)
    , Longest(octree.Longest)
    , Triangles(octree.Triangles)
    , Upper(octree.Upper)
    , Lists(octree.Lists)
  {
  }
  bool expired() const { return this->Data.expired(); }
  /// Empty once no copy of the octree is left.
  Octree lock() const
  {
    Octree octree;
    octree.Data = this->Data.lock();
    octree.Size = this->Size;
    octree.Id = this->Id;
    octree.Longest = this->Longest;
    octree.Triangles = this->Triangles.lock();
    octree.Upper = this->Upper.lock();
    octree.Lists = this->Lists.lock();
    const bool whole =
      octree.Data && octree.Upper && octree.Lists && (octree.Triangles || octree.hasPlanes());
    return whole ? octree : Octree();
  }

private:
  std::weak_ptr<const std::byte> Data;
  std::size_t Size = 0;
  std::uint64_t Id = 0;
  std::uint32_t Longest = 0;
  std::weak_ptr<const Surface> Triangles;
  std::weak_ptr<const UpperLevels> Upper;
  std::weak_ptr<const Octree::FromLists> Lists;
};
}

#endif
