#include "svoTileRays.h"

#include "svoIntersect.h"
#include "svoPlaceOnTriangles.h"

#include <algorithm>
#include <limits>

namespace svo
{
namespace
{
/// Where a tile sees more nodes than this its rays are walked one by one after all.
constexpr std::size_t MostTileNodes = 256;

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
    if (rays.tMin[i] <= rays.tMax[i])
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

bool findPart(const TracedInstances& instances, int tileX, int tileY, TilePart& part)
{
  const TracedInstance& entry = *part.entry;
  const PixelRect& rect = entry.local.rect;
  if (8 * tileX < rect.x0 || 8 * tileX >= rect.x1 || 8 * tileY < rect.y0 || 8 * tileY >= rect.y1)
  {
    return false;
  }
  part.nodes.clear();
  if (!entry.tiles)
  {
    const TileIntervals& all = entry.layer ? entry.layer->intervals : entry.intervals;
    const std::size_t i = all.index(tileX, tileY);
    // Planes may be met a cell before the cube, but not before the near plane.
    part.tNear = std::max(
      all.tNear[i], static_cast<float>(std::min(instances.view().tNear - entry.local.base, 0.0)));
    part.tFar = std::min(all.tFar[i], entry.local.tMax);
    return part.tNear <= part.tFar;
  }
  part.tNear = 0.0f;
  part.tFar = entry.local.tMax;
  part.pyramid = makePyramid(entry.projection, instances.view(), tileX, tileY);
  if (!findTileNodes(*entry.octree, part.pyramid, part.tNear, part.tFar, MostTileNodes, part.nodes))
  {
    part.nodes.clear();
    return true;
  }
  if (part.nodes.empty())
  {
    return false;
  }
  part.tNear = std::max(part.tNear, part.nodes.front().tNear);
  return true;
}

void fillPart(const TilePart& part, const TilePoints& at, RayBlock& block)
{
  const PixelRect& pixels = part.entry->local.pixels;
  std::fill(block.tMin, block.tMin + 64, part.tNear);
  for (int i = 0; i < 64; ++i)
  {
    const bool sees =
      at.x[i] >= pixels.x0 && at.x[i] < pixels.x1 && at.y[i] >= pixels.y0 && at.y[i] < pixels.y1;
    block.tMax[i] = sees ? part.tFar : -std::numeric_limits<float>::infinity();
  }
}

bool cutRays(const TracedInstances& instances, const HitOrder& order, const TilePart& part,
  const MergedTile& merged, RayBlock& block)
{
  // A tie must survive the rounding. Plane leaves answer a ray that found nothing to its end with
  // the first cell that refused it, so there a ray is either not traced or traced to its own end.
  const TracedInstance& entry = *part.entry;
  bool alive = false;
  for (int i = 0; i < 64; ++i)
  {
    if (merged.instance[i] != NoInstance)
    {
      const std::uint32_t winner = merged.instance[i];
      const double cut =
        order.lastDepth(entry, winner, order.linearDepth(winner, merged.t[i])) - entry.local.base;
      if (entry.cuttable || cut < part.tNear)
      {
        const bool moves =
          instances.placed(entry.index) || (instances.exact() && instances.shifted());
        const double reach = moves ? placingReach(entry.local) : 0.0;
        block.tMax[i] = std::min(block.tMax[i], roundUp(cut + reach));
      }
    }
    alive = alive || block.tMax[i] >= part.tNear;
  }
  return alive;
}

void traceRays(const TracedInstances& instances, const TilePart& part, const double* x,
  const double* y, RayBlock& block, HitBlock& found)
{
  const TracedInstance& entry = *part.entry;
  const TraceOptions options{ entry.key.leafGeometry, entry.key.level };
  if (entry.local.stretched)
  {
    intersectStretched(*entry.octree, entry.local, x, y, block, options, found);
    return;
  }
  if (!part.nodes.empty())
  {
    fillRays(entry.local, x, y, block);
    intersectTile(*entry.octree, part.pyramid, part.nodes, block, found);
  }
  else
  {
    intersectFew(*entry.octree, entry.local, x, y, block, options, found);
  }
  if (instances.placed(entry.index))
  {
    placeOnTriangles(*entry.octree->surface(), entry.local, x, y, found);
  }
}
}
