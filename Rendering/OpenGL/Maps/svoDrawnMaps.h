// Shadow maps that OpenGL draws, in layers of one texture: triangles are rasterised, balls and
// planes are met by rays of their own (svoMapCasters.glsl).
#ifndef svoDrawnMaps_h
#define svoDrawnMaps_h

#include "svoBufferTexture.h"
#include "svoFrame.h"
#include "svoLightDetail.h"
#include "svoMapCopies.h"
#include "svoOutline.h"
#include "svoScene.h"
#include "svoView.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace svo
{
class OctreeArena;

/// Of one renderer. All calls are made in its context; whoever owns one is told before it goes.
class DrawnMaps
{
public:
  /// Has the maps of a scene's lights, fitted as the CPU's are (svoLightDetail.h): each drawn
  /// anew where something of it is not as in the last frame. All casters lie in `arena`, and where
  /// their colours have alpha in `alphas`. At most `room` bytes. Why they are not there, in a few
  /// words, else empty.
  std::string draw(const Scene& scene, const std::vector<CasterInMemory>& casters,
    const OctreeArena& arena, const BufferTexture& alphas, const View& eye,
    const FrameSettings& settings, std::size_t room);
  /// Frees them; what draws them stays until release().
  void forget();
  void release();

  /// As Tracer::shadowMaps() and mapTexture().
  const std::vector<ShadowMap>& maps() const { return this->Maps; }
  unsigned int texture() const { return this->Texels; }
  /// Casters that were drawn in the last frame, each once a map.
  std::size_t drawn() const { return this->Drawn; }
  const TexelWidths& widths() const { return this->Widths; }
  /// Of the maps; of all that is there.
  std::size_t mapBytes() const;
  std::size_t bytes() const;

private:
  void fit(const Scene& scene, const View& eye, const FrameSettings& settings);
  bool resize(int size, int layers, bool translucent, std::size_t room);
  const std::string& link(bool alphas);
  void releaseTextures();
  std::string drawParts(const std::vector<PixelRect>& parts, const std::vector<MapCopy>& copies,
    const OctreeArena& arena, const BufferTexture& alphas);

  std::uint64_t Version = 0; // of the scene that Maps are of
  std::vector<Outline> Fitted;
  std::vector<LightMaps> Lights;
  std::vector<ShadowMap> Maps;
  std::vector<MapCopy> InMaps; // what is in them; of it no octrees
  TexelWidths Widths;
  std::size_t Drawn = 0;

  int Size = 0, Layers = 0; // of the texture
  bool Translucent = false; // it has opacities
  unsigned int Texels = 0, Depths = 0, Framebuffer = 0, Vertices = 0;
  BufferTexture Copies{ BufferTexture::Texel::FourFloats };
  unsigned int Programs[MapCopy::Shapes] = {}; // by shape
  bool HasAlphas = false;                      // they know of them
  std::string Refusal;                         // OpenGL's words, if it does not compile them
};
}

#endif
