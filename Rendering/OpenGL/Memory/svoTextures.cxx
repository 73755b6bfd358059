#include "svoTextures.h"

#include "svoOpenGL.h"

namespace svo
{
void forgetErrors()
{
  for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i)
  {
  }
}

unsigned int makeTexture(unsigned int format, int width, int height, int layers)
{
  forgetErrors();
  const GLenum target = layers > 0 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
  GLint bound = 0; // VTK knows what it has bound
  glGetIntegerv(layers > 0 ? GL_TEXTURE_BINDING_2D_ARRAY : GL_TEXTURE_BINDING_2D, &bound);
  const bool stencil = format == GL_DEPTH32F_STENCIL8;
  const GLenum order = stencil        ? GL_DEPTH_STENCIL
    : format == GL_DEPTH_COMPONENT32F ? GL_DEPTH_COMPONENT
                                      : GL_RGBA;
  const GLenum type = stencil ? GL_FLOAT_32_UNSIGNED_INT_24_8_REV : GL_FLOAT;
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(target, name);
  const auto internal = static_cast<GLint>(format);
  if (layers > 0)
  {
    glTexImage3D(target, 0, internal, width, height, layers, 0, order, type, nullptr);
  }
  else
  {
    glTexImage2D(target, 0, internal, width, height, 0, order, type, nullptr);
  }
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
  glBindTexture(target, static_cast<GLuint>(bound));
  if (glGetError() != GL_NO_ERROR)
  {
    glDeleteTextures(1, &name);
    name = 0;
  }
  return name;
}
}
