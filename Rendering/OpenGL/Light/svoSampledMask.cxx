#include "svoSampledMask.h"

#include "svoAroundValues.h"
#include "svoMaskLookup.h"
#include "svoOpenGL.h"
#include "svoSampleLookup.h"
#include "svoSkyShader.h"

#include "vtkOpenGLState.h"

#include <algorithm>
#include <vector>

namespace svo
{
namespace
{
constexpr int OfMaps = -1, Nothing = -2; // svoPlaneOf()
}

const LightCode& SampledMask::lookUp(const LightCode& allMaps, const ReceiverShares& shares,
  const FrameSettings& settings, const View& view, bool unlit, int width, int height, bool others,
  bool translucent)
{
  const std::vector<int>& ofLights = shares.sampled.ofLights;
  const auto isSampled = [&](int light)
  { return light < static_cast<int>(ofLights.size()) && ofLights[light] != SampledPlanes::None; };
  static const LightCode NoMaps;
  const bool needsMaps =
    others || !std::all_of(allMaps.lights.begin(), allMaps.lights.end(), isSampled);
  const LightCode& maps = needsMaps ? allMaps : NoMaps; // else shaders had code in vain
  this->Code = LightCode();
  if (!shares.sampled.any())
  {
    this->release();
    return allMaps;
  }
  translucent = translucent && PlaceBuffer::hasRows(view.height);
  const int layers = shares.layers();
  this->Filled =
    this->Filled && this->Surfaces.fits(view.width, view.height, translucent, layers, GL_RGBA16);
  if (!this->Surfaces.resize(view.width, view.height, translucent, layers, GL_RGBA16))
  {
    return allMaps;
  }
  this->Code = maps;
  std::vector<int>& lights = this->Code.lights;
  std::vector<int> planes(lights.size(), OfMaps);
  for (int light = 0; light < static_cast<int>(ofLights.size()); ++light)
  {
    if (!isSampled(light))
    {
      continue;
    }
    bool found = false;
    for (std::size_t number = 0; number < lights.size(); ++number)
    {
      if (lights[number] == light)
      {
        planes[number] = found ? Nothing : ofLights[light];
        found = true;
      }
    }
    if (!found)
    {
      lights.push_back(light);
      planes.push_back(ofLights[light]);
    }
  }
  if (shares.sampled.ofOcclusion != SampledPlanes::None)
  {
    this->Code.occlusion = this->Code.count();
    planes.push_back(shares.sampled.ofOcclusion);
  }
  if (const int sky = shares.sampled.ofSky; sky != SampledPlanes::None)
  {
    this->Code.sky = this->Code.count();
    planes.insert(planes.end(), { sky, sky + 1, sky + 2 });
  }
  this->Code.unlit = unlit;
  this->Code.constants += "const int svoMapCount = " + std::to_string(maps.lights.size()) + ";\n" +
    sampleConstants(this->Code, planes, settings);
  this->Code.text = this->textOf(maps, others);
  addAroundValues(settings, view, this->Code);
  this->Surfaces.describe(this->Code, width, height, others);
  return this->Code;
}

const char* SampledMask::textOf(const LightCode& maps, bool others)
{
  std::string& text = this->Texts[{ maps.empty() ? nullptr : maps.text, others }];
  if (text.empty())
  {
    const std::string mapped = "svoMapLeft(number, position, facet, normal, lift, extent)";
    text = svoSkyShader +
      (maps.empty()
          ? std::string()
          : "#define svoLeft svoMapLeft\n" + std::string(maps.text) + "#undef svoLeft\n") +
      "float svoLeftByRay(int number, vec3 position, vec3 facet, vec3 normal, vec3 lift,\n"
      "  float extent)\n{\n  return " +
      (maps.empty() ? "1.0" : "number < svoMapCount ? " + mapped + " : 1.0") +
      ";\n}\n#define svoHasMaps\n#define svoPlaneOf(number) svoSumOf[number]\n" +
      (others ? "#define svoHasOthers\n" : "") + svoMaskLookup + (others ? svoSampleLookup : "");
  }
  return text.c_str();
}

void SampledMask::gather(
  vtkOpenGLState* state, const PlaceBuffer::Draw& draw, ReceiverPlaces& places)
{
  this->Surfaces.gather(state, draw);
  this->Surfaces.read(state, places);
}

void SampledMask::upload(const ReceiverShares& shares)
{
  this->Filled = true;
  GLint bound = 0, alignment = 4;
  glGetIntegerv(GL_TEXTURE_BINDING_2D_ARRAY, &bound);
  glGetIntegerv(GL_UNPACK_ALIGNMENT, &alignment);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glBindTexture(GL_TEXTURE_2D_ARRAY, this->Surfaces.shares());
  glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, this->Surfaces.width(), this->Surfaces.rows(),
    this->Surfaces.layers(), GL_RGBA, GL_UNSIGNED_SHORT, shares.numbers.data());
  glBindTexture(GL_TEXTURE_2D_ARRAY, static_cast<GLuint>(bound));
  glPixelStorei(GL_UNPACK_ALIGNMENT, alignment);
}

std::size_t SampledMask::bytes() const
{
  return PlaceBuffer::bytesOf(this->Surfaces.width(), this->Surfaces.height(),
    this->Surfaces.translucent(), 8 * this->Surfaces.layers());
}

void SampledMask::release()
{
  this->Surfaces.release();
  this->Filled = false;
  this->Code = LightCode();
}
}
