// The instances that a view sees as its rays meet them: each one's place, and the order in which
// they are traced. Made once a frame, read by all threads.
#ifndef svoTracedInstances_h
#define svoTracedInstances_h

#include "svoDepthLayer.h"
#include "svoInstance.h"
#include "svoPixelFunctions.h"
#include "svoTilePlanes.h"
#include "svoViewedInstances.h"
#include "svoVisibleInstances.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace svo
{
/// How the depth of an instance's hits is found once more, where it decides who is in front.
enum class DepthRefinement : std::uint8_t
{
  Never,
  OnTriangle, // hits lie on the triangles that they name
  Traced      // hits stand for triangles that have to be found
};

struct TracedInstance : VisibleInstance
{
  MeshPoints points;
  DepthRefinement refinement;
  // Of those that are traced by tiles, and not as balls.
  PixelFunctions functions;
  RaySizes sizes;
  // Set by LayeredView.
  DepthLayer* layer = nullptr; // kept, or null: traced for this frame alone, cut at what is merged
  TileIntervals intervals;     // where there is no layer, of those whose rays are walked
};

/// Entries are those that are seen, in the order of the scene; ViewedInstances has them by index
/// into Scene::instances.
class TracedInstances : public ViewedInstances
{
public:
  using List = std::vector<TracedInstance>;

  /// `exact`: see LayeredView.
  explicit TracedInstances(bool exact)
    : Exact(exact)
  {
  }

  /// Finds those that `takesPart` (findVisible()) and places them in the view.
  void find(const Scene& scene, const View& view, const Culling& culling,
    const std::function<bool(const Instance&)>& takesPart, const LevelOf& levelOf,
    const ParallelFor& parallelFor);

  bool exact() const { return this->Exact; }
  const View& view() const { return this->Seen; }
  const VisibleSet& set() const { return this->Visible; }

  bool empty() const { return this->Entries.empty(); }
  std::size_t size() const { return this->Entries.size(); }
  const TracedInstance& operator[](std::size_t entry) const { return this->Entries[entry]; }
  List::const_iterator begin() const { return this->Entries.begin(); }
  List::const_iterator end() const { return this->Entries.end(); }
  List& entries() { return this->Entries; }
  /// Where one of them is.
  std::size_t indexOf(const TracedInstance& entry) const
  {
    return static_cast<std::size_t>(&entry - this->Entries.data());
  }
  /// By index into Scene::instances, of one that is seen.
  const TracedInstance& of(std::uint32_t instance) const
  {
    return this->Entries[this->EntryOf[instance]];
  }
  std::size_t entryOf(std::uint32_t instance) const { return this->EntryOf[instance]; }
  /// Front to back.
  const std::vector<std::uint32_t>& order() const { return this->Order; }
  /// The lowest node of the tree of instances around an entry, by index into VisibleSet::nodes.
  std::uint32_t nodeOf(std::size_t entry) const { return this->NodeOf[entry]; }

  /// Offsets of depth differ.
  bool shifted() const { return this->Shifted; }
  /// They do, and by slopes, too.
  bool sloped() const { return this->Sloped; }
  double largestError() const { return this->LargestError; }
  /// To where linear depths begin, of a view that is not parallel.
  double fromEye() const { return this->FromEye; }
  /// Of all that are traced by tiles.
  const KeyBase& keys() const { return this->Keys; }

private:
  void place(const Scene& scene, const LevelOf& levelOf, std::uint32_t index, std::size_t entry);
  DepthRefinement refinementOf(
    const Instance& instance, const VisibleInstance& visible, double& error) const;
  KeyBase keyBase() const;
  void compareOffsets();

  const bool Exact;
  View Seen;
  VisibleSet Visible;
  List Entries;
  std::vector<std::uint32_t> EntryOf, Order, NodeOf;
  bool Shifted = false, Sloped = false;
  double LargestError = 0.0, FromEye = 0.0;
  KeyBase Keys;
};
}

#endif
