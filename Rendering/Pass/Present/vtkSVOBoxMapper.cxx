#include "vtkSVOBoxMapper.h"

#include "svoOpenGL.h"
#include "svoUniforms.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLHelper.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"

vtkStandardNewMacro(vtkSVOBoxMapper);

void vtkSVOBoxMapper::SetSurface(
  const svo::EyeCode& code, std::size_t surface, svo::BorrowedTextures& textures)
{
  this->Code = &code;
  this->Surface = surface;
  this->Textures = &textures;
  if (code.constants != this->Constants)
  {
    this->Constants = code.constants;
    this->Modified(); // has shaders made anew
  }
}

void vtkSVOBoxMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor)
{
  // The box may reach beyond the far plane where what is seen in it does not.
  const bool clamped = glIsEnabled(GL_DEPTH_CLAMP) == GL_TRUE;
  glEnable(GL_DEPTH_CLAMP);
  this->Superclass::RenderPieceDraw(renderer, actor);
  if (!clamped)
  {
    glDisable(GL_DEPTH_CLAMP);
  }
}

void vtkSVOBoxMapper::ReplaceShaderValues(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor)
{
  const std::string text = this->Constants + this->Code->text;
  std::string vertex = shaders[vtkShader::Vertex]->GetSource();
  const auto inVertex = [&vertex](const char* mark, const std::string& by)
  { vtkShaderProgram::Substitute(vertex, mark, by, false); };
  inVertex("//VTK::PositionVC::Dec",
    "uniform mat4 svoBoxToView;\n"
    "uniform mat4 svoViewToClip;\n"
    "out vec3 svoEndVSOutput;\n"
    "out vec3 svoViewEndVSOutput;\n");
  inVertex("//VTK::PositionVC::Impl",
    "  svoEndVSOutput = vertexMC.xyz;\n"
    "  svoViewEndVSOutput = (svoBoxToView * vec4(vertexMC.xyz, 1.0)).xyz;\n"
    "  gl_Position = svoViewToClip * vec4(svoViewEndVSOutput, 1.0);\n");
  shaders[vtkShader::Vertex]->SetSource(vertex);

  std::string fragment = shaders[vtkShader::Fragment]->GetSource();
  const auto inFragment = [&fragment](const char* mark, const std::string& by)
  { vtkShaderProgram::Substitute(fragment, mark, by, false); };
  inFragment("//VTK::PositionVC::Dec",
    "in vec3 svoEndVSOutput;\n"
    "in vec3 svoViewEndVSOutput;\n" +
      text);
  inFragment("//VTK::PositionVC::Impl",
    "  svoSeen svoSurface;\n"
    "  bool svoFound = svoSees(svoEndVSOutput, svoViewEndVSOutput, svoSurface);\n"
    "  vec4 vertexVC = vec4(svoSurface.position, 1.0);\n");
  inFragment("//VTK::Depth::Impl",
    "  if (!svoFound)\n"
    "  {\n"
    "    discard;\n"
    "  }\n"
    "  gl_FragDepth = svoDepthOf(svoSurface.position);\n");
  inFragment("//VTK::Normal::Dec", "");
  inFragment("//VTK::Normal::Impl", "  vec3 normalVCVSOutput = svoSurface.normal;\n");
  inFragment("//VTK::Color::Impl",
    "//VTK::Color::Impl\n"
    "  ambientColor *= svoSurface.color;\n"
    "  diffuseColor *= svoSurface.color;\n");
  shaders[vtkShader::Fragment]->SetSource(fragment);
  this->Superclass::ReplaceShaderValues(shaders, renderer, actor);
}

void vtkSVOBoxMapper::SetMapperShaderParameters(
  vtkOpenGLHelper& cells, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::SetMapperShaderParameters(cells, renderer, actor);
  this->Textures->send(cells.Program);
  const auto program = static_cast<unsigned int>(cells.Program->GetHandle());
  svo::sendUniforms(program, this->Code->values);
  svo::sendUniforms(program, this->Code->surfaces[this->Surface].values);
}
