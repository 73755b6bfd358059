// The triangles of one or more instances in a group of tiles: made ready once, and each tile finds
// the nearest of them in one pass. Rays about which that leaves a doubt are tested one by one.
#ifndef svoGroupTriangles_h
#define svoGroupTriangles_h

#include "svoHitOrder.h"
#include "svoTileGroup.h"
#include "svoTilePlanes.h"
#include "svoTracedInstances.h"
#include "svoTriangleGroup.h"

#include <cstdint>
#include <vector>

namespace svo
{
/// What a thread keeps for them from tile to tile.
struct GroupTrianglesMemory
{
  std::vector<GroupNode> nodes;
  NearestTriangles nearest;
  std::vector<SeenHit> hits;
};

class GroupTriangles
{
public:
  void clear()
  {
    this->Group.clear();
    this->Planes.clear();
    this->PlaneOf.clear();
    this->Incomplete = false;
  }
  bool empty() const { return this->Group.empty(); }
  /// To ask what they hide.
  const TriangleGroup& triangles() const { return this->Group; }

  /// Adds what a group may see of an instance, but of that what there is hides. `many`: many other
  /// instances are added, which may hide each other. False if the instance has to be traced by
  /// rays.
  bool add(const TracedInstances& instances, const TracedInstance& entry, const TileGroup& group,
    bool many, GroupTrianglesMemory& memory);
  /// After add() has failed: all the others have to be added once more.
  bool incomplete() const { return this->Incomplete; }

  /// What they give for a tile of the group; false if nothing, and then nothing is written.
  /// Calls count(instance) for those whose triangles were looked at, perhaps more than once.
  template <class Count>
  bool nearest(const TracedInstances& instances, const TileGroup& group, int tileX, int tileY,
    GroupTrianglesMemory& memory, MergedTile& hits, Count&& count)
  {
    const int column = tileX - group.x, row = tileY - group.y;
    NearestTriangles& found = memory.nearest;
    if (this->empty() || !this->Group.nearest(column, row, found, hits.primitive, hits.instance))
    {
      return false;
    }
    for (const SeenTriangle& seen : found.seen)
    {
      count(this->Group.owner(seen.slot));
    }
    for (const GroupPixels::Part& part : this->Group.small().parts())
    {
      if (part.tiles >> (TileGroup::Tiles * row + column) & 1)
      {
        count(part.owner);
      }
    }
    return this->settle(instances, group, tileX, tileY, memory, hits);
  }

private:
  /// Finds the depths of the nearest triangles, and all of the rays that are in doubt; false if
  /// nothing is hit.
  bool settle(const TracedInstances& instances, const TileGroup& group, int tileX, int tileY,
    GroupTrianglesMemory& memory, MergedTile& hits);
  /// In double; adds to the doubtful rays.
  void placeHits(const TracedInstances& instances, const TileGroup& group, int tileX, int tileY,
    const NearestTriangles& nearest, std::uint64_t& doubtful, MergedTile& hits);

  TriangleGroup Group;
  /// Planes of slots that were seen so far, and where among them a slot's lies, or -1; the first
  /// is of no slot.
  std::vector<SeenPlane> Planes;
  std::vector<std::int32_t> PlaneOf;
  bool Incomplete = false; // by an instance that could not be made ready
};
}

#endif
