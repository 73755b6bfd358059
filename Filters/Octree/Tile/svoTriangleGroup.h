// The triangles that a group of 4x4 tiles sees, of one or several instances, made ready once to be
// drawn into each of the tiles.
#ifndef svoTriangleGroup_h
#define svoTriangleGroup_h

#include "svoGroupView.h"
#include "svoOctree.h"
#include "svoPyramidNodes.h"
#include "vtkSVOOctreeModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
/// A triangle of a group that a tile may see.
struct SeenTriangle
{
  float key; // no point of it in the tile has a lesser one
  std::int32_t slot;
  std::uint64_t pixels = 0; // whose rays may meet it first, as far as was known when it was drawn
};

/// What a tile's 64 rays meet first, as far as that is beyond doubt.
struct NearestTriangles
{
  static constexpr std::int32_t None = -1;

  alignas(64) std::int32_t slot[64]; // in the group, or None
  std::uint64_t doubtful = 0;        // rays, one bit each, whose slot means nothing
  std::vector<SeenTriangle> seen;    // nearest first

  // Scratch memory.
  std::vector<std::int32_t> selected;
  std::vector<float> keys;
};

class VTKSVOOCTREE_EXPORT TriangleGroup
{
public:
  void clear() { this->Arrays.count = 0; }
  bool empty() const { return this->Arrays.count == 0; }
  std::size_t size() const { return this->Arrays.count; }

  /// Adds the triangles of an octree's nodes. False if there are some that cannot be made ready,
  /// as those that cross the eye plane: then nothing is added.
  bool add(const Octree& octree, const std::vector<TileNode>& nodes, const GroupView& view,
    std::uint32_t owner);

  /// What the rays through the pixels' centres of a tile of the group meet first: slots, and their
  /// triangles and owners, ~0 where there are none. False if nothing; then nothing is written.
  bool nearest(int column, int row, NearestTriangles& found, std::uint32_t* triangles,
    std::uint32_t* owners) const;

  std::uint32_t triangle(std::int32_t slot) const { return this->Arrays.id[slot]; }
  std::uint32_t owner(std::int32_t slot) const { return this->Arrays.owner[slot]; }
  /// True if the depth of a hit may be off by more than GroupView::nearReach.
  bool steep(std::int32_t slot) const { return (this->Arrays.flags[slot] & Steep) != 0; }

  enum Flags : std::int32_t
  {
    Thin = 1,    // may as well be wound the other way round: nothing of it is certain
    Unsure = 2,  // depths may be off by more than GroupView::reach
    Clipped = 4, // reaches beyond the rays' ends
    Steep = 8
  };
  /// An array a number, a triangle a slot. The pixel is counted from the middle of the group.
  struct Slots
  {
    std::size_t count = 0;
    /// Edge e is ex[e] x + ey[e] y + ec[e]: above 1 the pixel is certainly inside of it, below -1
    /// certainly not.
    std::array<std::vector<float>, 3> ex, ey, ec;
    std::vector<float> kx, ky, kc; // the key is kx x + ky y + kc ...
    std::vector<float> slack;      // ... and not further from it
    std::vector<float> kNear, kFar;
    std::vector<std::int32_t> tiles, x0, x1, y0, y1; // the pixels that it may cover
    std::vector<std::int32_t> flags;
    std::vector<std::uint32_t> id, owner;
    // Scratch memory: triangles that cannot be projected corner by corner.
    std::size_t crossingCount = 0;
    std::vector<std::int32_t> crossing;
    void makeRoom(std::size_t size);
  };

  const Slots& slots() const { return this->Arrays; }

private:
  /// The triangles of a node.
  struct NodeList
  {
    const std::uint32_t* ids;
    std::uint32_t count, inlineId;
    bool counted; // the count stands before the ids
  };
  Slots Arrays;
  std::vector<NodeList> Lists;
  std::vector<std::uint32_t> Ids;   // of the octree that is added
  std::vector<std::uint64_t> Known; // triangles among Ids: one bit each, zero in between
};
}

#endif
