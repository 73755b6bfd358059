// One view of a scene: finds who is seen, and traces what their rays hit ("Z-buffer depth table of
// an object" and its merging in Huang and Cheng, 2017); kept from frame to frame where nothing
// changed.
#ifndef svoLayeredView_h
#define svoLayeredView_h

#include "svoGroupLists.h"
#include "svoHits.h"
#include "svoLayerCache.h"
#include "svoMergedTiles.h"
#include "svoParallel.h"
#include "svoScene.h"
#include "svoTileSampler.h"
#include "svoTracedInstances.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace svo
{
class LayeredView : public TileSampler
{
public:
  /// `exact`: hits of instances that are traced by tiles are placed in double
  /// (svoPlaceOnTriangles.h), and who is in front follows from window depths with their offsets
  /// (DepthOffset). A light's view can do without: its texels are wider than what
  /// the one mends, and the other is the window's.
  /// `moved`: the view takes the place of others, so it has no layers in its first frame.
  explicit LayeredView(bool exact = true, bool moved = false)
    : Instances(exact)
    , HasFrame(moved)
  {
  }
  LayeredView(const LayeredView&) = delete;
  LayeredView& operator=(const LayeredView&) = delete;

  /// Prepares a frame: finds the instances that the view sees (findVisible()) and the layers of
  /// them that are still true. Returns false if no instance can be seen.
  bool prepare(const Scene& scene, const View& view,
    const std::function<bool(const Instance&)>& takesPart, const LevelOf& levelOf, bool keep,
    LayerBudget& budget, const ParallelFor& parallelFor = serialFor);

  /// Traces and merges. With `wanted` (one byte a place of the view's TileGrid) only
  /// tiles marked there; others are left without hits, unless they are unchanged.
  void trace(const ParallelFor& parallelFor, const std::uint8_t* wanted);
  /// What was hit. Who is seen is true from prepare() on.
  const Hits& hits() const { return this->Seen; }

  /// To be called after trace().
  void sample(int tileX, int tileY, TileSamples* samples, std::size_t count) const override;

  /// Of the frames to come. The tree is to be that of the scene that prepare() gets. But for
  /// Culling::leastPixels it changes no bit.
  void setCulling(const Culling& culling) { this->Cull = culling; }
  /// The instances that the view sees.
  const VisibleSet& visibleSet() const { return this->Instances.set(); }
  /// Of these, how many the last trace() did not have to look at: no tile was asked for that they
  /// reach into, or others hid them wherever one was.
  struct Spared
  {
    std::size_t unasked = 0, hidden = 0;
  };
  const Spared& spared() const { return this->NotLookedAt; }

  std::uint64_t rays() const { return this->Rays; }
  std::uint64_t retracedLayers() const { return this->Retraced; }
  std::size_t layerMemory() const { return this->Layers.memory(); }
  void release();
  /// Of a view that sees nothing: its depth buffer has no tiles until it is traced.
  void forget();

private:
  void findLayers(LayerBudget& budget);
  void findIntervals(const ParallelFor& parallelFor);
  /// Finds the tiles that have changed.
  void findStale(const std::uint8_t* wanted);
  void traceTiles(const ParallelFor& parallelFor);
  /// Of those that turned out to be others.
  void noteVersions();

  TracedInstances Instances;
  Hits Seen{ {}, {}, 0, this->Instances };
  MergedTiles Tiles;       // which of them have changed
  bool HasFrame;           // hits and layers are those of a frame that keeps them
  bool WasShifted = false; // TracedInstances::shifted() of the last frame
  LayerCache Layers;
  std::vector<MergedPart> Parts; // memory for those of the next frame
  GroupLists Groups;             // of entries
  Culling Cull;
  Spared NotLookedAt;
  std::vector<std::uint8_t> LastHit; // DepthBuffer::hit of the last frame
  std::uint64_t Rays = 0;
  std::uint64_t Retraced = 0;
};
}

#endif
