#include "svoTileTracer.h"

#include <algorithm>
#include <limits>

namespace svo
{
TileTracer::TileTracer(const TracedInstances& instances, bool occlusion,
  const std::vector<std::uint8_t>& lastHit, DepthBuffer& depth, MergedTiles& tiles)
  : Instances(instances)
  , Order(instances)
  , LastHit(lastHit)
  , Depth(depth)
  , Tiles(tiles)
  , Occlusion(instances, occlusion, this->Group, this->Triangles.triangles())
{
  Account none;
  none.counted = depth.tiles();
  this->Accounts.assign(instances.size(), none);
}

void TileTracer::trace(int groupX, int groupY, const std::uint32_t* nearby, std::size_t count)
{
  this->Group.x = groupX;
  this->Group.y = groupY;
  if (!this->findWindow())
  {
    return;
  }
  this->gather(nearby, count);
  this->Group.eachTile(
    [this](int tileX, int tileY)
    {
      if (this->Tiles.isMerged(this->indexOf(tileX, tileY)))
      {
        this->mergeTile(tileX, tileY);
      }
    });
}

bool TileTracer::findWindow()
{
  constexpr int Size = TileGroup::Tiles;
  int x0 = Size, y0 = Size, x1 = -1, y1 = -1;
  for (int y = 0; y < Size; ++y)
  {
    for (int x = 0; x < Size; ++x)
    {
      const int tileX = this->Group.x + x, tileY = this->Group.y + y;
      if (this->Depth.grid.holds(tileX, tileY) && this->Tiles.isMerged(this->indexOf(tileX, tileY)))
      {
        x0 = std::min(x0, x);
        y0 = std::min(y0, y);
        x1 = std::max(x1, x);
        y1 = y;
      }
    }
  }
  const auto pixel = [](int tile) { return static_cast<std::uint8_t>(8 * tile); };
  const auto last = [](int tile) { return static_cast<std::uint8_t>(8 * tile + 7); };
  this->Group.window = { pixel(x0), last(x1), pixel(y0), last(y1) };
  return x1 >= 0;
}

void TileTracer::gather(const std::uint32_t* nearby, std::size_t count)
{
  this->Nearby = 0;
  this->Together.clear();
  this->Balls.clear();
  if (this->Candidates.size() < count)
  {
    this->Candidates.resize(count);
  }
  for (std::size_t k = 0; k < count; ++k)
  {
    const TracedInstance& entry = this->Instances[nearby[k]];
    if (!this->Group.wants(entry.local.pixels))
    {
      continue;
    }
    const Method method = this->choose(entry);
    if (method == Method::Ball)
    {
      this->Balls.add(entry, this->Group);
      this->accountOf(entry).asked = true;
      continue;
    }
    Candidate& candidate = this->Candidates[this->Nearby++];
    candidate.part.entry = &entry;
    candidate.hidden = false;
    candidate.method = method == Method::Alone ? this->aloneOrRays(candidate) : method;
    candidate.unknown = entry.tiles ? Method::Layer : Method::Rays;
    if (method == Method::Together)
    {
      this->Together.push_back(&candidate);
    }
  }
  this->Balls.sort();
  while (!this->findTogether())
  {
  }
  this->findHidden();
}

TileTracer::Method TileTracer::choose(const TracedInstance& entry) const
{
  return entry.ball             ? Method::Ball
    : entry.layer               ? Method::Layer
    : !entry.tiles              ? Method::Rays
    : this->Instances.shifted() ? Method::Alone
                                : Method::Together;
}

TileTracer::Method TileTracer::aloneOrRays(Candidate& candidate)
{
  candidate.triangles.clear();
  return candidate.triangles.add(
           this->Instances, candidate.entry(), this->Group, this->manyTogether(), this->Memory)
    ? Method::Alone
    : Method::Rays;
}

bool TileTracer::findTogether()
{
  this->Triangles.clear();
  this->Occlusion.restart();
  for (Candidate* const candidate : this->Together)
  {
    candidate->hidden =
      candidate->method == Method::Together && this->Occlusion.hides(candidate->entry());
    if (candidate->method == Method::Together && !candidate->hidden &&
      !this->Triangles.add(
        this->Instances, candidate->entry(), this->Group, this->manyTogether(), this->Memory))
    {
      candidate->method = Method::Rays;
      if (this->Triangles.incomplete())
      {
        return false;
      }
    }
  }
  return true;
}

void TileTracer::findHidden()
{
  for (std::size_t k = 0; k < this->Nearby; ++k)
  {
    Candidate& candidate = this->Candidates[k];
    if (candidate.method == Method::Rays)
    {
      candidate.hidden = this->Occlusion.hides(candidate.entry());
    }
    Account& account = this->accountOf(candidate.entry());
    account.asked = true;
    account.looked = account.looked || !candidate.hidden;
  }
}

bool TileTracer::nearestTriangles(int tileX, int tileY, GroupTriangles& triangles, MergedTile& hits)
{
  const std::size_t tile = this->indexOf(tileX, tileY);
  return triangles.nearest(this->Instances, this->Group, tileX, tileY, this->Memory, hits,
    [&](std::uint32_t owner)
    {
      Account& account = this->Accounts[this->Instances.entryOf(owner)];
      if (account.counted != tile)
      {
        account.counted = tile;
        account.rays += 64;
      }
    });
}

bool TileTracer::makeReady(int tileX, int tileY, const MergedTile& merged,
  std::optional<double>& deepest, Candidate& candidate)
{
  const TracedInstance& entry = candidate.entry();
  candidate.key = -std::numeric_limits<double>::infinity();
  switch (candidate.method)
  {
    case Method::Layer: // first: kept ones cost nothing and cut the others' rays
      return entry.layer->holds(tileX, tileY) &&
        entry.layer->traced[entry.layer->index(tileX, tileY)] != DepthLayer::Empty;
    case Method::Alone:
      return true;
    case Method::Ball:
    case Method::Together:
      return false; // they are merged
    case Method::Rays:
      break;
  }
  if (!deepest)
  {
    deepest = this->Occlusion.deepest(merged);
  }
  if (candidate.hidden || this->Occlusion.before(entry) > *deepest ||
    !findPart(this->Instances, tileX, tileY, candidate.part))
  {
    return false;
  }
  candidate.key = entry.local.base + candidate.part.tNear;
  return true;
}

void TileTracer::collect(int tileX, int tileY, bool onlyChanged, const MergedTile& merged)
{
  std::optional<double> deepest;
  this->OneByOne.clear();
  for (std::size_t k = 0; k < this->Nearby; ++k)
  {
    Candidate& candidate = this->Candidates[k];
    if ((!onlyChanged || this->Tiles.partChanged(candidate.entry().index)) &&
      this->makeReady(tileX, tileY, merged, deepest, candidate))
    {
      this->OneByOne.push_back(&candidate);
    }
  }
  // Front to back.
  std::stable_sort(this->OneByOne.begin(), this->OneByOne.end(),
    [](const Candidate* a, const Candidate* b) { return a->key < b->key; });
}

void TileTracer::traceTile(int tileX, int tileY, bool onlyChanged)
{
  const std::size_t tile = this->indexOf(tileX, tileY);
  MergedTile merged{ this->Depth.t.data() + 64 * tile, this->Depth.instance.data() + 64 * tile,
    this->Depth.primitive.data() + 64 * tile, false };
  merged.any = onlyChanged ? this->LastHit[tile] != 0
                           : this->nearestTriangles(tileX, tileY, this->Triangles, merged);
  this->Balls.merge(
    this->Order, this->Occlusion, this->Group, tileX, tileY, merged,
    [&](const TracedInstance& entry)
    { return !onlyChanged || this->Tiles.partChanged(entry.index); },
    [&](const TracedInstance& entry)
    {
      Account& account = this->accountOf(entry);
      account.looked = true;
      account.rays += 64;
    });
  this->collect(tileX, tileY, onlyChanged, merged);
  if (!this->OneByOne.empty())
  {
    const TilePoints at(tileX, tileY);
    for (Candidate* const candidate : this->OneByOne)
    {
      if (candidate->method == Method::Layer)
      {
        this->mergeLayer(tileX, tileY, at, *candidate, merged);
      }
      else if (candidate->method == Method::Alone)
      {
        this->mergeAlone(tileX, tileY, at, *candidate, merged);
      }
      else
      {
        this->mergeRays(at, *candidate, merged);
      }
    }
  }
  this->Depth.hit[tile] = merged.any;
}

void TileTracer::mergeRays(const TilePoints& at, Candidate& candidate, MergedTile& merged)
{
  RayBlock block;
  HitBlock found;
  fillPart(candidate.part, at, block);
  if (merged.any && !cutRays(this->Instances, this->Order, candidate.part, merged, block))
  {
    return;
  }
  traceRays(this->Instances, candidate.part, at.x, at.y, block, found);
  this->accountOf(candidate.entry()).rays += 64;
  this->Order.merge(candidate.entry(), found.t, found.primitive, at, merged);
}

void TileTracer::mergeAlone(
  int tileX, int tileY, const TilePoints& at, Candidate& candidate, MergedTile& merged)
{
  MergedTile own{ this->Own.t, this->Own.instance, this->Own.primitive, false };
  if (this->nearestTriangles(tileX, tileY, candidate.triangles, own))
  {
    this->Order.merge(candidate.entry(), own.t, own.primitive, at, merged);
  }
}

void TileTracer::mergeLayer(
  int tileX, int tileY, const TilePoints& at, Candidate& candidate, MergedTile& merged)
{
  DepthLayer& layer = *candidate.entry().layer;
  const std::size_t k = layer.index(tileX, tileY);
  float* const t = layer.t.data() + 64 * k;
  Primitive* const primitive = layer.primitive.data() + 64 * k;
  if (layer.traced[k] == DepthLayer::Unknown)
  {
    layer.traced[k] = this->traceLayer(tileX, tileY, at, candidate, t, primitive)
      ? DepthLayer::Traced
      : DepthLayer::Empty;
  }
  if (layer.traced[k] == DepthLayer::Traced)
  {
    this->Order.merge(candidate.entry(), t, primitive, at, merged);
  }
}

/// A layer is traced whole: it must stay true when what is before it goes away.
bool TileTracer::traceLayer(
  int tileX, int tileY, const TilePoints& at, Candidate& candidate, float* t, Primitive* primitive)
{
  if (candidate.unknown == Method::Layer)
  {
    candidate.unknown = this->aloneOrRays(candidate);
  }
  if (candidate.unknown == Method::Alone)
  {
    MergedTile hits{ t, this->Own.instance, primitive, false };
    return this->nearestTriangles(tileX, tileY, candidate.triangles, hits);
  }
  if (!findPart(this->Instances, tileX, tileY, candidate.part))
  {
    return false;
  }
  RayBlock block;
  HitBlock found;
  fillPart(candidate.part, at, block);
  traceRays(this->Instances, candidate.part, at.x, at.y, block, found);
  std::copy(found.t, found.t + 64, t);
  std::copy(found.primitive, found.primitive + 64, primitive);
  this->accountOf(candidate.entry()).rays += 64;
  return true;
}

void TileTracer::mergeTile(int tileX, int tileY)
{
  const std::size_t tile = this->indexOf(tileX, tileY);
  if (!this->Tiles.wasMerged(tile))
  {
    this->traceTile(tileX, tileY, false);
    return;
  }
  // Where no changed instance was seen the last hits are those of the others, which any order of
  // merging gives again.
  const std::uint32_t* instance = this->Depth.instance.data() + 64 * tile;
  const bool wasSeen = this->LastHit[tile] && this->Tiles.anyChanged(instance);
  this->traceTile(tileX, tileY, !wasSeen && this->Triangles.empty());
  if (!wasSeen && !(this->Depth.hit[tile] && this->Tiles.anyChanged(instance)))
  {
    this->Tiles.settle(tile);
  }
}
}
