// OpenGL's state around what draws beside VTK, which knows what it has set.
#ifndef svoStateGuard_h
#define svoStateGuard_h

#include "svoOpenGL.h"

#include <cstddef>
#include <iterator>
#include <vector>

namespace svo
{
/// Switches tests, blending and culling off; in the end all is as it was of these, of depths,
/// colours, the viewport and the scissor box, the framebuffer that is drawn into, the program, the
/// vertex array, and what was bound here.
class StateGuard
{
public:
  StateGuard()
  {
    for (std::size_t i = 0; i < std::size(this->On); ++i)
    {
      this->On[i] = glIsEnabled(Switches[i]);
      glDisable(Switches[i]);
    }
    glGetIntegerv(GL_VIEWPORT, this->Viewport);
    glGetIntegerv(GL_SCISSOR_BOX, this->Scissor);
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &this->Framebuffer);
    glGetIntegerv(GL_CURRENT_PROGRAM, &this->Program);
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &this->Vertices);
    glGetIntegerv(GL_ACTIVE_TEXTURE, &this->Unit);
    glGetIntegerv(GL_DEPTH_FUNC, &this->Compared);
    glGetBooleanv(GL_DEPTH_WRITEMASK, &this->Deep);
    glGetBooleanv(GL_COLOR_WRITEMASK, this->Colors);
  }
  StateGuard(const StateGuard&) = delete;
  StateGuard& operator=(const StateGuard&) = delete;
  ~StateGuard()
  {
    for (std::size_t i = 0; i < this->Bound.size(); ++i)
    {
      glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
      glBindTexture(this->Bound[i].target, static_cast<GLuint>(this->Bound[i].before));
    }
    glActiveTexture(static_cast<GLenum>(this->Unit));
    glColorMask(this->Colors[0], this->Colors[1], this->Colors[2], this->Colors[3]);
    glDepthMask(this->Deep);
    glDepthFunc(static_cast<GLenum>(this->Compared));
    glBindVertexArray(static_cast<GLuint>(this->Vertices));
    glUseProgram(static_cast<GLuint>(this->Program));
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(this->Framebuffer));
    glScissor(this->Scissor[0], this->Scissor[1], this->Scissor[2], this->Scissor[3]);
    glViewport(this->Viewport[0], this->Viewport[1], this->Viewport[2], this->Viewport[3]);
    for (std::size_t i = 0; i < std::size(this->On); ++i)
    {
      this->On[i] ? glEnable(Switches[i]) : glDisable(Switches[i]);
    }
  }

  /// Binds a buffer texture, or a GL_TEXTURE_2D, to the next unit, and returns that.
  int bind(GLuint texture, GLenum target = GL_TEXTURE_BUFFER)
  {
    const auto unit = static_cast<int>(this->Bound.size());
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    this->Bound.push_back({ target, 0 });
    glGetIntegerv(target == GL_TEXTURE_2D ? GL_TEXTURE_BINDING_2D : GL_TEXTURE_BINDING_BUFFER,
      &this->Bound.back().before);
    glBindTexture(target, texture);
    return unit;
  }

private:
  static constexpr GLenum Switches[] = { GL_BLEND, GL_SCISSOR_TEST, GL_DEPTH_TEST, GL_CULL_FACE,
    GL_STENCIL_TEST };
  GLboolean On[std::size(Switches)];
  GLint Viewport[4], Scissor[4];
  GLint Framebuffer, Program, Vertices, Unit, Compared;
  GLboolean Deep, Colors[4];
  struct Binding
  {
    GLenum target;
    GLint before;
  };
  std::vector<Binding> Bound; // by unit
};
}

#endif
