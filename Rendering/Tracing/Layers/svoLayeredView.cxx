#include "svoLayeredView.h"

#include <algorithm>
#include <mutex>

namespace svo
{
namespace
{
/// Area of a triangle in the image, pixels, from which on tracing by tiles is quicker.
constexpr double LeastTrianglePixels = 0.5;
}

DepthLayer::DepthLayer(const PixelRect& r)
  : rect(r)
{
  const std::size_t tiles = static_cast<std::size_t>((r.x1 - r.x0) / 8) * ((r.y1 - r.y0) / 8);
  this->traced.resize(tiles);
  this->t.resize(64 * tiles);
  this->primitive.resize(64 * tiles);
}

bool worthTiles(const Instance& instance, const LocalView& local, const View& view)
{
  const Octree& octree = instance.octree;
  if (!traitsOf(instance.leafGeometry).exact() || !octree.surface() || local.stretched)
  {
    return false;
  }
  const double pixel = worldPixel(view, local.base + 0.5 * local.tMax);
  const double voxel = worldVoxel(instance) / pixel;
  const Header& h = octree.header();
  const double voxels = static_cast<double>(h.voxelCount) / static_cast<double>(h.triangleCount);
  return voxels * voxel * voxel >= LeastTrianglePixels;
}

int deepened(const Instance& instance, int level)
{
  return traitsOf(instance.leafGeometry).exact() && instance.octree.surface() &&
      !stopsAtNodes(instance, level)
    ? instance.octree.level()
    : level;
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
  this->MergedWhole = false;
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
  this->Offsets.clear();
  this->Placed.assign(scene.instances.size(), 0);
  for (const Instance& instance : scene.instances)
  {
    this->Geometries.push_back(instance.leafGeometry);
    this->Offsets.push_back(instance.depthOffsetUnits);
  }
  this->Shifted = false;
  for (const Entry& entry : this->Instances)
  {
    this->Shifted = this->Shifted ||
      (this->Exact && this->Offsets[entry.index] != this->Offsets[this->Instances[0].index]);
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
    this->Placed[entry.index] = this->Exact && entry.tiles;
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

bool LayeredView::isMerged(const std::uint8_t* wanted)
{
  const std::size_t tiles =
    static_cast<std::size_t>((this->Of.width + 7) / 8) * ((this->Of.height + 7) / 8);
  const bool whole =
    !wanted || std::all_of(wanted, wanted + tiles, [](std::uint8_t w) { return w != 0; });
  bool kept = true;
  std::vector<Part> parts;
  for (const Entry& entry : this->Instances)
  {
    kept = kept && entry.layer;
    parts.push_back({ entry.index, entry.key, this->Offsets[entry.index] });
  }
  const bool same = kept && whole && this->MergedWhole && sameRays(this->Of, this->MergedView) &&
    parts == this->MergedParts;
  this->MergedWhole = whole;
  this->MergedView = this->Of;
  this->MergedParts = std::move(parts);
  return same;
}

void LayeredView::trace(const ParallelFor& parallelFor, const std::uint8_t* wanted)
{
  this->Rays = 0;
  this->Retraced = 0;
  PixelRect all{ this->Of.width, this->Of.height, 0, 0 };
  for (const Entry& entry : this->Instances)
  {
    const PixelRect& r = entry.local.rect;
    all = { std::min(all.x0, r.x0), std::min(all.y0, r.y0), std::max(all.x1, r.x1),
      std::max(all.y1, r.y1) };
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
  this->Changed = !this->isMerged(wanted);
  if (!this->Changed)
  {
    return;
  }
  this->Merged.resize(this->Of.width, this->Of.height);
  if (all.empty())
  {
    return;
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
        this->gather(x0, y0, mine);
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
