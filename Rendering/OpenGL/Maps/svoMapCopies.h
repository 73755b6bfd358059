// Which casters are drawn into which shadow maps, as svoMapCasters.glsl reads them.
#ifndef svoMapCopies_h
#define svoMapCopies_h

#include "svoBox.h"
#include "svoFrame.h"
#include "svoLightDetail.h"
#include "svoScene.h"
#include "svoView.h"
#include "svoWorldToOctree.h"

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include <glm/vec4.hpp>

namespace svo
{
/// An instance of a scene that casts, and what shaders know of it, as in svoRayWalk.glsl: its
/// octree and opacity; svoEnds::low and reach; svoEnds::high.
struct CasterInMemory
{
  std::size_t instance;
  glm::vec4 octree, low, high;
  WorldToOctree toOctree;
  Box box; // of the mesh, octree coordinates
};

/// A caster in a map.
struct MapCopy
{
  enum Shape
  {
    Triangles,
    Ball,
    Planes,
    Shapes
  };
  struct Record // in a shader's memory
  {
    glm::vec4 rows[4];
    glm::vec4 source;
    glm::vec4 octree, low, high;
  };

  int map;
  Shape shape;
  std::uint64_t octreeId;
  std::size_t instance;
  std::uint64_t version; // Instance::version
  PixelRect rect;        // texels that it may reach
  const Octree* octree;  // for a frame
  Record record;

  /// True if both are drawn at once.
  bool joins(const MapCopy& o) const
  {
    return this->map == o.map && this->shape == o.shape &&
      (this->shape != Triangles || this->octreeId == o.octreeId);
  }
  bool operator<(const MapCopy& o) const
  {
    return std::tie(this->map, this->shape, this->octreeId, this->instance) <
      std::tie(o.map, o.shape, o.octreeId, o.instance);
  }
};

/// What is to be drawn into which of a scene's maps, map by map, what is drawn at once together.
/// `lights`: what the maps are of. Says of the maps what they allow for, and their layers: those in
/// which something is seen have one, from 0 on.
std::vector<MapCopy> copiesIn(const Scene& scene, const std::vector<CasterInMemory>& casters,
  const std::vector<LightMaps>& lights, std::vector<ShadowMap>& maps);

/// By map, of so many: what holds all that is there once only, or was another one.
std::vector<PixelRect> changedParts(
  const std::vector<MapCopy>& before, const std::vector<MapCopy>& now, std::size_t maps);
}

#endif
