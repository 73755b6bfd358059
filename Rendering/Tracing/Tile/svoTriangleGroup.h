// The triangles that a group of 4x4 tiles sees, of one or several instances, made ready once to be
// drawn into each of the tiles.
#ifndef svoTriangleGroup_h
#define svoTriangleGroup_h

#include "svoGroupPixels.h"
#include "svoGroupView.h"
#include "svoOctree.h"
#include "svoPyramidNodes.h"
#include "vtkSVOTracingModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
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

/// A triangle that rays may meet first of which that has to be asked.
struct CandidateTriangle
{
  std::uint32_t triangle, owner;
  std::uint64_t pixels; // whose rays those are
};

/// What a tile's 64 rays meet first, as far as that is beyond doubt.
struct NearestTriangles
{
  static constexpr std::int32_t None = -1, Small = -2;

  /// In the group; None; or Small: a triangle of a few pixels, which has no slot.
  alignas(64) std::int32_t slot[64];
  std::uint64_t doubtful = 0;                // rays, one bit each, whose slot means nothing
  std::vector<SeenTriangle> seen;            // that have slots, nearest first
  std::vector<CandidateTriangle> candidates; // see findCandidates()

  // Scratch memory.
  std::vector<std::int32_t> selected;
  std::vector<float> keys;
};

/// What triangles of a few pixels become. Points are cheaper where there are so many that they hide
/// each other, slots elsewhere; what is met is the same.
enum class SmallTriangles
{
  AsPoints,
  AsSlots
};

class VTKSVOTRACING_EXPORT TriangleGroup
{
public:
  void clear()
  {
    this->Arrays.count = 0;
    this->Small.clear();
    this->Cover = std::numeric_limits<float>::infinity();
  }
  bool empty() const { return this->Arrays.count == 0 && this->Small.empty(); }
  std::size_t size() const { return this->Arrays.count; }

  /// Adds the triangles of an octree's nodes, but of those that what there is hides: nearer ones
  /// are to come first. False if there are some that cannot be made ready, as those that cross the
  /// eye plane: then the group is good for nothing until it is cleared.
  bool add(const Octree& octree, const std::vector<GroupNode>& nodes, const GroupView& view,
    SmallTriangles small, std::uint32_t owner);

  /// True if what there is hides all that lies in a node's box, or in any other one, from its
  /// `tNear` on.
  bool hides(const GroupNode& node, const GroupView& view) const;
  /// The same of these pixels of the group, from a key on.
  bool hides(const GroupWindow& box, float key) const
  {
    return key > this->Cover || this->Small.hides(box.x0, box.x1, box.y0, box.y1, key);
  }

  /// What the rays through the pixels' centres of a tile of the group meet first: slots, and their
  /// triangles and owners, ~0 where there are none. False if nothing; then nothing is written.
  bool nearest(int column, int row, NearestTriangles& found, std::uint32_t* triangles,
    std::uint32_t* owners) const;

  /// True if the depth of what a ray of that tile meets may be off by more than
  /// GroupView::nearReach.
  bool steep(int column, int row, int pixel, const NearestTriangles& found) const;
  /// All that these rays of that tile may meet first.
  void findCandidates(int column, int row, std::uint64_t rays, NearestTriangles& found) const;

  std::uint32_t triangle(std::int32_t slot) const { return this->Arrays.id[slot]; }
  std::uint32_t owner(std::int32_t slot) const { return this->Arrays.owner[slot]; }

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
  const GroupPixels& small() const { return this->Small; }

private:
  /// The triangles of a node.
  struct NodeList
  {
    const std::uint32_t* ids;
    std::uint32_t count, inlineId;
    bool counted; // the count stands before the ids
  };
  /// So many lists are on their way at a time.
  static constexpr std::size_t ListsAtOnce = 16;
  /// Fewer would leave lanes empty, more be made ready before what hides them.
  static constexpr std::size_t TrianglesAtOnce = 128;

  static void findList(const Octree& octree, std::uint32_t node, NodeList& list);
  /// Adds the triangles of Lists to Ids, each once.
  void readLists(const Surface& surface);
  /// Projects triangles of one owner, each of them once. They become slots, or, if there are
  /// `points`, points where they have a few pixels; those that have to be made ready alone are
  /// named in slots.crossing. Behind the last id there is room for a vector of zeros.
  static void project(const Surface& surface, const std::uint32_t* ids, std::size_t count,
    const GroupView& view, std::uint32_t owner, Slots& slots, SeenPoints* points);
  /// Makes ready those from `first` on.
  bool makeReady(const Surface& surface, const GroupView& view, SmallTriangles small,
    std::uint32_t owner, std::size_t first);
  /// Looks for triangles before all pixels of the group among slots from `first` on.
  void findCover(std::size_t first);

  Slots Arrays;
  float Cover = std::numeric_limits<float>::infinity(); // hits of greater keys come second
  GroupPixels Small;
  // Of the octree that is added.
  std::array<NodeList, ListsAtOnce> Lists;
  std::size_t ListCount = 0;
  std::vector<std::uint32_t> Ids;
  std::size_t Count = 0;
  std::vector<std::uint64_t> Known; // triangles among Ids: one bit each, zero in between
};
}

#endif
