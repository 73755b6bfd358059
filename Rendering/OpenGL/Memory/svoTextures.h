// Textures of the current context that are drawn into, and looked up texel by texel.
#ifndef svoTextures_h
#define svoTextures_h

#include "vtkSVOOpenGLModule.h"

namespace svo
{
/// A texture of one level, not filtered, of undefined texels: GL_TEXTURE_2D, or with `layers`
/// GL_TEXTURE_2D_ARRAY. `format`: OpenGL's internal one. 0 if OpenGL refuses.
VTKSVOOPENGL_EXPORT unsigned int makeTexture(
  unsigned int format, int width, int height, int layers = 0);

/// Forgets OpenGL's errors that others have made.
void forgetErrors();
}

#endif
