#include "svoTracedBoxes.h"

#include "svoOpenGL.h"
#include "svoProgram.h"
#include "svoPropPasses.h"
#include "svoStrips.h"
#include "svoUniforms.h"

#include "vtkActor.h"
#include "vtkCellArray.h"
#include "vtkInformation.h"
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
#include "vtkRenderer.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include <glm/vec3.hpp>

namespace svo
{
namespace
{
/// Lines of sight that a pixel has, one for each sample up to four, and how many samples there are.
std::pair<int, int> linesOfSight()
{
  GLint major = 0, samples = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_SAMPLES, &samples);
  samples = std::max(samples, 1);
  return { major >= 4 ? std::min(samples, 4) : 1, samples };
}

/// Draws what lies in some boxes, by VTK's own shaders with EyeCode in them. The input is as many
/// cubes, or more: cube n from (0, 0, 2 n) to (1, 1, 2 n + 1), as triangles that are wound to the
/// left outside. Of these the farther ones are drawn, each fragment of which follows its line of
/// sight back to the eye; so the eye may be inside of a box. Colours, lights and whatever passes
/// add are VTK's.
class BoxMapper : public vtkOpenGLPolyDataMapper
{
public:
  static BoxMapper* New();
  vtkTypeMacro(BoxMapper, vtkOpenGLPolyDataMapper);

  /// What to draw until the next call: boxes of `code`, with its textures.
  void SetBoxes(const EyeCode& code, std::size_t first, std::size_t end, BorrowedTextures& textures)
  {
    this->Code = &code;
    this->First = static_cast<int>(first);
    this->Count = static_cast<int>(end - first);
    this->Textures = &textures;
    this->Share = 0.0;
    for (std::size_t box = first; box < end; ++box)
    {
      this->Share += code.surfaces[box].share;
    }
    if (code.constants != this->Constants)
    {
      this->Constants = code.constants;
      this->Modified(); // has shaders made anew
    }
  }

  /// Of the picture's pixels, one of several boxes as often.
  double GetShare() const { return this->Share; }

protected:
  void RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) override
  {
    vtkOpenGLState* state =
      static_cast<vtkOpenGLRenderWindow*>(renderer->GetVTKWindow())->GetState();
    const vtkOpenGLState::ScopedglScissor before(state);
    const vtkOpenGLState::ScopedglEnableDisable cut(state, GL_SCISSOR_TEST);
    const auto [lines, samples] = linesOfSight();
    if (lines > 1)
    {
      glEnable(GL_SAMPLE_SHADING);
      glMinSampleShading(static_cast<float>(lines) / static_cast<float>(samples));
    }
    // The box may reach beyond the far plane where what is seen in it does not.
    const bool clamped = glIsEnabled(GL_DEPTH_CLAMP) == GL_TRUE;
    glEnable(GL_DEPTH_CLAMP);
    int area[4];
    glGetIntegerv(glIsEnabled(GL_SCISSOR_TEST) ? GL_SCISSOR_BOX : GL_VIEWPORT, area);
    if (lines * this->Share * area[3] <= RowsAtOnce)
    {
      this->Superclass::RenderPieceDraw(renderer, actor);
    }
    else
    {
      state->vtkglEnable(GL_SCISSOR_TEST);
      eachStrip(area[1], area[1] + area[3], lines * this->Share,
        [&](int row, int rows)
        {
          state->vtkglScissor(area[0], row, area[2], rows);
          this->Superclass::RenderPieceDraw(renderer, actor);
        });
    }
    if (!clamped)
    {
      glDisable(GL_DEPTH_CLAMP);
    }
    if (lines > 1)
    {
      glMinSampleShading(0.0f);
      glDisable(GL_SAMPLE_SHADING);
    }
  }

  void ReplaceShaderValues(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;

  void SetMapperShaderParameters(
    vtkOpenGLHelper& cells, vtkRenderer* renderer, vtkActor* actor) override
  {
    this->Superclass::SetMapperShaderParameters(cells, renderer, actor);
    this->Textures->send(cells.Program);
    sendUniforms(static_cast<unsigned int>(cells.Program->GetHandle()), this->Code->values);
    cells.Program->SetUniformi("svoFirstBox", this->First);
    cells.Program->SetUniformi("svoBoxCount", this->Count);
  }

private:
  const EyeCode* Code = nullptr;
  int First = 0, Count = 0;
  double Share = 0.0;
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
    "uniform int svoFirstBox;\n"
    "uniform int svoBoxCount;\n"
    "flat out int svoBoxVSOutput;\n"
    "out vec3 svoEndVSOutput;\n"
    "out vec3 svoViewEndVSOutput;\n" +
      std::string(this->Code->vertexText));
  inVertex("//VTK::PositionVC::Impl",
    "  int svoCube = int(vertexMC.z + 0.5) / 2;\n"
    "  svoBoxVSOutput = svoFirstBox + svoCube;\n"
    "  svoEndVSOutput = vec3(0.0);\n"
    "  svoViewEndVSOutput = vec3(0.0);\n"
    "  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);\n" // of cubes for which there are no boxes
    "  if (svoCube < svoBoxCount)\n"
    "  {\n"
    "    gl_Position = svoCorner(svoBoxVSOutput,\n"
    "      vec3(vertexMC.xy, vertexMC.z - float(2 * svoCube)), svoEndVSOutput,\n"
    "      svoViewEndVSOutput);\n"
    "  }\n");
  shaders[vtkShader::Vertex]->SetSource(vertex);

  std::string fragment = shaders[vtkShader::Fragment]->GetSource();
  const auto inFragment = [&fragment](const char* mark, const std::string& by)
  { vtkShaderProgram::Substitute(fragment, mark, by, false); };
  inFragment("//VTK::PositionVC::Dec",
    "flat in int svoBoxVSOutput;\n"
    "in vec3 svoEndVSOutput;\n"
    "in vec3 svoViewEndVSOutput;\n" +
      text);
  inFragment("//VTK::PositionVC::Impl",
    "  svoSeen svoSurface;\n"
    "  bool svoFound = svoSees(svoBoxVSOutput, svoEndVSOutput, svoViewEndVSOutput,\n"
    "    svoSurface);\n"
    "  vec4 vertexVC = vec4(svoSurface.position, 1.0);\n");
  inFragment("//VTK::Depth::Impl",
    "  gl_FragDepth = svoDepthOf(svoSurface.position);\n"
    "  if (!svoFound || gl_FragDepth > 1.0 + svoDepthOffset)\n" // as the far plane cuts it
    "  {\n"
    "    discard;\n"
    "  }\n");
  inFragment("//VTK::Normal::Dec", "");
  inFragment("//VTK::Normal::Impl", "  vec3 normalVCVSOutput = svoSurface.normal;\n");
  inFragment("//VTK::Color::Impl",
    "//VTK::Color::Impl\n"
    "  ambientColor *= svoSurface.color;\n"
    "  diffuseColor *= svoSurface.color;\n");
  shaders[vtkShader::Fragment]->SetSource(fragment);
  this->Superclass::ReplaceShaderValues(shaders, renderer, actor);
}

/// A cube's sides, wound to the left outside; corners by x + 2 y + 4 z.
constexpr vtkIdType Sides[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 },
  { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };

vtkSmartPointer<vtkActor> makeActor()
{
  vtkNew<vtkPolyData> none;
  vtkNew<BoxMapper> mapper;
  mapper->SetInputData(none);
  mapper->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->FrontfaceCullingOn();
  actor->SetPropertyKeys(vtkNew<vtkInformation>());
  return actor;
}

/// Has at least so many cubes, and at most four times as many.
void makeCubes(BoxMapper* mapper, std::size_t count)
{
  const auto known = static_cast<std::size_t>(mapper->GetInput()->GetNumberOfPoints()) / 8;
  if (known >= count && known <= 4 * count)
  {
    return;
  }
  const auto wanted = static_cast<vtkIdType>(known > 0 ? count + count / 2 : count);
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(8 * wanted);
  vtkNew<vtkCellArray> sides;
  sides->AllocateExact(12 * wanted, 36 * wanted);
  for (vtkIdType first = 0; first < 8 * wanted; first += 8)
  {
    for (int i = 0; i < 8; ++i)
    {
      points->SetPoint(first + i, i & 1, i >> 1 & 1, static_cast<double>((i >> 2) + first / 4));
    }
    for (const auto& side : Sides)
    {
      sides->InsertNextCell({ first + side[0], first + side[1], first + side[2] });
      sides->InsertNextCell({ first + side[0], first + side[2], first + side[3] });
    }
  }
  vtkNew<vtkPolyData> cubes;
  cubes->SetPoints(points);
  cubes->SetPolys(sides);
  mapper->SetInputData(cubes);
}

/// True if one material's boxes are drawn as the other's are.
bool looksLike(const Material& a, const Material& b, bool tinted)
{
  const auto values = [](const Material& m)
  {
    return std::make_tuple(
      m.ambient, m.diffuse, m.specular, m.specularPower, m.lighting, m.specularColor);
  };
  return values(a) == values(b) &&
    (tinted || (a.ambientColor == b.ambientColor && a.diffuseColor == b.diffuseColor));
}

void setMaterial(vtkProperty* property, const Material& material, bool tinted)
{
  const glm::vec3 own(1.0f);
  const glm::dvec3 ambient(tinted ? own : material.ambientColor);
  const glm::dvec3 diffuse(tinted ? own : material.diffuseColor);
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
                        "  vec3 end, viewEnd;\n"
                        "  svoCorner(0, gl_FragCoord.xyz, end, viewEnd);\n"
                        "  bool found = svoSees(0, end, viewEnd, seen);\n"
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
  const auto materialOf = [&](std::size_t box) -> const Material&
  { return scene.instances[code.surfaces[box].instance].material; };
  for (std::size_t first = 0, end = 0; first < code.surfaces.size(); first = end)
  {
    const EyeCode::Surface& surface = code.surfaces[first];
    vtkProp* prop = props[surface.instance];
    for (end = first + 1;
         end < code.surfaces.size() && props[code.surfaces[end].instance] == prop &&
         code.surfaces[end].tinted == surface.tinted &&
         looksLike(materialOf(first), materialOf(end), surface.tinted);
         ++end)
    {
    }
    if (this->Props.size() == this->Actors.size())
    {
      this->Actors.push_back(makeActor());
    }
    vtkActor* actor = this->Actors[this->Props.size()];
    auto* mapper = static_cast<BoxMapper*>(actor->GetMapper());
    mapper->SetBoxes(code, first, end, this->Textures);
    makeCubes(mapper, end - first);
    setMaterial(actor->GetProperty(), materialOf(first), surface.tinted);
    this->Props.push_back(prop);
  }
  this->Actors.resize(this->Props.size());
}

/// Has them drawn with a prop's keys, and passes that stand for its own. The same object as ever:
/// of an actor with another one VTK makes all buffers anew.
void TracedBoxes::takeKeys(vtkActor* actor, vtkProp* prop, vtkProp* presenter)
{
  vtkInformation* keys = actor->GetPropertyKeys();
  keys->Clear();
  if (vtkInformation* own = prop->GetPropertyKeys())
  {
    keys->Copy(own);
    keys->Remove(vtkOpenGLRenderPass::RenderPasses());
  }
  std::vector<vtkOpenGLRenderPass*> passes;
  const auto add = [&](vtkOpenGLRenderPass* pass)
  {
    if (std::find(passes.begin(), passes.end(), pass) == passes.end())
    {
      passes.push_back(pass);
    }
  };
  eachPass(prop, add);
  if (presenter)
  {
    eachPass(presenter, add);
  }
  for (vtkOpenGLRenderPass* pass : passes)
  {
    auto known = std::find_if(this->Passes.begin(), this->Passes.end(),
      [pass](const auto& one) { return one->Pass == pass; });
    if (known == this->Passes.end())
    {
      known = this->Passes.insert(known, vtkSmartPointer<ForwardingPass>::New());
      (*known)->Pass = pass;
    }
    addPass(keys, *known);
  }
}

void TracedBoxes::draw(vtkViewport* viewport, const std::set<vtkProp*>* only, vtkProp* presenter)
{
  const int lines = linesOfSight().first;
  double rows = 0.0; // of pixels, as many as are asked for and not begun
  for (std::size_t i = 0; i < this->Props.size(); ++i)
  {
    vtkActor* actor = this->Actors[i];
    const double share = static_cast<BoxMapper*>(actor->GetMapper())->GetShare();
    if (share == 0.0 || (only && only->count(this->Props[i]) == 0))
    {
      continue;
    }
    this->takeKeys(actor, this->Props[i], presenter);
    actor->RenderOpaqueGeometry(viewport);
    rows += lines * share * viewport->GetSize()[1];
    if (rows > RowsAtOnce)
    {
      glFlush();
      rows = 0.0;
    }
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
