#include "svoPixelProgram.h"

#include "svoOpenGL.h"
#include "svoPixelMain.h"
#include "svoProgram.h"
#include "svoStrips.h"
#include "svoUniforms.h"

#include "vtkOpenGLState.h"
#include "vtkTextureUnitManager.h"

namespace svo
{
namespace
{
/// Groups of the compute shader.
unsigned int groupsOf(int pixels)
{
  return static_cast<unsigned int>(pixels + 7) / 8;
}
}

bool PixelProgram::hasCompute()
{
  GLint major = 0, minor = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  return 10 * major + minor >= 43 && glDispatchCompute != nullptr;
}

bool PixelProgram::link(const std::string& text, bool computes, std::string& words)
{
  this->release();
  this->Computes = computes;
  const std::string whole =
    (computes ? "#version 430\n#define svoComputes\n" : "#version 150\n") + text + svoPixelMain;
  this->Program = computes
    ? linkProgram({ { GL_COMPUTE_SHADER, whole } }, words)
    : linkProgram({ { GL_VERTEX_SHADER, AllPixels }, { GL_FRAGMENT_SHADER, whole } }, words);
  glGenVertexArrays(1, &this->Vertices);
  return this->linked();
}

void PixelProgram::release()
{
  if (this->Vertices != 0)
  {
    glDeleteVertexArrays(1, &this->Vertices);
    glDeleteProgram(this->Program);
  }
  this->Program = this->Vertices = 0;
}

PixelProgram::Use::Use(vtkOpenGLState* state, const PixelProgram& program,
  const ShaderValues& values, const std::vector<ShaderValues::Texture>& textures)
  : State(state)
  , Of(program)
{
  glGetIntegerv(GL_CURRENT_PROGRAM, &this->ProgramBefore);
  glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &this->VerticesBefore);
  glUseProgram(program.Program);
  glBindVertexArray(program.Vertices);
  const vtkOpenGLState::ScopedglActiveTexture before(state);
  for (const auto* list : { &values.textures, &textures })
  {
    for (const ShaderValues::Texture& texture : *list)
    {
      const int unit = state->GetTextureUnitManager()->Allocate();
      state->vtkglActiveTexture(GL_TEXTURE0 + unit);
      glBindTexture(texture.target, texture.name);
      this->set(texture.sampler, unit);
      this->Units.emplace_back(unit, texture.target);
    }
  }
  sendUniforms(program.Program, values);
}

PixelProgram::Use::~Use()
{
  if (this->Of.Computes)
  {
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
  }
  const vtkOpenGLState::ScopedglActiveTexture before(this->State);
  for (const auto& [unit, target] : this->Units)
  {
    this->State->vtkglActiveTexture(GL_TEXTURE0 + unit);
    glBindTexture(target, 0);
    this->State->GetTextureUnitManager()->Free(unit);
  }
  glBindVertexArray(static_cast<GLuint>(this->VerticesBefore));
  glUseProgram(static_cast<GLuint>(this->ProgramBefore));
}

void PixelProgram::Use::set(const char* uniform, int value)
{
  glUniform1i(glGetUniformLocation(this->Of.Program, uniform), value);
}

void PixelProgram::Use::set(const char* uniform, float value)
{
  glUniform1f(glGetUniformLocation(this->Of.Program, uniform), value);
}

void PixelProgram::Use::fill(const Layer& layer)
{
  if (!this->Of.Computes)
  {
    this->State->vtkglBindFramebuffer(GL_FRAMEBUFFER, layer.framebuffer);
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, layer.texture, 0, layer.layer);
  }
  else
  {
    glBindImageTexture(0, layer.texture, 0, GL_FALSE, layer.layer,
      layer.adds ? GL_READ_WRITE : GL_WRITE_ONLY, layer.format);
  }
  eachStrip(0, layer.height, 1.0,
    [&](int row, int rows)
    {
      if (!this->Of.Computes)
      {
        this->State->vtkglViewport(0, row, layer.width, rows);
        glDrawArrays(GL_TRIANGLES, 0, 3);
      }
      else
      {
        this->set("svoFirstRow", row);
        glDispatchCompute(groupsOf(layer.width), groupsOf(rows), 1);
      }
    });
  if (this->Of.Computes && layer.adds)
  {
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }
}
}
