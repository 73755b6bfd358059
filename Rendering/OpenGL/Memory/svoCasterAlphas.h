// The alpha of casters' colours in OpenGL's memory, as svoRayWalk.glsl reads it: eight numbers a
// caster, which are its opacity; how many there are of each triangle or plane;
// OctreeArena::firstOf() of its octree; the texels of a row; three unused ones. Then two rows of
// texels, and triangle by triangle, or plane by plane
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
#include <tuple>
#include <vector>

#include <glm/vec2.hpp>

namespace svo
{
class CasterAlphas
{
public:
  /// Forgets which casters there are; what lies in OpenGL's memory stays until send().
  void clear();
  /// One with mappedOpacity, that lives until send(); `first` as above. Where its numbers will
  /// begin, in eights.
  std::size_t add(const Instance& caster, const glm::vec2& first);
  /// Has all of them in OpenGL's memory: sends them if they are others than the last ones. False,
  /// and nothing is there, if OpenGL has no room.
  bool send();
  void release();

  const BufferTexture& texels() const { return this->Texels; }

private:
  struct Caster
  {
    const Instance* instance;
    glm::vec2 first;
  };
  /// What a caster's numbers are made of: octree, Attributes::version, the arrays that hold alpha
  /// or lead to it, opacity, first.
  using Key = std::tuple<std::uint64_t, std::uint64_t, const void*, const void*, const void*, float,
    float, float>;
  std::vector<Caster> Casters;
  std::vector<Key> Keys, Sent; // of these casters; of those in OpenGL's memory
  std::size_t Size = 0;        // of all numbers
  BufferTexture Texels{ BufferTexture::Texel::Float };
};
}

#endif
