#include "svoShadowReceivers.h"

#include "svoOpenGL.h"
#include "svoShaderTokens.h"
#include "svoShadowCatcher.h"
#include "svoShadowReceiver.h"
#include "svoShadowRules.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"

#include <algorithm>
#include <iomanip>
#include <locale>
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
const char LitMark[] = "//SVO::Lit\n"; // after VTK's lighting
constexpr std::size_t MapsOfLight = 6; // that there is room for, where most have fewer

/// Maps that a shader has room for beside what VTK tells it of so many lights.
std::size_t mostMaps(std::size_t lights)
{
  constexpr std::size_t OfLight = 28, OfMap = 20, Others = 512; // components, as vectors of four
  GLint components = 0;
  glGetIntegerv(GL_MAX_FRAGMENT_UNIFORM_COMPONENTS, &components);
  const std::size_t taken = OfLight * lights + Others;
  const std::size_t left = std::max<std::size_t>(components, taken) - taken;
  return std::clamp<std::size_t>(
    left / OfMap, MapsOfLight, static_cast<std::size_t>(TextureArray::mostLayers()));
}

double brightness(const Light& light)
{
  return light.color.r + light.color.g + light.color.b;
}

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

/// Where a fragment lies, and its own plane.
constexpr char FragmentOfFacet[] =
  "  vec3 svoPosition = vertexVC.xyz;\n"
  "  vec3 svoFacet = normalize(cross(dFdx(vertexVC.xyz), dFdy(vertexVC.xyz)));\n";

/// The same on lines as tubes and points as spheres: VTK leaves vertexVC on the axis, or at the
/// centre. Its normals of tubes are not quite perpendicular to them in windows that are not square.
constexpr char FragmentOfTube[] =
  "  vec3 svoAcross = dFdx(vertexVC.xyz);\n"
  "  vec3 svoUp = dFdy(vertexVC.xyz);\n"
  "  vec3 svoAxis = dot(svoAcross, svoAcross) < dot(svoUp, svoUp) ? svoUp : svoAcross;\n"
  "  float svoAxisSquare = dot(svoAxis, svoAxis);\n"
  "  vec3 svoFacet = svoAxisSquare > 0.0\n"
  "    ? normalize(normalVCVSOutput - dot(normalVCVSOutput, svoAxis) / svoAxisSquare * svoAxis)\n"
  "    : normalVCVSOutput;\n"
  "  vec3 svoPosition =\n"
  "    vertexVC.xyz + ZCalcR * (cameraParallel == 0 ? -vertexVC.z : 1.0) * svoFacet;\n";

/// Adds the code of shadow catchers. `lit`: the shader knows of shadows.
void catchShadows(std::string& declarations, std::string& body, bool lit)
{
  // A physically based material weighs light by rules of its own.
  const bool seen = lit && body.find("albedo") == std::string::npos;
  vtkShaderProgram::Substitute(
    declarations, DeclarationMark, std::string(CatcherDeclarations) + DeclarationMark, false);
  vtkShaderProgram::Substitute(body, ImplementationMark,
    std::string(ImplementationMark) + (seen ? CatcherBeforeLighting : ""), false);
  vtkShaderProgram::Substitute(body, LitMark, seen ? CatcherAfterLighting : CatcherUnseen, false);
}

/// The numbers of svoShadowRules.h, in GLSL.
std::string shadowRules()
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::showpoint << std::setprecision(9); // a float's; without a point it were an int
  for (const ShadowRule& rule : ShadowRules)
  {
    text << "const float svo" << rule.name << " = " << rule.value << ";\n";
  }
  return text.str();
}

/// Leaves maps of the faintest lights out until no more than `most` are left; true if there were
/// more.
bool keepBrightest(std::map<int, std::vector<const ShadowMap*>>& byLight,
  const std::vector<Light>& lights, std::size_t most)
{
  std::size_t count = 0;
  for (const auto& entry : byLight)
  {
    count += entry.second.size();
  }
  if (count <= most)
  {
    return false;
  }
  const auto fainter = [&](const auto& a, const auto& b)
  { return brightness(lights[a.first]) < brightness(lights[b.first]); };
  while (count > most)
  {
    const auto faintest = std::min_element(byLight.begin(), byLight.end(), fainter);
    count -= faintest->second.size();
    byLight.erase(faintest);
  }
  return true;
}
}

std::string ShadowReceivers::update(vtkOpenGLRenderWindow* window,
  const std::vector<ShadowMap>& maps, const std::vector<Light>& lights, const View& eye,
  const FrameSettings& settings)
{
  if (maps.empty())
  {
    this->release();
    return {};
  }
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
    byLight[map.light].push_back(&map);
  }
  std::string complaint;
  const std::size_t most = mostMaps(lights.size());
  if (keepBrightest(byLight, lights, most))
  {
    complaint = "Rasterised surfaces receive shadows of the brightest lights only: OpenGL takes no "
                "more shadow maps.";
  }

  std::vector<const ShadowMap*> layers;
  this->Lights.clear();
  this->First.clear();
  this->Rows.clear();
  this->Errors.clear();
  for (const auto& entry : byLight)
  {
    this->Lights.push_back(entry.first);
    this->First.push_back(static_cast<int>(layers.size()));
    for (const ShadowMap* map : entry.second)
    {
      const glm::mat4 matrix = glm::transpose(receiverMatrix(*map, eye));
      this->Rows.insert(this->Rows.end(), &matrix[0][0], &matrix[0][0] + 16);
      this->Errors.push_back(static_cast<float>(map->worldBias));
      layers.push_back(map);
    }
  }
  const auto count = static_cast<int>(layers.size());
  this->First.push_back(count);
  // Shaders are not built anew because a light has other maps than before.
  this->Capacity = std::min(std::max(layers.size(), MapsOfLight * byLight.size()), most);

  const int size = maps.front().view.width;
  if (!this->Maps || !this->Maps->fits(window, size, count))
  {
    this->Maps = vtkSmartPointer<TextureArray>::New();
    this->Maps->SetContext(window);
    if (!this->Maps->allocate(size, count))
    {
      this->release();
      return "Rasterised surfaces receive no shadows: OpenGL has no room for " +
        std::to_string(count) + " shadow maps of " + std::to_string(size) +
        " texels. Lower ShadowBufferResolution.";
    }
    this->Sent.clear();
  }
  this->Sent.resize(count);
  for (int i = 0; i < count; ++i)
  {
    const std::shared_ptr<const std::vector<float>>& depth = layers[i]->depth;
    if (this->Sent[i].lock() != depth)
    {
      this->Maps->send(i, depth->data());
      this->Sent[i] = depth;
    }
  }
  return complaint;
}

void ShadowReceivers::activate()
{
  if (!this->empty())
  {
    this->Maps->Activate();
  }
}

void ShadowReceivers::deactivate()
{
  if (!this->empty())
  {
    this->Maps->Deactivate();
  }
}

void ShadowReceivers::release()
{
  this->Lights.clear();
  this->First.clear();
  this->Capacity = 0;
  this->Maps = nullptr;
}

std::string ShadowReceivers::signature() const
{
  std::ostringstream text;
  text << this->Capacity << ' ' << this->PlaneBias << ' ' << this->Filter << ' ' << this->Catchers
       << ": ";
  for (const int light : this->Lights)
  {
    text << light << ' ';
  }
  return text.str();
}

void ShadowReceivers::markShader(std::string& fragmentShader)
{
  vtkShaderProgram::Substitute(
    fragmentShader, "//VTK::Light::Dec", std::string(DeclarationMark) + "//VTK::Light::Dec", false);
  vtkShaderProgram::Substitute(fragmentShader, "//VTK::Light::Impl",
    std::string(ImplementationMark) + "  //VTK::Light::Impl\n" + LitMark, false);
}

std::string ShadowReceivers::declarations() const
{
  const auto boolean = [](bool value) { return value ? "true" : "false"; };
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << "const int svoCapacity = " << this->Capacity << ";\n"
       << "const bool svoPlaneBias = " << boolean(this->PlaneBias) << ";\n"
       << "const bool svoFilter = " << boolean(this->Filter) << ";\n"
       << shadowRules() << svoShadowReceiver << "uniform int svoFirst[" << this->Lights.size()
       << " + 1];\n";
  return text.str();
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
  std::ostringstream code;
  const auto weigh = [&](int light, const std::string& share)
  {
    const std::string number = std::to_string(light);
    const std::string color = "lightColor" + number;
    if (renameToken(body, color, "svoColor" + number))
    {
      code << "  vec3 svoColor" << number << " = "
           << (this->Catchers ? "svoWeigh(" + color + ", " + share + ")" : color + " * " + share)
           << ";\n";
    }
  };
  // Unlit surfaces have no position to ask about.
  if (body.find("vec4 vertexVC =") != std::string::npos)
  {
    for (std::size_t i = 0; i < this->Lights.size(); ++i)
    {
      weigh(this->Lights[i], "svoShare[" + std::to_string(i) + "]");
    }
  }
  const bool any = !code.str().empty();
  const bool round = hasNormal && hasToken(declarations, "ZCalcR");
  if (this->Catchers)
  {
    // Those that cast nothing.
    for (int i = 0; any && hasToken(declarations, "lightColor" + std::to_string(i)); ++i)
    {
      weigh(i, "1.0");
    }
    catchShadows(declarations, body, any);
  }
  const bool smooth = any && hasNormal && sendCorner(vertexShader, geometryShader);
  // One loop, since compilers copy the function to wherever it is called.
  const std::string count = std::to_string(this->Lights.size());
  vtkShaderProgram::Substitute(declarations, DeclarationMark,
    any ? this->declarations() +
        (smooth ? "flat in vec3 svoCornerVSOutput;\nflat in vec3 svoCornerNormalVSOutput;\n" : "")
        : std::string(),
    false);
  vtkShaderProgram::Substitute(body, ImplementationMark,
    any ? std::string(round ? FragmentOfTube : FragmentOfFacet) +
        "  float svoExtent = min(length(dFdx(svoPosition)), length(dFdy(svoPosition)));\n"
        "  vec3 svoLift = " +
        std::string(smooth ? "svoSmoothLift(svoPosition, svoFacet, normalVCVSOutput, "
                             "svoCornerVSOutput, normalize(svoCornerNormalVSOutput));\n"
                           : "vec3(0.0);\n") +
        "  float svoShare[" + count +
        "];\n"
        "  for (int i = 0; i < " +
        count +
        "; ++i)\n"
        "  {\n"
        "    svoShare[i] = svoLit(svoFirst[i], svoFirst[i + 1], svoPosition, svoFacet, " +
        (hasNormal ? "normalVCVSOutput" : "svoFacet") +
        ", svoLift, svoExtent);\n"
        "  }\n" +
        code.str()
        : std::string(),
    false);
  fragmentShader = declarations + body;
}

void ShadowReceivers::setUniforms(vtkShaderProgram* program, bool receives, bool catches) const
{
  if (program->IsUniformUsed("svoCatch"))
  {
    program->SetUniformf("svoCatch", catches ? 1.0f : 0.0f);
  }
  if (this->empty() || !program->IsUniformUsed("svoMaps"))
  {
    return;
  }
  // Mappers' own textures may have taken the unit meanwhile.
  this->Maps->Activate();
  program->SetUniformi("svoMaps", this->Maps->GetTextureUnit());
  const auto count = static_cast<int>(this->Errors.size());
  program->SetUniformMatrix4x4v("svoRows", count, const_cast<float*>(this->Rows.data()));
  program->SetUniform1fv("svoErrors", count, this->Errors.data());
  program->SetUniform1iv("svoFirst", static_cast<int>(this->First.size()), this->First.data());
  program->SetUniformf("svoReceive", receives ? 1.0f : 0.0f);
  program->SetUniformf("svoIntensity", this->Intensity);
  program->SetUniformf("svoManualBias", this->ManualBias);
}
}
