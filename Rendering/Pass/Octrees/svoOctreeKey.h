// The name of an octree that is built from a mesh.
#ifndef svoOctreeKey_h
#define svoOctreeKey_h

#include "svoLayout.h"
#include "svoMeshOctree.h"
#include "svoReuse.h"

#include <cstdint>
#include <tuple>

namespace svo
{
struct OctreeKey
{
  std::uint64_t signature; // meshSignature()
  int level;
  LeafGeometry leafGeometry;

  bool operator<(const OctreeKey& other) const
  {
    return std::tie(this->signature, this->level, this->leafGeometry) <
      std::tie(other.signature, other.level, other.leafGeometry);
  }
  MeshOctreeOptions options() const
  {
    MeshOctreeOptions options;
    options.signature = this->signature;
    options.level = this->level;
    options.leafGeometry = this->leafGeometry;
    return options;
  }
  ReuseHistory::Id id() const
  {
    return this->signature ^
      (static_cast<std::uint64_t>(this->level) * 4 +
        static_cast<std::uint64_t>(this->leafGeometry)) *
      0x9e3779b97f4a7c15ull;
  }
};
}

#endif
