// Octrees of the poses of an animated mesh: those that a loop can use are kept.
#ifndef svoOctreeCache_h
#define svoOctreeCache_h

#include "svoOctree.h"
#include "svoOctreeLibrary.h"
#include "svoReuse.h"

#include <cstddef>
#include <list>

namespace svo
{
/// Not thread-safe: a filter's own.
class OctreeCache
{
public:
  struct Entry
  {
    OctreeKey key;
    Octree octree;
  };

  /// The entry, now the most recently used one; null if there is none, which is to be made and
  /// inserted then. Valid until the next call.
  const Entry* find(const OctreeKey& key);

  /// The entry of the same mesh in the same cube that was used last, of any level and leaf
  /// geometry; null if there is none. Valid until the next call.
  const Entry* latest(const OctreeKey& key) const;

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
