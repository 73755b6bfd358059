#include "svoLightSamples.h"

#include "svoLightSampleShader.h"
#include "svoOpenGL.h"
#include "svoSampleSequence.h"
#include "svoSkyShader.h"
#include "svoTextures.h"

#include "vtkOpenGLState.h"

#include <algorithm>
#include <cstddef>

namespace svo
{
namespace
{
/// Samples that a pixel takes at a time: drivers end what takes too long.
constexpr int AtATime = 4;
/// ... and at all.
constexpr int MostSamples = 4096;

/// As svoLightSampleShader.glsl reads them.
std::vector<std::uint32_t> sequenceWords()
{
  constexpr int Edge = 64; // of the blue-noise mask
  std::vector<std::uint32_t> words;
  words.reserve(Edge * Edge + 2 * MostSamples);
  for (int i = 0; i < Edge * Edge; ++i)
  {
    words.push_back(pixelRotation(i % Edge, i / Edge, 0).u);
  }
  for (const SquarePoint& point : firstPoints(MostSamples))
  {
    words.insert(words.end(), { point.u, point.v });
  }
  return words;
}
}

bool LightSamples::link(const LightCode& asked, bool computes, std::string& words)
{
  this->Held = 0;
  return this->Program.link("#define svoFormat rgba32f\n#define svoAdds\n" + asked.constants +
      asked.text + svoSkyShader + svoLightSampleShader,
    computes, words);
}

bool LightSamples::resize(int width, int height, int layers)
{
  if (this->Sums != 0)
  {
    glDeleteTextures(1, &this->Sums);
    glDeleteFramebuffers(1, &this->Framebuffer);
  }
  this->Sums = this->Framebuffer = 0;
  this->Held = 0;
  this->Width = width;
  this->Height = height;
  this->Layers = layers;
  if (layers == 0)
  {
    return true;
  }
  GLint before = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &before);
  this->Sums = makeTexture(GL_RGBA32F, width, height, layers);
  glGenFramebuffers(1, &this->Framebuffer);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, this->Framebuffer);
  glFramebufferTextureLayer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, this->Sums, 0, 0);
  const bool complete = glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(before));
  return complete;
}

void LightSamples::take(vtkOpenGLState* state, const LightCode& asked,
  const std::vector<ShaderValues::Texture>& places, int sliceRows)
{
  this->Held = asked.picture == this->Picture ? this->Held : 0;
  this->Picture = asked.picture;
  if (this->Held >= asked.samples)
  {
    return;
  }
  state->vtkglBindFramebuffer(GL_FRAMEBUFFER, this->Framebuffer);
  for (int layer = 0; this->Held == 0 && layer < this->Layers; ++layer)
  {
    const float nothing[] = { 0.0f, 0.0f, 0.0f, 0.0f };
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, this->Sums, 0, layer);
    glClearBufferfv(GL_COLOR, 0, nothing);
  }
  if (this->Sequence.size() == 0)
  {
    const std::vector<std::uint32_t> words = sequenceWords();
    if (!this->Sequence.allocate(words.size()))
    {
      return;
    }
    this->Sequence.send(0, words.data(), words.size());
  }
  const vtkOpenGLState::ScopedglEnableDisable blends(state, GL_BLEND);
  const vtkOpenGLState::ScopedglBlendFuncSeparate sums(state);
  state->vtkglEnable(GL_BLEND);
  state->vtkglBlendFunc(GL_ONE, GL_ONE);
  std::vector<ShaderValues::Texture> textures = places;
  textures.push_back({ "svoSequence", this->Sequence.name() });
  PixelProgram::Use program(state, this->Program, asked, textures);
  program.set("svoRowsOfSlice", sliceRows);
  for (int first = this->Held; first < asked.samples; first += AtATime)
  {
    program.set("svoFirstSample", first);
    program.set("svoEndSample", std::min(first + AtATime, asked.samples));
    for (int layer = 0; layer < this->Layers; ++layer)
    {
      const LightCode::Sampled& of = asked.sampled[static_cast<std::size_t>(layer)];
      program.set("svoNumber", of.number);
      program.set("svoStream", static_cast<int>(of.stream));
      program.set("svoSize", of.size);
      program.fill(
        { this->Framebuffer, this->Sums, GL_RGBA32F, layer, this->Width, this->Height, true });
    }
  }
  this->Held = asked.samples;
}

void LightSamples::release()
{
  this->resize(0, 0, 0);
  this->Program.release();
  this->Sequence.release();
}
}
