// What an instance looks like to a view.
#ifndef svoLayerKey_h
#define svoLayerKey_h

#include "svoLayout.h"

#include <cstdint>

#include <glm/mat4x4.hpp>

namespace svo
{
/// Equal keys give equal hits, bit for bit.
struct LayerKey
{
  std::uint64_t octree = 0; // Octree::id()
  glm::dmat4 localToWorld{ 1.0 };
  LeafGeometry leafGeometry = LeafGeometry::Automatic;
  int level = 0;

  bool operator==(const LayerKey& other) const
  {
    return octree == other.octree && localToWorld == other.localToWorld &&
      leafGeometry == other.leafGeometry && level == other.level;
  }
};
}

#endif
