// Memory of an OpenGL context that shaders look up by number: a buffer behind a texture. All calls
// are made in that context; whoever owns one is told before it goes.
#ifndef svoBufferTexture_h
#define svoBufferTexture_h

#include "vtkSVOOpenGLModule.h"

#include <cstddef>

namespace svo
{
class VTKSVOOPENGL_EXPORT BufferTexture
{
public:
  enum class Texel
  {
    Float,      // R32F
    FourFloats, // RGBA32F
    Word,       // R32UI
    FourWords   // RGBA32UI
  };

  explicit BufferTexture(Texel texel)
    : Kind(texel)
  {
  }
  BufferTexture(const BufferTexture&) = delete;
  BufferTexture& operator=(const BufferTexture&) = delete;

  /// Texels that the current context allows.
  static std::size_t most();

  /// Makes room for so many texels, which are undefined then but for the first `kept`, which stay.
  /// False, and nothing is there, if OpenGL refuses.
  bool allocate(std::size_t texels, std::size_t kept = 0);
  void send(std::size_t first, const void* texels, std::size_t count);
  void release();

  std::size_t size() const { return this->Size; } // texels
  std::size_t texelBytes() const;
  std::size_t bytes() const { return this->Size * this->texelBytes(); }
  /// Name of the texture; 0: there is none.
  unsigned int name() const { return this->Texture; }

private:
  Texel Kind;
  std::size_t Size = 0;
  unsigned int Buffer = 0, Texture = 0;
};
}

#endif
