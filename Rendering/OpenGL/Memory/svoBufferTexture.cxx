#include "svoBufferTexture.h"

#include "svoOpenGL.h"
#include "svoTextures.h"

#include <algorithm>

namespace svo
{
namespace
{
constexpr GLenum Formats[] = { GL_R32F, GL_RGBA32F, GL_R32UI, GL_RGBA32UI }; // by Texel
}

std::size_t BufferTexture::most()
{
  GLint texels = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
  return static_cast<std::size_t>(std::max(texels, 0));
}

std::size_t BufferTexture::texelBytes() const
{
  const bool four = this->Kind == Texel::FourFloats || this->Kind == Texel::FourWords;
  return four ? 16 : 4;
}

bool BufferTexture::allocate(std::size_t texels, std::size_t kept)
{
  forgetErrors();
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBuffer(GL_TEXTURE_BUFFER, buffer);
  glBufferData(GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(texels * this->texelBytes()), nullptr,
    GL_DYNAMIC_DRAW);
  if (kept > 0)
  {
    glBindBuffer(GL_COPY_READ_BUFFER, this->Buffer);
    glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_TEXTURE_BUFFER, 0, 0,
      static_cast<GLsizeiptr>(kept * this->texelBytes()));
    glBindBuffer(GL_COPY_READ_BUFFER, 0);
  }
  glBindBuffer(GL_TEXTURE_BUFFER, 0);
  this->release();
  this->Buffer = buffer;
  GLint bound = 0; // VTK knows what it has bound
  glGetIntegerv(GL_TEXTURE_BINDING_BUFFER, &bound);
  glGenTextures(1, &this->Texture);
  glBindTexture(GL_TEXTURE_BUFFER, this->Texture);
  glTexBuffer(GL_TEXTURE_BUFFER, Formats[static_cast<int>(this->Kind)], this->Buffer);
  glBindTexture(GL_TEXTURE_BUFFER, static_cast<GLuint>(bound));
  this->Size = texels;
  if (glGetError() != GL_NO_ERROR)
  {
    this->release();
    return false;
  }
  return true;
}

void BufferTexture::send(std::size_t first, const void* texels, std::size_t count)
{
  if (count == 0) // there may be no buffer
  {
    return;
  }
  glBindBuffer(GL_TEXTURE_BUFFER, this->Buffer);
  glBufferSubData(GL_TEXTURE_BUFFER, static_cast<GLintptr>(first * this->texelBytes()),
    static_cast<GLsizeiptr>(count * this->texelBytes()), texels);
  glBindBuffer(GL_TEXTURE_BUFFER, 0);
}

void BufferTexture::release()
{
  if (this->Buffer != 0)
  {
    glDeleteTextures(1, &this->Texture);
    glDeleteBuffers(1, &this->Buffer);
  }
  this->Buffer = this->Texture = 0;
  this->Size = 0;
}
}
