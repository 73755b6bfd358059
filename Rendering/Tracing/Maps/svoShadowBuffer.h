// The shadow buffer of one light: depth layers of the casters seen from the light, merged like the
// eye's. It makes the maps; points are tested against them by svoMapTest.h.
#ifndef svoShadowBuffer_h
#define svoShadowBuffer_h

#include "svoCulling.h"
#include "svoFrame.h"
#include "svoHits.h"
#include "svoLayerBudget.h"
#include "svoLightDetail.h"
#include "svoLightTile.h"
#include "svoProcesses.h"
#include "svoScene.h"
#include "svoSeenReceivers.h"
#include "svoSurfacePoint.h"
#include "svoTilePatch.h"
#include "svoTracedMaps.h"
#include "svoTranslucentGroups.h"

#include <atomic>
#include <memory>
#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
class LayeredView;

class ShadowBuffer
{
public:
  /// Prepares the layers of the light's maps, which are of the scene's outlines and those of other
  /// processes; `first`: of this scene's instances among all. `group`: of its casters, those that
  /// this is the buffer of; svoTranslucentGroups.h. The scene is borrowed until trace() is over.
  void prepare(const Scene& scene, const LightMaps& maps, std::size_t first,
    const FrameSettings& settings, LayerBudget& budget, std::uint8_t group = OpaqueCasters,
    const ParallelFor& parallelFor = serialFor);

  /// Of its layers, from prepare() on.
  void setCulling(const Culling& culling) { this->Cull = culling; }

  /// How points are tested; prepare() does this, too.
  void setBias(const FrameSettings& settings)
  {
    this->Tested.automaticBias = settings.automaticBias;
    this->Tested.bias = settings.bias;
    this->Around = settings.filters() ? AroundFilter : AroundTest;
  }

  /// Notes the 8x8 light tiles that the points of a patch will look up, and perhaps a few more.
  /// `name`: of the buffer. Thread-safe.
  void mark(const TilePatch& patch, BufferName name, LightTiles& noted);
  /// A tile that was noted in the last frame, when the maps were the same.
  void mark(const LightTile& noted)
  {
    this->Maps[noted.map]->wanted[noted.tile].store(1, std::memory_order_relaxed);
  }
  /// True if the maps are those of the last frame, and what they show is tested alike.
  bool sameMaps() const { return this->SameMaps; }
  /// After trace(): true if the tile does not show what it showed; Hits::changedSince().
  bool changedSince(const LightTile& noted, std::uint64_t version) const
  {
    return this->Maps[noted.map]->hits.changedSince(noted.tile, version);
  }
  bool wants(const LightTile& noted) const
  {
    return this->Maps[noted.map]->wanted[noted.tile].load(std::memory_order_relaxed) != 0;
  }
  /// Notes the tiles that knows() asks about a point.
  void note(const glm::dvec3& position, BufferName name, RaisedTiles& noted) const;
  /// What fragments of surfaces that are rasterised may look up.
  void mark(const SeenReceivers& receivers);
  /// Every tile will be looked up.
  void markAll();

  void trace(const ParallelFor& parallelFor);

  /// Merges what was traced, whole, with the other processes'. A collective call; `first`: index of
  /// this process's first instance among all. Of translucent casters the alpha of colours does not
  /// count any more.
  void merge(Processes& processes, std::size_t first);

  /// True if the texels around the point are traced: those of marked points are.
  bool knows(const glm::dvec3& position) const;

  /// What points are tested against, after trace().
  const TracedMaps& maps() const { return this->Tested; }

  /// What the buffer says of a point that nobody may have marked.
  struct MapAnswer
  {
    bool known = false;
    float darkness = 0.0f; // if known
    double texel = 0.0;    // the shorter edge of a texel there, world; 0 outside of the map
  };
  /// `extent`: of darkness(), or null: it is 0 or 1, by shadows().
  MapAnswer ask(const SurfacePoint& point, double error, const double* extent) const;

  /// `group`: ShadowMap::group.
  void copyMaps(int light, std::vector<ShadowMap>& maps, int group = 0);

  /// Bytes of the maps, as they are now: tiles in which something lies, tables of all tiles, and
  /// copies. Not those of kept layers.
  std::size_t memory() const;

  /// What trace() had to do: rays, layers, and casters, each once a map, that it did not look at.
  void addStatistics(FrameStatistics& statistics) const;
  std::size_t layerMemory() const;

private:
  struct Map
  {
    explicit Map(std::unique_ptr<LayeredView> view);
    ~Map();

    std::unique_ptr<LayeredView> layers;
    const Hits& hits; // theirs
    TileGrid grid;    // of the map's view, from prepare() on; the hits have it after trace()
    TracedMap traced{ this->hits };
    std::vector<std::atomic<std::uint8_t>> wanted; // per tile
    std::vector<std::uint8_t> received; // per tile: receivers may look it up; empty: all of them
    std::shared_ptr<const ShadowTexels> copied; // ShadowMap::texels; null: they have changed
    std::vector<std::uint8_t> copiedOf;         // the tiles that were received then
    std::uint64_t copiedFrom = 0;               // Hits::version

    bool isReceived(std::size_t tile) const { return received.empty() || received[tile] != 0; }
    /// True if `copied` has what receivers may look up.
    bool copySuffices() const;

    /// `ofCasters`: CasterOpacity; null of opaque ones.
    std::shared_ptr<const ShadowTexels> copy(
      double base, const std::vector<float>* ofCasters) const;
    /// Of a map that sees nothing.
    void forget();
    /// Bytes of its tables, of tiles in which something lies, and of the copy.
    std::size_t memory() const;
    /// Notes the tiles around points that are inside, of this map: few, or one by one. False if
    /// there are too many to be noted here.
    bool want(const MapPlaces& places, float around, BufferName name, std::uint8_t index,
      LightTiles& noted);
  };
  void arrangeMaps(const std::vector<View>& views, LayerBudget& budget);
  void noteOpacities(const Scene& scene, const std::uint8_t* casters, std::uint8_t group);
  /// True if the texels around the place are.
  bool isTraced(const MapPlace& place) const;
  /// Calls function(name) for the light tiles of the texels that a point asks: one, two or four.
  template <class Function>
  void tilesAround(const MapPlace& place, BufferName name, Function&& function) const;
  /// How far from a point texels are asked, in texels: the test asks the four whose centres
  /// surround it; the filter's narrowest window reaches as far, and endsBefore() asks one beyond.
  static constexpr float AroundTest = 0.5f, AroundFilter = 2.0f;

  Culling Cull;
  std::vector<std::unique_ptr<Map>> Maps;
  TracedMaps Tested; // of them
  std::vector<glm::dmat4> CasterPlace;
  // Of translucent casters.
  bool Translucent = false;
  std::vector<Attributes> MappedColors; // of those whose alpha counts
  bool OtherOpacities = false;          // they have changed
  const Scene* Traced = nullptr;        // with these, until trace() is over
  float Around = AroundTest;
  bool SameMaps = false;
};
}

#endif
