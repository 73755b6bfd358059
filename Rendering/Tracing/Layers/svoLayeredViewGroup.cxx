// What LayeredView does for a group of tiles: the triangles of all instances that are traced by
// tiles are made ready once, and each tile finds the nearest of them in one pass. Rays about which
// that leaves a doubt are tested one by one.
#include "svoLayeredView.h"

#include "svoPlaceOnTriangles.h"
#include "svoRayMeetsTriangle.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace svo
{
namespace
{
/// Where a group sees more nodes than this its tiles look for their own.
constexpr std::size_t MostGroupNodes = 4096;
/// Where it sees fewer of an instance there are not enough triangles for one to hide another. With
/// 0 ordinary meshes take 5 % longer, meshes of triangles smaller than pixels 2 % less.
constexpr std::size_t FewGroupNodes = 400;
/// But where so many instances are together they hide each other.
constexpr std::size_t Crowd = 8;

int lowest(std::uint64_t bits)
{
  return __builtin_ctzll(bits);
}
}

bool LayeredView::findTriangles(
  const Entry& entry, TileScratch& scratch, FoundTriangles& found) const
{
  // Keys are squares of depths.
  constexpr double Farthest = 1e15, FarthestRatio = 1e9;
  const double size = entry.functions.wBase + entry.local.tMax;
  if (!entry.functions.valid || !(size + std::abs(this->Keys.far) < Farthest) ||
    !(std::abs(this->Keys.far) < FarthestRatio * size))
  {
    return false;
  }
  HitLimits limits;
  if (this->Exact)
  {
    limits.error = this->Errors[entry.index];
    // A little less than where placeOnPlane() changes its mind.
    limits.nearReach = 0.999 * edgeOnReach(entry.local);
    limits.reach = 0.999 * placingReach(entry.local);
  }
  const GroupView view =
    makeGroupView(entry.local, entry.functions, this->Keys, limits, scratch.groupX, scratch.groupY);
  const TilePyramid all =
    makePyramid(entry.projection, this->Seen, scratch.groupX, scratch.groupY, GroupTiles);
  if (!findGroupNodes(*entry.octree, all, 0.0f, entry.local.tMax, MostGroupNodes,
        scratch.groupNodes, scratch.window))
  {
    return false;
  }
  if (scratch.groupNodes.empty())
  {
    return true;
  }
  found.incomplete = !found.group.add(*entry.octree, scratch.groupNodes, view,
    scratch.groupNodes.size() < FewGroupNodes && scratch.together.size() < Crowd
      ? SmallTriangles::AsSlots
      : SmallTriangles::AsPoints,
    entry.index);
  return !found.incomplete;
}

bool LayeredView::findTogether(TileScratch& scratch) const
{
  scratch.found.clear();
  ++scratch.asking;
  for (TileEntry* const candidate : scratch.together)
  {
    candidate->hidden =
      candidate->method == TraceMethod::Together && this->isHidden(*candidate->entry, scratch);
    if (candidate->method == TraceMethod::Together && !candidate->hidden &&
      !this->findTriangles(*candidate->entry, scratch, scratch.found))
    {
      candidate->method = TraceMethod::Rays;
      if (scratch.found.incomplete)
      {
        return false;
      }
    }
  }
  return true;
}

void LayeredView::gather(std::size_t group, TileScratch& scratch) const
{
  const GroupLists::List nearby = this->Groups.of(group);
  scratch.nearby = 0;
  scratch.together.clear();
  scratch.balls.clear();
  const auto most = static_cast<std::size_t>(nearby.end() - nearby.begin());
  if (scratch.entries.size() < most)
  {
    scratch.entries.resize(most);
  }
  for (const std::uint32_t e : nearby)
  {
    const Entry& entry = this->Instances[e];
    if (!scratch.wants(entry.local.pixels))
    {
      continue;
    }
    if (entry.ball)
    {
      scratch.balls.push_back({ &entry, 0, entry.local.base });
      scratch.cullStates[e] |= Asked;
      continue;
    }
    TileEntry& candidate = scratch.entries[scratch.nearby++];
    candidate.entry = &entry;
    candidate.hidden = false;
    candidate.method = entry.tiles ? TraceMethod::Unknown : TraceMethod::Rays;
    if (entry.tiles && !entry.layer)
    {
      candidate.method = TraceMethod::Together;
      if (this->Shifted)
      {
        candidate.alone.clear();
        candidate.method = this->findTriangles(entry, scratch, candidate.alone) ? TraceMethod::Alone
                                                                                : TraceMethod::Rays;
      }
      else
      {
        scratch.together.push_back(&candidate);
      }
    }
  }
  this->gatherBalls(scratch);
  while (!this->findTogether(scratch))
  {
  }
  for (std::size_t k = 0; k < scratch.nearby; ++k)
  {
    TileEntry& candidate = scratch.entries[k];
    if (candidate.method == TraceMethod::Rays && !candidate.entry->layer)
    {
      candidate.hidden = this->isHidden(*candidate.entry, scratch);
    }
    scratch.cullStates[static_cast<std::size_t>(candidate.entry - this->Instances.data())] |=
      candidate.hidden ? Asked : Asked | Looked;
  }
}

void LayeredView::traceLayer(int tileX, int tileY, TileEntry& candidate, TileScratch& scratch)
{
  const Entry& entry = *candidate.entry;
  if (candidate.method == TraceMethod::Unknown)
  {
    candidate.alone.clear();
    candidate.method =
      this->findTriangles(entry, scratch, candidate.alone) ? TraceMethod::Alone : TraceMethod::Rays;
  }
  if (candidate.method != TraceMethod::Alone)
  {
    return;
  }
  DepthLayer& layer = *entry.layer;
  const std::size_t k = layer.index(tileX, tileY);
  MergedTile hits{ layer.t.data() + 64 * k, scratch.instance, layer.primitive.data() + 64 * k,
    false };
  layer.traced[k] = this->nearestHits(tileX, tileY, candidate.alone, scratch, hits)
    ? DepthLayer::Traced
    : DepthLayer::Empty;
}

bool LayeredView::nearestHits(
  int tileX, int tileY, FoundTriangles& found, TileScratch& scratch, MergedTile& hits) const
{
  const TriangleGroup& group = found.group;
  NearestTriangles& nearest = scratch.nearest;
  const int column = tileX - scratch.groupX, row = tileY - scratch.groupY;
  if (group.empty() || !group.nearest(column, row, nearest, hits.primitive, hits.instance))
  {
    return false;
  }
  const std::size_t tile = static_cast<std::size_t>(tileY) * this->Merged.tilesX + tileX;
  const auto count = [&](std::uint32_t owner)
  {
    const std::uint32_t e = this->EntryOf[owner];
    if (scratch.counted[e] != tile)
    {
      scratch.counted[e] = tile;
      scratch.rays[e] += 64;
    }
  };
  for (const SeenTriangle& seen : nearest.seen)
  {
    count(group.owner(seen.slot));
  }
  for (const GroupPixels::Part& part : group.small().parts())
  {
    if (part.tiles >> (GroupTiles * row + column) & 1)
    {
      count(part.owner);
    }
  }
  std::uint64_t doubtful = nearest.doubtful;
  if (this->Exact)
  {
    this->placeHits(tileX, tileY, found, doubtful, scratch, hits);
  }
  else
  {
    this->measureHits(tileX, tileY, nearest, hits);
  }
  group.findCandidates(column, row, doubtful, nearest);
  for (; doubtful != 0; doubtful &= doubtful - 1)
  {
    const int i = lowest(doubtful);
    const double x = 8 * tileX + (i & 7) + 0.5, y = 8 * tileY + (i >> 3) + 0.5;
    SeenHit first;
    const bool hit = this->traceDoubtful(x, y, i, scratch, first);
    hits.primitive[i] = hit ? first.primitive : NoPrimitive;
    hits.instance[i] = hit ? first.instance : NoInstance;
    hits.t[i] = hit ? first.floatT : 0.0f;
  }
  return std::any_of(
    hits.primitive, hits.primitive + 64, [](Primitive p) { return p != NoPrimitive; });
}

void LayeredView::placeHits(int tileX, int tileY, FoundTriangles& found, std::uint64_t& doubtful,
  const TileScratch& scratch, MergedTile& hits) const
{
  const NearestTriangles& nearest = scratch.nearest;
  const TriangleGroup& group = found.group;
  if (found.planes.empty())
  {
    found.planes.emplace_back();
    found.planeOf.assign(group.size() + 1, -1);
    found.planeOf[0] = 0; // of no slot
  }
  static_assert(NearestTriangles::None == -1, "planes are counted from it");
  std::int32_t* const planeOf = found.planeOf.data() + 1;
  std::int32_t plane[64];
  const auto add = [&](int i)
  {
    const Entry& entry = this->Instances[this->EntryOf[hits.instance[i]]];
    found.planes.emplace_back(
      TrianglePlane(*entry.octree->surface(), hits.primitive[i]), entry.local, entry.sizes);
    return static_cast<std::int32_t>(found.planes.size()) - 1;
  };
  std::uint64_t small = 0;
  for (int i = 0; i < 64; ++i)
  {
    const std::int32_t slot = nearest.slot[i];
    if (slot == NearestTriangles::Small)
    {
      small |= std::uint64_t(1) << i;
      continue;
    }
    if (planeOf[slot] < 0)
    {
      planeOf[slot] = add(i);
    }
    plane[i] = planeOf[slot];
  }
  const std::size_t shared = found.planes.size();
  for (; small != 0; small &= small - 1)
  {
    const int i = lowest(small);
    plane[i] = add(i);
  }
  // No decided hit lies beyond the rays' ends.
  std::uint64_t left =
    depthsOnPlanes(found.planes.data(), plane, 8.0 * tileX, 8.0 * tileY, hits.t) & ~doubtful;
  found.planes.resize(shared);
  for (; left != 0; left &= left - 1)
  {
    const int i = lowest(left);
    if (nearest.slot[i] == NearestTriangles::None)
    {
      continue;
    }
    const Entry& entry = this->Instances[this->EntryOf[hits.instance[i]]];
    bool edgeOn;
    const double t = meetPlane(TrianglePlane(*entry.octree->surface(), hits.primitive[i]),
      entry.local, 8 * tileX + (i & 7) + 0.5, 8 * tileY + (i >> 3) + 0.5, edgeOn);
    hits.t[i] = static_cast<float>(t);
    if (edgeOn && group.steep(tileX - scratch.groupX, tileY - scratch.groupY, i, nearest))
    {
      doubtful |= std::uint64_t(1) << i;
    }
  }
}

void LayeredView::measureHits(
  int tileX, int tileY, const NearestTriangles& nearest, MergedTile& hits) const
{
  RayBlock block;
  HitBlock measured;
  double x[64], y[64];
  std::int32_t decided[64];
  for (int i = 0; i < 64; ++i)
  {
    x[i] = 8 * tileX + (i & 7) + 0.5;
    y[i] = 8 * tileY + (i >> 3) + 0.5;
    decided[i] = nearest.slot[i] != NearestTriangles::None;
  }
  // Of one instance after the other; mostly there is one.
  for (int first = 0; first < 64; ++first)
  {
    if (!decided[first])
    {
      continue;
    }
    const std::uint32_t owner = hits.instance[first];
    const Entry& entry = this->Instances[this->EntryOf[owner]];
    for (int i = 0; i < 64; ++i)
    {
      const bool own = hits.instance[i] == owner;
      measured.primitive[i] = own ? hits.primitive[i] : NoPrimitive;
      decided[i] = own ? 0 : decided[i];
    }
    fillRays(entry.local, x, y, block);
    depthsOnTriangles(*entry.octree, block, measured);
    for (int i = 0; i < 64; ++i)
    {
      hits.t[i] = measured.primitive[i] != NoPrimitive ? measured.t[i] : hits.t[i];
    }
  }
}

bool LayeredView::traceDoubtful(
  double x, double y, int ray, TileScratch& scratch, SeenHit& first) const
{
  // The nearest of each instance by the float test, as intersectTile() has it.
  scratch.hits.clear();
  for (const CandidateTriangle& candidate : scratch.nearest.candidates)
  {
    if (!(candidate.pixels >> ray & 1))
    {
      continue;
    }
    const std::uint32_t owner = candidate.owner;
    const Entry& entry = this->Instances[this->EntryOf[owner]];
    glm::vec3 origin, direction;
    entry.local.ray(x, y, origin, direction);
    float t;
    if (!rayMeetsTriangle(*entry.octree->surface(), origin, direction, candidate.triangle, t) ||
      !(t >= 0.0f && t <= entry.local.tMax))
    {
      continue;
    }
    const auto same = std::find_if(scratch.hits.begin(), scratch.hits.end(),
      [&](const SeenHit& hit) { return hit.instance == owner; });
    const SeenHit hit{ owner, candidate.triangle, 0.0, x, y, t };
    if (same == scratch.hits.end())
    {
      scratch.hits.push_back(hit);
    }
    else if (t < same->floatT || (t == same->floatT && hit.primitive > same->primitive))
    {
      *same = hit;
    }
  }
  bool any = false;
  for (SeenHit& hit : scratch.hits)
  {
    const Entry& entry = this->Instances[this->EntryOf[hit.instance]];
    if (this->Exact)
    {
      hit.floatT = placeOnPlane(
        TrianglePlane(*entry.octree->surface(), hit.primitive), entry.local, x, y, hit.floatT);
    }
    hit.t = entry.local.base + hit.floatT;
    if (!any || this->inFront(hit, first))
    {
      any = true;
      first = hit;
    }
  }
  return any;
}
}
