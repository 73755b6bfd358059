#include "svoShadowMask.h"

#include "svoMaskLookup.h"
#include "svoOpenGL.h"
#include "svoProgram.h"
#include "svoShadowMaskShader.h"
#include "svoTextures.h"
#include "svoUniforms.h"

#include "vtkOpenGLState.h"
#include "vtkTextureUnitManager.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace svo
{
namespace
{
/// Rows that are asked at a time: drivers end what takes too long.
constexpr int Rows = 128;

/// Groups of the compute shader.
unsigned int groupsOf(int pixels)
{
  return static_cast<unsigned int>(pixels + 7) / 8;
}

/// Of shares, four lights each.
int layersOf(int lights)
{
  return (lights + 3) / 4;
}

bool hasCompute()
{
#ifdef GL_COMPUTE_SHADER
  GLint major = 0, minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  return 10 * major + minor >= 43 && glDispatchCompute != nullptr;
#else
  return false;
#endif
}

/// Textures of a program, bound while it runs.
class Bound
{
public:
  Bound(vtkOpenGLState* state, GLuint program)
    : State(state)
    , Program(program)
  {
  }
  Bound(const Bound&) = delete;
  Bound& operator=(const Bound&) = delete;
  ~Bound()
  {
    for (const auto& [unit, target] : this->Units)
    {
      this->State->vtkglActiveTexture(GL_TEXTURE0 + unit);
      glBindTexture(target, 0);
      this->State->GetTextureUnitManager()->Free(unit);
    }
  }

  void add(const char* sampler, GLenum target, GLuint name)
  {
    const int unit = this->State->GetTextureUnitManager()->Allocate();
    this->State->vtkglActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(target, name);
    glUniform1i(glGetUniformLocation(this->Program, sampler), unit);
    this->Units.emplace_back(unit, target);
  }

private:
  vtkOpenGLState* State;
  GLuint Program;
  std::vector<std::pair<int, GLenum>> Units;
};
}

const LightCode& ShadowMask::lookUp(
  const LightCode& asked, int width, int height, bool others, std::size_t room)
{
  this->Code = LightCode();
  if (asked.empty() || !asked.costly)
  {
    this->releaseTextures();
    return asked;
  }
  if (!this->accepts(asked) ||
    !this->resize(width, height, static_cast<int>(asked.lights.size()), room))
  {
    return asked;
  }
  this->Code.text = svoMaskLookup;
  if (others)
  {
    this->Code = asked;
    if (this->Mixed.empty())
    {
      this->Mixed = std::string("#define svoLeft svoRayLeft\n") + asked.text +
        "#undef svoLeft\n#define svoHasOthers\n" + svoMaskLookup;
    }
    this->Code.text = this->Mixed.c_str();
    this->Code.textures.push_back({ "svoPlaces", this->Places, GL_TEXTURE_2D });
  }
  this->Code.lights = asked.lights;
  this->Code.costly = false;
  this->Code.fromPlaces = true;
  this->Code.textures.push_back({ "svoShares", this->Shares, GL_TEXTURE_2D_ARRAY });
  this->Code.integers.push_back({ "svoFirstPixel", { 0, 0 } });
  return this->Code;
}

void ShadowMask::find(
  vtkOpenGLState* state, const LightCode& asked, const std::function<void()>& draw)
{
  if (this->Code.empty()) // lookUp() has no mask
  {
    return;
  }
  int viewport[4];
  state->vtkglGetIntegerv(GL_VIEWPORT, viewport);
  this->Code.integers.back().values = { viewport[0], viewport[1] };
  using Able = vtkOpenGLState::ScopedglEnableDisable;
  const Able blends(state, GL_BLEND), scissors(state, GL_SCISSOR_TEST), deep(state, GL_DEPTH_TEST);
  const vtkOpenGLState::ScopedglViewport seen(state);
  const vtkOpenGLState::ScopedglDepthMask mask(state);
  const vtkOpenGLState::ScopedglDepthFunc compared(state);
  const vtkOpenGLState::ScopedglColorMask colors(state);
  state->PushFramebufferBindings();
  state->vtkglBindFramebuffer(GL_FRAMEBUFFER, this->Gathering);
  state->vtkglViewport(0, 0, this->Width, this->Height);
  state->vtkglDisable(GL_BLEND);
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(GL_LEQUAL);
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  const float nowhere[] = { 0.0f, 0.0f, 0.0f, -1e30f };
  const float farthest = 1.0f;
  glClearBufferfv(GL_COLOR, 0, nowhere);
  glClearBufferfv(GL_DEPTH, 0, &farthest);
  draw();
  state->vtkglDisable(GL_DEPTH_TEST);
  this->ask(state, asked);
  state->PopFramebufferBindings();
}

void ShadowMask::ask(vtkOpenGLState* state, const LightCode& asked)
{
  const vtkOpenGLState::ScopedglActiveTexture unit(state);
  GLint before = 0, verticesBefore = 0; // VTK knows what it has bound
  glGetIntegerv(GL_CURRENT_PROGRAM, &before);
  glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &verticesBefore);
  glUseProgram(this->Program);
  {
    Bound textures(state, this->Program);
    for (const LightCode::Texture& texture : asked.textures)
    {
      textures.add(texture.sampler, texture.target, texture.name);
    }
    textures.add("svoPlaces", GL_TEXTURE_2D, this->Places);
    textures.add("svoPlanes", GL_TEXTURE_2D, this->Planes);
    sendUniforms(this->Program, asked);
    const GLint firstLight = glGetUniformLocation(this->Program, "svoFirstLight");
    const GLint firstRow = glGetUniformLocation(this->Program, "svoFirstRow");
    state->vtkglBindFramebuffer(GL_FRAMEBUFFER, this->Answering);
    glBindVertexArray(this->Vertices);
    for (int layer = 0; layer < this->Layers; ++layer)
    {
      glUniform1i(firstLight, 4 * layer);
      if (!this->Computes)
      {
        glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, this->Shares, 0, layer);
      }
#ifdef GL_COMPUTE_SHADER
      else
      {
        glBindImageTexture(0, this->Shares, 0, GL_FALSE, layer, GL_WRITE_ONLY, GL_RGBA8);
      }
#endif
      for (int row = 0; row < this->Height; row += Rows)
      {
        const int rows = std::min(Rows, this->Height - row);
        if (!this->Computes)
        {
          state->vtkglViewport(0, row, this->Width, rows);
          glDrawArrays(GL_TRIANGLES, 0, 3);
        }
#ifdef GL_COMPUTE_SHADER
        else
        {
          glUniform1i(firstRow, row);
          glDispatchCompute(groupsOf(this->Width), groupsOf(rows), 1);
        }
#endif
        glFlush();
      }
    }
#ifdef GL_COMPUTE_SHADER
    if (this->Computes)
    {
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    }
#endif
  }
  glBindVertexArray(static_cast<GLuint>(verticesBefore));
  glUseProgram(static_cast<GLuint>(before));
}

bool ShadowMask::accepts(const LightCode& code)
{
  if (code.empty() || !code.costly)
  {
    return true;
  }
  if (code.constants != this->Constants || code.text != this->Text)
  {
    this->Constants = code.constants;
    this->Text = code.text;
    this->Mixed.clear();
    this->Computes = this->Wanted == Way::Compute && hasCompute();
    if (!this->link(code) && this->Computes)
    {
      this->Computes = false;
      this->link(code);
    }
  }
  return this->Program != 0;
}

/// Makes the program that asks, by compute shaders or not.
bool ShadowMask::link(const LightCode& asked)
{
  const std::string text =
    (this->Computes ? "#version 430\n#define svoComputes\n" : "#version 150\n") + asked.constants +
    asked.text + svoShadowMaskShader;
  glDeleteProgram(this->Program);
  std::string words;
  this->Refusal.clear();
#ifdef GL_COMPUTE_SHADER
  if (this->Computes)
  {
    this->Program = linkProgram({ { GL_COMPUTE_SHADER, text } }, words);
  }
  else
#endif
  {
    this->Program =
      linkProgram({ { GL_VERTEX_SHADER, AllPixels }, { GL_FRAGMENT_SHADER, text } }, words);
  }
  if (this->Program == 0)
  {
    this->Refusal = "OpenGL refuses the shader of rays to lights (" + words +
      "); shadow maps are traced on the CPU instead.";
  }
  return this->Program != 0;
}

/// Has textures and framebuffers of a size. False, and nothing is there, if OpenGL refuses, or if
/// they take more than `room`.
bool ShadowMask::resize(int width, int height, int lights, std::size_t room)
{
  const int layers = layersOf(lights);
  if (bytesOf(width, height, lights) > room)
  {
    this->releaseTextures();
    return false;
  }
  if (this->Shares != 0 && width == this->Width && height == this->Height && layers == this->Layers)
  {
    return true;
  }
  this->releaseTextures();
  GLint before = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &before);
  this->Width = width;
  this->Height = height;
  this->Layers = layers;
  this->Places = makeTexture(GL_RGBA32F, width, height);
  this->Planes = makeTexture(GL_RGBA16, width, height);
  this->Depths = makeTexture(GL_DEPTH_COMPONENT32F, width, height);
  this->Shares = makeTexture(GL_RGBA8, width, height, layers);
  glGenVertexArrays(1, &this->Vertices);
  glGenFramebuffers(1, &this->Gathering);
  glGenFramebuffers(1, &this->Answering);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, this->Answering);
  glFramebufferTextureLayer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, this->Shares, 0, 0);
  bool complete = glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, this->Gathering);
  glFramebufferTexture(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, this->Places, 0);
  glFramebufferTexture(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, this->Planes, 0);
  glFramebufferTexture(GL_DRAW_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, this->Depths, 0);
  const GLenum targets[] = { GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1 };
  glDrawBuffers(2, targets);
  complete = complete && glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(before));
  if (!complete || glGetError() != GL_NO_ERROR)
  {
    this->releaseTextures();
    return false;
  }
  return true;
}

std::size_t ShadowMask::bytesOf(int width, int height, int lights)
{
  return static_cast<std::size_t>(width) * height * (16 + 8 + 4 + 4 * layersOf(lights));
}

std::size_t ShadowMask::bytes() const
{
  return this->Shares == 0 ? 0 : bytesOf(this->Width, this->Height, 4 * this->Layers);
}

void ShadowMask::releaseTextures()
{
  if (this->Gathering != 0)
  {
    const GLuint textures[] = { this->Places, this->Planes, this->Depths, this->Shares };
    const GLuint framebuffers[] = { this->Gathering, this->Answering };
    glDeleteTextures(4, textures);
    glDeleteFramebuffers(2, framebuffers);
    glDeleteVertexArrays(1, &this->Vertices);
  }
  this->Places = this->Planes = this->Depths = this->Shares = 0;
  this->Gathering = this->Answering = this->Vertices = 0;
}

void ShadowMask::release()
{
  this->releaseTextures();
  if (this->Program != 0)
  {
    glDeleteProgram(this->Program);
  }
  this->Program = 0;
  this->Text = nullptr;
  this->Refusal.clear();
  this->Code = LightCode();
}
}
