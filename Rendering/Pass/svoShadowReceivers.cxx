#include "svoShadowReceivers.h"

#include "svoOpenGL.h"
#include "svoShadowReceiver.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>

#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

namespace svo
{
namespace
{
const char DeclarationMark[] = "//SVO::Dec\n";
const char ImplementationMark[] = "//SVO::Impl\n";
constexpr std::size_t MaximumMaps = 6;

/// View coordinates of the eye -> (x, y, linear depth - base, w) of a map. Composed in double, so
/// that world coordinates may be large.
glm::mat4 receiverMatrix(const ShadowMap& map, const View& eye)
{
  const glm::dmat4 toLight = map.view.worldToView * glm::inverse(eye.worldToView);
  glm::dmat4 result = map.view.viewToClip * toLight;
  for (int column = 0; column < 4; ++column)
  {
    result[column][2] = -toLight[column][2];
  }
  result[3][2] -= map.base;
  return glm::mat4(result);
}

bool isIdentifier(char c)
{
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

/// Renames a whole token; true if it was there.
bool rename(std::string& text, const std::string& from, const std::string& to)
{
  bool found = false;
  std::size_t at = 0;
  while ((at = text.find(from, at)) != std::string::npos)
  {
    const std::size_t end = at + from.size();
    if ((at == 0 || !isIdentifier(text[at - 1])) &&
      (end >= text.size() || !isIdentifier(text[end])))
    {
      text.replace(at, from.size(), to);
      at += to.size();
      found = true;
    }
    else
    {
      at = end;
    }
  }
  return found;
}

/// Has the vertex shader, and the geometry shader if there is one, send each facet one of its
/// corners with its normal; false if they know none. (VTK's shader cache changes VSOut in fragment
/// shaders to GSOut where there are geometry shaders.)
bool sendCorner(std::string& vertexShader, std::string& geometryShader)
{
  const std::string copied = "normalVCGSOutput = normalVCVSOutput[i];";
  const std::size_t main = vertexShader.find("void main()");
  const std::size_t end = vertexShader.rfind('}');
  const std::size_t geometryMain = geometryShader.find("void main()");
  const std::size_t copy = geometryShader.find(copied);
  if (main == std::string::npos || end == std::string::npos || end < main ||
    vertexShader.find("out vec3 normalVCVSOutput;") == std::string::npos ||
    vertexShader.find("vertexVCVSOutput =", main) == std::string::npos ||
    (!geometryShader.empty() &&
      (geometryMain == std::string::npos || copy == std::string::npos || copy < geometryMain)))
  {
    return false;
  }
  vertexShader.insert(end,
    "  svoCornerVSOutput = vertexVCVSOutput.xyz;\n"
    "  svoCornerNormalVSOutput = normalVCVSOutput;\n");
  vertexShader.insert(
    main, "flat out vec3 svoCornerVSOutput;\nflat out vec3 svoCornerNormalVSOutput;\n");
  if (!geometryShader.empty())
  {
    geometryShader.insert(copy + copied.size(),
      "\n  svoCornerGSOutput = svoCornerVSOutput[0];\n"
      "  svoCornerNormalGSOutput = svoCornerNormalVSOutput[0];\n");
    geometryShader.insert(geometryMain,
      "flat in vec3 svoCornerVSOutput[];\nflat in vec3 svoCornerNormalVSOutput[];\n"
      "flat out vec3 svoCornerGSOutput;\nflat out vec3 svoCornerNormalGSOutput;\n");
  }
  return true;
}
}

void ShadowReceivers::update(vtkOpenGLRenderWindow* window, const std::vector<ShadowMap>& maps,
  const View& eye, const FrameSettings& settings, bool changed)
{
  double casterVoxel = 0.0;
  for (const ShadowMap& map : maps)
  {
    casterVoxel = std::max(casterVoxel, map.casterVoxel);
  }
  this->ManualBias = static_cast<float>(settings.bias * casterVoxel);
  this->Intensity = static_cast<float>(settings.shadowIntensity);
  this->PlaneBias = settings.automaticBias;
  this->Filter = settings.filterShadows;
  std::map<int, std::vector<const ShadowMap*>> byLight;
  for (const ShadowMap& map : maps)
  {
    if (byLight[map.light].size() < MaximumMaps)
    {
      byLight[map.light].push_back(&map);
    }
  }

  std::vector<LightMaps> lights;
  for (const auto& entry : byLight)
  {
    LightMaps light;
    light.light = entry.first;
    light.resolution = entry.second.front()->view.width;
    const auto old = std::find_if(this->Lights.begin(), this->Lights.end(),
      [&](const LightMaps& candidate) { return candidate.light == light.light; });
    const bool fits = old != this->Lights.end() && old->resolution == light.resolution &&
      old->biases.size() == entry.second.size() && old->atlas && old->atlas->GetContext() == window;
    if (fits)
    {
      light.atlas = old->atlas;
    }
    for (const ShadowMap* map : entry.second)
    {
      const glm::mat4 matrix = receiverMatrix(*map, eye);
      light.matrices.insert(light.matrices.end(), &matrix[0][0], &matrix[0][0] + 16);
      light.biases.push_back(static_cast<float>(map->worldBias));
    }
    if (!fits || changed)
    {
      this->send(window, entry.second, light);
    }
    lights.push_back(light);
  }
  this->Lights = std::move(lights);
}

void ShadowReceivers::send(
  vtkOpenGLRenderWindow* window, const std::vector<const ShadowMap*>& maps, LightMaps& light)
{
  const int size = light.resolution;
  const auto count = static_cast<int>(maps.size());
  if (!light.atlas)
  {
    light.atlas = vtkSmartPointer<vtkTextureObject>::New();
    light.atlas->SetContext(window);
    light.atlas->SetMinificationFilter(vtkTextureObject::Nearest);
    light.atlas->SetMagnificationFilter(vtkTextureObject::Nearest);
    light.atlas->SetWrapS(vtkTextureObject::ClampToEdge);
    light.atlas->SetWrapT(vtkTextureObject::ClampToEdge);
    light.atlas->Allocate2D(size, size * count, 1, VTK_FLOAT);
  }
  light.atlas->Bind();
  for (int i = 0; i < count; ++i)
  {
    glTexSubImage2D(
      GL_TEXTURE_2D, 0, 0, i * size, size, size, GL_RED, GL_FLOAT, maps[i]->depth.data());
  }
}

void ShadowReceivers::activate()
{
  for (LightMaps& light : this->Lights)
  {
    light.atlas->Activate();
  }
}

void ShadowReceivers::deactivate()
{
  for (LightMaps& light : this->Lights)
  {
    light.atlas->Deactivate();
  }
}

void ShadowReceivers::release()
{
  this->Lights.clear();
}

std::string ShadowReceivers::signature() const
{
  std::ostringstream text;
  for (const LightMaps& light : this->Lights)
  {
    text << light.light << ' ';
  }
  return text.str();
}

void ShadowReceivers::markShader(std::string& fragmentShader)
{
  vtkShaderProgram::Substitute(
    fragmentShader, "//VTK::Light::Dec", std::string(DeclarationMark) + "//VTK::Light::Dec", false);
  vtkShaderProgram::Substitute(fragmentShader, "//VTK::Light::Impl",
    std::string(ImplementationMark) + "  //VTK::Light::Impl", false);
}

void ShadowReceivers::completeShader(
  std::string& vertexShader, std::string& geometryShader, std::string& fragmentShader) const
{
  const std::size_t main = fragmentShader.find("void main()");
  if (main == std::string::npos)
  {
    return;
  }
  std::string declarations = fragmentShader.substr(0, main);
  std::string body = fragmentShader.substr(main);
  // A normal map's bumps are no planes of the surface.
  const bool hasNormal = body.find("normalVCVSOutput") != std::string::npos &&
    fragmentShader.find("normalTex") == std::string::npos;
  std::ostringstream uniforms;
  std::ostringstream code;
  // Unlit surfaces have no position to ask about.
  if (body.find("vec4 vertexVC =") != std::string::npos)
  {
    for (const LightMaps& light : this->Lights)
    {
      const std::string number = std::to_string(light.light);
      const std::string color = "lightColor" + number;
      if (!rename(body, color, "svoColor" + number))
      {
        continue;
      }
      uniforms << "uniform sampler2D svoAtlas" << number << ";\nuniform int svoCount" << number
               << ";\nuniform mat4 svoMaps" << number << "[6];\nuniform float svoBias" << number
               << "[6];\n";
      code << "  vec3 svoColor" << number << " = " << color << " * svoLit(svoAtlas" << number
           << ", svoCount" << number << ", svoMaps" << number << ", svoBias" << number
           << ", vertexVC.xyz, svoFacet, " << (hasNormal ? "normalVCVSOutput" : "svoFacet")
           << ", svoLift, svoExtent);\n";
    }
  }
  const bool any = !uniforms.str().empty();
  const bool smooth = any && hasNormal && sendCorner(vertexShader, geometryShader);
  if (smooth)
  {
    uniforms << "flat in vec3 svoCornerVSOutput;\nflat in vec3 svoCornerNormalVSOutput;\n";
  }
  vtkShaderProgram::Substitute(declarations, DeclarationMark,
    any ? std::string(svoShadowReceiver) + uniforms.str() : std::string(), false);
  vtkShaderProgram::Substitute(body, ImplementationMark,
    any ? "  vec3 svoFacet = normalize(cross(dFdx(vertexVC.xyz), dFdy(vertexVC.xyz)));\n"
          "  float svoExtent = min(length(dFdx(vertexVC.xyz)), length(dFdy(vertexVC.xyz)));\n"
          "  vec3 svoLift = " +
        std::string(smooth ? "svoSmoothLift(vertexVC.xyz, svoFacet, normalVCVSOutput, "
                             "svoCornerVSOutput, normalize(svoCornerNormalVSOutput));\n"
                           : "vec3(0.0);\n") +
        code.str()
        : std::string(),
    false);
  fragmentShader = declarations + body;
}

void ShadowReceivers::setUniforms(vtkShaderProgram* program, bool receives) const
{
  bool any = false;
  for (const LightMaps& light : this->Lights)
  {
    const std::string number = std::to_string(light.light);
    const std::string atlas = "svoAtlas" + number;
    if (!program->IsUniformUsed(atlas.c_str()))
    {
      continue;
    }
    any = true;
    // Mappers' own textures may have taken the unit meanwhile.
    light.atlas->Activate();
    const auto count = static_cast<int>(light.biases.size());
    program->SetUniformi(atlas.c_str(), light.atlas->GetTextureUnit());
    program->SetUniformi(("svoCount" + number).c_str(), count);
    program->SetUniformMatrix4x4v(
      ("svoMaps" + number).c_str(), count, const_cast<float*>(light.matrices.data()));
    program->SetUniform1fv(("svoBias" + number).c_str(), count, light.biases.data());
  }
  if (any)
  {
    program->SetUniformf("svoReceive", receives ? 1.0f : 0.0f);
    program->SetUniformf("svoIntensity", this->Intensity);
    program->SetUniformi("svoPlaneBias", this->PlaneBias ? 1 : 0);
    program->SetUniformi("svoFilter", this->Filter ? 1 : 0);
    program->SetUniformf("svoManualBias", this->ManualBias);
  }
}
}
