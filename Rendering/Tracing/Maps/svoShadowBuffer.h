// The shadow buffer of one light: depth layers of the casters seen from the light, merged like the
// eye's, and the test of a visible point against it.
#ifndef svoShadowBuffer_h
#define svoShadowBuffer_h

#include "svoFrame.h"
#include "svoLayeredView.h"
#include "svoLightDetail.h"
#include "svoLightTile.h"
#include "svoMapOpacities.h"
#include "svoProcesses.h"
#include "svoScene.h"
#include "svoSeenReceivers.h"
#include "svoSharedDepth.h"
#include "svoSurfacePoint.h"
#include "svoTileOccluders.h"
#include "svoTilePatch.h"
#include "svoTileShadows.h"
#include "svoTranslucentGroups.h"

#include <atomic>
#include <cassert>
#include <memory>
#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
/// Tiles of a map.
inline std::size_t tilesIn(const View& map)
{
  return static_cast<std::size_t>((map.width + 7) / 8) * ((map.height + 7) / 8);
}

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
  /// Casters of its maps, each once a map, that trace() did not look at.
  std::size_t sparedCasters() const;

  /// How points are tested; prepare() does this, too.
  void setBias(const FrameSettings& settings)
  {
    this->AutomaticBias = settings.automaticBias;
    this->Bias = settings.bias;
    this->Around = settings.filters() ? AroundFilter : AroundTest;
  }

  /// Notes the 8x8 light tiles that the points of a patch will look up, and perhaps a few more.
  /// Thread-safe.
  void mark(const TilePatch& patch, std::uint16_t light, LightTiles& noted);
  /// A tile that was noted in the last frame, when the maps were the same.
  void mark(const LightTile& noted)
  {
    this->Faces[noted.map]->wanted[noted.tile].store(1, std::memory_order_relaxed);
  }
  /// True if the maps are those of the last frame, and what they show is tested alike.
  bool sameMaps() const { return this->SameMaps; }
  /// After trace(): true if the tile does not show what it showed.
  bool changed(const LightTile& noted) const
  {
    return this->Faces[noted.map]->layers.hits().tiles.changed(noted.tile);
  }
  bool wants(const LightTile& noted) const
  {
    return this->Faces[noted.map]->wanted[noted.tile].load(std::memory_order_relaxed) != 0;
  }
  /// Notes the tiles that knows() asks about a point.
  void note(const glm::dvec3& position, std::uint16_t light, RaisedTiles& noted) const;
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

  /// True if a caster lies between the light and the point. `error`: how far the point may lie from
  /// the surface that it stands for, world units.
  ///
  /// With the automatic bias texels are asked by shadowTest(), which says why it asks as it does.
  /// Without it the test is the paper's bare `distance > depth` plus `bias` voxels of the caster.
  bool shadows(const SurfacePoint& point, double error) const;

  /// The same of a patch's points, by pixel: those that are `asked` and dark.
  std::uint64_t shadows(const TilePatch& patch, double error, std::uint64_t asked) const;

  /// The share of the light that the point misses, 0..1: the test above, of every texel in a window
  /// around the point, weighted so that it changes smoothly with the point (percentage-closer
  /// filtering: Reeves et al., SIGGRAPH 1987; on the receiver's plane: Isidoro, "Shadow Mapping:
  /// GPU-based Tips and Techniques", GDC 2006). `extent`, world units: how wide a piece of the
  /// surface the point stands for; the window is three texels wide, more only where a piece is
  /// wider than a texel (TexelWindow).
  ///
  /// A texel's answer is that of a texel as large as it takes to hold the point: planes are
  /// followed, and the bend of the surface is allowed for, over the whole way. A nearby occluder
  /// does not count if it is the other side of a crease. Where the map is flat all texels say what
  /// one says, and the test of one is all there is. Without the automatic bias: 0 or 1, as the test
  /// above has it.
  float darkness(const SurfacePoint& point, double error, double extent) const;

  /// The same of a patch's points, by pixel: of those that are `asked`, 0 of others.
  void darkness(const TilePatch& patch, double error, const double* extents, std::uint64_t asked,
    float* darkness) const;

  /// Of a buffer of translucent casters: the share of the light that these take from a patch's
  /// points, by pixel, 0..1; of those that are `asked`, 0 of others. The test is that of shadows(),
  /// or of darkness() where there are `extents`, and each texel counts as much as what lies there
  /// is opaque.
  void taken(const TilePatch& patch, double error, const double* extents, std::uint64_t asked,
    float* taken) const;

  /// Whether points are compared on their own planes, see setBias().
  bool automaticBias() const { return this->AutomaticBias; }

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
  void release();

  /// Bytes of the maps, as they are now: tiles in which something lies, tables of all tiles, and
  /// copies. Not those of kept layers.
  std::size_t memory() const;

  std::uint64_t rays() const;
  std::uint64_t retracedLayers() const;
  std::size_t layerMemory() const;

private:
  struct Face
  {
    explicit Face(bool moved)
      : layers(/*exact=*/false, moved)
    {
    }

    View view;
    glm::dmat4 worldToClip{ 1.0 };
    TexelEdge edge;
    LayeredView layers;
    SharedDepth shared; // with other processes' casters; takes the place of the layers' depths
    std::vector<std::atomic<std::uint8_t>> wanted; // per tile
    bool seesCasters = false;
    MapOccluders occluders;             // of the layers; unknown where depths are shared
    MapOpacities opacities;             // unknown where each caster is equally opaque all over
    std::vector<std::uint8_t> received; // per tile: receivers may look it up; empty: all of them
    std::shared_ptr<const ShadowTexels> copied; // ShadowMap::texels; null: they have changed
    std::vector<std::uint8_t> copiedOf;         // the tiles that were received then

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
    bool want(const MapPlaces& places, float around, std::uint16_t light, std::uint16_t map,
      LightTiles& noted);
    /// Where its occluders are known.
    MapTexels texels() const
    {
      const DepthBuffer& depth = this->layers.hits().depth;
      return { depth.tilesX, this->occluders.nearest(), depth.t.data(), depth.instance.data() };
    }

    /// What lies in the tiles around points that are inside.
    TileOccluders around(const MapPlaces& places, float margin) const
    {
      return this->occluders.in(
        tilesOf(places, this->view, margin), this->layers.hits().depth.tilesX);
    }

    /// True if something lies in a tile.
    bool holds(std::size_t tile) const
    {
      return this->shared.merged() ? this->shared.holds(tile)
                                   : this->layers.hits().depth.hit[tile] != 0;
    }
    /// What lies at a texel (index as DepthBuffer::at): false if nothing.
    bool occluder(std::size_t at, std::uint32_t& caster, double& t) const
    {
      if (this->shared.merged())
      {
        return this->shared.at(at, caster, t);
      }
      const DepthBuffer& depth = this->layers.hits().depth;
      assert(at >> 6 < depth.tiles());
      if (!depth.hit[at >> 6] || depth.instance[at] == NoInstance)
      {
        return false;
      }
      caster = depth.instance[at];
      t = this->layers.hits().base(caster) + depth.t[at];
      return true;
    }
  };
  /// Where a point is looked up.
  struct Place
  {
    const Face* face = nullptr;
    double x = 0.0, y = 0.0; // texels
    double t = 0.0;          // linear depth of the point
    glm::ivec2 nearest() const { return glm::ivec2(static_cast<int>(x), static_cast<int>(y)); }
    /// Number i (1..3) of the other texels whose centres surround the point.
    glm::ivec2 neighbour(int i) const;
  };
  enum class Answer // of shadowTest()
  {
    Lit = 0,
    DarkNearby = 1, // by an occluder within NearbyReach texels' depth
    Dark = 2
  };
  /// What all texels say of all points of a patch: where everything is farther from the light than
  /// the points' planes are followed to, or all texels hold something that lies before what
  /// shadowTest() follows and allows at most, none of them needs to be looked up.
  enum class TileAnswer
  {
    Lit,
    Dark,
    Unknown
  };
  /// `around`: what lies there. `span`: of ask(), at most.
  TileAnswer answer(const Face& face, const MapPlaces& places, const TileOccluders& around,
    double error, double span = 1.0) const;
  /// What a texel's caster takes, 0..1; 0 where there is none.
  float opacity(const Face& face, const glm::ivec2& texel) const;
  /// The mean of that over what lies in a window.
  float opacity(const Place& place, double width) const;
  void findSameOpacity();
  void noteOpacities(const Scene& scene, const std::uint8_t* casters, std::uint8_t group);
  /// False if the point is outside of all faces, or its face sees no caster.
  bool lookUp(const glm::dvec3& position, Place& place) const;
  /// True if the texels around the place are.
  bool isTraced(const Place& place) const;
  /// Calls body(tile) for the light tiles of the texels that a point asks: one, two or four.
  template <class Body>
  void tilesAround(const Place& place, Body&& body) const;
  /// Calls body(name) for those around a point; not if it is outside of what is seen.
  template <class Body>
  void namesAround(const glm::dvec3& position, std::uint16_t light, Body&& body) const;
  /// Looks up what lies at the texels of points that are sure; returns those where something does.
  /// `theirs`: whose these texels are, all of them, or TileOccluders::Several.
  std::uint64_t occluders(const Face& face, const MapPlaces& places, std::uint32_t theirs,
    double error, TexelTests& tests) const;
  /// Tests these. Returns those that are dark; adds those that have to be tested in double.
  std::uint64_t test(const Face& face, const TilePatch& patch, const MapPlaces& places,
    double error, std::uint64_t& single) const;
  /// True if most of the other texels around the point find it dark as well.
  bool agreed(const Place& place, const SurfacePoint& point, double error) const;
  /// `span`: the size of the texel is taken for so many times what it is.
  Answer ask(const Place& place, const glm::ivec2& texel, const SurfacePoint& point, double error,
    double span = 1.0) const;
  bool shadows(const Place& place, const SurfacePoint& point, double error) const;
  // The filter; svoShadowFilter.cxx has it.
  /// Width of the box for a point that stands for `extent`, texels.
  static double boxWidth(const Place& place, double extent);
  /// The texels of the window hold nothing, or one surface without steps and creases.
  bool isFlat(const Place& place, double width) const;
  /// Of points that are sure, those around which it is, as far as patches can tell.
  std::uint64_t flat(const Face& face, const MapPlaces& places, const double* extents) const;
  /// What lies at a texel, followed to the point in the way that the map shows from the texel
  /// beyond, passes behind the point: it is the other side of a crease and no occluder.
  bool endsBefore(const Place& place, const glm::ivec2& texel, double error) const;
  /// `weighed`: by how opaque what lies at each texel is.
  float filtered(const Place& place, double width, const SurfacePoint& point, double error,
    bool weighed = false) const;

  /// How far from a point texels are asked, in texels: the test asks the four whose centres
  /// surround it; the filter's narrowest window reaches as far, and endsBefore() asks one beyond.
  static constexpr float AroundTest = 0.5f, AroundFilter = 2.0f;

  Culling Cull;
  std::vector<std::unique_ptr<Face>> Faces;
  // By index of the outline: of the instance, among those of all processes where depths are shared.
  std::vector<double> CasterVoxel; // world, of the level that is traced
  std::vector<double> CasterError; // world
  std::vector<glm::dmat4> CasterPlace;
  double LargestVoxel = 0.0, LargestError = 0.0; // of them
  // Of translucent casters.
  bool Translucent = false;
  std::vector<float> CasterOpacity;     // likewise by index; without the alpha of colours
  float SameOpacity = -1.0f;            // of all casters, if it is; else negative
  std::vector<Attributes> MappedColors; // of those whose alpha counts
  bool OtherOpacities = false;          // they are not what they were
  const Scene* Traced = nullptr;        // with these, until trace() is over
  bool AutomaticBias = true;
  double Bias = 0.0;
  float Around = AroundTest;
  bool SameMaps = false;
};
}

#endif
