// Floats behind one texture unit, which shaders look up by their number.
#ifndef svoTexelBuffer_h
#define svoTexelBuffer_h

#include "vtkTextureObject.h"

#include <cstddef>

namespace svo
{
class TexelBuffer : public vtkTextureObject
{
public:
  static TexelBuffer* New();
  vtkTypeMacro(TexelBuffer, vtkTextureObject);

  /// Floats that a context allows.
  static std::size_t most();

  /// Makes room for so many floats, which are undefined then, in the context that SetContext() has
  /// been told. False if OpenGL refuses.
  bool allocate(std::size_t count);
  std::size_t size() const { return this->Width; }
  void send(std::size_t first, const float* values, std::size_t count);

  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  TexelBuffer() = default;
  ~TexelBuffer() override;

private:
  TexelBuffer(const TexelBuffer&) = delete;
  void operator=(const TexelBuffer&) = delete;

  unsigned int Buffer = 0;
};
}

#endif
