// Square textures of floats of one size, as many as a shader likes behind one texture unit.
#ifndef svoTextureArray_h
#define svoTextureArray_h

#include "vtkTextureObject.h"

namespace svo
{
class TextureArray : public vtkTextureObject
{
public:
  static TextureArray* New();
  vtkTypeMacro(TextureArray, vtkTextureObject);

  /// Layers that a context allows; at least 256.
  static int mostLayers();

  /// Makes room for so many layers of size^2 texels in the context that SetContext() has been told,
  /// if there is not just that already; what they hold is undefined then. False if OpenGL refuses.
  bool allocate(int size, int layers);
  bool fits(vtkOpenGLRenderWindow* window, int size, int layers);

  /// size^2 floats, row by row from the lower left.
  void send(int layer, const float* texels);

protected:
  TextureArray() = default;
  ~TextureArray() override = default;

private:
  TextureArray(const TextureArray&) = delete;
  void operator=(const TextureArray&) = delete;
};
}

#endif
