#include "svoLayeredView.h"

#include "svoTileTracer.h"

#include <algorithm>
#include <cassert>
#include <memory>
#include <mutex>

namespace svo
{
namespace
{
/// Pixels of the rectangle of an instance from which on its layer may be kept. Smaller ones are
/// traced again wherever something changes, so that what is kept goes with the picture and not
/// with their number.
constexpr double SmallestLayer = 16 * 64;
/// Rectangles with fewer pixels have layers only while all of these together have no more than
/// twice the picture's: what is kept goes with the picture, not with the number of instances.
constexpr double CrowdsLayer = 128 * 128;

double pixelsOf(const PixelRect& r)
{
  return static_cast<double>(r.x1 - r.x0) * (r.y1 - r.y0);
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
  this->Seen.depth = DepthBuffer();
  this->Seen.versions = {};
  this->LastHit = {};
  this->Tiles.forget();
}

bool LayeredView::prepare(const Scene& scene, const View& view,
  const std::function<bool(const Instance&)>& takesPart, const LevelOf& levelOf, bool keep,
  LayerBudget& budget, const ParallelFor& parallelFor)
{
  this->Layers.beginFrame(keep, this->HasFrame && !sameRays(view, this->Instances.view()), budget);
  this->HasFrame = keep;
  this->Instances.find(scene, view, this->Cull, takesPart, levelOf, parallelFor);
  this->findLayers(budget);
  this->Layers.endFrame(budget);
  return !this->Instances.empty();
}

void LayeredView::findLayers(LayerBudget& budget)
{
  const View& view = this->Instances.view();
  double ofCrowd = 0.0;
  for (const TracedInstance& entry : this->Instances)
  {
    const double pixels = pixelsOf(entry.local.rect);
    ofCrowd += pixels >= SmallestLayer && pixels < CrowdsLayer ? pixels : 0;
  }
  const double smallest = ofCrowd > 2.0 * pixelsOf(view.crop) ? CrowdsLayer : SmallestLayer;
  for (TracedInstance& entry : this->Instances.entries())
  {
    const bool large = pixelsOf(entry.local.rect) >= smallest && !entry.ball;
    entry.layer =
      large ? this->Layers.layerOf(entry.id, entry.key, entry.local.rect, budget) : nullptr;
  }
}

/// Of instances whose rays are walked.
void LayeredView::findIntervals(const ParallelFor& parallelFor)
{
  const auto find = [this](TracedInstance& entry, const ParallelFor& loops)
  {
    TileIntervals& intervals = entry.layer ? entry.layer->intervals : entry.intervals;
    if (!entry.tiles && intervals.tNear.empty())
    {
      computeTileIntervals(*entry.octree, entry.key.localToWorld, this->Instances.view(),
        entry.local.rect, { entry.key.leafGeometry, entry.key.level }, entry.local.base, loops,
        intervals);
    }
  };
  constexpr int Small = 64; // pixels
  const auto isSmall = [](const TracedInstance& entry)
  { return entry.local.rect.y1 - entry.local.rect.y0 <= Small; };
  std::vector<TracedInstance>& all = this->Instances.entries();
  forEach(parallelFor, all.size(), 32,
    [&](std::size_t e)
    {
      if (isSmall(all[e]))
      {
        find(all[e], serialFor);
      }
    });
  for (TracedInstance& entry : all)
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
  this->findIntervals(parallelFor);
  this->findStale(wanted);
  if (this->Tiles.anyStale())
  {
    if (!this->Instances.empty())
    {
      this->traceTiles(parallelFor);
    }
    this->Seen.depth.trim([this](std::size_t tile) { return this->Tiles.isMerged(tile); });
    this->noteVersions();
  }
}

void LayeredView::noteVersions()
{
  const std::uint64_t now = nextTileVersion();
  this->Seen.versions.resize(this->Seen.depth.tiles());
  for (std::size_t tile = 0; tile < this->Seen.versions.size(); ++tile)
  {
    if (this->Tiles.changed(tile))
    {
      this->Seen.versions[tile] = this->Seen.version = now;
    }
  }
}

void LayeredView::findStale(const std::uint8_t* wanted)
{
  const View& view = this->Instances.view();
  DepthBuffer& depth = this->Seen.depth;
  this->Parts.clear();
  this->Parts.reserve(this->Instances.size());
  for (const TracedInstance& entry : this->Instances)
  {
    this->Parts.push_back(
      { entry.index, entry.key, this->Instances.offset(entry.index), entry.local.rect });
  }
  // What differs between offsets decides for all.
  const bool keep = this->HasFrame && this->Instances.shifted() == this->WasShifted;
  this->WasShifted = this->Instances.shifted();
  const TileGrid grid(view);
  if (!this->Tiles.beginFrame(view, this->Parts, keep, wanted))
  {
    depth.resize(grid);
  }
  depth.grid = grid;
  this->LastHit = depth.hit;
  for (std::size_t tile = 0; tile < depth.tiles(); ++tile)
  {
    depth.hit[tile] = depth.hit[tile] && !this->Tiles.isStale(tile);
  }
}

void LayeredView::traceTiles(const ParallelFor& parallelFor)
{
  PixelRect all;
  for (const TracedInstance& entry : this->Instances)
  {
    all = around(all, entry.local.rect);
  }
  this->Groups.fill(all, 8 * TileGroup::Tiles, this->Instances.order(),
    [this](std::uint32_t e) -> const PixelRect& { return this->Instances[e].local.rect; });
  std::vector<std::unique_ptr<TileTracer>> idle; // no more than there are threads
  std::mutex mutex;
  parallelFor(0, this->Groups.groups(), std::max<std::size_t>(this->Groups.columns() / 8, 2),
    [&](std::size_t first, std::size_t last)
    {
      std::unique_ptr<TileTracer> mine;
      {
        const std::lock_guard<std::mutex> lock(mutex);
        if (!idle.empty())
        {
          mine = std::move(idle.back());
          idle.pop_back();
        }
      }
      if (!mine)
      {
        mine = std::make_unique<TileTracer>(
          this->Instances, this->Cull.occlusion, this->LastHit, this->Seen.depth, this->Tiles);
      }
      for (std::size_t group = first; group < last; ++group)
      {
        const GroupLists::List nearby = this->Groups.of(group);
        mine->trace(TileGroup::Tiles * this->Groups.x(group),
          TileGroup::Tiles * this->Groups.y(group), nearby.begin(),
          static_cast<std::size_t>(nearby.end() - nearby.begin()));
      }
      const std::lock_guard<std::mutex> lock(mutex);
      idle.push_back(std::move(mine));
    });
  for (std::size_t e = 0; e < this->Instances.size(); ++e)
  {
    std::uint64_t rays = 0;
    bool asked = false, looked = false;
    for (const std::unique_ptr<TileTracer>& tracer : idle)
    {
      const TileTracer::Account& account = tracer->account(e);
      rays += account.rays;
      asked = asked || account.asked;
      looked = looked || account.looked;
    }
    this->NotLookedAt.unasked -= asked;
    this->NotLookedAt.hidden += asked && !looked;
    this->Rays += rays;
    this->Retraced += rays > 0;
  }
}

void LayeredView::sample(int tileX, int tileY, TileSamples* samples, std::size_t count) const
{
  assert(this->Seen.depth.grid.holds(tileX, tileY));
  for (std::size_t b = 0; b < count; ++b)
  {
    std::fill(samples[b].instance, samples[b].instance + 64, NoInstance);
  }
  RayBlock block;
  HitBlock found;
  TilePart part;
  const HitOrder order(this->Instances);
  for (const TracedInstance& entry : this->Instances)
  {
    part.entry = &entry;
    if (!findPart(this->Instances, tileX, tileY, part))
    {
      continue;
    }
    for (std::size_t b = 0; b < count; ++b)
    {
      TileSamples& s = samples[b];
      std::fill(block.tMin, block.tMin + 64, part.tNear);
      std::fill(block.tMax, block.tMax + 64, part.tFar);
      traceRays(this->Instances, part, s.x, s.y, block, found);
      for (int i = 0; i < 64; ++i)
      {
        const SeenHit mine{ entry.index, found.primitive[i], entry.local.base + found.t[i], s.x[i],
          s.y[i] };
        if (mine.primitive != NoPrimitive &&
          (s.instance[i] == NoInstance ||
            order.inFront(mine, { s.instance[i], s.primitive[i], s.t[i], s.x[i], s.y[i] })))
        {
          s.t[i] = mine.t;
          s.instance[i] = entry.index;
          s.primitive[i] = found.primitive[i];
        }
      }
    }
  }
}
}
