#include "svoFrameCopy.h"

#include "svoOpenGL.h"

#include "vtkTextureObject.h"

#include <string>

namespace svo
{
namespace
{
bool runsOnProcessor()
{
  const auto* text = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  const std::string renderer = text ? text : "";
  for (const char* name : { "llvmpipe", "softpipe", "SWR", "Software Rasterizer" })
  {
    if (renderer.find(name) != std::string::npos)
    {
      return true;
    }
  }
  return false;
}

/// The internal format of what is attached to the framebuffer that is bound; 0 if that is no plain
/// texture of two dimensions.
GLint formatOf(GLenum attachment)
{
  const auto ask = [attachment](GLenum what)
  {
    GLint answer = 0;
    glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment, what, &answer);
    return answer;
  };
  if (ask(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) != GL_TEXTURE)
  {
    return 0;
  }
  GLint before = 0, format = 0;
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &before);
  glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(ask(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME)));
  glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
  glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(before));
  return format;
}
}

bool isWorthCopying()
{
  GLint framebuffer = 0, buffer = GL_NONE, samples = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
  glGetIntegerv(GL_DRAW_BUFFER, &buffer);
  glGetIntegerv(GL_SAMPLES, &samples);
  return framebuffer != 0 && buffer == GL_COLOR_ATTACHMENT0 && samples == 0 && runsOnProcessor() &&
    formatOf(GL_COLOR_ATTACHMENT0) == GL_RGBA8 &&
    formatOf(GL_DEPTH_ATTACHMENT) == GL_DEPTH_COMPONENT32;
}

void toDepthBuffer(const float* depths, std::size_t count, std::uint32_t* words)
{
  // Mesa multiplies by 2^31, the largest power of two that an int has room for but for 1 itself,
  // doubles the integer, and takes one off where that went over.
  for (std::size_t i = 0; i < count; ++i)
  {
    const float half = depths[i] * 2147483648.0f;
    const bool over = !(half < 2147483648.0f);
    words[i] = over ? ~0u : 2u * static_cast<std::uint32_t>(static_cast<std::int32_t>(half));
  }
}

bool copyRectangles(
  vtkTextureObject* colors, vtkTextureObject* depths, const std::vector<PixelRect>& rectangles)
{
  // Past vtkOpenGLState, which is none the wiser.
  GLint before = 0, viewport[4];
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &before);
  glGetIntegerv(GL_VIEWPORT, viewport);
  GLuint source = 0;
  glGenFramebuffers(1, &source);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, source);
  glFramebufferTexture2D(
    GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colors->GetHandle(), 0);
  glFramebufferTexture2D(
    GL_READ_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depths->GetHandle(), 0);
  const bool complete = glCheckFramebufferStatus(GL_READ_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  for (std::size_t i = 0; complete && i < rectangles.size(); ++i)
  {
    const PixelRect& r = rectangles[i];
    glBlitFramebuffer(r.x0, r.y0, r.x1, r.y1, viewport[0] + r.x0, viewport[1] + r.y0,
      viewport[0] + r.x1, viewport[1] + r.y1, GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT,
      GL_NEAREST);
  }
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(before));
  glDeleteFramebuffers(1, &source);
  return complete;
}
}
