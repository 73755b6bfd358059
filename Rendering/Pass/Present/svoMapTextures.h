// A frame's shadow maps behind one texture unit. Of those that lie in arrays only the ones that are
// others than last time are sent.
#ifndef svoMapTextures_h
#define svoMapTextures_h

#include "svoFrame.h"
#include "svoTexelBuffer.h"

#include "vtkSmartPointer.h"

#include <cstddef>
#include <memory>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkTextureObject;

namespace svo
{
class MapTextures
{
public:
  /// Floats that all maps may have together in the current context.
  static std::size_t most();

  /// Has these maps, at least one, all of one size, behind the unit. `texture`: where they lie
  /// already (Tracer::mapTexture()), or 0. False, and nothing is there, if OpenGL has no room.
  bool upload(
    const std::vector<const ShadowMap*>& maps, unsigned int texture, vtkOpenGLRenderWindow* window);
  void release();

  /// By map: where its table begins.
  const std::vector<int>& tables() const { return this->Tables; }
  /// Bytes that OpenGL holds for this.
  std::size_t memory() const { return this->Sent ? this->Sent->size() * sizeof(float) : 0; }

  /// Binds them to a texture unit, which it returns.
  int activate() const;
  void deactivate() const;

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
  void borrow(
    const std::vector<const ShadowMap*>& maps, unsigned int texture, vtkOpenGLRenderWindow* window);
  bool fits(const std::vector<const ShadowMap*>& maps, vtkOpenGLRenderWindow* window) const;
  bool layOut(const std::vector<const ShadowMap*>& maps, vtkOpenGLRenderWindow* window);
  void send(const ShadowTexels& texels, const Block& block);

  vtkSmartPointer<vtkTextureObject> Texture; // the tracer's, or Sent
  vtkSmartPointer<TexelBuffer> Sent;         // first of all a tile of texels in which nothing lies
  std::vector<Block> Blocks;                 // of Sent, by map
  std::vector<int> Tables;
};
}

#endif
