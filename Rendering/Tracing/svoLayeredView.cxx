#include "svoLayeredView.h"

#include "svoPlaceOnTriangles.h"

#include "svoIntersect.h"
#include "svoLeafGeometry.h"
#include "svoSelect.h"

#include <algorithm>
#include <limits>
#include <mutex>

namespace svo
{
namespace
{
/// Area of a triangle in the image, pixels, from which on tracing by tiles is quicker.
constexpr double LeastTrianglePixels = 0.5;
/// Where a tile sees more nodes than this its rays are walked one by one after all.
constexpr std::size_t MostTileNodes = 256;
/// Tiles along an edge of a group whose nodes are found together.
constexpr int GroupTiles = 4;
}

DepthLayer::DepthLayer(const PixelRect& r)
  : rect(r)
{
  const std::size_t tiles = static_cast<std::size_t>((r.x1 - r.x0) / 8) * ((r.y1 - r.y0) / 8);
  this->traced.resize(tiles);
  this->t.resize(64 * tiles);
  this->primitive.resize(64 * tiles);
}

bool endsFreely(const Instance& instance, int level)
{
  if (instance.leafGeometry == LeafGeometry::Voxel || !instance.octree.surface())
  {
    return true;
  }
  const bool inBrick = level >= instance.octree.level() - 2; // above, leaves are mean planes
  return inBrick &&
    (instance.leafGeometry == LeafGeometry::Triangle ||
      (instance.leafGeometry == LeafGeometry::Automatic &&
        instance.octree.longestList() <= ShortList));
}

bool worthTiles(const Instance& instance, const LocalView& local, const View& view)
{
  const Octree& octree = instance.octree;
  const bool exact = instance.leafGeometry == LeafGeometry::Triangle ||
    instance.leafGeometry == LeafGeometry::Automatic;
  if (!exact || !octree.surface() || local.stretched)
  {
    return false;
  }
  const double pixel = worldPixel(view, local.base + 0.5 * local.tMax);
  const double voxel = worldVoxel(instance) / pixel;
  const Header& h = octree.header();
  const double voxels = static_cast<double>(h.voxelCount) / static_cast<double>(h.triangleCount);
  return voxels * voxel * voxel >= LeastTrianglePixels;
}

bool sameRays(const View& a, const View& b)
{
  return a.origin == b.origin && a.originX == b.originX && a.originY == b.originY &&
    a.direction == b.direction && a.directionX == b.directionX && a.directionY == b.directionY &&
    a.tNear == b.tNear && a.tFar == b.tFar && a.width == b.width && a.height == b.height;
}

void LayeredView::release()
{
  this->Layers.clear();
  this->Memory = 0;
  this->Began = false;
}

void LayeredView::dropLayers(LayerBudget& budget)
{
  for (auto& kept : this->Layers)
  {
    kept.second.layer.reset();
  }
  budget.used -= this->Memory;
  this->Memory = 0;
}

void LayeredView::prepare(const Scene& scene, const View& view, bool keep, LayerBudget& budget)
{
  this->Bases.assign(scene.instances.size(), 0.0);
  this->Levels.assign(scene.instances.size(), 0);
  this->Geometries.clear();
  for (const Instance& instance : scene.instances)
  {
    this->Geometries.push_back(instance.leafGeometry);
  }
  // Layers are made for what stands still: something new is taken to do so, something that just
  // changed, or is seen by a view that did, is taken to go on changing.
  const bool moved = this->Began && !sameRays(view, this->Of);
  if (!keep || moved || budget.used > budget.limit)
  {
    this->dropLayers(budget);
  }
  if (!keep)
  {
    this->Layers.clear();
  }
  this->Of = view;
  this->Began = keep;
  for (auto& kept : this->Layers)
  {
    kept.second.used = false;
  }
  for (Entry& entry : this->Instances)
  {
    this->Bases[entry.index] = entry.local.base;
    this->Levels[entry.index] = entry.key.level;
    this->Geometries[entry.index] = entry.key.leafGeometry;
    if (!keep)
    {
      continue;
    }
    const auto inserted = this->Layers.try_emplace(entry.id);
    Kept& kept = inserted.first->second;
    if (kept.used) // two instances of one id: the first has the layer
    {
      continue;
    }
    kept.used = true;
    const bool changed = !inserted.second && !(kept.key == entry.key);
    kept.key = entry.key;
    if (changed && kept.layer)
    {
      this->Memory -= kept.layer->bytes();
      budget.used -= kept.layer->bytes();
      kept.layer.reset();
    }
    if (changed || moved)
    {
      continue;
    }
    if (!kept.layer)
    {
      auto layer = std::make_unique<DepthLayer>(entry.local.rect);
      if (budget.used + layer->bytes() <= budget.limit)
      {
        this->Memory += layer->bytes();
        budget.used += layer->bytes();
        kept.layer = std::move(layer);
      }
    }
    entry.layer = kept.layer.get();
  }
  for (auto kept = this->Layers.begin(); kept != this->Layers.end();)
  {
    if (kept->second.used)
    {
      ++kept;
      continue;
    }
    const std::size_t bytes = kept->second.layer ? kept->second.layer->bytes() : 0;
    this->Memory -= bytes;
    budget.used -= bytes;
    kept = this->Layers.erase(kept);
  }
}

bool LayeredView::findNodes(int tileX, int tileY, TileEntry& candidate) const
{
  const Entry& entry = *candidate.entry;
  const int groupX = tileX / GroupTiles, groupY = tileY / GroupTiles;
  if (groupX != candidate.groupX || groupY != candidate.groupY)
  {
    candidate.groupX = groupX;
    candidate.groupY = groupY;
    const TilePyramid all =
      makePyramid(entry.projection, this->Of, GroupTiles * groupX, GroupTiles * groupY, GroupTiles);
    candidate.groupFound = candidate.group.find(
      *entry.octree, all, candidate.tNear, candidate.tFar, GroupTiles * MostTileNodes);
  }
  if (candidate.groupFound)
  {
    candidate.group.select(candidate.pyramid, candidate.nodes);
    return candidate.nodes.size() <= MostTileNodes;
  }
  return findTileNodes(*entry.octree, candidate.pyramid, candidate.tNear, candidate.tFar,
    MostTileNodes, candidate.nodes);
}

bool LayeredView::meets(int tileX, int tileY, TileEntry& candidate) const
{
  const Entry& entry = *candidate.entry;
  const PixelRect& rect = entry.local.rect;
  if (8 * tileX < rect.x0 || 8 * tileX >= rect.x1 || 8 * tileY < rect.y0 || 8 * tileY >= rect.y1)
  {
    return false;
  }
  candidate.nodes.clear();
  if (!entry.tiles)
  {
    const TileIntervals& all = entry.layer ? entry.layer->intervals : entry.intervals;
    const std::size_t i = all.index(tileX, tileY);
    // Planes may be met a cell before the cube, but not before the near plane.
    candidate.tNear =
      std::max(all.tNear[i], static_cast<float>(std::min(this->Of.tNear - entry.local.base, 0.0)));
    candidate.tFar = std::min(all.tFar[i], entry.local.tMax);
    return candidate.tNear <= candidate.tFar;
  }
  candidate.tNear = 0.0f;
  candidate.tFar = entry.local.tMax;
  candidate.pyramid = makePyramid(entry.projection, this->Of, tileX, tileY);
  if (!this->findNodes(tileX, tileY, candidate))
  {
    candidate.nodes.clear();
    return true;
  }
  if (candidate.nodes.empty())
  {
    return false;
  }
  candidate.tNear = std::max(candidate.tNear, candidate.nodes.front().tNear);
  return true;
}

void LayeredView::order(int tileX, int tileY, TileScratch& scratch)
{
  scratch.order.clear();
  for (std::size_t e = 0; e < this->Instances.size(); ++e)
  {
    const Entry& entry = this->Instances[e];
    TileEntry& candidate = scratch.entries[e];
    candidate.entry = &entry;
    DepthLayer* layer = entry.layer;
    if (layer && layer->holds(tileX, tileY))
    {
      std::uint8_t& state = layer->traced[layer->index(tileX, tileY)];
      if (state == DepthLayer::Unknown && !this->meets(tileX, tileY, candidate))
      {
        state = DepthLayer::Empty;
      }
      if (state != DepthLayer::Empty)
      {
        // Kept layers first: they cost nothing and cut the others' rays.
        candidate.key = -std::numeric_limits<double>::infinity();
        scratch.order.push_back(&candidate);
      }
    }
    else if (!layer && this->meets(tileX, tileY, candidate))
    {
      candidate.key = entry.local.base + candidate.tNear;
      scratch.order.push_back(&candidate);
    }
  }
  // Then front to back.
  std::stable_sort(scratch.order.begin(), scratch.order.end(),
    [](const TileEntry* a, const TileEntry* b) { return a->key < b->key; });
}

void LayeredView::traceRays(const TileEntry& candidate, const double* x, const double* y,
  RayBlock& block, HitBlock& found) const
{
  const Entry& entry = *candidate.entry;
  const TraceOptions options{ entry.key.leafGeometry, entry.key.level };
  if (entry.local.stretched)
  {
    intersectStretched(*entry.octree, entry.local, x, y, block, options, found);
    return;
  }
  for (int i = 0; i < 64; ++i)
  {
    entry.local.fill(x[i], y[i], i, block);
  }
  if (!candidate.nodes.empty())
  {
    intersectTile(*entry.octree, candidate.pyramid, candidate.nodes, block, found);
    if (this->Exact)
    {
      placeOnTriangles(*entry.octree->surface(), entry.local, x, y, found);
    }
  }
  else
  {
    intersect(*entry.octree, block, options, found);
  }
}

bool LayeredView::cutRays(
  const TileEntry& candidate, const MergedTile& merged, RayBlock& block) const
{
  // A tie must survive the rounding. Plane leaves answer a ray that found nothing to its end with
  // the first cell that refused it, so there a ray is either not traced or traced to its own end.
  const Entry& entry = *candidate.entry;
  bool alive = false;
  for (int i = 0; i < 64; ++i)
  {
    if (merged.instance[i] != NoInstance)
    {
      const double cut = this->Bases[merged.instance[i]] + merged.t[i] - entry.local.base;
      if (entry.cuttable || cut < candidate.tNear)
      {
        const bool placed = this->Exact && !candidate.nodes.empty();
        const double reach = placed ? placingReach(entry.local) : 0.0;
        block.tMax[i] = std::min(block.tMax[i], roundUp(cut + reach));
      }
    }
    alive = alive || block.tMax[i] >= candidate.tNear;
  }
  return alive;
}

void LayeredView::merge(
  const Entry& entry, const float* t, const Primitive* primitive, MergedTile& merged) const
{
  // min(t), the smaller index where equal: any order of merging gives the same buffer. A NaN
  // compares false and never wins.
  for (int i = 0; i < 64; ++i)
  {
    if (primitive[i] == NoPrimitive)
    {
      continue;
    }
    if (!merged.any)
    {
      merged.any = true;
      std::fill(merged.instance, merged.instance + 64, NoInstance);
      std::fill(merged.primitive, merged.primitive + 64, NoPrimitive);
    }
    const std::uint32_t winner = merged.instance[i];
    const double mine = entry.local.base + t[i];
    const double other = winner != NoInstance ? this->Bases[winner] + merged.t[i] : 0.0;
    if (winner == NoInstance || mine < other || (mine == other && entry.index < winner))
    {
      merged.t[i] = t[i];
      merged.primitive[i] = primitive[i];
      merged.instance[i] = entry.index;
    }
  }
}

void LayeredView::traceTile(int tileX, int tileY, TileScratch& scratch)
{
  const std::size_t tile = static_cast<std::size_t>(tileY) * this->Merged.tilesX + tileX;
  MergedTile merged{ this->Merged.t.data() + 64 * tile, this->Merged.instance.data() + 64 * tile,
    this->Merged.primitive.data() + 64 * tile, false };
  RayBlock block;
  HitBlock found;
  double xs[64], ys[64];
  for (int i = 0; i < 64; ++i)
  {
    xs[i] = 8 * tileX + (i & 7) + 0.5;
    ys[i] = 8 * tileY + (i >> 3) + 0.5;
  }
  this->order(tileX, tileY, scratch);
  for (const TileEntry* next : scratch.order)
  {
    const TileEntry& candidate = *next;
    const Entry& entry = *candidate.entry;
    const auto fill = [&]
    {
      std::fill(block.tMin, block.tMin + 64, candidate.tNear);
      std::fill(block.tMax, block.tMax + 64, candidate.tFar);
    };
    if (!entry.layer)
    {
      fill();
      if (merged.any && !this->cutRays(candidate, merged, block))
      {
        continue;
      }
      traceRays(candidate, xs, ys, block, found);
      scratch.rays[&entry - this->Instances.data()] += 64;
      this->merge(entry, found.t, found.primitive, merged);
      continue;
    }
    // A layer is traced whole: it must stay true when what is before it goes away.
    const std::size_t k = entry.layer->index(tileX, tileY);
    float* keptT = entry.layer->t.data() + 64 * k;
    Primitive* keptPrimitive = entry.layer->primitive.data() + 64 * k;
    if (entry.layer->traced[k] == DepthLayer::Unknown)
    {
      entry.layer->traced[k] = DepthLayer::Traced;
      fill();
      traceRays(candidate, xs, ys, block, found);
      std::copy(found.t, found.t + 64, keptT);
      std::copy(found.primitive, found.primitive + 64, keptPrimitive);
      scratch.rays[&entry - this->Instances.data()] += 64;
    }
    this->merge(entry, keptT, keptPrimitive, merged);
  }
  this->Merged.hit[tile] = merged.any;
}

void LayeredView::sample(int tileX, int tileY, Samples& samples) const
{
  std::fill(samples.instance, samples.instance + 64, NoInstance);
  RayBlock block;
  HitBlock found;
  TileEntry candidate;
  for (const Entry& entry : this->Instances)
  {
    candidate.entry = &entry;
    candidate.groupX = tileX / GroupTiles; // no other tile of the group will ask
    candidate.groupY = tileY / GroupTiles;
    candidate.groupFound = false;
    if (!this->meets(tileX, tileY, candidate))
    {
      continue;
    }
    std::fill(block.tMin, block.tMin + 64, candidate.tNear);
    std::fill(block.tMax, block.tMax + 64, candidate.tFar);
    traceRays(candidate, samples.x, samples.y, block, found);
    for (int i = 0; i < 64; ++i)
    {
      const double t = entry.local.base + found.t[i];
      const bool nearer = samples.instance[i] == NoInstance || t < samples.t[i] ||
        (t == samples.t[i] && entry.index < samples.instance[i]);
      if (found.primitive[i] != NoPrimitive && nearer)
      {
        samples.t[i] = t;
        samples.instance[i] = entry.index;
        samples.primitive[i] = found.primitive[i];
      }
    }
  }
}

void LayeredView::trace(const ParallelFor& parallelFor, const std::uint8_t* wanted)
{
  this->Merged.resize(this->Of.width, this->Of.height);
  this->Rays = 0;
  this->Retraced = 0;
  PixelRect all{ this->Of.width, this->Of.height, 0, 0 };
  for (const Entry& entry : this->Instances)
  {
    const PixelRect& r = entry.local.rect;
    all = { std::min(all.x0, r.x0), std::min(all.y0, r.y0), std::max(all.x1, r.x1),
      std::max(all.y1, r.y1) };
  }
  if (all.empty())
  {
    return;
  }
  for (Entry& entry : this->Instances)
  {
    TileIntervals& intervals = entry.layer ? entry.layer->intervals : entry.intervals;
    if (!entry.tiles && intervals.tNear.empty())
    {
      computeTileIntervals(*entry.octree, entry.key.localToWorld, this->Of, entry.local.rect,
        { entry.key.leafGeometry, entry.key.level }, entry.local.base, parallelFor, intervals);
    }
  }
  const int tx0 = all.x0 / 8;
  const int tx1 = (all.x1 + 7) / 8;
  const int ty0 = all.y0 / 8;
  const int ty1 = (all.y1 + 7) / 8;
  const int gx0 = tx0 / GroupTiles;
  const int gy0 = ty0 / GroupTiles;
  const std::size_t columns = (tx1 + GroupTiles - 1) / GroupTiles - gx0;
  const std::size_t rows = (ty1 + GroupTiles - 1) / GroupTiles - gy0;
  std::vector<std::uint64_t> rays(this->Instances.size());
  std::mutex raysMutex;
  parallelFor(0, columns * rows, std::max<std::size_t>(columns / 8, 2),
    [&](std::size_t first, std::size_t last)
    {
      TileScratch mine;
      mine.entries.resize(this->Instances.size());
      mine.rays.resize(this->Instances.size());
      for (std::size_t group = first; group < last; ++group)
      {
        const int x0 = GroupTiles * (gx0 + static_cast<int>(group % columns));
        const int y0 = GroupTiles * (gy0 + static_cast<int>(group / columns));
        for (int tileY = std::max(y0, ty0); tileY < std::min(y0 + GroupTiles, ty1); ++tileY)
        {
          for (int tileX = std::max(x0, tx0); tileX < std::min(x0 + GroupTiles, tx1); ++tileX)
          {
            const std::size_t tile = static_cast<std::size_t>(tileY) * this->Merged.tilesX + tileX;
            if (!wanted || wanted[tile])
            {
              this->traceTile(tileX, tileY, mine);
            }
          }
        }
      }
      const std::lock_guard<std::mutex> lock(raysMutex);
      for (std::size_t e = 0; e < mine.rays.size(); ++e)
      {
        rays[e] += mine.rays[e];
      }
    });
  for (std::uint64_t r : rays)
  {
    this->Rays += r;
    this->Retraced += r > 0;
  }
}
}
