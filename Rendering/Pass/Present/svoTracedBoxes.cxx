#include "svoTracedBoxes.h"

#include "svoOpenGL.h"
#include "svoProgram.h"
#include "svoPropPasses.h"
#include "svoStrips.h"
#include "svoUniforms.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLVertexBufferObject.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <map>

#include <glm/vec3.hpp>

namespace svo
{
namespace
{
/// Draws what lies in a box, by VTK's own shaders with EyeCode in them. The input is the box, as
/// triangles that are wound to the left outside. Of these the farther ones are drawn, each fragment
/// of which follows its line of sight back to the eye; so the eye may be inside of the box.
/// Colours, lights and whatever passes add are VTK's.
class BoxMapper : public vtkOpenGLPolyDataMapper
{
public:
  static BoxMapper* New();
  vtkTypeMacro(BoxMapper, vtkOpenGLPolyDataMapper);

  /// What to draw until the next call: one of `code`'s surfaces, with the textures of `code`.
  void SetSurface(const EyeCode& code, std::size_t surface, BorrowedTextures& textures)
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

protected:
  void RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) override
  {
    // The box may reach beyond the far plane where what is seen in it does not.
    const bool clamped = glIsEnabled(GL_DEPTH_CLAMP) == GL_TRUE;
    glEnable(GL_DEPTH_CLAMP);
    if (this->Code->surfaces[this->Surface].rows <= RowsAtOnce)
    {
      this->Superclass::RenderPieceDraw(renderer, actor);
    }
    else
    {
      this->DrawStrips(renderer, actor);
    }
    if (!clamped)
    {
      glDisable(GL_DEPTH_CLAMP);
    }
  }

  void ReplaceShaderValues(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;

  void SetMapperShaderParameters(
    vtkOpenGLHelper& cells, vtkRenderer* renderer, vtkActor* actor) override
  {
    this->Superclass::SetMapperShaderParameters(cells, renderer, actor);
    this->Textures->send(cells.Program);
    const auto program = static_cast<unsigned int>(cells.Program->GetHandle());
    sendUniforms(program, this->Code->values);
    sendUniforms(program, this->Code->surfaces[this->Surface].values);
  }

private:
  void DrawStrips(vtkRenderer* renderer, vtkActor* actor)
  {
    vtkOpenGLState* state =
      static_cast<vtkOpenGLRenderWindow*>(renderer->GetVTKWindow())->GetState();
    const vtkOpenGLState::ScopedglScissor before(state);
    const vtkOpenGLState::ScopedglEnableDisable cut(state, GL_SCISSOR_TEST);
    int area[4];
    glGetIntegerv(glIsEnabled(GL_SCISSOR_TEST) ? GL_SCISSOR_BOX : GL_VIEWPORT, area);
    state->vtkglEnable(GL_SCISSOR_TEST);
    eachStrip(area[1], area[1] + area[3],
      [&](int row, int rows)
      {
        state->vtkglScissor(area[0], row, area[2], rows);
        this->Superclass::RenderPieceDraw(renderer, actor);
      });
  }

  const EyeCode* Code = nullptr;
  std::size_t Surface = 0;
  BorrowedTextures* Textures = nullptr;
  std::string Constants; // that the shaders were made with
};
vtkStandardNewMacro(BoxMapper);

void BoxMapper::ReplaceShaderValues(
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

/// A box's sides, wound to the left outside; corners by x + 2 y + 4 z.
constexpr vtkIdType Sides[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 },
  { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };

vtkSmartPointer<vtkActor> makeActor()
{
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(8);
  vtkNew<vtkCellArray> sides;
  for (const auto& side : Sides)
  {
    sides->InsertNextCell({ side[0], side[1], side[2] });
    sides->InsertNextCell({ side[0], side[2], side[3] });
  }
  vtkNew<vtkPolyData> box;
  box->SetPoints(points);
  box->SetPolys(sides);
  vtkNew<BoxMapper> mapper;
  mapper->SetInputData(box);
  mapper->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

void setBox(vtkPolyData* box, const glm::vec3& low, const glm::vec3& high)
{
  bool same = true;
  for (int i = 0; i < 8; ++i)
  {
    const glm::dvec3 corner(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    double known[3];
    box->GetPoint(i, known);
    same = same && glm::dvec3(known[0], known[1], known[2]) == corner;
    box->GetPoints()->SetPoint(i, corner.x, corner.y, corner.z);
  }
  if (!same)
  {
    box->GetPoints()->Modified();
  }
}

void setMaterial(vtkProperty* property, const Material& material, bool colored)
{
  const glm::vec3 own(1.0f);
  const glm::dvec3 ambient(colored ? own : material.ambientColor);
  const glm::dvec3 diffuse(colored ? own : material.diffuseColor);
  const glm::dvec3 specular(material.specularColor);
  property->SetAmbientColor(&ambient.x);
  property->SetDiffuseColor(&diffuse.x);
  property->SetSpecularColor(&specular.x);
  property->SetAmbient(material.ambient);
  property->SetDiffuse(material.diffuse);
  property->SetSpecular(material.specular);
  property->SetSpecularPower(material.specularPower);
  property->SetLighting(material.lighting);
}
}

/// Does for shaders what another pass does, and does not keep it alive: VTK's mappers hold the
/// passes that they were drawn with, and one that belongs to a pass would keep it for ever.
class TracedBoxes::ForwardingPass : public vtkOpenGLRenderPass
{
public:
  static ForwardingPass* New();
  vtkTypeMacro(ForwardingPass, vtkOpenGLRenderPass);

  vtkWeakPointer<vtkOpenGLRenderPass> Pass;

  void Render(const vtkRenderState*) override {}
  bool PreReplaceShaderValues(std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp* prop) override
  {
    return !this->Pass ||
      this->Pass->PreReplaceShaderValues(
        vertexShader, geometryShader, fragmentShader, mapper, prop);
  }
  bool PostReplaceShaderValues(std::string& vertexShader, std::string& geometryShader,
    std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp* prop) override
  {
    return !this->Pass ||
      this->Pass->PostReplaceShaderValues(
        vertexShader, geometryShader, fragmentShader, mapper, prop);
  }
  bool SetShaderParameters(vtkShaderProgram* program, vtkAbstractMapper* mapper, vtkProp* prop,
    vtkOpenGLVertexArrayObject* array) override
  {
    return !this->Pass || this->Pass->SetShaderParameters(program, mapper, prop, array);
  }
  vtkMTimeType GetShaderStageMTime() override
  {
    return this->Pass ? this->Pass->GetShaderStageMTime() : 0;
  }
};
vtkStandardNewMacro(TracedBoxes::ForwardingPass);

bool TracedBoxes::accepts(const EyeCode& code)
{
  if (code.surfaces.empty())
  {
    return true;
  }
  if (code.constants != this->Constants)
  {
    this->Constants = code.constants;
    std::string words;
    const unsigned int program =
      linkProgram({ { GL_VERTEX_SHADER, AllPixels },
                    { GL_FRAGMENT_SHADER,
                      "#version 150\n" + code.constants + code.text +
                        "out vec4 color;\n"
                        "void main()\n"
                        "{\n"
                        "  svoSeen seen;\n"
                        "  bool found = svoSees(gl_FragCoord.xyz, gl_FragCoord.xyz, seen);\n"
                        "  color = found ? vec4(seen.normal + seen.color, "
                        "svoDepthOf(seen.position)) : vec4(0.0);\n"
                        "}\n" } },
        words);
    glDeleteProgram(program);
    this->Refusal = program != 0 ? ""
                                 : "OpenGL refuses the shader that traces surfaces (" + words +
        "); octrees are traced on the CPU instead.";
  }
  return this->Refusal.empty();
}

void TracedBoxes::update(vtkOpenGLRenderWindow* window, const EyeCode& code, const Scene& scene,
  const std::vector<vtkProp*>& props)
{
  this->Props.clear();
  this->Textures.update(
    window, code.surfaces.empty() ? std::vector<ShaderValues::Texture>() : code.values.textures);
  for (std::size_t i = 0; i < code.surfaces.size(); ++i)
  {
    if (i == this->Actors.size())
    {
      this->Actors.push_back(makeActor());
    }
    const EyeCode::Surface& surface = code.surfaces[i];
    vtkActor* actor = this->Actors[i];
    auto* mapper = static_cast<BoxMapper*>(actor->GetMapper());
    mapper->SetSurface(code, i, this->Textures);
    setBox(mapper->GetInput(), surface.low, surface.high);
    setMaterial(actor->GetProperty(), scene.instances[surface.instance].material, surface.colored);
    actor->GetProperty()->SetFrontfaceCulling(!surface.turned);
    actor->GetProperty()->SetBackfaceCulling(surface.turned);
    this->Props.push_back(props[surface.instance]);
  }
}

/// A prop's keys, with passes that stand for its own.
vtkSmartPointer<vtkInformation> TracedBoxes::keysOf(vtkProp* prop)
{
  auto keys = vtkSmartPointer<vtkInformation>::New();
  if (vtkInformation* own = prop->GetPropertyKeys())
  {
    keys->Copy(own);
    keys->Remove(vtkOpenGLRenderPass::RenderPasses());
  }
  eachPass(prop,
    [&](vtkOpenGLRenderPass* pass)
    {
      auto known = std::find_if(this->Passes.begin(), this->Passes.end(),
        [pass](const auto& one) { return one->Pass == pass; });
      if (known == this->Passes.end())
      {
        known = this->Passes.insert(known, vtkSmartPointer<ForwardingPass>::New());
        (*known)->Pass = pass;
      }
      addPass(keys, *known);
    });
  return keys;
}

void TracedBoxes::draw(vtkViewport* viewport, const std::set<vtkProp*>* only)
{
  for (std::size_t i = 0; i < this->Props.size(); ++i)
  {
    if (only && only->count(this->Props[i]) == 0)
    {
      continue;
    }
    this->Actors[i]->SetPropertyKeys(this->keysOf(this->Props[i]));
    this->Actors[i]->RenderOpaqueGeometry(viewport);
  }
  this->Textures.deactivate();
}

void TracedBoxes::clear()
{
  this->Props.clear();
  this->Textures.release();
}

void TracedBoxes::release()
{
  this->clear();
  this->Passes.clear();
  this->Constants.clear();
  this->Refusal.clear();
}

void TracedBoxes::releaseGraphicsResources(vtkWindow* window)
{
  for (vtkActor* actor : this->Actors)
  {
    actor->ReleaseGraphicsResources(window);
  }
}
}
