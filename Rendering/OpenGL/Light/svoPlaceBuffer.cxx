#include "svoPlaceBuffer.h"

#include "svoLightCode.h"
#include "svoOpenGL.h"
#include "svoReceivers.h"
#include "svoTextures.h"

#include "vtkOpenGLState.h"

#include <string>

namespace svo
{
bool PlaceBuffer::hasRows(int height)
{
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  return rowsOf(height, true) <= most;
}

bool PlaceBuffer::resize(int width, int height, bool translucent, int layers, unsigned int format)
{
  if (this->fits(width, height, translucent, layers, format))
  {
    return true;
  }
  this->release();
  GLint before = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &before);
  this->Width = width;
  this->Height = height;
  this->Slices = translucent ? 1 + TranslucentSlices : 1;
  this->Layers = layers;
  this->Format = format;
  this->Shares = makeTexture(format, width, this->rows(), layers);
  this->Places = makeTexture(GL_RGBA32F, width, this->rows());
  this->Planes = makeTexture(GL_RGBA16, width, this->rows());
  this->Depths = makeTexture(GL_DEPTH_COMPONENT32F, width, this->rows());
  this->Before = translucent ? makeTexture(GL_RGBA32F, width, height) : 0;
  glGenFramebuffers(1, &this->Framebuffer);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, this->Framebuffer);
  glFramebufferTexture(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, this->Places, 0);
  glFramebufferTexture(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, this->Planes, 0);
  glFramebufferTexture(GL_DRAW_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, this->Depths, 0);
  const GLenum targets[] = { GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1 };
  glDrawBuffers(2, targets);
  const bool complete = glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(before));
  if (!complete || this->Shares == 0 || glGetError() != GL_NO_ERROR)
  {
    this->release();
    return false;
  }
  return true;
}

void PlaceBuffer::release()
{
  if (this->any())
  {
    const GLuint textures[] = { this->Places, this->Planes, this->Depths, this->Before,
      this->Shares };
    glDeleteTextures(5, textures);
    glDeleteFramebuffers(1, &this->Framebuffer);
  }
  *this = PlaceBuffer();
}

void PlaceBuffer::gather(vtkOpenGLState* state, const Draw& draw)
{
  using Able = vtkOpenGLState::ScopedglEnableDisable;
  const Able blends(state, GL_BLEND), scissors(state, GL_SCISSOR_TEST), deep(state, GL_DEPTH_TEST);
  const vtkOpenGLState::ScopedglViewport seen(state);
  const vtkOpenGLState::ScopedglScissor cut(state);
  const vtkOpenGLState::ScopedglDepthMask mask(state);
  const vtkOpenGLState::ScopedglDepthFunc compared(state);
  const vtkOpenGLState::ScopedglColorMask colors(state);
  state->PushFramebufferBindings();
  state->vtkglBindFramebuffer(GL_FRAMEBUFFER, this->Framebuffer);
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
  for (int slice = 0; slice < this->Slices; ++slice)
  {
    const int row = slice * this->sliceRows();
    // Wide lines and points leave a viewport.
    state->vtkglEnable(GL_SCISSOR_TEST);
    state->vtkglScissor(0, row, this->Width, this->Height);
    if (slice > 0)
    {
      glBlitFramebuffer(0, 0, this->Width, this->Height, 0, row, this->Width, row + this->Height,
        GL_DEPTH_BUFFER_BIT, GL_NEAREST);
    }
    if (slice > 1)
    {
      GLint bound = 0;
      glGetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
      glBindTexture(GL_TEXTURE_2D, this->Before);
      glReadBuffer(GL_COLOR_ATTACHMENT0);
      glCopyTexSubImage2D(
        GL_TEXTURE_2D, 0, 0, 0, 0, row - this->sliceRows(), this->Width, this->Height);
      glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(bound));
    }
    state->vtkglViewport(0, row, this->Width, this->Height);
    draw(slice, slice > 1 ? row : 0);
  }
  state->PopFramebufferBindings();
}

void PlaceBuffer::describe(LightCode& code, int width, int height, bool others) const
{
  code.fromPlaces = true;
  code.textures.push_back({ "svoShares", this->Shares, GL_TEXTURE_2D_ARRAY });
  code.floats.push_back({ "svoMaskPixels", 1,
    { static_cast<float>(this->Width) / static_cast<float>(width),
      static_cast<float>(this->Height) / static_cast<float>(height) } });
  if (others)
  {
    code.textures.push_back({ "svoPlaces", this->Places, GL_TEXTURE_2D });
    code.integers.push_back({ "svoSliceRows", { this->Height, this->sliceRows() } });
    code.translucent = this->translucent();
  }
  if (others && code.translucent)
  {
    code.textures.push_back({ "svoBefore", this->Before, GL_TEXTURE_2D });
    code.constants += "#define svoSlices " + std::to_string(this->Slices) + "\n";
  }
  code.integers.push_back({ "svoFirstPixel", { 0, 0 } });
}

void PlaceBuffer::aim(vtkOpenGLState* state, LightCode& code)
{
  int viewport[4];
  state->vtkglGetIntegerv(GL_VIEWPORT, viewport);
  code.integers.back().values = { // what describe() ends with
    viewport[0], viewport[1]
  };
}

void PlaceBuffer::read(vtkOpenGLState* state, ReceiverPlaces& places) const
{
  const std::size_t numbers = 4 * static_cast<std::size_t>(this->Width) * this->rows();
  places.width = this->Width;
  places.height = this->rows();
  places.sliceRows = this->sliceRows();
  places.places.resize(numbers);
  places.planes.resize(numbers);
  state->PushReadFramebufferBinding();
  state->vtkglBindFramebuffer(GL_READ_FRAMEBUFFER, this->Framebuffer);
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glReadPixels(0, 0, this->Width, this->rows(), GL_RGBA, GL_FLOAT, places.places.data());
  glReadBuffer(GL_COLOR_ATTACHMENT1);
  glReadPixels(0, 0, this->Width, this->rows(), GL_RGBA, GL_UNSIGNED_SHORT, places.planes.data());
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  state->PopReadFramebufferBinding();
}
}
