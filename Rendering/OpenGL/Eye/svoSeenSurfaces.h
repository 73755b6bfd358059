// Octrees of planes that the eye sees, as VTK's shaders trace them: svoEyeWalk.glsl.
#ifndef svoSeenSurfaces_h
#define svoSeenSurfaces_h

#include "svoBufferTexture.h"
#include "svoEyeCode.h"
#include "svoScene.h"
#include "svoView.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <glm/vec4.hpp>

namespace svo
{
class OctreeArena;

class SeenSurfaces
{
public:
  /// Which instances of a scene, with planes, may be seen: has room for their boxes, and sends
  /// colours that are not in OpenGL's memory. False, and nothing is there, if it has no room.
  bool place(const Scene& scene, const std::vector<std::size_t>& seen);

  /// Says in empty code what VTK draws of these in a view, all held by `arena`; `constants` are the
  /// walk's. Sends boxes that have changed.
  void describe(const Scene& scene, const View& view, const OctreeArena& arena,
    const std::string& constants, EyeCode& code);

  bool any() const { return !this->Seen.empty(); }
  void release();
  std::size_t bytes() const { return this->Colors.bytes() + this->Boxes.bytes(); }

private:
  /// What colours lie in memory for: an octree's id, Attributes::version, and their array.
  using Key = std::tuple<std::uint64_t, std::uint64_t, const void*>;
  static Key keyOf(const Instance& instance);
  bool placeColors(const Scene& scene);

  std::vector<std::size_t> Seen;      // instances
  std::map<Key, std::size_t> Colored; // first texel
  BufferTexture Colors{ BufferTexture::Texel::Word };
  std::vector<glm::vec4> Sent; // boxes
  BufferTexture Boxes{ BufferTexture::Texel::FourFloats };
};
}

#endif
