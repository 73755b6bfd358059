// What LayeredView does for one tile: finds the instances that its rays may meet, traces them front
// to back, merges.
#include "svoLayeredView.h"

#include "svoPlaceOnTriangles.h"

#include "svoIntersect.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace svo
{
namespace
{
/// Where a tile sees more nodes than this its rays are walked one by one after all.
constexpr std::size_t MostTileNodes = 256;

bool isAlive(const RayBlock& rays, int i)
{
  return rays.tMin[i] <= rays.tMax[i];
}

/// As intersect(), where only some of the rays are any: these go together.
void intersectFew(const Octree& octree, const LocalView& local, const double* x, const double* y,
  const RayBlock& rays, const TraceOptions& options, HitBlock& hits)
{
  RayBlock few;
  HitBlock found;
  double fewX[RayBlock::Size], fewY[RayBlock::Size];
  int ray[RayBlock::Size];
  int count = 0;
  for (int i = 0; i < RayBlock::Size; ++i)
  {
    hits.primitive[i] = NoPrimitive;
    hits.t[i] = 0.0f;
    if (isAlive(rays, i))
    {
      fewX[count] = x[i];
      fewY[count] = y[i];
      few.tMin[count] = rays.tMin[i];
      few.tMax[count] = rays.tMax[i];
      ray[count++] = i;
    }
  }
  if (count == 0)
  {
    return;
  }
  for (int i = count; i < RayBlock::Size; ++i)
  {
    fewX[i] = fewX[0];
    fewY[i] = fewY[0];
    few.tMin[i] = 1.0f;
    few.tMax[i] = 0.0f;
  }
  fillRays(local, fewX, fewY, few);
  intersect(octree, few, options, found);
  for (int i = 0; i < count; ++i)
  {
    hits.t[ray[i]] = found.t[i];
    hits.primitive[ray[i]] = found.primitive[i];
  }
}
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
    candidate.tNear = std::max(
      all.tNear[i], static_cast<float>(std::min(this->Seen.tNear - entry.local.base, 0.0)));
    candidate.tFar = std::min(all.tFar[i], entry.local.tMax);
    return candidate.tNear <= candidate.tFar;
  }
  candidate.tNear = 0.0f;
  candidate.tFar = entry.local.tMax;
  candidate.pyramid = makePyramid(entry.projection, this->Seen, tileX, tileY);
  if (!findTileNodes(*entry.octree, candidate.pyramid, candidate.tNear, candidate.tFar,
        MostTileNodes, candidate.nodes))
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

void LayeredView::order(int tileX, int tileY, bool onlyChanged, TileScratch& scratch)
{
  scratch.order.clear();
  for (std::size_t k = 0; k < scratch.nearby; ++k)
  {
    TileEntry& candidate = scratch.entries[k];
    const Entry& entry = *candidate.entry;
    if (onlyChanged && !this->Tiles.partChanged(entry.index))
    {
      continue;
    }
    DepthLayer* layer = entry.layer;
    if (layer && layer->holds(tileX, tileY))
    {
      std::uint8_t& state = layer->traced[layer->index(tileX, tileY)];
      if (state == DepthLayer::Unknown && entry.tiles)
      {
        this->traceLayer(tileX, tileY, candidate, scratch);
      }
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
    else if (!layer && candidate.method != TraceMethod::Together && !candidate.hidden &&
      (candidate.method == TraceMethod::Alone ||
        (!(this->before(entry) > scratch.deepest) && this->meets(tileX, tileY, candidate))))
    {
      candidate.key = candidate.method == TraceMethod::Alone
        ? -std::numeric_limits<double>::infinity()
        : entry.local.base + candidate.tNear;
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
  if (!candidate.nodes.empty())
  {
    fillRays(entry.local, x, y, block);
    intersectTile(*entry.octree, candidate.pyramid, candidate.nodes, block, found);
  }
  else
  {
    intersectFew(*entry.octree, entry.local, x, y, block, options, found);
  }
  if (this->Placed[entry.index])
  {
    placeOnTriangles(*entry.octree->surface(), entry.local, x, y, found);
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
      const std::uint32_t winner = merged.instance[i];
      const double cut =
        this->lastDepth(entry, winner, this->Bases[winner] + merged.t[i]) - entry.local.base;
      if (entry.cuttable || cut < candidate.tNear)
      {
        const bool moves = this->Placed[entry.index] || (this->Exact && this->Shifted);
        const double reach = moves ? placingReach(entry.local) : 0.0;
        block.tMax[i] = std::min(block.tMax[i], roundUp(cut + reach));
      }
    }
    alive = alive || block.tMax[i] >= candidate.tNear;
  }
  return alive;
}

void LayeredView::merge(const Entry& entry, const float* t, const Primitive* primitive,
  const double* x, const double* y, MergedTile& merged) const
{
  // Any order of merging gives the same buffer. A NaN compares false and never wins.
  if (!merged.any)
  {
    std::uint32_t any = 0;
    for (int i = 0; i < 64; ++i)
    {
      any |= static_cast<std::uint32_t>(primitive[i] != NoPrimitive);
    }
    if (any)
    {
      merged.any = true;
      for (int i = 0; i < 64; ++i)
      {
        merged.t[i] = t[i];
        merged.primitive[i] = primitive[i];
        merged.instance[i] = primitive[i] == NoPrimitive ? NoInstance : entry.index;
      }
    }
    return;
  }
  for (int i = 0; i < 64; ++i)
  {
    if (primitive[i] == NoPrimitive)
    {
      continue;
    }
    const std::uint32_t winner = merged.instance[i];
    if (winner == NoInstance ||
      this->inFront({ entry.index, primitive[i], entry.local.base + t[i], x[i], y[i] },
        { winner, merged.primitive[i], this->Bases[winner] + merged.t[i], x[i], y[i] }))
    {
      merged.t[i] = t[i];
      merged.primitive[i] = primitive[i];
      merged.instance[i] = entry.index;
    }
  }
}

void LayeredView::traceTile(int tileX, int tileY, bool onlyChanged, TileScratch& scratch)
{
  const std::size_t tile = static_cast<std::size_t>(tileY) * this->Merged.tilesX + tileX;
  MergedTile merged{ this->Merged.t.data() + 64 * tile, this->Merged.instance.data() + 64 * tile,
    this->Merged.primitive.data() + 64 * tile, false };
  merged.any = onlyChanged ? this->LastHit[tile] != 0
                           : this->nearestHits(tileX, tileY, scratch.found, scratch, merged);
  this->mergeBalls(tileX, tileY, onlyChanged, scratch, merged);
  scratch.deepest = this->deepest(merged);
  this->order(tileX, tileY, onlyChanged, scratch);
  this->Merged.hit[tile] = merged.any;
  if (scratch.order.empty())
  {
    return;
  }
  RayBlock block;
  HitBlock found;
  double xs[64], ys[64];
  for (int i = 0; i < 64; ++i)
  {
    xs[i] = 8 * tileX + (i & 7) + 0.5;
    ys[i] = 8 * tileY + (i >> 3) + 0.5;
  }
  for (TileEntry* next : scratch.order)
  {
    TileEntry& candidate = *next;
    const Entry& entry = *candidate.entry;
    const auto fill = [&]
    {
      const PixelRect& pixels = entry.local.pixels;
      std::fill(block.tMin, block.tMin + 64, candidate.tNear);
      for (int i = 0; i < 64; ++i)
      {
        const bool sees =
          xs[i] >= pixels.x0 && xs[i] < pixels.x1 && ys[i] >= pixels.y0 && ys[i] < pixels.y1;
        block.tMax[i] = sees ? candidate.tFar : -std::numeric_limits<float>::infinity();
      }
    };
    if (!entry.layer && candidate.method == TraceMethod::Alone)
    {
      MergedTile own{ scratch.t, scratch.instance, scratch.primitive, false };
      if (this->nearestHits(tileX, tileY, candidate.alone, scratch, own))
      {
        this->merge(entry, own.t, own.primitive, xs, ys, merged);
      }
      continue;
    }
    if (!entry.layer)
    {
      fill();
      if (merged.any && !this->cutRays(candidate, merged, block))
      {
        continue;
      }
      traceRays(candidate, xs, ys, block, found);
      scratch.rays[&entry - this->Instances.data()] += 64;
      this->merge(entry, found.t, found.primitive, xs, ys, merged);
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
    this->merge(entry, keptT, keptPrimitive, xs, ys, merged);
  }
  this->Merged.hit[tile] = merged.any;
}

void LayeredView::mergeTile(int tileX, int tileY, TileScratch& scratch)
{
  const std::size_t tile = static_cast<std::size_t>(tileY) * this->Merged.tilesX + tileX;
  if (!this->Tiles.wasMerged(tile))
  {
    this->traceTile(tileX, tileY, false, scratch);
    return;
  }
  // Where no changed instance was seen the last hits are those of the others, which any order of
  // merging gives again.
  const std::uint32_t* instance = this->Merged.instance.data() + 64 * tile;
  const bool wasSeen = this->LastHit[tile] && this->Tiles.anyChanged(instance);
  this->traceTile(tileX, tileY, !wasSeen && scratch.found.group.empty(), scratch);
  if (!wasSeen && !(this->Merged.hit[tile] && this->Tiles.anyChanged(instance)))
  {
    this->Tiles.settle(tile);
  }
}

void LayeredView::sample(int tileX, int tileY, TileSamples* samples, std::size_t count) const
{
  assert(tileX >= 0 && tileX < this->Merged.tilesX && tileY >= 0 && tileY < this->Merged.tilesY);
  for (std::size_t b = 0; b < count; ++b)
  {
    std::fill(samples[b].instance, samples[b].instance + 64, NoInstance);
  }
  RayBlock block;
  HitBlock found;
  TileEntry candidate;
  for (const Entry& entry : this->Instances)
  {
    candidate.entry = &entry;
    if (!this->meets(tileX, tileY, candidate))
    {
      continue;
    }
    for (std::size_t b = 0; b < count; ++b)
    {
      TileSamples& s = samples[b];
      std::fill(block.tMin, block.tMin + 64, candidate.tNear);
      std::fill(block.tMax, block.tMax + 64, candidate.tFar);
      traceRays(candidate, s.x, s.y, block, found);
      for (int i = 0; i < 64; ++i)
      {
        const SeenHit mine{ entry.index, found.primitive[i], entry.local.base + found.t[i], s.x[i],
          s.y[i] };
        if (mine.primitive != NoPrimitive &&
          (s.instance[i] == NoInstance ||
            this->inFront(mine, { s.instance[i], s.primitive[i], s.t[i], s.x[i], s.y[i] })))
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
