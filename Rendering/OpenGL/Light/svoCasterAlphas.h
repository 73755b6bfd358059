// The alpha of casters' colours in OpenGL's memory, as svoRayWalk.glsl reads it: eight numbers a
// caster, which are its opacity; how many there are of each triangle or plane; (n / 4096, n %
// 4096), the arena's number of its octree's first one; the texels of a row; three unused ones. Then
// two rows of texels, and triangle by triangle, or plane by plane
//
//   1  the plane's alpha
//   3  the corners' alphas
//   6  the corners' places in a row of texels, and then from row to row
#ifndef svoCasterAlphas_h
#define svoCasterAlphas_h

#include "svoBufferTexture.h"
#include "svoInstance.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
class CasterAlphas
{
public:
  /// Forgets which casters there are; what lies in OpenGL's memory stays until send().
  void clear() { this->Casters.clear(); }
  /// One with mappedOpacity, that lives until send(); `first` as above. Where its numbers will
  /// begin, in eights.
  std::size_t add(const Instance& caster, std::uint32_t first);
  /// Has all of them in OpenGL's memory: sends them if they are others than the last ones. False,
  /// and nothing is there, if OpenGL has no room.
  bool send();
  void release();

  const BufferTexture& texels() const { return this->Texels; }

private:
  struct Caster
  {
    const Instance* instance;
    std::uint32_t first;
    std::size_t end; // of its numbers
    // What they are made of:
    std::uint64_t octree, version; // id; Attributes::version
    const void* colors;
    float opacity;
    bool operator==(const Caster& other) const;
  };
  std::vector<Caster> Casters, Sent;
  BufferTexture Texels{ BufferTexture::Texel::Float };
};
}

#endif
