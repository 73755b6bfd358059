#include "svoPlaceBuffer.h"

#include "svoOpenGL.h"
#include "svoReceivers.h"
#include "svoTextures.h"

#include "vtkOpenGLState.h"

namespace svo
{
bool PlaceBuffer::resize(int width, int height)
{
  if (width == this->Width && height == this->Height)
  {
    return true;
  }
  if (this->any())
  {
    const GLuint textures[] = { this->Places, this->Planes, this->Depths };
    glDeleteTextures(3, textures);
    glDeleteFramebuffers(1, &this->Framebuffer);
  }
  *this = PlaceBuffer();
  if (width * height == 0)
  {
    return true;
  }
  GLint before = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &before);
  this->Width = width;
  this->Height = height;
  this->Places = makeTexture(GL_RGBA32F, width, height);
  this->Planes = makeTexture(GL_RGBA16, width, height);
  this->Depths = makeTexture(GL_DEPTH_COMPONENT32F, width, height);
  glGenFramebuffers(1, &this->Framebuffer);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, this->Framebuffer);
  glFramebufferTexture(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, this->Places, 0);
  glFramebufferTexture(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, this->Planes, 0);
  glFramebufferTexture(GL_DRAW_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, this->Depths, 0);
  const GLenum targets[] = { GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1 };
  glDrawBuffers(2, targets);
  const bool complete = glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(before));
  if (!complete || glGetError() != GL_NO_ERROR)
  {
    this->resize(0, 0);
    return false;
  }
  return true;
}

void PlaceBuffer::gather(vtkOpenGLState* state, const std::function<void()>& draw)
{
  using Able = vtkOpenGLState::ScopedglEnableDisable;
  const Able blends(state, GL_BLEND), scissors(state, GL_SCISSOR_TEST), deep(state, GL_DEPTH_TEST);
  const vtkOpenGLState::ScopedglViewport seen(state);
  const vtkOpenGLState::ScopedglDepthMask mask(state);
  const vtkOpenGLState::ScopedglDepthFunc compared(state);
  const vtkOpenGLState::ScopedglColorMask colors(state);
  state->PushFramebufferBindings();
  state->vtkglBindFramebuffer(GL_FRAMEBUFFER, this->Framebuffer);
  state->vtkglViewport(0, 0, this->Width, this->Height);
  state->vtkglDisable(GL_BLEND);
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(GL_LEQUAL);
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  const float nowhere[] = { 0.0f, 0.0f, 0.0f, ReceiverPlaces::Nowhere };
  const float farthest = 1.0f;
  glClearBufferfv(GL_COLOR, 0, nowhere);
  glClearBufferfv(GL_DEPTH, 0, &farthest);
  draw();
  state->PopFramebufferBindings();
}

void PlaceBuffer::read(vtkOpenGLState* state, ReceiverPlaces& places) const
{
  const std::size_t numbers = 4 * static_cast<std::size_t>(this->Width) * this->Height;
  places.width = this->Width;
  places.height = this->Height;
  places.places.resize(numbers);
  places.planes.resize(numbers);
  state->PushReadFramebufferBinding();
  state->vtkglBindFramebuffer(GL_READ_FRAMEBUFFER, this->Framebuffer);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glReadPixels(0, 0, this->Width, this->Height, GL_RGBA, GL_FLOAT, places.places.data());
  glReadBuffer(GL_COLOR_ATTACHMENT1);
  glReadPixels(0, 0, this->Width, this->Height, GL_RGBA, GL_UNSIGNED_SHORT, places.planes.data());
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  state->PopReadFramebufferBinding();
}
}
