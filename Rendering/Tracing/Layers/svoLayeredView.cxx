#include "svoLayeredView.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <mutex>

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
/// Rectangles with fewer pixels have layers only while all of these together have no more than
/// twice the picture's: what is kept goes with the picture, not with the number of instances.
constexpr int CrowdsLayer = 128 * 128;

int pixelsOf(const PixelRect& r)
{
  return (r.x1 - r.x0) * (r.y1 - r.y0);
}
}

void LayeredView::release()
{
  this->Layers.clear();
  this->HasFrame = false;
  this->Tiles.forget();
}

void LayeredView::forget()
{
  this->Merged = DepthBuffer();
  this->LastHit = {};
  this->Tiles.forget();
}

bool LayeredView::prepare(const Scene& scene, const View& view,
  const std::function<bool(const Instance&)>& takesPart, const LevelOf& levelOf, bool keep,
  LayerBudget& budget, const ParallelFor& parallelFor)
{
  const std::size_t count = scene.instances.size();
  this->Bases.assign(count, 0.0);
  this->Levels.assign(count, 0);
  this->Placed.assign(count, 0);
  this->Errors.assign(count, 0.0);
  this->EntryOf.assign(count, 0);
  this->Geometries.clear();
  this->Offsets.clear();
  for (const Instance& instance : scene.instances)
  {
    this->Geometries.push_back(instance.body->leafGeometry);
    this->Offsets.push_back(instance.depthOffset);
  }
  this->Layers.beginFrame(keep, this->HasFrame && !sameRays(view, this->Seen), budget);
  this->Seen = view;
  this->HasFrame = keep;
  findVisible(scene, view, this->Cull, takesPart, parallelFor, this->Visible);
  const std::vector<std::uint32_t>& visible = this->Visible.visible;
  this->Instances.resize(visible.size()); // what others have allocated is of use to these
  parallelFor(0, visible.size(), 64,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t e = first; e < last; ++e)
      {
        this->EntryOf[visible[e]] = static_cast<std::uint32_t>(e);
        this->fill(scene, levelOf, this->Instances[e], visible[e]);
      }
    });
  this->Order.resize(visible.size());
  this->NodeOf.resize(visible.size());
  for (std::size_t k = 0; k < visible.size(); ++k)
  {
    this->Order[k] = this->EntryOf[this->Visible.order[k]];
    this->NodeOf[this->Order[k]] = this->Visible.nodeOf[k];
  }
  this->FromEye = view.parallel
    ? 0.0
    : glm::dot(view.originX, view.directionX) / glm::dot(view.directionX, view.directionX);
  this->LargestError = 0.0;
  for (const Entry& entry : this->Instances)
  {
    this->LargestError = std::max(this->LargestError, this->Errors[entry.index]);
  }
  double ofCrowd = 0.0;
  for (const Entry& entry : this->Instances)
  {
    const int pixels = pixelsOf(entry.local.rect);
    ofCrowd += pixels >= SmallestLayer && pixels < CrowdsLayer ? pixels : 0;
  }
  const int smallest = ofCrowd > 2.0 * view.width * view.height ? CrowdsLayer : SmallestLayer;
  for (Entry& entry : this->Instances)
  {
    const bool large = pixelsOf(entry.local.rect) >= smallest && !entry.ball;
    entry.layer =
      large ? this->Layers.layerOf(entry.id, entry.key, entry.local.rect, budget) : nullptr;
  }
  this->Keys = this->keyBase();
  this->Layers.endFrame(budget);
  const bool compared = this->Exact && this->Instances.size() > 1;
  this->Sloped = compared &&
    std::any_of(this->Instances.begin(), this->Instances.end(),
      [this](const Entry& entry) { return this->Offsets[entry.index].factor != 0.0f; });
  this->Shifted = this->Sloped ||
    (compared &&
      std::any_of(this->Instances.begin(), this->Instances.end(),
        [this](const Entry& entry)
        { return this->Offsets[entry.index] != this->Offsets[this->Instances[0].index]; }));
  return !this->Instances.empty();
}

/// Makes an instance's entry.
void LayeredView::fill(
  const Scene& scene, const LevelOf& levelOf, Entry& entry, std::uint32_t index)
{
  static_cast<VisibleInstance&>(entry) =
    seenInstance(scene, index, this->Seen, levelOf, this->Exact);
  const Instance& instance = scene.instances[index];
  this->Bases[index] = entry.local.base;
  this->Levels[index] = entry.key.level;
  this->Geometries[index] = entry.key.leafGeometry;
  this->Placed[index] = this->Exact && entry.tiles;
  entry.points = instance.body->points;
  entry.refinement = this->refinementOf(instance, entry, this->Errors[index]);
  entry.intervals.tNear.clear();
  if (entry.tiles && !entry.ball)
  {
    entry.functions = PixelFunctions(entry.local, this->Seen);
    entry.sizes = RaySizes(entry.local, this->Seen);
  }
}

KeyBase LayeredView::keyBase() const
{
  const double infinity = std::numeric_limits<double>::infinity();
  double nearest = infinity, farthest = -infinity;
  for (const Entry& entry : this->Instances)
  {
    if (entry.tiles && !entry.ball && entry.functions.valid)
    {
      const double begin = this->Seen.parallel ? entry.local.base : entry.functions.wBase;
      nearest = std::min(nearest, begin);
      farthest = std::max(farthest, begin + entry.local.tMax);
    }
  }
  if (nearest > farthest)
  {
    return {};
  }
  // Floats, so that they can be handed on without loss.
  return this->Seen.parallel ? KeyBase{ static_cast<float>(0.5 * (nearest + farthest)), false }
                             : KeyBase{ static_cast<float>(farthest), farthest > 2.0 * nearest };
}

/// Of instances whose rays are walked.
void LayeredView::findIntervals(const ParallelFor& parallelFor)
{
  const auto find = [this](Entry& entry, const ParallelFor& loops)
  {
    TileIntervals& intervals = entry.layer ? entry.layer->intervals : entry.intervals;
    if (!entry.tiles && intervals.tNear.empty())
    {
      computeTileIntervals(*entry.octree, entry.key.localToWorld, this->Seen, entry.local.rect,
        { entry.key.leafGeometry, entry.key.level }, entry.local.base, loops, intervals);
    }
  };
  constexpr int Small = 64; // pixels
  const auto isSmall = [](const Entry& entry)
  { return entry.local.rect.y1 - entry.local.rect.y0 <= Small; };
  parallelFor(0, this->Instances.size(), 32,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t e = first; e < last; ++e)
      {
        if (isSmall(this->Instances[e]))
        {
          find(this->Instances[e], serialFor);
        }
      }
    });
  for (Entry& entry : this->Instances)
  {
    if (!isSmall(entry))
    {
      find(entry, parallelFor);
    }
  }
}

void LayeredView::trace(const ParallelFor& parallelFor, const std::uint8_t* wanted)
{
  this->Rays = 0;
  this->Retraced = 0;
  this->NotLookedAt = { this->Instances.size(), 0 };
  PixelRect all{ this->Seen.width, this->Seen.height, 0, 0 };
  for (const Entry& entry : this->Instances)
  {
    const PixelRect& r = entry.local.rect;
    all = { std::min(all.x0, r.x0), std::min(all.y0, r.y0), std::max(all.x1, r.x1),
      std::max(all.y1, r.y1) };
  }
  this->findIntervals(parallelFor);
  this->Parts.clear();
  this->Parts.reserve(this->Instances.size());
  for (const Entry& entry : this->Instances)
  {
    this->Parts.push_back({ entry.index, entry.key, this->Offsets[entry.index], entry.local.rect });
  }
  // What differs between offsets decides for all.
  const bool keep = this->HasFrame && this->Shifted == this->WasShifted;
  this->WasShifted = this->Shifted;
  if (!this->Tiles.beginFrame(this->Seen, this->Parts, keep, wanted))
  {
    this->Merged.resize(this->Seen.width, this->Seen.height);
  }
  this->LastHit = this->Merged.hit;
  for (std::size_t tile = 0; tile < this->Merged.tiles(); ++tile)
  {
    this->Merged.hit[tile] = this->Merged.hit[tile] && !this->Tiles.isStale(tile);
  }
  if (!this->Tiles.anyStale())
  {
    return;
  }
  if (!all.empty())
  {
    this->traceTiles(all, parallelFor);
  }
  this->Merged.trim([this](std::size_t tile) { return this->Tiles.isMerged(tile); });
}

void LayeredView::traceTiles(const PixelRect& all, const ParallelFor& parallelFor)
{
  this->Groups.fill(all, 8 * GroupTiles, this->Order,
    [this](std::uint32_t e) -> const PixelRect& { return this->Instances[e].local.rect; });
  std::vector<std::unique_ptr<TileScratch>> idle; // no more than there are threads
  std::mutex mutex;
  parallelFor(0, this->Groups.groups(), std::max<std::size_t>(this->Groups.columns() / 8, 2),
    [&](std::size_t first, std::size_t last)
    {
      std::unique_ptr<TileScratch> taken;
      {
        const std::lock_guard<std::mutex> lock(mutex);
        if (!idle.empty())
        {
          taken = std::move(idle.back());
          idle.pop_back();
        }
      }
      if (!taken)
      {
        taken = std::make_unique<TileScratch>();
        taken->rays.resize(this->Instances.size());
        taken->cullStates.resize(this->Instances.size());
        taken->nodes.resize(this->Visible.nodes.size());
        taken->counted.resize(this->Instances.size(), this->Merged.tiles());
      }
      TileScratch& mine = *taken;
      for (std::size_t group = first; group < last; ++group)
      {
        if (!this->findWindow(group, mine))
        {
          continue;
        }
        this->gather(group, mine);
        for (int row = mine.window.y0 / 8; row <= mine.window.y1 / 8; ++row)
        {
          for (int column = mine.window.x0 / 8; column <= mine.window.x1 / 8; ++column)
          {
            const int tileX = mine.groupX + column, tileY = mine.groupY + row;
            const std::size_t tile = static_cast<std::size_t>(tileY) * this->Merged.tilesX + tileX;
            if (this->Tiles.isMerged(tile))
            {
              this->mergeTile(tileX, tileY, mine);
            }
          }
        }
      }
      const std::lock_guard<std::mutex> lock(mutex);
      idle.push_back(std::move(taken));
    });
  for (std::size_t e = 0; e < this->Instances.size(); ++e)
  {
    std::uint64_t rays = 0;
    std::uint8_t cullState = 0;
    for (const std::unique_ptr<TileScratch>& scratch : idle)
    {
      rays += scratch->rays[e];
      cullState |= scratch->cullStates[e];
    }
    this->NotLookedAt.unasked -= cullState != 0;
    this->NotLookedAt.hidden += cullState == Asked;
    this->Rays += rays;
    this->Retraced += rays > 0;
  }
}
}
