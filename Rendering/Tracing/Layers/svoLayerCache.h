// The depth layers of a view that are kept from frame to frame, under a limit.
//
// Layers are made for instances that stand still: a new instance is taken to do so, one that just
// changed, or is seen by a view that did, is taken to go on changing.
#ifndef svoLayerCache_h
#define svoLayerCache_h

#include "svoDepthLayer.h"
#include "svoLayerBudget.h"
#include "svoLayerKey.h"
#include "vtkSVOTracingModule.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>

namespace svo
{
class VTKSVOTRACING_EXPORT LayerCache
{
public:
  /// Begins a frame. Layers are dropped, not to come back in this frame, where `moved`, the view's
  /// rays are others than in the last frame; all are, with what is known of instances, unless
  /// `keep`.
  void beginFrame(bool keep, bool moved, LayerBudget& budget);

  /// The layer of an instance, by Instance::id; null if it has none in this frame: layers are not
  /// kept, the instance changes, another one with the same id has it, or the budget is spent. It is
  /// what `key` names in the present view, whatever instance had the id before.
  DepthLayer* layerOf(
    std::uint64_t id, const LayerKey& key, const PixelRect& rect, LayerBudget& budget);

  /// Ends the asking: forgets instances that were not asked for since beginFrame().
  void endFrame(LayerBudget& budget);

  std::size_t memory() const { return this->Memory; } // bytes
  void clear();

private:
  struct Entry
  {
    LayerKey key;
    std::unique_ptr<DepthLayer> layer; // null while the instance or the view moves
    bool used = false;
  };
  void drop(Entry& kept, LayerBudget& budget);

  std::unordered_map<std::uint64_t, Entry> Layers; // by Instance::id
  bool Keep = false;
  bool Moved = false;
  std::size_t Memory = 0;
};
}

#endif
