// The maps of a light, traced: what lies at their texels, and what is known of those who cast. What
// tests of points read (svoMapTest.h), however it was made.
#ifndef svoTracedMaps_h
#define svoTracedMaps_h

#include "svoHits.h"
#include "svoMapOpacities.h"
#include "svoMapTexels.h"
#include "svoSharedDepth.h"
#include "svoTexelPlace.h"
#include "svoTileOccluders.h"
#include "svoView.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace svo
{
struct TracedMap : MapGeometry
{
  explicit TracedMap(const Hits& traced)
    : hits(traced)
  {
  }

  const Hits& hits;
  bool seesCasters = false;
  // By index of the outline: of the instance, among those of all processes where depths are shared.
  // 0 of those that the map does not see: the level hangs on how wide its texels are.
  std::vector<double> casterVoxel;               // world, of the level that is traced
  std::vector<double> casterError;               // world
  double largestVoxel = 0.0, largestError = 0.0; // of them

  void findLargest()
  {
    const auto largest = [](const std::vector<double>& all)
    { return all.empty() ? 0.0 : *std::max_element(all.begin(), all.end()); };
    this->largestVoxel = largest(this->casterVoxel);
    this->largestError = largest(this->casterError);
  }
  SharedDepth shared;     // with other processes' casters; takes the place of the hits' depths
  MapOccluders occluders; // of the hits; unknown where depths are shared
  MapOpacities opacities; // unknown where each caster is equally opaque all over

  /// Where its occluders are known.
  MapTexels texels() const
  {
    const DepthBuffer& depth = this->hits.depth;
    return { depth.grid, this->occluders.tiles(), depth.t.data(), depth.instance.data() };
  }

  /// What lies in the tiles around points that are inside.
  TileOccluders around(const MapPlaces& places, float margin) const
  {
    return this->occluders.in(tilesOf(places, this->view, margin), this->hits.depth.grid);
  }

  /// True if something lies in a tile.
  bool holds(std::size_t tile) const
  {
    return this->shared.merged() ? this->shared.holds(tile) : this->hits.depth.hit[tile] != 0;
  }

  /// What lies at a texel (index as DepthBuffer::at): false if nothing.
  bool occluder(std::size_t at, std::uint32_t& caster, double& t) const
  {
    if (this->shared.merged())
    {
      return this->shared.at(at, caster, t);
    }
    const DepthBuffer& depth = this->hits.depth;
    assert(at >> 6 < depth.tiles());
    if (!depth.hit[at >> 6] || depth.instance[at] == NoInstance)
    {
      return false;
    }
    caster = depth.instance[at];
    t = this->hits.base(caster) + depth.t[at];
    return true;
  }
  bool occluder(const glm::ivec2& texel, std::uint32_t& caster, double& t) const
  {
    return this->occluder(this->hits.depth.at(texel.x, texel.y), caster, t);
  }
};

/// Where a point is looked up.
struct MapPlace
{
  const TracedMap* map = nullptr;
  std::size_t index = 0;   // among the maps
  double x = 0.0, y = 0.0; // texels
  double t = 0.0;          // linear depth of the point

  glm::ivec2 nearest() const { return glm::ivec2(static_cast<int>(x), static_cast<int>(y)); }
  /// Number i (1..3) of the other texels whose centres surround the point.
  glm::ivec2 neighbour(int i) const
  {
    assert(i >= 1 && i <= 3);
    const glm::ivec2 texel = this->nearest();
    const int dx = this->x - texel.x < 0.5 ? -1 : 1;
    const int dy = this->y - texel.y < 0.5 ? -1 : 1;
    return texel + glm::ivec2(i & 1 ? dx : 0, i & 2 ? dy : 0);
  }
};

struct TracedMaps
{
  std::vector<const TracedMap*> maps;
  // Of translucent casters.
  std::vector<float> casterOpacity; // by index, as in a map; without the alpha of colours
  float sameOpacity = -1.0f;        // of all casters, if it is; else negative
  /// Whether points are compared on their own planes.
  bool automaticBias = true;
  double bias = 0.0;

  /// `mapped`: colours make some of them translucent, too.
  void findSameOpacity(bool mapped);

  /// False if the point is outside of all maps, or its map sees no caster.
  bool lookUp(const glm::dvec3& position, MapPlace& place) const
  {
    for (std::size_t i = 0; i < this->maps.size(); ++i)
    {
      const TracedMap* map = this->maps[i];
      const TexelPlace at = texelPlace(*map, position);
      if (at.inside > 0.0)
      {
        place = { map, i, at.x, at.y, at.t };
        return map->seesCasters;
      }
    }
    return false;
  }
};
}

#endif
