// A frame's shadow maps in one buffer texture. Of those that lie in arrays only the ones that are
// others than last time are sent. All calls are made in its context.
#ifndef svoMapTextures_h
#define svoMapTextures_h

#include "svoBufferTexture.h"
#include "svoFrame.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace svo
{
class MapTextures
{
public:
  /// Floats that all maps may have together in the current context.
  static std::size_t most();

  /// Has these maps, at least one, all of one size, in the texture. `texture`: where they lie
  /// already (Tracer::mapTexture()), or 0. False, and nothing is there, if OpenGL has no room.
  bool upload(const std::vector<const ShadowMap*>& maps, unsigned int texture);
  void release();

  /// By map: where its table begins; there its layer.
  const std::vector<int>& tables() const { return this->Tables; }
  /// Bytes that OpenGL holds for this.
  std::size_t memory() const { return this->Sent.bytes(); }
  /// The name of the texture.
  unsigned int name() const { return this->Borrowed != 0 ? this->Borrowed : this->Sent.name(); }

private:
  /// Where a map lies.
  struct Block
  {
    std::size_t first = 0; // its table: by tile of the map where its texels begin, in tiles
    std::size_t table = 0; // tiles of the map
    std::size_t tiles = 0; // that there is room for behind the table
    std::size_t stride = 0;
    std::weak_ptr<const ShadowTexels> sent; // what is there

    std::size_t texels() const
    {
      constexpr std::size_t InTile = ShadowTexels::InTile;
      return (this->first + this->table + InTile - 1) / InTile * InTile;
    }
  };
  bool fits(const std::vector<const ShadowMap*>& maps) const;
  bool layOut(const std::vector<const ShadowMap*>& maps);
  void send(const ShadowTexels& texels, const Block& block);

  unsigned int Borrowed = 0;                         // the tracer's
  BufferTexture Sent{ BufferTexture::Texel::Float }; // first a tile of texels in which nothing lies
  std::vector<Block> Blocks;                         // of Sent, by map
  std::vector<int> Tables;
};
}

#endif
