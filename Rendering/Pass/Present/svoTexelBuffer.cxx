#include "svoTexelBuffer.h"

#include "svoOpenGL.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"

#include <algorithm>

namespace svo
{
vtkStandardNewMacro(TexelBuffer);

TexelBuffer::~TexelBuffer()
{
  // The superclass releases what it knows of, as the window does before it goes.
  if (this->Buffer != 0 && this->Context)
  {
    this->Context->PushContext();
    glDeleteBuffers(1, &this->Buffer);
    this->Context->PopContext();
  }
}

std::size_t TexelBuffer::most()
{
  GLint texels = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
  return static_cast<std::size_t>(std::max(texels, 0));
}

bool TexelBuffer::allocate(std::size_t count)
{
  this->Target = GL_TEXTURE_BUFFER;
  this->Components = 1;
  this->Width = static_cast<unsigned int>(count);
  this->Height = this->Depth = 1;
  this->NumberOfDimensions = 1;
  this->AutoParametersOff();
  this->CreateTexture();
  for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; ++i) // errors of others
  {
  }
  if (this->Buffer == 0)
  {
    glGenBuffers(1, &this->Buffer);
  }
  glBindBuffer(GL_TEXTURE_BUFFER, this->Buffer);
  glBufferData(
    GL_TEXTURE_BUFFER, static_cast<GLsizeiptr>(count * sizeof(float)), nullptr, GL_DYNAMIC_DRAW);
  glBindBuffer(GL_TEXTURE_BUFFER, 0);
  this->Activate();
  glTexBuffer(GL_TEXTURE_BUFFER, GL_R32F, this->Buffer);
  this->Deactivate();
  return glGetError() == GL_NO_ERROR;
}

void TexelBuffer::send(std::size_t first, const float* values, std::size_t count)
{
  glBindBuffer(GL_TEXTURE_BUFFER, this->Buffer);
  glBufferSubData(GL_TEXTURE_BUFFER, static_cast<GLintptr>(first * sizeof(float)),
    static_cast<GLsizeiptr>(count * sizeof(float)), values);
  glBindBuffer(GL_TEXTURE_BUFFER, 0);
}

void TexelBuffer::ReleaseGraphicsResources(vtkWindow* window)
{
  if (this->Buffer != 0)
  {
    glDeleteBuffers(1, &this->Buffer);
    this->Buffer = 0;
  }
  this->Superclass::ReleaseGraphicsResources(window);
}
}
