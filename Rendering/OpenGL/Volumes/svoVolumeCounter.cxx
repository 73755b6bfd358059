#include "svoVolumeCounter.h"

#include "svoOpenGL.h"
#include "svoPixelRay.h"
#include "svoProgram.h"
#include "svoShadowVolume.h"
#include "svoStateGuard.h"
#include "svoTerminator.h"
#include "svoTextures.h"
#include "svoUnfold.h"
#include "svoUniforms.h"
#include "svoVolumeDepth.h"
#include "svoVolumeReceiver.h"

#include "vtkOpenGLState.h"

#include <iomanip>
#include <locale>
#include <sstream>
#include <string>
#include <utility>

#include <glm/gtc/type_ptr.hpp>

namespace svo
{
/// OpenGL's state of stencils, beside that of StateGuard.
class StencilGuard
{
public:
  StencilGuard()
  {
    for (int side = 0; side < 2; ++side)
    {
      for (int i = 0; i < Names; ++i)
      {
        glGetIntegerv(Of[side][i], &this->Values[side][i]);
      }
    }
  }
  StencilGuard(const StencilGuard&) = delete;
  StencilGuard& operator=(const StencilGuard&) = delete;
  ~StencilGuard()
  {
    const GLenum sides[] = { GL_FRONT, GL_BACK };
    for (int side = 0; side < 2; ++side)
    {
      const GLint* v = this->Values[side];
      glStencilFuncSeparate(
        sides[side], static_cast<GLenum>(v[0]), v[1], static_cast<GLuint>(v[2]));
      glStencilOpSeparate(sides[side], static_cast<GLenum>(v[3]), static_cast<GLenum>(v[4]),
        static_cast<GLenum>(v[5]));
      glStencilMaskSeparate(sides[side], static_cast<GLuint>(v[6]));
    }
  }

private:
  static constexpr int Names = 7;
  static constexpr GLenum Of[2][Names] = {
    { GL_STENCIL_FUNC, GL_STENCIL_REF, GL_STENCIL_VALUE_MASK, GL_STENCIL_FAIL,
      GL_STENCIL_PASS_DEPTH_FAIL, GL_STENCIL_PASS_DEPTH_PASS, GL_STENCIL_WRITEMASK },
    { GL_STENCIL_BACK_FUNC, GL_STENCIL_BACK_REF, GL_STENCIL_BACK_VALUE_MASK, GL_STENCIL_BACK_FAIL,
      GL_STENCIL_BACK_PASS_DEPTH_FAIL, GL_STENCIL_BACK_PASS_DEPTH_PASS, GL_STENCIL_BACK_WRITEMASK }
  };
  GLint Values[2][Names];
};

namespace
{
// A stencil: rays tell its pixel's light. Else the bits below count volumes.
constexpr GLint Asks = 0x80;
constexpr GLuint CountBits = 0x7f;
constexpr int VerticesOfEdge = 6, VerticesOfCap = 3; // as svoShadowVolume.glsl

constexpr char Zero[] = "#version 150\n"
                        "out vec4 svoNone;\n"
                        "void main()\n"
                        "{\n"
                        "  svoNone = vec4(0.0);\n"
                        "}\n";

GLint at(GLuint program, const char* uniform)
{
  return glGetUniformLocation(program, uniform);
}

/// How a side of a volume counts: by those before a point, or by those behind it.
void count(GLenum side, VolumeDraws::Sides way)
{
  const bool enters = (side == GL_FRONT) == (way == VolumeDraws::Before);
  const GLenum how = enters ? GL_INCR_WRAP : GL_DECR_WRAP;
  way == VolumeDraws::Before ? glStencilOpSeparate(side, GL_KEEP, GL_KEEP, how)
                             : glStencilOpSeparate(side, GL_KEEP, how, GL_KEEP);
}
}

/// Drawing into a light's number, and into depths and stencils. In the end OpenGL is as before.
class VolumeCounter::Scope : public StateGuard
{
public:
  Scope(const VolumeCounter& counter, int number, unsigned int shares)
  {
    glBindVertexArray(counter.Vertices);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, counter.Framebuffer);
    glFramebufferTextureLayer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, shares, 0, number / 4);
    glFramebufferTexture(GL_DRAW_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, counter.Depths, 0);
    glViewport(0, 0, counter.Width, counter.Height);
    glStencilMask(~0u);
    this->write(number);
  }
  /// Colours are written to this number of a layer alone; to none: -1.
  static void write(int number)
  {
    const int plane = number < 0 ? number : number % 4;
    glColorMask(plane == 0, plane == 1, plane == 2, plane == 3);
  }
  /// A program, told of a light.
  static void use(GLuint program, const VolumeDraws& draws, const VolumeDraws::OfLight& light)
  {
    glUseProgram(program);
    glUniform4fv(at(program, "svoLight"), 1, glm::value_ptr(light.light));
    sendUniforms(program, draws.values);
  }

private:
  StencilGuard Stencil;
};

bool VolumeCounter::link(std::string& words)
{
  if (this->Sides != 0)
  {
    return true;
  }
  const auto volume = [&words](unsigned int& program, int caps)
  {
    const std::string constants = "#version 150\n#define svoCaps " + std::to_string(caps) + "\n";
    program =
      linkProgram({ { GL_VERTEX_SHADER, constants + "#define svoAtVertices\n" + svoShadowVolume },
                    { GL_FRAGMENT_SHADER, constants + svoPixelRay + svoShadowVolume } },
        words);
    return program != 0;
  };
  const auto pixels = [&words](unsigned int& program, const std::string& text)
  {
    program = linkProgram({ { GL_VERTEX_SHADER, AllPixels }, { GL_FRAGMENT_SHADER, text } }, words);
    return program != 0;
  };
  std::ostringstream receivers;
  receivers.imbue(std::locale::classic());
  receivers << std::showpoint << std::setprecision(9)
            << "#version 150\nconst float svoDoubtfulSine = " << DoubtfulSine << ";\n"
            << svoUnfold << svoPixelRay << svoVolumeReceiver << svoVolumeDepth;
  const bool linked = volume(this->Sides, 0) && volume(this->Caps, 1) &&
    pixels(this->Receivers, receivers.str()) && pixels(this->Dark, Zero);
  if (!linked)
  {
    this->release();
  }
  return linked;
}

bool VolumeCounter::resize(int width, int height, unsigned int shares)
{
  if (width == this->Width && height == this->Height)
  {
    return true;
  }
  if (this->Framebuffer != 0)
  {
    glDeleteTextures(1, &this->Depths);
    glDeleteFramebuffers(1, &this->Framebuffer);
    glDeleteVertexArrays(1, &this->Vertices);
  }
  this->Width = width;
  this->Height = height;
  this->Depths = this->Framebuffer = this->Vertices = 0;
  if (width * height == 0)
  {
    return true;
  }
  this->Depths = makeTexture(GL_DEPTH32F_STENCIL8, width, height);
  glGenFramebuffers(1, &this->Framebuffer);
  glGenVertexArrays(1, &this->Vertices);
  if (this->Depths == 0)
  {
    return false;
  }
  const Scope scope(*this, 0, shares);
  return glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

void VolumeCounter::find(vtkOpenGLState* state, const VolumeDraws& draws, int number,
  const Pixels& pixels, const Rays& rays)
{
  this->receive(draws, number, pixels);
  {
    // Others draw: what VTK has cached is to be so.
    const StencilGuard stencil;
    const vtkOpenGLState::ScopedglEnableDisable tests(state, GL_STENCIL_TEST);
    const vtkOpenGLState::ScopedglColorMask colors(state);
    const int plane = number % 4;
    state->vtkglEnable(GL_STENCIL_TEST);
    state->vtkglColorMask(plane == 0, plane == 1, plane == 2, plane == 3);
    // To what has no volume rays go from everywhere.
    glStencilFunc(draws.tellAll ? GL_EQUAL : GL_ALWAYS, Asks, Asks);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    rays(this->Framebuffer);
  }
  this->darken(draws, number, pixels);
}

/// All is lit; has depths of what volumes tell of, and stencils of what asks.
void VolumeCounter::receive(const VolumeDraws& draws, int number, const Pixels& pixels)
{
  Scope scope(*this, number, pixels.shares);
  const float lit[] = { 1.0f, 1.0f, 1.0f, 1.0f };
  glDepthMask(GL_TRUE);
  glClearBufferfv(GL_COLOR, 0, lit);
  glClearBufferfi(GL_DEPTH_STENCIL, 0, 0.0f, Asks);
  Scope::write(-1);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_ALWAYS);
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_ALWAYS, 0, ~0u);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  Scope::use(this->Receivers, draws, draws.lights[number]);
  glUniform1i(at(this->Receivers, "svoPlaces"), scope.bind(pixels.places, GL_TEXTURE_2D));
  glUniform1i(at(this->Receivers, "svoPlanes"), scope.bind(pixels.planes, GL_TEXTURE_2D));
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

/// Counts volumes, and darkens what lies in some.
void VolumeCounter::darken(const VolumeDraws& draws, int number, const Pixels& pixels)
{
  const VolumeDraws::OfLight& light = draws.lights[number];
  Scope scope(*this, number, pixels.shares);
  const std::pair<const char*, int> samplers[] = { { "svoCasters", scope.bind(draws.casters) },
    { "svoTriangles", scope.bind(draws.triangles) }, { "svoEdges", scope.bind(draws.edges) },
    { "svoSenses", scope.bind(draws.senses) } };
  const auto use = [&](GLuint program)
  {
    Scope::use(program, draws, light);
    for (const auto& [name, unit] : samplers)
    {
      glUniform1i(at(program, name), unit);
    }
  };
  Scope::write(-1);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_LESS);
  glEnable(GL_STENCIL_TEST);
  glStencilMask(CountBits);
  glStencilFunc(GL_EQUAL, 0, Asks);
  for (const VolumeDraws::Sides way : { VolumeDraws::Before, VolumeDraws::Behind })
  {
    const VolumeDraws::Part& part = light.parts[way];
    if (part.caps.empty())
    {
      continue;
    }
    count(GL_FRONT, way);
    count(GL_BACK, way);
    use(this->Sides);
    glUniform1i(at(this->Sides, "svoFirst"), part.firstEdge);
    glDrawArrays(GL_TRIANGLES, 0, VerticesOfEdge * part.edges);
    use(this->Caps);
    const int corners = way == VolumeDraws::Behind ? 2 * VerticesOfCap : VerticesOfCap;
    glUniform1i(at(this->Caps, "svoCorners"), corners);
    const GLint first = at(this->Caps, "svoFirst");
    const GLint firstTriangle = at(this->Caps, "svoFirstTriangle");
    for (const VolumeDraws::Caps& caps : part.caps)
    {
      glUniform1i(first, caps.firstCaster);
      glUniform1i(firstTriangle, caps.firstTriangle);
      glDrawArraysInstanced(GL_TRIANGLES, 0, corners * caps.triangles, caps.casters);
    }
  }
  glDisable(GL_DEPTH_TEST);
  glStencilFunc(GL_NOTEQUAL, 0, CountBits);
  glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
  Scope::write(number);
  glUseProgram(this->Dark);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void VolumeCounter::release()
{
  this->resize(0, 0, 0);
  for (unsigned int* program : { &this->Sides, &this->Caps, &this->Receivers, &this->Dark })
  {
    glDeleteProgram(*program);
    *program = 0;
  }
}
}
