#include "svoShadowReceivers.h"

#include "svoAmbientCode.h"
#include "svoShadowCatcher.h"
#include "svoShadowReceiver.h"
#include "svoUniforms.h"

#include "vtkShaderProgram.h"

#include <cctype>
#include <map>
#include <sstream>

namespace svo
{
namespace
{
const char DeclarationMark[] = "//SVO::Dec\n";
const char ImplementationMark[] = "//SVO::Impl\n";
const char LitMark[] = "//SVO::Lit\n"; // after VTK's lighting

bool isIdentifier(char c)
{
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

/// Renames a whole token; true if it was there.
bool renameToken(std::string& text, const std::string& from, const std::string& to)
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

/// True if `text` has `name` as a whole token.
bool hasToken(std::string text, const std::string& name)
{
  return renameToken(text, name, name);
}

/// Has the vertex shader, and the geometry shader if there is one, send where a fragment lies
/// inside of its facet, and with `corner` each facet one of its corners with its normal; false if
/// they know none. (VTK's shader cache changes VSOut in fragment shaders to GSOut where there are
/// geometry shaders.)
bool sendPlaces(std::string& vertexShader, std::string& geometryShader, bool& corner)
{
  const std::string copied = "vertexVCGSOutput = vertexVCVSOutput[i];";
  const std::size_t main = vertexShader.find("void main()");
  const std::size_t end = vertexShader.rfind('}');
  const std::size_t geometryMain = geometryShader.find("void main()");
  const std::size_t copy = geometryShader.find(copied);
  if (main == std::string::npos || end == std::string::npos || end < main ||
    vertexShader.find("vertexVCVSOutput =", main) == std::string::npos ||
    (!geometryShader.empty() &&
      (geometryMain == std::string::npos || copy == std::string::npos || copy < geometryMain)))
  {
    return false;
  }
  const auto send = [&](const std::string& kind, const std::string& name, const std::string& what,
                      const std::string& of)
  {
    vertexShader.insert(vertexShader.rfind('}'), "  " + name + "VSOutput = " + what + ";\n");
    vertexShader.insert(main, kind + " out vec3 " + name + "VSOutput;\n");
    if (!geometryShader.empty())
    {
      geometryShader.insert(geometryShader.find(copied) + copied.size(),
        "\n  " + name + "GSOutput = " + name + "VSOutput[" + of + "];\n");
      geometryShader.insert(geometryShader.find("void main()"),
        kind + " in vec3 " + name + "VSOutput[];\n" + kind + " out vec3 " + name + "GSOutput;\n");
    }
  };
  corner = vertexShader.find("out vec3 normalVCVSOutput;") != std::string::npos;
  // With several samples a pixel its centre may lie beyond the facet, and behind the one beside it.
  send("centroid", "svoPlace", "vertexVCVSOutput.xyz", "i");
  if (corner)
  {
    send("flat", "svoCorner", "vertexVCVSOutput.xyz", "0");
    send("flat", "svoCornerNormal", "normalVCVSOutput", "0");
  }
  return true;
}

/// Where a fragment lies, and its own plane.
constexpr char FragmentOfFacet[] =
  "  vec3 svoPosition = vertexVC.xyz;\n"
  "  vec3 svoFacet = normalize(cross(dFdx(vertexVC.xyz), dFdy(vertexVC.xyz)));\n"
  "  svoFacet = svoMirrored > 0.0 ? -svoFacet : svoFacet;\n";

/// The same of what svoTracedBoxes.cxx has traced.
constexpr char FragmentOfTraced[] = "  vec3 svoPosition = svoSurface.position;\n"
                                    "  vec3 svoFacet = svoSurface.facet;\n"
                                    "#ifdef svoRays\n"
                                    "  svoAbove = svoSeenError;\n"
                                    "#endif\n";

/// The rims of VTK's balls have no derivatives.
constexpr char FacetOfNormal[] = "  if (any(isnan(svoFacet)))\n"
                                 "  {\n"
                                 "    svoFacet = normalVCVSOutput;\n"
                                 "  }\n";

/// The same on lines as tubes and points as spheres: VTK leaves vertexVC on the axis, or at the
/// centre. Its normals of tubes are not quite perpendicular to them in windows that are not square.
/// The place is three twentieths of the radius above the surface: what casts the tube's shadow is
/// wider by up to 0.118 of it (Pieces of svoPlacedShapes.cxx), and at joints, which VTK draws flat,
/// what is seen lies inside of the next tube.
constexpr char FragmentOfTube[] =
  "  vec3 svoAcross = dFdx(vertexVC.xyz);\n"
  "  vec3 svoUp = dFdy(vertexVC.xyz);\n"
  "  vec3 svoAxis = dot(svoAcross, svoAcross) < dot(svoUp, svoUp) ? svoUp : svoAcross;\n"
  "  float svoAxisSquare = dot(svoAxis, svoAxis);\n"
  "  vec3 svoFacet = svoAxisSquare > 0.0\n"
  "    ? normalize(normalVCVSOutput - dot(normalVCVSOutput, svoAxis) / svoAxisSquare * svoAxis)\n"
  "    : normalVCVSOutput;\n"
  "  vec3 svoPosition =\n"
  "    vertexVC.xyz + 1.15 * ZCalcR * (cameraParallel == 0 ? -vertexVC.z : 1.0) * svoFacet;\n";

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

/// Adds the code of what is all around.
void lightAround(const LightCode& code, const std::string& normal, bool catchers,
  std::string& declarations, std::string& body)
{
  const bool pbr = body.find("albedo") != std::string::npos;
  std::string text;
  const auto onCatchers = [&](const char* rule)
  { text += catchers ? std::string("  if (svoCatch > 0.0)\n  ") + rule + "  else\n" : ""; };
  // Image-based lighting has its own light of all around.
  if (code.sky != LightCode::None && body.find("irradiance") == std::string::npos)
  {
    text += SkyAfterLighting;
    onCatchers(SkyOnCatcher);
    text += pbr ? SkyOnAlbedo : SkyOnColors;
  }
  else if (code.unlit && !pbr)
  {
    text += NoLight;
  }
  if (code.occlusion != LightCode::None)
  {
    text += OcclusionAfterLighting;
    onCatchers(OcclusionOnCatcher);
    text += pbr ? OcclusionOnAlbedo : OcclusionOnColors;
    vtkShaderProgram::Substitute(
      declarations, DeclarationMark, std::string(DeclarationMark) + AmbientDeclarations, false);
  }
  renameToken(text, "NORMAL", normal);
  renameToken(text, "SKY", std::to_string(code.sky));
  renameToken(text, "OPEN", std::to_string(code.occlusion));
  vtkShaderProgram::Substitute(body, LitMark, text + LitMark, false);
}
}

void ShadowReceivers::update(
  vtkOpenGLRenderWindow* window, const LightCode& code, double intensity, bool catchers)
{
  this->Code = &code;
  this->Intensity = static_cast<float>(intensity);
  this->Catchers = catchers;
  this->Textures.update(
    window, code.empty() ? std::vector<ShaderValues::Texture>() : code.textures);
}

void ShadowReceivers::release()
{
  this->Code = nullptr;
  this->Textures.release();
}

std::string ShadowReceivers::signature() const
{
  std::ostringstream text;
  text << this->Catchers << ": ";
  if (!this->empty())
  {
    for (const int light : this->Code->lights)
    {
      text << light << ' ';
    }
    text << this->Code->occlusion << this->Code->sky << this->Code->unlit << this->Code->constants
         << static_cast<const void*>(this->Code->text);
  }
  return text.str();
}

void ShadowReceivers::markShader(std::string& fragmentShader)
{
  if (fragmentShader.find(DeclarationMark) != std::string::npos)
  {
    return; // of a prop that carries the pass twice: it is also a part of another one
  }
  vtkShaderProgram::Substitute(
    fragmentShader, "//VTK::Light::Dec", std::string(DeclarationMark) + "//VTK::Light::Dec", false);
  vtkShaderProgram::Substitute(fragmentShader, "//VTK::Light::Impl",
    std::string(ImplementationMark) + "  //VTK::Light::Impl\n" + LitMark, false);
}

std::string ShadowReceivers::declarations() const
{
  return this->Code->constants + this->Code->text + svoShadowReceiver;
}

void ShadowReceivers::completeShader(
  std::string& vertexShader, std::string& geometryShader, std::string& fragmentShader) const
{
  const std::size_t main = fragmentShader.find("void main()");
  if (main == std::string::npos || fragmentShader.find(DeclarationMark) == std::string::npos)
  {
    return;
  }
  std::string declarations = fragmentShader.substr(0, main);
  std::string body = fragmentShader.substr(main);
  // VTK offsets lines by the slope of a depth that tubes have not written yet: it may be anything.
  vtkShaderProgram::Substitute(body, "vec2(dFdx(gl_FragDepth), dFdy(gl_FragDepth))",
    "vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z))", false);
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
  const bool asks = !this->empty() && body.find("vec4 vertexVC =") != std::string::npos;
  std::map<int, std::string> shares; // by light
  for (std::size_t i = 0; asks && i < this->Code->lights.size(); ++i)
  {
    std::string& share = shares[this->Code->lights[i]];
    share += (share.empty() ? "svoShare[" : " * svoShare[") + std::to_string(i) + "]";
  }
  for (const auto& [light, share] : shares)
  {
    weigh(light, "svoShown(" + share + ")");
  }
  const bool around = asks && this->Code->hasAround();
  const bool any = !code.str().empty() || around;
  const bool round = hasNormal && hasToken(declarations, "ZCalcR");
  const bool traced = hasToken(body, "svoSurface");
  const std::string normal = hasNormal ? "normalVCVSOutput" : "svoFacet";
  if (around)
  {
    lightAround(*this->Code, normal, this->Catchers, declarations, body);
  }
  if (this->Catchers)
  {
    // Those that cast nothing.
    for (int i = 0; any && hasToken(declarations, "lightColor" + std::to_string(i)); ++i)
    {
      weigh(i, "1.0");
    }
    catchShadows(declarations, body, any);
  }
  bool corner = false;
  const bool placed = any && sendPlaces(vertexShader, geometryShader, corner);
  const bool smooth = corner && hasNormal;
  // One loop, since compilers copy the function to wherever it is called.
  const std::string count = any ? std::to_string(this->Code->count()) : std::string();
  vtkShaderProgram::Substitute(declarations, DeclarationMark,
    any ? this->declarations() + (placed ? "centroid in vec3 svoPlaceVSOutput;\n" : "") +
        (smooth ? "flat in vec3 svoCornerVSOutput;\nflat in vec3 svoCornerNormalVSOutput;\n" : "")
        : std::string(),
    false);
  vtkShaderProgram::Substitute(body, ImplementationMark,
    any ? std::string(traced ? FragmentOfTraced
              : round        ? FragmentOfTube
                             : FragmentOfFacet) +
        (hasNormal ? FacetOfNormal : "") +
        "  float svoExtent = min(length(dFdx(svoPosition)), length(dFdy(svoPosition)));\n"
        "  float svoSteep = fwidth(svoPosition.z);\n"
        "  vec3 svoLift = " +
        std::string(smooth
            ? "svoSmoothLift(svoPosition, svoFacet, normalVCVSOutput, svoCornerVSOutput, "
              "normalize(svoCornerNormalVSOutput));\n"
            : "vec3(0.0);\n") +
        (placed && !round ? "  svoPosition = svoInFacet(svoPosition, svoPlaceVSOutput, svoFacet);\n"
                          : "") +
        "  float svoShare[" + count +
        "];\n"
        "  for (int i = 0; i < " +
        count +
        "; ++i)\n"
        "  {\n"
        "    svoShare[i] = svoGather > 0.0 ? 1.0 : svoLeft(i, svoPosition, svoFacet, " +
        normal +
        ", svoLift, svoExtent);\n"
        "  }\n" +
        code.str()
        : std::string(),
    false);
  if (any && this->Code->fromPlaces)
  {
    body.insert(body.rfind('}'),
      "  if (svoGather > 0.0)\n"
      "  {\n"
      "    if (!svoIsBehind(svoPosition, svoExtent, svoSteep))\n"
      "    {\n"
      "      discard;\n"
      "    }\n"
      "    gl_FragData[0] = svoPlaceOf(svoPosition, svoLift, " +
        std::string(traced ? "svoSeenError" : "0.0") +
        ");\n"
        "    gl_FragData[1] = svoPlanesOf(svoFacet, " +
        normal +
        ");\n"
        "  }\n");
  }
  fragmentShader = declarations + body;
}

void ShadowReceivers::setUniforms(
  vtkShaderProgram* program, bool receives, bool catches, bool opaque) const
{
  // What a program has no uniform for VTK leaves out.
  program->SetUniformf("svoCatch", catches && !this->Gathers ? 1.0f : 0.0f);
  if (this->empty() || !program->IsUniformUsed("svoReceive"))
  {
    return;
  }
  this->Textures.send(program);
  sendUniforms(static_cast<unsigned int>(program->GetHandle()), *this->Code);
  program->SetUniformf("svoReceive", receives ? 1.0f : 0.0f);
  program->SetUniformf("svoGather", this->Gathers ? 1.0f : 0.0f);
  program->SetUniformi("svoBehind", this->Behind);
  program->SetUniformf("svoOpaque", opaque ? 1.0f : 0.0f);
  program->SetUniformf("svoIntensity", this->Intensity);
  program->SetUniformf("svoMirrored", this->Mirrored ? 1.0f : 0.0f);
}
}
