#include "svoGroupTriangles.h"

#include "svoIntersectTile.h"
#include "svoNode.h"
#include "svoPlaceOnTriangles.h"
#include "svoRayMeetsTriangle.h"

#include <algorithm>
#include <cmath>

namespace svo
{
namespace
{
/// Where a group sees more nodes than this its tiles look for their own.
constexpr std::size_t MostGroupNodes = 4096;
/// Where it sees fewer of an instance there are not enough triangles for one to hide another. With
/// 0 ordinary meshes take 5 % longer, meshes of triangles smaller than pixels 2 % less.
constexpr std::size_t FewGroupNodes = 400;

/// Depths in float, of views that are not exact.
void measureHits(const TracedInstances& instances, int tileX, int tileY,
  const NearestTriangles& nearest, MergedTile& hits)
{
  RayBlock block;
  HitBlock measured;
  const TilePoints at(tileX, tileY);
  std::int32_t decided[64];
  for (int i = 0; i < 64; ++i)
  {
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
    const TracedInstance& entry = instances.of(owner);
    for (int i = 0; i < 64; ++i)
    {
      const bool own = hits.instance[i] == owner;
      measured.primitive[i] = own ? hits.primitive[i] : NoPrimitive;
      decided[i] = own ? 0 : decided[i];
    }
    fillRays(entry.local, at.x, at.y, block);
    depthsOnTriangles(*entry.octree, block, measured);
    for (int i = 0; i < 64; ++i)
    {
      hits.t[i] = measured.primitive[i] != NoPrimitive ? measured.t[i] : hits.t[i];
    }
  }
}

/// What a ray of the tile in memory.nearest meets first, by the float test; false if nothing.
bool traceDoubtful(const TracedInstances& instances, double x, double y, int ray,
  GroupTrianglesMemory& memory, SeenHit& first)
{
  // The nearest of each instance by the float test, as intersectTile() has it.
  memory.hits.clear();
  for (const CandidateTriangle& candidate : memory.nearest.candidates)
  {
    if (!(candidate.pixels >> ray & 1))
    {
      continue;
    }
    const std::uint32_t owner = candidate.owner;
    const TracedInstance& entry = instances.of(owner);
    float t;
    if (!rayMeetsTriangle(*entry.octree->surface(), glm::vec3(entry.local.originAt(x, y)),
          glm::vec3(entry.local.directionAt(x, y)), candidate.triangle, t) ||
      !(t >= 0.0f && t <= entry.local.tMax))
    {
      continue;
    }
    const auto same = std::find_if(memory.hits.begin(), memory.hits.end(),
      [&](const SeenHit& hit) { return hit.instance == owner; });
    const SeenHit hit{ owner, candidate.triangle, 0.0, x, y, t };
    if (same == memory.hits.end())
    {
      memory.hits.push_back(hit);
    }
    else if (t < same->floatT || (t == same->floatT && hit.primitive > same->primitive))
    {
      *same = hit;
    }
  }
  const HitOrder order(instances);
  bool any = false;
  for (SeenHit& hit : memory.hits)
  {
    const TracedInstance& entry = instances.of(hit.instance);
    if (instances.exact())
    {
      hit.floatT = placeOnPlane(
        TrianglePlane(*entry.octree->surface(), hit.primitive), entry.local, x, y, hit.floatT);
    }
    hit.t = entry.local.base + hit.floatT;
    if (!any || order.inFront(hit, first))
    {
      any = true;
      first = hit;
    }
  }
  return any;
}
}

bool GroupTriangles::add(const TracedInstances& instances, const TracedInstance& entry,
  const TileGroup& group, bool many, GroupTrianglesMemory& memory)
{
  // Keys are squares of depths.
  const KeyBase& keys = instances.keys();
  constexpr double Farthest = 1e15, FarthestRatio = 1e9;
  const double size = entry.functions.wBase + entry.local.tMax;
  if (!entry.functions.valid || !(size + std::abs(keys.far) < Farthest) ||
    !(std::abs(keys.far) < FarthestRatio * size))
  {
    return false;
  }
  HitLimits limits;
  if (instances.exact())
  {
    limits.error = instances.error(entry.index);
    // A little less than where placeOnPlane() changes its mind.
    limits.nearReach = 0.999 * edgeOnReach(entry.local);
    limits.reach = 0.999 * placingReach(entry.local);
  }
  const GroupView view =
    makeGroupView(entry.local, entry.functions, keys, limits, group.x, group.y);
  const TilePyramid all =
    makePyramid(entry.projection, instances.view(), group.x, group.y, TileGroup::Tiles);
  if (!findGroupNodes(
        *entry.octree, all, 0.0f, entry.local.tMax, MostGroupNodes, memory.nodes, group.window))
  {
    return false;
  }
  if (memory.nodes.empty())
  {
    return true;
  }
  this->Incomplete = !this->Group.add(*entry.octree, memory.nodes, view,
    memory.nodes.size() < FewGroupNodes && !many ? SmallTriangles::AsSlots
                                                 : SmallTriangles::AsPoints,
    entry.index);
  return !this->Incomplete;
}

bool GroupTriangles::settle(const TracedInstances& instances, const TileGroup& group, int tileX,
  int tileY, GroupTrianglesMemory& memory, MergedTile& hits)
{
  NearestTriangles& nearest = memory.nearest;
  std::uint64_t doubtful = nearest.doubtful;
  if (instances.exact())
  {
    this->placeHits(instances, group, tileX, tileY, nearest, doubtful, hits);
  }
  else
  {
    measureHits(instances, tileX, tileY, nearest, hits);
  }
  this->Group.findCandidates(tileX - group.x, tileY - group.y, doubtful, nearest);
  for (; doubtful != 0; doubtful &= doubtful - 1)
  {
    const int i = lowestBit(doubtful);
    const double x = 8 * tileX + (i & 7) + 0.5, y = 8 * tileY + (i >> 3) + 0.5;
    SeenHit first;
    const bool hit = traceDoubtful(instances, x, y, i, memory, first);
    hits.primitive[i] = hit ? first.primitive : NoPrimitive;
    hits.instance[i] = hit ? first.instance : NoInstance;
    hits.t[i] = hit ? first.floatT : 0.0f;
  }
  return std::any_of(
    hits.primitive, hits.primitive + 64, [](Primitive p) { return p != NoPrimitive; });
}

void GroupTriangles::placeHits(const TracedInstances& instances, const TileGroup& group, int tileX,
  int tileY, const NearestTriangles& nearest, std::uint64_t& doubtful, MergedTile& hits)
{
  if (this->Planes.empty())
  {
    this->Planes.emplace_back();
    this->PlaneOf.assign(this->Group.size() + 1, -1);
    this->PlaneOf[0] = 0; // of no slot
  }
  static_assert(NearestTriangles::None == -1, "planes are counted from it");
  std::int32_t* const planeOf = this->PlaneOf.data() + 1;
  std::int32_t plane[64];
  const auto add = [&](int i)
  {
    const TracedInstance& entry = instances.of(hits.instance[i]);
    this->Planes.emplace_back(
      TrianglePlane(*entry.octree->surface(), hits.primitive[i]), entry.local, entry.sizes);
    return static_cast<std::int32_t>(this->Planes.size()) - 1;
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
  const std::size_t shared = this->Planes.size();
  for (; small != 0; small &= small - 1)
  {
    const int i = lowestBit(small);
    plane[i] = add(i);
  }
  // No decided hit lies beyond the rays' ends.
  std::uint64_t left =
    depthsOnPlanes(this->Planes.data(), plane, 8.0 * tileX, 8.0 * tileY, hits.t) & ~doubtful;
  this->Planes.resize(shared);
  for (; left != 0; left &= left - 1)
  {
    const int i = lowestBit(left);
    if (nearest.slot[i] == NearestTriangles::None)
    {
      continue;
    }
    const TracedInstance& entry = instances.of(hits.instance[i]);
    bool edgeOn;
    const double t = meetPlane(TrianglePlane(*entry.octree->surface(), hits.primitive[i]),
      entry.local, 8 * tileX + (i & 7) + 0.5, 8 * tileY + (i >> 3) + 0.5, edgeOn);
    hits.t[i] = static_cast<float>(t);
    if (edgeOn && this->Group.steep(tileX - group.x, tileY - group.y, i, nearest))
    {
      doubtful |= std::uint64_t(1) << i;
    }
  }
}
}
