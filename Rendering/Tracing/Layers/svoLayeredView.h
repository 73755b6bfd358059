// The depth layers of one view, one per instance ("Z-buffer depth table of an object" in Huang and
// Cheng, 2017), merged into a depth buffer; kept from frame to frame where nothing changed.
#ifndef svoLayeredView_h
#define svoLayeredView_h

#include "svoDepthBuffer.h"
#include "svoGroupLists.h"
#include "svoIntersectTile.h"
#include "svoLayerCache.h"
#include "svoMergedTiles.h"
#include "svoParallel.h"
#include "svoPixelFunctions.h"
#include "svoScene.h"
#include "svoTileBalls.h"
#include "svoTilePlanes.h"
#include "svoTriangleGroup.h"
#include "svoVisibleInstances.h"

#include <cassert>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace svo
{
/// What 64 rays anywhere in a tile see.
struct TileSamples
{
  double x[64]; // points of the image, all in one tile
  double y[64];
  double t[64]; // linear depth
  std::uint32_t instance[64];
  Primitive primitive[64];
};

class LayeredView
{
public:
  /// `exact`: hits of instances that are traced by tiles are placed in double
  /// (svoPlaceOnTriangles.h), and who is in front follows from window depths with their offsets
  /// (DepthOffset). A light's view can do without: its texels are wider than what
  /// the one mends, and the other is the window's.
  /// `moved`: the view takes the place of others, so it has no layers in its first frame.
  explicit LayeredView(bool exact = true, bool moved = false)
    : Exact(exact)
    , HasFrame(moved)
  {
  }

  /// Prepares a frame: finds the instances that the view sees (findVisible()) and the layers of
  /// them that are still true. Returns false if no instance can be seen.
  bool prepare(const Scene& scene, const View& view,
    const std::function<bool(const Instance&)>& takesPart, const LevelOf& levelOf, bool keep,
    LayerBudget& budget, const ParallelFor& parallelFor = serialFor);

  /// Traces and merges. With `wanted` (one byte a tile) only tiles marked there; others are left
  /// without hits, unless they are what they were.
  void trace(const ParallelFor& parallelFor, const std::uint8_t* wanted);
  /// False if the depth buffer is the one that it was before trace().
  bool changed() const { return this->Tiles.anyStale(); }
  /// Which of its tiles are.
  const MergedTiles& tiles() const { return this->Tiles; }

  /// Traces points of a tile, `count` times 64, through all instances; to be called after trace().
  void sample(int tileX, int tileY, TileSamples* samples, std::size_t count) const;

  /// Of the frames to come. The tree is to be that of the scene that prepare() gets. But for
  /// Culling::leastPixels it changes no bit.
  void setCulling(const Culling& culling) { this->Cull = culling; }
  /// The instances that the view sees.
  const VisibleSet& visibleSet() const { return this->Visible; }
  /// Of these, how many the last trace() did not have to look at: no tile was asked for that they
  /// reach into, or others hid them wherever one was.
  struct Spared
  {
    std::size_t unasked = 0, hidden = 0;
  };
  const Spared& spared() const { return this->NotLookedAt; }

  const DepthBuffer& depthBuffer() const { return this->Merged; }
  /// Base of an instance's t, by index into Scene::instances.
  double base(std::uint32_t instance) const
  {
    assert(instance < this->Bases.size());
    return this->Bases[instance];
  }
  int level(std::uint32_t instance) const { return this->Levels[instance]; }
  /// Whole tiles that may see the instance.
  PixelRect rect(std::uint32_t instance) const
  {
    const std::uint32_t entry = this->EntryOf[instance];
    const bool seen = entry < this->Instances.size() && this->Instances[entry].index == instance;
    return seen ? this->Instances[entry].local.rect : PixelRect();
  }
  /// What the instance's rays end on in this view.
  LeafGeometry leafGeometry(std::uint32_t instance) const { return this->Geometries[instance]; }
  /// True if all hits of the instance are placed in double.
  bool placed(std::uint32_t instance) const { return this->Placed[instance] != 0; }
  std::uint64_t rays() const { return this->Rays; }
  std::uint64_t retracedLayers() const { return this->Retraced; }
  std::size_t layerMemory() const { return this->Layers.memory(); }
  void release();
  /// Of a view that sees nothing: its depth buffer has no tiles until it is traced.
  void forget();

private:
  /// Tiles along an edge of a group whose nodes are found together.
  static constexpr int GroupTiles = GroupView::Tiles;
  /// Pixels of the rectangle of an instance from which on its layer may be kept. Smaller ones are
  /// traced again wherever something changes, so that what is kept goes with the picture and not
  /// with their number.
  static constexpr int SmallestLayer = 16 * 64;

  /// How the depth of an instance's hits is found once more, where it decides who is in front.
  enum class DepthRefinement : std::uint8_t
  {
    Never,
    OnTriangle, // hits lie on the triangles that they name
    Traced      // hits stand for triangles that have to be found
  };
  struct Entry : VisibleInstance
  {
    MeshPoints points;
    DepthRefinement refinement;
    DepthLayer* layer =
      nullptr;               // kept, or null: traced for this frame alone, cut at what is merged
    TileIntervals intervals; // where there is no layer
    // Of instances that are traced by tiles.
    PixelFunctions functions;
    RaySizes sizes;
  };
  /// The triangles of one or more instances in a group of tiles.
  struct FoundTriangles
  {
    TriangleGroup group;
    /// Planes of slots that were seen so far, and where among them a slot's lies, or -1; the first
    /// is of no slot.
    std::vector<SeenPlane> planes;
    std::vector<std::int32_t> planeOf;
    bool incomplete = false; // by an instance that could not be made ready

    void clear()
    {
      this->incomplete = false;
      this->group.clear();
      this->planes.clear();
      this->planeOf.clear();
    }
  };
  /// How an instance is traced in a group of tiles.
  enum class TraceMethod : std::uint8_t
  {
    Unknown,
    Together, // with others
    Alone,
    Rays // tile by tile
  };
  /// What became of an instance, bits.
  enum CullState : std::uint8_t
  {
    Asked = 1, // tiles are traced that it reaches into
    Looked = 2 // and it was not hidden there
  };
  /// An instance that a tile's rays may meet.
  struct TileEntry
  {
    const Entry* entry;
    double key; // order of tracing
    float tNear, tFar;
    TilePyramid pyramid;
    std::vector<TileNode> nodes; // empty: the rays are walked one by one, or known already
    TraceMethod method = TraceMethod::Unknown; // in the group
    bool hidden = false;                       // others hide all that the group sees of it
    FoundTriangles alone;                      // where this is the way
  };
  /// A ball that a group of tiles may see.
  struct BallEntry
  {
    const Entry* entry;
    std::uint32_t tiles; // of the group, row by row, a bit for each that may see it
    double base;
  };
  struct SeenHit
  {
    std::uint32_t instance;
    Primitive primitive;
    double t;            // linear depth
    double x, y;         // of the image
    float floatT = 0.0f; // t minus the instance's base, where that is asked for
  };
  struct MergedTile
  {
    float* t;
    std::uint32_t* instance;
    Primitive* primitive;
    bool any; // else nothing is written yet
  };
  /// What a thread keeps from tile to tile.
  struct TileScratch
  {
    std::vector<TileEntry> entries;       // at least those that reach into the group of tiles ...
    std::size_t nearby = 0;               // ... which are so many, front to back
    std::vector<TileEntry*> together;     // of these, in the same order
    std::vector<BallEntry> balls;         // front to back, not among `entries`
    std::vector<TileEntry*> order;        // those that the tile's rays may meet
    std::vector<std::uint64_t> rays;      // by index into Instances
    std::vector<std::uint8_t> cullStates; // by index into Instances: CullState
    /// By index into VisibleSet::nodes: twice what `asking` was when it was asked about, and 1 if
    /// it was hidden.
    std::vector<std::uint64_t> nodes;
    std::uint64_t asking = 0;

    // The group of tiles.
    int groupX, groupY;   // in tiles
    GroupWindow window;   // around those of its tiles that are asked for
    FoundTriangles found; // of those
    std::vector<GroupNode> groupNodes;
    // The tile.
    double deepest = 0.0; // of it, linear depth: nothing beyond is seen
    NearestTriangles nearest;
    std::vector<std::size_t> counted; // by index into Instances: the tile that rays has last
    TileBalls seenBalls;
    std::vector<SeenHit> hits;
    alignas(64) float t[64];
    alignas(64) std::uint32_t instance[64];
    alignas(64) Primitive primitive[64];

    /// What a rectangle of pixels, of which the window has some, has of the group.
    GroupWindow windowOf(const PixelRect& r) const
    {
      const auto inGroup = [](int pixel, int firstTile, int low, int high)
      { return static_cast<std::uint8_t>(std::clamp(pixel - 8 * firstTile, low, high)); };
      const GroupWindow& w = this->window;
      return { inGroup(r.x0, this->groupX, w.x0, w.x1), inGroup(r.x1 - 1, this->groupX, w.x0, w.x1),
        inGroup(r.y0, this->groupY, w.y0, w.y1), inGroup(r.y1 - 1, this->groupY, w.y0, w.y1) };
    }
    bool wants(const PixelRect& r) const
    {
      const int x = 8 * this->groupX, y = 8 * this->groupY;
      return r.x0 <= x + this->window.x1 && r.x1 > x + this->window.x0 &&
        r.y0 <= y + this->window.y1 && r.y1 > y + this->window.y0;
    }
  };
  void fill(const Scene& scene, const LevelOf& levelOf, Entry& entry, std::uint32_t index);
  void findIntervals(const ParallelFor& parallelFor);
  /// Traces and merges the tiles that are to be merged, all of which lie in `all`.
  void traceTiles(const PixelRect& all, const ParallelFor& parallelFor);
  /// Where the rays of a tile can meet an instance; false if nowhere.
  bool meets(int tileX, int tileY, TileEntry& candidate) const;
  /// Finds which tiles of a group are asked for; false if none.
  bool findWindow(std::size_t group, TileScratch& scratch) const;
  /// Finds the instances that reach into the window of a group of tiles, and the triangles of those
  /// that are traced together.
  void gather(std::size_t group, TileScratch& scratch) const;
  /// True if what there is in the group of tiles hides all that lies in a rectangle of the image
  /// beyond a linear depth.
  bool hides(const TileScratch& scratch, const PixelRect& rect, double depth) const;
  bool hidesNode(std::uint32_t node, TileScratch& scratch) const;
  /// True if it hides all that an instance has there.
  bool isHidden(const Entry& entry, TileScratch& scratch) const;
  /// How much nearer than its nearest corner a hit in what is `deep` from there on may be found,
  /// and by how much that of another instance may be off.
  double slack(double nearest, double deep) const
  {
    return 2e-3 * deep + 1e-5 * (std::abs(nearest) + std::abs(this->FromEye)) + this->LargestError;
  }
  /// Linear depth before which an instance has no hits.
  double before(const Entry& entry) const
  {
    return entry.local.base - this->slack(entry.local.base, entry.local.tMax);
  }
  /// Adds what a group of tiles may see of those that are traced together. False, and all is to be
  /// done once more, if one of them turned out to have to be traced by rays.
  bool findTogether(TileScratch& scratch) const;
  /// Adds what a group of tiles may see of an instance; false if it has to be traced by rays.
  bool findTriangles(const Entry& entry, TileScratch& scratch, FoundTriangles& found) const;
  /// What the triangles of the group give for a tile of it; false if nothing.
  bool nearestHits(
    int tileX, int tileY, FoundTriangles& found, TileScratch& scratch, MergedTile& hits) const;
  /// Traces a tile of an instance's kept layer, unless that has to be done by rays.
  void traceLayer(int tileX, int tileY, TileEntry& candidate, TileScratch& scratch);
  void placeHits(int tileX, int tileY, FoundTriangles& found, std::uint64_t& doubtful,
    const TileScratch& scratch, MergedTile& hits) const;
  void measureHits(int tileX, int tileY, const NearestTriangles& nearest, MergedTile& hits) const;
  /// Notes for each ball that a group of tiles may see which of the tiles do, front to back.
  void gatherBalls(TileScratch& scratch) const;
  /// Merges what a tile sees of balls, front to back.
  void mergeBalls(
    int tileX, int tileY, bool onlyChanged, TileScratch& scratch, MergedTile& merged) const;
  /// What a ray of the tile in scratch.nearest meets first, by the float test; false if nothing.
  bool traceDoubtful(double x, double y, int ray, TileScratch& scratch, SeenHit& first) const;
  void order(int tileX, int tileY, bool onlyChanged, TileScratch& scratch);
  /// Linear depth beyond which nothing of a tile is seen; infinity if there is no such.
  double deepest(const MergedTile& merged) const;
  bool cutRays(const TileEntry& candidate, const MergedTile& merged, RayBlock& block) const;
  /// Through points x, y of the image; tMin and tMax are set, and those with tMin > tMax are none.
  void traceRays(const TileEntry& candidate, const double* x, const double* y, RayBlock& block,
    HitBlock& found) const;
  /// By what it is decided who is in front, but for slopes: an instance's linear depth, but where
  /// offsets differ.
  double rank(std::uint32_t instance, double linearDepth) const
  {
    return this->Shifted ? this->Seen.windowDepth(linearDepth) + this->Offsets[instance].units
                         : linearDepth;
  }
  /// How the depths of an instance's hits are found again, and how far off they can be.
  DepthRefinement refinementOf(
    const Instance& instance, const VisibleInstance& visible, double& error) const;
  /// True if one hit of a ray is in front of another one: less deep, or as deep and of the larger
  /// index. An order of all hits, whatever they are compared with first.
  bool inFront(const SeenHit& a, const SeenHit& b) const
  {
    const double behind = a.t - b.t;
    if (!this->Shifted && std::abs(behind) > this->Errors[a.instance] + this->Errors[b.instance])
    {
      return behind < 0.0;
    }
    return this->settle(a, b);
  }
  bool settle(const SeenHit& a, const SeenHit& b) const;
  /// `primitive`: what the hit is found on; set to the triangle that it stands for.
  double exactDepth(const SeenHit& hit, Primitive& primitive) const;
  double exactRank(const SeenHit& hit) const;
  /// The linear depth beyond which a hit of `entry` cannot be in front of one of `other`.
  double lastDepth(const Entry& entry, std::uint32_t other, double t) const
  {
    if (this->Sloped)
    {
      return std::numeric_limits<double>::infinity(); // facets may be as steep as they like
    }
    double last = t + this->Errors[other];
    if (this->Shifted)
    {
      last = this->Seen.linearDepth(this->rank(other, last) - this->Offsets[entry.index].units);
    }
    return last + this->Errors[entry.index];
  }
  void merge(const Entry& entry, const float* t, const Primitive* primitive, const double* x,
    const double* y, MergedTile& merged) const;
  /// `onlyChanged`: those instances are merged into what the tile was in the last frame.
  void traceTile(int tileX, int tileY, bool onlyChanged, TileScratch& scratch);
  /// Does no more than what changed since the last frame asks for, and notes whether it is seen.
  void mergeTile(int tileX, int tileY, TileScratch& scratch);
  KeyBase keyBase() const;

  const bool Exact;
  View Seen;
  bool HasFrame = false; // Seen and Layers are those of a frame that keeps layers
  VisibleSet Visible;
  std::vector<std::uint32_t> Order;  // indices into Instances, front to back
  std::vector<std::uint32_t> NodeOf; // by index into Instances: index into VisibleSet::nodes
  std::vector<Entry> Instances;
  std::vector<double> Bases;
  std::vector<DepthOffset> Offsets;
  bool Shifted = false;    // offsets of visible instances differ
  bool WasShifted = false; // in the last frame
  bool Sloped = false;     // shifted, and by slopes, too
  std::vector<int> Levels;
  std::vector<LeafGeometry> Geometries;
  std::vector<std::uint8_t> Placed;
  std::vector<double> Errors; // of t; 0: who is in front follows from t as it is
  double LargestError = 0.0;  // of them
  double FromEye = 0.0;       // to where linear depths begin, of a view that is not parallel
  std::vector<std::uint32_t> EntryOf; // index into Instances
  KeyBase Keys;
  LayerCache Layers;
  DepthBuffer Merged;
  MergedTiles Tiles;             // of Merged
  std::vector<MergedPart> Parts; // memory for those of the next frame
  GroupLists Groups;             // of Instances
  Culling Cull;
  Spared NotLookedAt;
  std::vector<std::uint8_t> LastHit; // DepthBuffer::hit of the last frame
  std::uint64_t Rays = 0;
  std::uint64_t Retraced = 0;
};
}

#endif
