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
/// What is not what it was in the last frame.
struct FrameChanges
{
  bool all = true;                      // of the picture nothing is known to be the same
  std::vector<std::uint32_t> instances; // by index, those of which anything differs
  bool none() const { return !this->all && this->instances.empty(); }
};

class KeptFrame
{
public:
  /// What of the inputs differs from those that `frame` was made of, if it is the one that was kept
  /// last. Instances are compared, by their versions, with those of the last call in any case.
  FrameChanges compare(
    const Scene& scene, const View& view, const FrameSettings& settings, const Frame& frame);
  /// `frame` has been made of what was compared last.
  void keep(const Frame& frame);
  void forget() { this->Version = 0; }

  /// Frame::covered of the kept frame.
  const PixelRect& covered() const { return this->Covered; }

private:
  /// Values as plain bytes.
  using Values = std::vector<unsigned char>;
  static void valuesOf(
    const Scene& scene, const View& view, const FrameSettings& settings, Values& values);

  std::uint64_t Version = 0; // Frame::version
  const std::uint8_t* Pixels = nullptr;
  PixelRect Covered;
  Values LastFrame, NextFrame; // all but the instances
  std::uint64_t SceneVersion = 0;
  std::vector<std::uint64_t> Instances; // their versions
};
}

#endif
