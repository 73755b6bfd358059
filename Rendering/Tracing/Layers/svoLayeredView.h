// The depth layers of one view, one per instance ("Z-buffer depth table of an object" in Huang and
// Cheng, 2017), merged into a depth buffer; kept from frame to frame where nothing changed.
#ifndef svoLayeredView_h
#define svoLayeredView_h

#include "svoDepthBuffer.h"
#include "svoIntersectTile.h"
#include "svoLeafError.h"
#include "svoLocalView.h"
#include "svoParallel.h"
#include "svoProjection.h"
#include "svoScene.h"
#include "svoTileIntervals.h"
#include "vtkSVOTracingModule.h"

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace svo
{
/// What an instance looks like to a view. Equal keys give equal layers, bit for bit.
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

/// What all layers together may take, and take.
struct LayerBudget
{
  std::size_t limit = 0; // bytes
  std::size_t used = 0;  // bytes
};

/// A kept depth layer: the tiles of an instance's rectangle that somebody asked for so far.
struct DepthLayer
{
  PixelRect rect;
  std::vector<std::uint8_t> traced; // per tile of rect, a State
  RawArray<float> t;                // 64 per tile, of traced ones
  RawArray<Primitive> primitive;
  TileIntervals intervals; // of rect

  enum State : std::uint8_t
  {
    Unknown,
    Traced,
    Empty // traced, and nothing was there
  };

  explicit DepthLayer(const PixelRect& r);
  bool holds(int tileX, int tileY) const
  {
    return 8 * tileX >= this->rect.x0 && 8 * tileX < this->rect.x1 && 8 * tileY >= this->rect.y0 &&
      8 * tileY < this->rect.y1;
  }
  /// Index of a tile of the image, which must be one of the rectangle.
  std::size_t index(int tileX, int tileY) const
  {
    return static_cast<std::size_t>(tileY - this->rect.y0 / 8) *
      ((this->rect.x1 - this->rect.x0) / 8) +
      (tileX - this->rect.x0 / 8);
  }
  std::size_t bytes() const
  {
    return this->traced.size() * (1 + 2 * sizeof(float)) + this->t.size() * sizeof(float) +
      this->primitive.size() * sizeof(Primitive);
  }
};

/// What 64 rays anywhere in a tile see.
struct Samples
{
  double x[64]; // points of the image, all in one tile
  double y[64];
  double t[64]; // linear depth
  std::uint32_t instance[64];
  Primitive primitive[64];
};

/// True if an instance is to be traced tile by tile, to its triangles: those that its leaf geometry
/// leaves exact anyway, and no smaller in the image than about a pixel. Of `level` the tiles know
/// nothing: they are more accurate than any, and faster.
VTKSVOTRACING_EXPORT bool worthTiles(
  const Instance& instance, const LocalView& local, const View& view);

/// The level that rays of an instance really stop at: the last one where they would stop inside of
/// bricks whose triangles they test. They meet the same triangles, but pass bricks by that they
/// have nothing to look for in.
int deepened(const Instance& instance, int level);

class LayeredView
{
public:
  /// `exact`: hits of instances that are traced by tiles are placed in double
  /// (svoPlaceOnTriangles.h), and who is in front follows from window depths with their offsets
  /// (Instance::depthOffsetUnits). A light's view can do without: its texels are wider than what
  /// the one mends, and the other is the window's.
  explicit LayeredView(bool exact = true)
    : Exact(exact)
  {
  }

  /// Prepares a frame: folds the view into every instance that `takesPart`, picks levels, and
  /// keeps the layers that are still true. Returns false if no instance can be seen.
  /// `levelOf` gives the octree level of an instance's rays.
  template <class TakesPart, class LevelOf>
  bool begin(const Scene& scene, const View& view, TakesPart takesPart, LevelOf levelOf, bool keep,
    LayerBudget& budget)
  {
    this->Instances.clear();
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
    {
      const Instance& instance = scene.instances[i];
      if (!takesPart(instance) || !instance.octree || instance.octree.empty())
      {
        continue;
      }
      const LocalView local = makeLocalView(instance.octree, instance.localToWorld, view);
      if (!local.rect.empty())
      {
        const bool tiles = worthTiles(instance, local, view);
        const int level =
          tiles ? instance.octree.level() : deepened(instance, levelOf(instance, local));
        const LeafGeometry geometry = tiles ? LeafGeometry::Triangle : instance.leafGeometry;
        this->Instances.push_back({ i, instance.id, &instance.octree, local,
          makeProjection(instance.octree, instance.localToWorld, view, local.base),
          { instance.octree.id(), instance.localToWorld, geometry, level }, nullptr, {},
          tiles || endsFreely(instance, level), tiles });
      }
    }
    this->prepare(scene, view, keep, budget);
    return !this->Instances.empty();
  }

  /// Traces and merges. With `wanted` (one byte a tile) only tiles marked there; a tile that is not
  /// wanted is left without hits. What was merged last, of all tiles, stays where it would be the
  /// same.
  void trace(const ParallelFor& parallelFor, const std::uint8_t* wanted);
  /// False if the depth buffer is the one that it was before trace().
  bool changed() const { return this->Changed; }

  /// Traces points of a tile, `count` times 64, through all instances; to be called after trace().
  void sample(int tileX, int tileY, Samples* samples, std::size_t count) const;

  const DepthBuffer& depthBuffer() const { return this->Merged; }
  /// Base of an instance's t, by index into Scene::instances.
  double base(std::uint32_t instance) const { return this->Bases[instance]; }
  int level(std::uint32_t instance) const { return this->Levels[instance]; }
  /// What the instance's rays end on in this view.
  LeafGeometry leafGeometry(std::uint32_t instance) const { return this->Geometries[instance]; }
  /// True if all hits of the instance are placed in double.
  bool placed(std::uint32_t instance) const { return this->Placed[instance] != 0; }
  std::uint64_t rays() const { return this->Rays; }
  std::uint64_t retracedLayers() const { return this->Retraced; }
  std::size_t layerMemory() const { return this->Memory; }
  void release();

private:
  /// Tiles along an edge of a group whose nodes are found together.
  static constexpr int GroupTiles = 4;

  struct Entry
  {
    std::uint32_t index; // in Scene::instances
    std::uint64_t id;
    const Octree* octree;
    LocalView local;
    Projection projection;
    LayerKey key;
    DepthLayer* layer;       // kept, or null: traced for this frame alone, cut at what is merged
    TileIntervals intervals; // where there is no layer
    bool cuttable;           // a ray's hit does not depend on where the ray ends
    bool tiles;              // see worthTiles()
  };
  /// An instance that a tile's rays may meet.
  struct TileEntry
  {
    const Entry* entry;
    double key; // order of tracing
    float tNear, tFar;
    TilePyramid pyramid;
    std::vector<TileNode> nodes; // empty: the rays are walked one by one, or known already
    // Of a group of tiles that this one is part of.
    int groupX = -1, groupY = -1;
    bool groupFound = false;
    TileGroup group;
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
    std::vector<TileEntry> entries;  // by index into Instances
    std::vector<std::size_t> nearby; // of Instances: those that reach into the group of tiles
    std::vector<TileEntry*> order;   // those that the tile's rays may meet
    std::vector<std::uint64_t> rays; // by index into Instances
  };
  struct Kept
  {
    LayerKey key;
    std::unique_ptr<DepthLayer> layer; // null while the instance or the view moves
    bool used = false;
  };

  void prepare(const Scene& scene, const View& view, bool keep, LayerBudget& budget);
  void dropLayers(LayerBudget& budget);
  /// Where the rays of a tile can meet an instance; false if nowhere.
  bool meets(int tileX, int tileY, TileEntry& candidate) const;
  bool findNodes(int tileX, int tileY, TileEntry& candidate) const;
  /// Finds the instances that reach into a group of tiles.
  void gather(int firstTileX, int firstTileY, TileScratch& scratch) const;
  void order(int tileX, int tileY, TileScratch& scratch);
  bool cutRays(const TileEntry& candidate, const MergedTile& merged, RayBlock& block) const;
  /// Through points x, y of the image; tMin and tMax are set.
  void traceRays(const TileEntry& candidate, const double* x, const double* y, RayBlock& block,
    HitBlock& found) const;
  /// By what it is decided who is in front: an instance's linear depth, but where offsets differ.
  double rank(std::uint32_t instance, double linearDepth) const
  {
    return this->Shifted ? this->Of.windowDepth(linearDepth) + this->Offsets[instance]
                         : linearDepth;
  }
  void merge(
    const Entry& entry, const float* t, const Primitive* primitive, MergedTile& merged) const;
  void traceTile(int tileX, int tileY, TileScratch& scratch);
  /// True if Merged is what a frame's instances give; notes what it will be.
  bool isMerged(const std::uint8_t* wanted);

  const bool Exact;
  View Of;
  bool Began = false; // Of and Layers are a frame's
  std::vector<Entry> Instances;
  std::vector<double> Bases;
  std::vector<double> Offsets; // of window depths
  bool Shifted = false;        // offsets of visible instances differ
  std::vector<int> Levels;
  std::vector<LeafGeometry> Geometries;
  std::vector<std::uint8_t> Placed;
  std::unordered_map<std::uint64_t, Kept> Layers; // by Instance::id
  DepthBuffer Merged;
  /// What Merged shows, seen by MergedView; true of all tiles if MergedWhole.
  struct Part
  {
    std::uint32_t index;
    LayerKey key;
    double offset;
    bool operator==(const Part& other) const
    {
      return index == other.index && key == other.key && offset == other.offset;
    }
  };
  std::vector<Part> MergedParts;
  View MergedView;
  bool MergedWhole = false;
  bool Changed = true;
  std::uint64_t Rays = 0;
  std::uint64_t Retraced = 0;
  std::size_t Memory = 0;
};

/// True if the two views have the same rays.
bool sameRays(const View& a, const View& b);
}

#endif
