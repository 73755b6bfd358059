// What the last frame was made of: where the next one is made of the same, it is the same picture,
// to the bit, and nothing has to be done.
#ifndef svoKeptFrame_h
#define svoKeptFrame_h

#include "svoFrame.h"
#include "svoScene.h"

#include <cstdint>
#include <vector>

namespace svo
{
class KeptFrame
{
public:
  /// Notes what `frame` has been made of.
  void keep(
    const Scene& scene, const View& view, const FrameSettings& settings, const Frame& frame);
  void forget() { this->Version = 0; }

  /// True if `frame` is the one that was kept last, and would be made of the same once more. Of
  /// octrees and arrays their names are compared: Octree::id(), and where an array lies together
  /// with its version.
  bool shows(
    const Scene& scene, const View& view, const FrameSettings& settings, const Frame& frame) const;
  /// Frame::covered of the kept frame.
  const PixelRect& covered() const { return this->Covered; }

private:
  std::uint64_t Version = 0; // Frame::version
  const std::uint8_t* Pixels = nullptr;
  PixelRect Covered;
  std::vector<unsigned char> Inputs;
};
}

#endif
