#include "svoShadowMask.h"

#include "svoMaskLookup.h"
#include "svoOpenGL.h"
#include "svoPixelRay.h"
#include "svoReceivers.h"
#include "svoSampleLookup.h"
#include "svoSampleMeans.h"
#include "svoShadowMaskShader.h"
#include "svoSkyShader.h"
#include "svoVolumeDraws.h"
#include "svoVolumeReceiver.h"

#include "vtkOpenGLState.h"

#include <string>
#include <vector>

namespace svo
{
namespace
{
/// Of shares, four lights each.
int layersOf(int lights)
{
  return (lights + 3) / 4;
}

/// Code whose svoLeft() is to have another name.
std::string renamed(const LightCode& asked, const std::string& name)
{
  return "#define svoLeft " + name + "\n" + asked.text + "#undef svoLeft\n";
}

std::string lookUpText(const LightCode& asked, bool others)
{
  const bool samples = !asked.sampled.empty();
  const std::string asks = renamed(asked, samples ? "svoLeftByRay" : "svoRayLeft");
  return (samples ? svoSkyShader : "") + (others ? asks + "#define svoHasOthers\n" : "") +
    svoMaskLookup + (others && samples ? svoSampleLookup : "");
}

/// What the mask is filled by.
std::string maskText(const LightCode& asked)
{
  return asked.constants +
    (asked.sampled.empty() ? std::string("#define svoFormat rgba8\n") + asked.text
                           : "#define svoFormat rgba16\n" + renamed(asked, "svoLeftByRay") +
          svoSkyShader + svoSampleMeans) +
    (asked.volumes ? std::string(svoPixelRay) + svoVolumeReceiver : "") + svoShadowMaskShader;
}
}

const LightCode& ShadowMask::lookUp(
  const LightCode& asked, int width, int height, bool others, std::size_t room, bool translucent)
{
  this->Code = LightCode();
  if (asked.empty() || !asked.costly)
  {
    this->releaseTextures();
    return asked;
  }
  const bool samples = !asked.sampled.empty();
  const int sampled = static_cast<int>(asked.sampled.size());
  translucent = translucent && samples && PlaceBuffer::hasRows(height) &&
    bytesOf(width, height, asked.count(), sampled, true) <= room;
  if (!this->accepts(asked) || !this->resize(width, height, translucent, asked, room))
  {
    if (!samples)
    {
      return asked;
    }
    this->Code = asked; // who asks themselves take no samples
    this->Code.occlusion = this->Code.sky = LightCode::None;
    return this->Code;
  }
  this->Code.text = svoMaskLookup;
  if (others || samples)
  {
    this->Code = asked;
    std::string& text = this->Texts[others];
    text = text.empty() ? lookUpText(asked, others) : text;
    this->Code.text = text.c_str();
  }
  if (!others)
  {
    this->Code.textures.clear();
  }
  this->Code.lights = asked.lights;
  this->Code.costly = false;
  this->Surfaces.describe(this->Code, width, height, others);
  return this->Code;
}

void ShadowMask::find(vtkOpenGLState* state, const LightCode& asked, bool same,
  const PlaceBuffer::Draw& draw, bool measure)
{
  if (!this->Code.fromPlaces) // lookUp() has no mask
  {
    return;
  }
  PlaceBuffer::aim(state, this->Code);
  const bool known = same && this->Found > 0 && this->Picture == asked.picture;
  if (known && this->Found == asked.samples)
  {
    return;
  }
  if (!same)
  {
    this->Samples.forget();
  }
  if (this->Found == 0 || this->Picture != asked.picture)
  {
    this->Changed = -1.0; // else what was known of surfaces that have changed since is as good
  }
  const bool compares = measure && known;
  const std::vector<std::uint16_t> before = compares ? this->read() : std::vector<std::uint16_t>();
  this->Found = asked.sampled.empty() ? 0 : asked.samples;
  this->Picture = asked.picture;
  if (!known)
  {
    this->Surfaces.gather(state, draw);
  }
  using Able = vtkOpenGLState::ScopedglEnableDisable;
  const Able blends(state, GL_BLEND), scissors(state, GL_SCISSOR_TEST), deep(state, GL_DEPTH_TEST);
  const vtkOpenGLState::ScopedglViewport seen(state);
  const vtkOpenGLState::ScopedglColorMask colors(state);
  state->PushFramebufferBindings();
  state->vtkglDisable(GL_BLEND);
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  const unsigned int places = this->Surfaces.places(), planes = this->Surfaces.planes();
  std::vector<ShaderValues::Texture> textures{ { "svoPlaces", places, GL_TEXTURE_2D },
    { "svoPlanes", planes, GL_TEXTURE_2D } };
  if (!asked.sampled.empty())
  {
    this->Samples.take(state, asked, textures, this->Surfaces.sliceRows());
    textures.insert(textures.end(),
      { { "svoSums", this->Samples.sums(), GL_TEXTURE_2D_ARRAY },
        { "svoPlacesAround", places, GL_TEXTURE_2D },
        { "svoPlanesAround", planes, GL_TEXTURE_2D } });
  }
  const auto fill = [&](unsigned int framebuffer, int layer, int firstLight)
  {
    PixelProgram::Use program(state, this->Program, asked, textures);
    program.set("svoFirstLight", firstLight);
    program.fill({ framebuffer, this->Surfaces.shares(), this->Surfaces.format(), layer,
      this->Surfaces.width(), this->Surfaces.rows() });
  };
  for (int layer = 0; !asked.volumes && layer < this->Surfaces.layers(); ++layer)
  {
    fill(this->Answering, layer, 4 * layer);
  }
  for (int light = 0; asked.volumes && light < asked.count(); ++light)
  {
    this->Counter.find(state, *asked.volumes, light, { places, planes, this->Surfaces.shares() },
      [&](unsigned int framebuffer) { fill(framebuffer, light / 4, light); });
  }
  state->PopFramebufferBindings();
  if (compares)
  {
    this->compare(state, asked, before);
  }
}

/// What it has: as ReceiverShares::numbers.
std::vector<std::uint16_t> ShadowMask::read() const
{
  std::vector<std::uint16_t> numbers(4 * static_cast<std::size_t>(this->Surfaces.width()) *
    this->Surfaces.rows() * this->Surfaces.layers());
  GLint bound = 0;
  glGetIntegerv(GL_TEXTURE_BINDING_2D_ARRAY, &bound);
  glBindTexture(GL_TEXTURE_2D_ARRAY, this->Surfaces.shares());
  glGetTexImage(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA, GL_UNSIGNED_SHORT, numbers.data());
  glBindTexture(GL_TEXTURE_2D_ARRAY, static_cast<GLuint>(bound));
  return numbers;
}

void ShadowMask::compare(
  vtkOpenGLState* state, const LightCode& asked, const std::vector<std::uint16_t>& before)
{
  std::vector<int> planes;
  for (const LightCode::Sampled& of : asked.sampled)
  {
    for (int part = 0; part < (of.number == asked.sky ? 3 : 1); ++part)
    {
      planes.push_back(of.number + part);
    }
  }
  ReceiverPlaces places;
  this->Surfaces.read(state, places);
  this->Changed = differenceOf(before, this->read(), planes, places);
}

bool ShadowMask::acceptsVolumes()
{
  std::string words;
  if (this->VolumeRefusal.empty() && !this->Counter.link(words))
  {
    this->VolumeRefusal = "OpenGL refuses the shaders of shadow volumes (" + words +
      "): rays to the lights find the same shadows.";
  }
  return this->VolumeRefusal.empty();
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
    this->Found = 0;
    this->Texts[0].clear();
    this->Texts[1].clear();
    const bool computes =
      this->Wanted == Method::Compute && PixelProgram::hasCompute() && !code.volumes;
    if (!this->link(code, computes) && computes)
    {
      this->link(code, false);
    }
  }
  return this->Program.linked();
}

/// Makes the programs that ask, by compute shaders or not.
bool ShadowMask::link(const LightCode& asked, bool computes)
{
  std::string words;
  this->Refusal.clear();
  if (!this->Program.link(maskText(asked), computes, words) ||
    (!asked.sampled.empty() && !this->Samples.link(asked, computes, words)))
  {
    this->Program.release();
    this->Refusal = "OpenGL refuses the shader of rays to lights (" + words +
      "); shadow maps are traced on the CPU instead.";
  }
  return this->Program.linked();
}

/// Has textures and framebuffers of a size. False, and nothing is there, if OpenGL refuses, or if
/// they take more than `room`.
bool ShadowMask::resize(
  int width, int height, bool translucent, const LightCode& asked, std::size_t room)
{
  const int layers = layersOf(asked.count());
  const auto sampled = static_cast<int>(asked.sampled.size());
  const bool counts = asked.volumes != nullptr;
  if (bytesOf(width, height, asked.count(), sampled, translucent, counts) > room)
  {
    this->releaseTextures();
    return false;
  }
  const unsigned int format = sampled > 0 ? GL_RGBA16 : GL_RGBA8;
  if (this->Surfaces.fits(width, height, translucent, layers, format) &&
    sampled == this->Samples.layers() && counts == this->Counter.any())
  {
    return true;
  }
  this->releaseTextures();
  GLint before = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &before);
  bool complete = this->Surfaces.resize(width, height, translucent, layers, format);
  const int rows = this->Surfaces.rows();
  glGenFramebuffers(1, &this->Answering);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, this->Answering);
  glFramebufferTextureLayer(
    GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, this->Surfaces.shares(), 0, 0);
  complete = complete && glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(before));
  complete = this->Samples.resize(width, rows, sampled) && complete;
  complete = this->Counter.resize(counts ? width : 0, counts ? rows : 0, this->Surfaces.shares()) &&
    complete;
  if (!complete || glGetError() != GL_NO_ERROR)
  {
    this->releaseTextures();
    return false;
  }
  return true;
}

std::size_t ShadowMask::bytesOf(
  int width, int height, int numbers, int sampled, bool translucent, bool volumes)
{
  const int shares = (sampled > 0 ? 8 : 4) * layersOf(numbers);
  return PlaceBuffer::bytesOf(
    width, height, translucent, shares + 16 * sampled + (volumes ? VolumeCounter::PixelBytes : 0));
}

std::size_t ShadowMask::bytes() const
{
  return bytesOf(this->Surfaces.width(), this->Surfaces.height(), 4 * this->Surfaces.layers(),
    this->Samples.layers(), this->Surfaces.translucent(), this->Counter.any());
}

void ShadowMask::releaseTextures()
{
  if (this->Answering != 0)
  {
    glDeleteFramebuffers(1, &this->Answering);
  }
  this->Answering = 0;
  this->Found = 0;
  this->Changed = -1.0;
  this->Surfaces.release();
  this->Samples.resize(0, 0, 0);
  this->Counter.resize(0, 0, 0);
}

void ShadowMask::release()
{
  this->releaseTextures();
  this->Program.release();
  this->Samples.release();
  this->Counter.release();
  this->Text = nullptr;
  this->Refusal.clear();
  this->VolumeRefusal.clear();
  this->Code = LightCode();
}
}
