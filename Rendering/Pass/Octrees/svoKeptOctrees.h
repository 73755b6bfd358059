// The octrees that a store has built, as many as fit into its memory.
#ifndef svoKeptOctrees_h
#define svoKeptOctrees_h

#include "svoOctree.h"
#include "svoOctreeLibrary.h"
#include "svoReuse.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>

namespace svo
{
struct KeptOctree
{
  Octree octree;               // empty if the build failed
  std::string message;         // not said yet
  std::uint64_t lastFrame = 0; // that used it
};

class KeptOctrees
{
public:
  /// Notes that the frame asks for an octree; `another`: of a mesh that has not asked for it
  /// before.
  void asked(const OctreeKey& key, bool another);

  bool has(const OctreeKey& key) const { return this->Octrees.count(key) > 0; }
  /// Null if there is none.
  KeptOctree* find(const OctreeKey& key);
  /// The octree to go on with while the right one is built: the coarsest that is deeper, or the
  /// deepest; null if there is none.
  KeptOctree* substitute(const OctreeKey& key);

  /// In the place of what has that key already.
  void keep(const OctreeKey& key, KeptOctree octree);

  /// Frees octrees that are not `owned` by a mesh. Where another mesh came later that looked the
  /// same, as with a reader that makes new ones for each time step, more are expected, and such
  /// octrees stay.
  void freeOrphans(const std::set<OctreeKey>& owned);
  /// Of those that `frame` did not use frees the ones that will be used last (svoReuse.h), until
  /// the rest fits into `memoryLimit` bytes.
  void shrink(std::size_t memoryLimit, std::uint64_t frame);
  void endFrame();

  std::size_t bytes() const { return this->Bytes; }
  /// Another number whenever an octree has come or gone.
  std::uint64_t version() const { return this->Version; }
  void clear();

private:
  using Iterator = std::map<OctreeKey, KeptOctree>::iterator;
  Iterator erase(Iterator octree);

  std::map<OctreeKey, KeptOctree> Octrees;
  std::size_t Bytes = 0;
  std::uint64_t Version = 0;
  ReuseHistory History;
  std::set<OctreeKey> Asked, AskedLast; // in this frame and in the one before
  std::set<OctreeKey> Orphaned;         // that were freed because their meshes were gone
  std::set<OctreeKey> Recurring;        // of those, octrees that another mesh had again
};
}

#endif
