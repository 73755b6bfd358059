// The octrees of one owner, a render pass or a filter: as many as fit into its memory.
#ifndef svoOwnedOctrees_h
#define svoOwnedOctrees_h

#include "svoOctree.h"
#include "svoOctreeLibrary.h"
#include "svoReuse.h"
#include "vtkSVOCoreModule.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>

namespace svo
{
struct OwnedOctree
{
  Octree octree;             // empty if the build failed
  std::string message;       // not said yet
  std::uint64_t lastUse = 0; // of its owner that had it
};

/// An octree may have several owners, and counts in the bytes of each; it is there as long as it
/// has one. A use is a frame of a pass, or a mesh that a filter converts. Not thread-safe: an
/// owner's own.
class VTKSVOCORE_EXPORT OwnedOctrees
{
public:
  /// Notes that this use asks for an octree; `another`: of a mesh that has not asked for it before.
  void asked(const OctreeKey& key, bool another);

  bool has(const OctreeKey& key) const { return this->Octrees.count(key) > 0; }
  /// For this use. Null if there is none.
  OwnedOctree* find(const OctreeKey& key);
  /// For this use, the octree to go on with while the right one is built: the coarsest that is
  /// deeper, or the deepest; null if there is none.
  OwnedOctree* substitute(const OctreeKey& key);
  /// The octree of the same mesh in the same cube that was used last, of any level and leaf
  /// geometry; null if there is none.
  const OwnedOctree* latest(const OctreeKey& key) const;

  /// For this use, in the place of what has that key already.
  void keep(const OctreeKey& key, const Octree& octree, const std::string& message);
  /// True if there is one, if need be one that another owner has: then it is kept here, too.
  bool takeOver(const OctreeKey& key);
  /// As long as at most `limit` bytes are in use: others go before. An octree that is larger than
  /// the limit is not kept.
  void keepWithin(const OctreeKey& key, const Octree& octree, std::size_t limit);

  /// Frees octrees that are not `owned` by a mesh. Where another mesh came later that looked the
  /// same, as with a reader that makes new ones for each time step, more are expected, and such
  /// octrees stay.
  void freeOrphans(const std::set<OctreeKey>& owned);
  /// Frees the ones that will be used last (svoReuse.h), until the rest fits into `limit` bytes;
  /// `spare`: none that this use had.
  void shrink(std::size_t limit, bool spare);

  /// Counts uses.
  std::uint64_t use() const { return this->Use; }
  void nextUse();

  std::size_t bytes() const { return this->Bytes; }
  std::size_t size() const { return this->Octrees.size(); }
  /// Another number whenever an octree has come or gone.
  std::uint64_t version() const { return this->Version; }
  void clear();

private:
  using Iterator = std::map<OctreeKey, OwnedOctree>::iterator;
  Iterator erase(Iterator octree);

  std::map<OctreeKey, OwnedOctree> Octrees;
  std::size_t Bytes = 0;
  std::uint64_t Use = 1;
  std::uint64_t Version = 0;
  ReuseHistory History;
  std::set<OctreeKey> Asked, AskedLast; // in this use and in the one before
  std::set<OctreeKey> Orphaned;         // that were freed because their meshes were gone
  std::set<OctreeKey> Recurring;        // of those, octrees that another mesh had again
};
}

#endif
