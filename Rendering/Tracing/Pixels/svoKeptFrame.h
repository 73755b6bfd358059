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
  bool all = true;                      // nothing is known to be the same
  std::vector<std::uint32_t> instances; // else: by index, those of which anything differs
  bool none() const { return !this->all && this->instances.empty(); }
};

class KeptFrame
{
public:
  /// What of the inputs differs from those that `frame` was made of, if it is the one that was kept
  /// last. Of octrees and arrays their names are compared: Octree::id(), and where an array lies
  /// together with its version.
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
  struct Instances
  {
    std::uint64_t version = 0; // Scene::version
    Values own;                // of each, without its body
    Values bodies;
    std::vector<std::uint32_t> body; // of each, in bodies; copies side by side have one
    std::size_t ownSize = 0, bodySize = 0;
  };
  std::vector<std::uint32_t> differences() const;
  static void valuesOf(
    const Scene& scene, const View& view, const FrameSettings& settings, Values& values);
  static void valuesOf(const Scene& scene, Instances& instances);

  std::uint64_t Version = 0; // Frame::version
  const std::uint8_t* Pixels = nullptr;
  PixelRect Covered;
  Values LastFrame, NextFrame; // all but the instances
  Instances Last, Next;
  bool SameInstances = false; // by their version: Last is what Next would be
};
}

#endif
