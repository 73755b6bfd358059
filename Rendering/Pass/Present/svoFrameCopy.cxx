#include "svoFrameCopy.h"

#include "svoOpenGL.h"

#include "vtkTextureObject.h"

#include <cmath>
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

GLint attached(GLenum attachment, GLenum what)
{
  GLint answer = 0;
  glGetFramebufferAttachmentParameteriv(GL_DRAW_FRAMEBUFFER, attachment, what, &answer);
  return answer;
}

/// The texture that is attached to the framebuffer that is bound.
GLuint textureOf(GLenum attachment)
{
  return static_cast<GLuint>(attached(attachment, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME));
}

/// Its internal format; 0 if that is no plain texture of two dimensions.
GLint formatOf(GLenum attachment)
{
  if (attached(attachment, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) != GL_TEXTURE)
  {
    return 0;
  }
  GLint before = 0, format = 0;
  glGetIntegerv(GL_TEXTURE_BINDING_2D, &before);
  glBindTexture(GL_TEXTURE_2D, textureOf(attachment));
  glGetTexLevelParameteriv(GL_TEXTURE_2D, 0, GL_TEXTURE_INTERNAL_FORMAT, &format);
  glBindTexture(GL_TEXTURE_2D, static_cast<GLuint>(before));
  return format;
}

/// A framebuffer of two textures for as long as this lives, in the place of the one that is bound.
class BoundFramebuffer
{
public:
  BoundFramebuffer(
    GLenum target, GLenum binding, GLuint colors, GLenum depthAttachment, GLuint depths)
    : Target(target)
  {
    glGetIntegerv(binding, &this->Before);
    glGenFramebuffers(1, &this->Own);
    glBindFramebuffer(target, this->Own);
    glFramebufferTexture2D(target, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colors, 0);
    glFramebufferTexture2D(target, depthAttachment, GL_TEXTURE_2D, depths, 0);
  }
  ~BoundFramebuffer()
  {
    glBindFramebuffer(this->Target, static_cast<GLuint>(this->Before));
    glDeleteFramebuffers(1, &this->Own);
  }
  BoundFramebuffer(const BoundFramebuffer&) = delete;
  BoundFramebuffer& operator=(const BoundFramebuffer&) = delete;

  bool complete() const
  {
    return glCheckFramebufferStatus(this->Target) == GL_FRAMEBUFFER_COMPLETE;
  }

private:
  GLenum Target;
  GLint Before = 0;
  GLuint Own = 0;
};
}

DepthFormat formatForCopies()
{
  GLint framebuffer = 0, buffer = GL_NONE, samples = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
  glGetIntegerv(GL_DRAW_BUFFER, &buffer);
  glGetIntegerv(GL_SAMPLES, &samples);
  if (framebuffer == 0 || buffer != GL_COLOR_ATTACHMENT0 || samples != 0 || !runsOnProcessor() ||
    formatOf(GL_COLOR_ATTACHMENT0) != GL_RGBA8)
  {
    return DepthFormat::None;
  }
  const GLint depth = formatOf(GL_DEPTH_ATTACHMENT);
  return depth == GL_DEPTH_COMPONENT32 ? DepthFormat::Bits32
    : depth == GL_DEPTH24_STENCIL8     ? DepthFormat::Bits24
                                       : DepthFormat::None;
}

bool keepsLight()
{
  GLint buffer = GL_NONE;
  glGetIntegerv(GL_DRAW_BUFFER, &buffer);
  if (buffer < GL_COLOR_ATTACHMENT0 || buffer > GL_COLOR_ATTACHMENT15)
  {
    return false; // of the window itself, or none
  }
  const auto attachment = static_cast<GLenum>(buffer);
  return attached(attachment, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) != GL_NONE &&
    attached(attachment, GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) == GL_FLOAT;
}

void toDepthBuffer(const float* depths, std::size_t count, DepthFormat format, std::uint32_t* words)
{
  if (format == DepthFormat::Bits24)
  {
    // 24 bits are what a float holds: Mesa multiplies by the largest and rounds.
    for (std::size_t i = 0; i < count; ++i)
    {
      words[i] = static_cast<std::uint32_t>(std::lrint(depths[i] * 16777215.0f)) << 8;
    }
    return;
  }
  // Mesa multiplies by 2^31, the largest power of two that an int has room for but for 1 itself,
  // doubles the integer, and takes one off where that went over.
  for (std::size_t i = 0; i < count; ++i)
  {
    const float half = depths[i] * 2147483648.0f;
    const bool over = !(half < 2147483648.0f);
    words[i] = over ? ~0u : 2u * static_cast<std::uint32_t>(static_cast<std::int32_t>(half));
  }
}

bool copyRectangles(vtkTextureObject* colors, vtkTextureObject* depths, DepthFormat format,
  const std::vector<PixelRect>& rectangles)
{
  // Past vtkOpenGLState, which is none the wiser.
  GLint viewport[4];
  glGetIntegerv(GL_VIEWPORT, viewport);
  // Where a stencil shares the depths' words both are copied, since Mesa takes words apart only by
  // drawing. VTK attaches the depths alone, and then only these would be.
  const bool stencil = format == DepthFormat::Bits24;
  const GLenum depthAttachment = stencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
  const GLbitfield all =
    GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | (stencil ? GL_STENCIL_BUFFER_BIT : 0);
  const BoundFramebuffer target(GL_DRAW_FRAMEBUFFER, GL_DRAW_FRAMEBUFFER_BINDING,
    textureOf(GL_COLOR_ATTACHMENT0), depthAttachment, textureOf(GL_DEPTH_ATTACHMENT));
  const BoundFramebuffer source(GL_READ_FRAMEBUFFER, GL_READ_FRAMEBUFFER_BINDING,
    colors->GetHandle(), depthAttachment, depths->GetHandle());
  const bool complete = target.complete() && source.complete();
  for (std::size_t i = 0; complete && i < rectangles.size(); ++i)
  {
    const PixelRect& r = rectangles[i];
    glBlitFramebuffer(r.x0, r.y0, r.x1, r.y1, viewport[0] + r.x0, viewport[1] + r.y0,
      viewport[0] + r.x1, viewport[1] + r.y1, all, GL_NEAREST);
  }
  return complete;
}
}
