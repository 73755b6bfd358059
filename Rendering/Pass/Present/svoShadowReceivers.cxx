#include "svoShadowReceivers.h"

#include "svoMapGroups.h"
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
  constexpr std::size_t OfLight = 28, OfMap = 24, Others = 512; // components, as vectors of four
  GLint components = 0;
  glGetIntegerv(GL_MAX_FRAGMENT_UNIFORM_COMPONENTS, &components);
  const std::size_t taken = OfLight * lights + Others;
  const std::size_t left = std::max<std::size_t>(components, taken) - taken;
  return std::max(left / OfMap, MapsOfLight);
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
}

std::string ShadowReceivers::update(vtkOpenGLRenderWindow* window,
  const std::vector<ShadowMap>& maps, const std::vector<Light>& lights, const View& eye,
  const FrameSettings& settings, unsigned int texture)
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
  MapGroups groups = groupsOf(maps);
  std::string complaint;
  const std::size_t most = mostMaps(lights.size());
  if (keepBrightest(groups, lights, most, MapTextures::most()))
  {
    complaint = "Rasterised surfaces receive shadows of the brightest lights only: OpenGL takes no "
                "more shadow maps.";
  }

  std::vector<const ShadowMap*> kept;
  this->Groups.clear();
  this->First.clear();
  this->Rows.clear();
  this->Errors.clear();
  for (const auto& entry : groups)
  {
    if (!entry.first.translucent)
    {
      this->FirstTranslucent = static_cast<int>(kept.size() + entry.second.size());
    }
    this->Groups.push_back(entry.first);
    this->First.push_back(static_cast<int>(kept.size()));
    for (const ShadowMap* map : entry.second)
    {
      const glm::mat4 matrix = glm::transpose(receiverMatrix(*map, eye));
      this->Rows.insert(this->Rows.end(), &matrix[0][0], &matrix[0][0] + 16);
      this->Errors.push_back(static_cast<float>(map->worldBias));
      kept.push_back(map);
    }
  }
  this->First.push_back(static_cast<int>(kept.size()));
  // Shaders are not built anew because a light has other maps than before.
  this->Capacity = std::min(std::max(kept.size(), MapsOfLight * groups.size()), most);
  this->Size = maps.front().view.width;
  if (!this->Maps.upload(kept, texture, window))
  {
    this->release();
    return "Rasterised surfaces receive no shadows: OpenGL has no room for " +
      std::to_string(kept.size()) + " shadow maps of " + std::to_string(this->Size) +
      " texels. Lower ShadowBufferResolution.";
  }
  return complaint;
}

void ShadowReceivers::activate()
{
  if (!this->empty())
  {
    this->Maps.activate();
  }
}

void ShadowReceivers::deactivate()
{
  if (!this->empty())
  {
    this->Maps.deactivate();
  }
}

void ShadowReceivers::release()
{
  this->Groups.clear();
  this->First.clear();
  this->Errors.clear();
  this->FirstTranslucent = 0;
  this->Capacity = 0;
  this->Maps.release();
}

std::string ShadowReceivers::signature() const
{
  std::ostringstream text;
  text << this->Capacity << ' ' << this->PlaneBias << ' ' << this->Filter << ' ' << this->Catchers
       << ": ";
  for (const MapGroup& group : this->Groups)
  {
    text << group.light << (group.group > 0 ? "t " : " ");
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
       << "const bool svoTranslucent = " << boolean(this->translucent()) << ";\n"
       << shadowRules() << svoShadowReceiver << "uniform int svoFirst[" << this->Groups.size()
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
    std::map<int, std::string> shares; // by light
    for (std::size_t i = 0; i < this->Groups.size(); ++i)
    {
      std::string& share = shares[this->Groups[i].light];
      share += (share.empty() ? "svoShare[" : " * svoShare[") + std::to_string(i) + "]";
    }
    for (const auto& [light, share] : shares)
    {
      weigh(light, this->translucent() ? "svoShown(" + share + ")" : share);
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
  const std::string count = std::to_string(this->Groups.size());
  const std::string lit = this->translucent() ? "svoLeft" : "svoLit";
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
        "    svoShare[i] = " +
        lit + "(svoFirst[i], svoFirst[i + 1], svoPosition, svoFacet, " +
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
  program->SetUniformi("svoMaps", this->Maps.activate());
  const auto count = static_cast<int>(this->Errors.size());
  program->SetUniformMatrix4x4v("svoRows", count, const_cast<float*>(this->Rows.data()));
  program->SetUniform1fv("svoErrors", count, this->Errors.data());
  program->SetUniform1iv("svoTables", count, this->Maps.tables().data());
  program->SetUniformi("svoSize", this->Size);
  program->SetUniform1iv("svoFirst", static_cast<int>(this->First.size()), this->First.data());
  if (this->translucent())
  {
    program->SetUniformi("svoFirstTranslucent", this->FirstTranslucent);
  }
  program->SetUniformf("svoReceive", receives ? 1.0f : 0.0f);
  program->SetUniformf("svoIntensity", this->Intensity);
  program->SetUniformf("svoManualBias", this->ManualBias);
}
}
