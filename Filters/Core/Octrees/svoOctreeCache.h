// Octrees of the poses of an animated mesh: those that a loop can use are kept.
#ifndef svoOctreeCache_h
#define svoOctreeCache_h

#include "svoOctree.h"
#include "svoReuse.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <list>

namespace svo
{
/// Not thread-safe: a filter's own.
class OctreeCache
{
public:
  struct Key
  {
    std::uint64_t signature; // of the mesh
    int level;
    LeafGeometry leafGeometry;
    std::array<double, 6> modelBounds; // of the whole that the mesh is a part of
    bool operator==(const Key& other) const
    {
      return signature == other.signature && level == other.level &&
        leafGeometry == other.leafGeometry && modelBounds == other.modelBounds;
    }
  };

  struct Entry
  {
    Key key;
    Octree octree;
  };

  /// The entry, now the most recently used one; null if there is none, which is to be made and
  /// inserted then. Valid until the next call.
  const Entry* find(const Key& key);

  /// The entry of the same mesh in the same cube that was used last, of any level and leaf
  /// geometry; null if there is none. Valid until the next call.
  const Entry* latest(std::uint64_t signature, const std::array<double, 6>& modelBounds) const;

  /// Keeps an octree, and lets go of others, those first that will be used last (svoReuse.h), until
  /// at most `limit` bytes are in use. An octree that is larger than the limit is not kept.
  void insert(Entry entry, std::size_t limit);

  /// Lets go of octrees until at most `limit` bytes are in use.
  void shrink(std::size_t limit);

  std::size_t bytes() const { return this->Bytes; }
  std::size_t size() const { return this->Entries.size(); }

private:
  std::list<Entry> Entries; // most recently used first
  std::size_t Bytes = 0;
  ReuseHistory History;
  ReuseHistory::Id Last = 0; // that was asked for
};
}

#endif
