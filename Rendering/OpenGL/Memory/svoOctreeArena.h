// Octrees and their triangles in the memory of an OpenGL context, as svoRayWalk.glsl reads them.
// Each is sent once, however many instances, views and frames it is in, and goes when it is gone
// from the processor's memory and such octrees have come to fill half of what is in use.
#ifndef svoOctreeArena_h
#define svoOctreeArena_h

#include "svoBufferTexture.h"
#include "svoOctree.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include <glm/vec2.hpp>

namespace svo
{
struct ShortLists;

/// A number n as (n / 4096, n % 4096): floats tell no larger ones apart.
glm::vec2 inFloats(std::uint32_t number);

class OctreeArena
{
public:
  /// The one of a context, FrameNeeds::context. Its last owner releases it.
  static std::shared_ptr<OctreeArena> of(const void* context);

  /// Has these octrees, all with a surface or planes and not empty, in memory, beside those of
  /// earlier frames and other renderers. False, and nothing is there, if all of them do not fit
  /// into `limit` (bytes), or OpenGL has no room: alone they may fit.
  bool hold(const std::vector<const Octree*>& octrees, std::size_t limit);
  std::size_t count() const { return this->Blocks.size(); }
  void release();
  /// How often it was emptied: whoever shares it asks hold() again when that was another's doing.
  std::uint64_t emptied() const { return this->Emptied; }

  /// The node at which rays through an octree that is held begin; its first triangle, or plane.
  std::uint32_t rootOf(const Octree& octree) const;
  std::uint32_t firstOf(const Octree& octree) const;

  std::size_t bytes() const
  {
    return this->Nodes.bytes() + this->Lists.bytes() + this->Triangles.bytes();
  }
  const BufferTexture& nodes() const { return this->Nodes; }
  const BufferTexture& lists() const { return this->Lists; }
  const BufferTexture& triangles() const { return this->Triangles; }

private:
  /// Numbers of texels: an octree's, or where it begins.
  struct Block
  {
    std::uint32_t node = 0, word = 0, corner = 0;
  };
  struct Held
  {
    WeakOctree octree;
    Block begin, size;
  };
  bool mostlyGone() const;
  bool add(const std::vector<const Octree*>& octrees, std::size_t limit);
  bool makeRoom(const Block& needed, std::size_t limit);
  void send(const Octree& octree, const ShortLists& lists, const Block& at);

  std::map<std::uint64_t, Held> Blocks; // by Octree::id()
  std::uint64_t Emptied = 0;
  Block End; // of what is in use
  BufferTexture Nodes{ BufferTexture::Texel::FourWords };
  BufferTexture Lists{ BufferTexture::Texel::Word };
  BufferTexture Triangles{ BufferTexture::Texel::FourFloats };
};
}

#endif
