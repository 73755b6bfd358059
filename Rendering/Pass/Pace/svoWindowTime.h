// The times that the renderers of a window take, which share the time of its frames.
#ifndef svoWindowTime_h
#define svoWindowTime_h

#include "svoEraseIf.h"
#include "svoSampleDistance.h"

#include <cstdint>
#include <map>
#include <memory>

namespace svo
{
/// The cost of frames of a window's renderers. Rays are equally far apart in all of them, so that
/// each has a share of the time in proportion to what there is to be seen in it: see
/// SampleDistance::choose().
class WindowTime
{
public:
  /// The one of a window. Renderers of different passes meet here.
  static std::shared_ptr<WindowTime> of(const void* window)
  {
    static std::map<const void*, std::weak_ptr<WindowTime>> windows;
    eraseIf(windows, [](const auto& entry) { return entry.second.expired(); });
    std::shared_ptr<WindowTime> found = windows[window].lock();
    if (!found)
    {
      found = std::make_shared<WindowTime>();
      windows[window] = found;
    }
    return found;
  }

  void measured(const void* renderer, const FrameCost& cost)
  {
    this->Renderers[renderer] = { cost, ++this->Count };
  }

  void forget(const void* renderer) { this->Renderers.erase(renderer); }

  /// The sum of those others that were measured since the renderer itself was: one that shows
  /// nothing any more, or whose layers are all kept, takes no time.
  FrameCost others(const void* renderer) const
  {
    const auto own = this->Renderers.find(renderer);
    const std::uint64_t since = own != this->Renderers.end() ? own->second.number : 0;
    FrameCost sum;
    for (const auto& entry : this->Renderers)
    {
      if (entry.second.number > since)
      {
        sum.fixed += entry.second.cost.fixed;
        sum.rays += entry.second.cost.rays;
        sum.shadows += entry.second.cost.shadows;
      }
    }
    return sum;
  }

private:
  struct Measured
  {
    FrameCost cost;
    std::uint64_t number = 0; // 1, 2, 3, ... in the order of measurements
  };
  std::map<const void*, Measured> Renderers;
  std::uint64_t Count = 0;
};
}

#endif
