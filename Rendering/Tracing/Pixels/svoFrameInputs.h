// What the last frame was made of: where the next one is made of the same, it is the same picture,
// to the bit, and nothing has to be done.
#ifndef svoFrameInputs_h
#define svoFrameInputs_h

#include "svoFrame.h"
#include "svoScene.h"
#include "vtkSVOTracingModule.h"

#include <cstdint>
#include <vector>

namespace svo
{
/// What has changed since the last frame.
struct FrameChanges
{
  bool all = true;                      // of the picture nothing is known to be the same
  std::vector<std::uint32_t> instances; // by index, those of which anything differs
  bool none() const { return !this->all && this->instances.empty(); }
};

class VTKSVOTRACING_EXPORT FrameInputs
{
public:
  /// True if anything but instances is another than in the last call: all values are compared. Of
  /// instances SceneChanges say so.
  bool differ(const Scene& scene, const View& view, const FrameSettings& settings);
  /// The picture of the last call is not kept: all of the next one is new.
  void forget() { this->Inputs.clear(); }

private:
  std::vector<unsigned char> Inputs; // all but the instances, as bytes
};
}

#endif
