#include "vtkSVOPresenter.h"

#include "svoOpenGL.h"
#include "svoPresentFS.h"
#include "svoPresentVS.h"
#include "svoPropPasses.h"

#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLCamera.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLVertexArrayObject.h"
#include "vtkRenderer.h"
#include "vtkSSAOPass.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"
#include "vtkTimerLog.h"

#include <string>
#include <utility>

#include <glm/vec2.hpp>

vtkStandardNewMacro(vtkSVOPresenter);
vtkStandardNewMacro(vtkSVONothing);

namespace
{
/// Calls something in the context of a window before that goes, or is exchanged for another. A
/// texture, since these alone of what VTK installs know about that: numbers of buffers mean others
/// in other contexts, which may be the current ones.
class ContextKeeper : public vtkTextureObject
{
public:
  static ContextKeeper* New();
  vtkTypeMacro(ContextKeeper, vtkTextureObject);
  void ReleaseGraphicsResources(vtkWindow* window) override
  {
    // Calls this function once more in the context, unless this is that call.
    this->Superclass::ReleaseGraphicsResources(window);
    this->Release();
  }
  std::function<void()> Release;
};
vtkStandardNewMacro(ContextKeeper);
}

vtkSVOPresenter::vtkSVOPresenter()
{
  const auto keeper = vtkSmartPointer<ContextKeeper>::New();
  keeper->Release = [this] { this->ReleaseAll(); };
  this->Context = keeper;
}

vtkSVOPresenter::~vtkSVOPresenter()
{
  this->Context->ReleaseGraphicsResources(nullptr);
}

void vtkSVOPresenter::SetFrame(
  svo::Frame* frame, const SilhouetteFinder& silhouettes, vtkOpenGLRenderPass* pass)
{
  this->Frame = frame;
  this->FindSilhouettes = silhouettes;
  this->Pass = pass;
  this->PresentTime = 0.0;
}

void vtkSVOPresenter::Enter(vtkOpenGLRenderWindow* window)
{
  this->Context->SetContext(window);
  this->Entered = true;
}

void vtkSVOPresenter::SetLeave(std::function<void()> leave)
{
  this->Context->ReleaseGraphicsResources(nullptr);
  this->LeaveContext = std::move(leave);
}

void vtkSVOPresenter::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Context->ReleaseGraphicsResources(window);
  this->QuadMapper->ReleaseGraphicsResources(window);
}

void vtkSVOPresenter::ReleaseAll()
{
  this->Corners = nullptr;
  this->Array = nullptr;
  this->Textures.release();
  if (std::exchange(this->Entered, false) && this->LeaveContext)
  {
    this->LeaveContext();
  }
}

void vtkSVOPresenter::UploadRectangles(const std::vector<svo::PixelRect>& rectangles)
{
  std::vector<glm::vec2> corners;
  for (const svo::PixelRect& r : rectangles)
  {
    const glm::vec2 a(r.x0, r.y0), b(r.x1, r.y0), c(r.x1, r.y1), d(r.x0, r.y1);
    corners.insert(corners.end(), { a, b, c, a, c, d });
  }
  this->Drawn = static_cast<int>(corners.size());
  if (!this->Corners)
  {
    this->Corners = vtkSmartPointer<vtkOpenGLBufferObject>::New();
    this->Array = vtkSmartPointer<vtkOpenGLVertexArrayObject>::New();
  }
  this->Corners->Upload(corners, vtkOpenGLBufferObject::ArrayBuffer);
}

void vtkSVOPresenter::StandFor(vtkProp* prop)
{
  this->SetPropertyKeys(nullptr);
  if (prop)
  {
    vtkNew<vtkInformation> keys;
    svo::eachPass(prop, [&](vtkOpenGLRenderPass* pass) { svo::addPass(keys, pass); });
    this->SetPropertyKeys(keys);
  }
}

bool vtkSVOPresenter::WantsNormals()
{
  bool wants = false;
  svo::eachPass(
    this, [&](vtkOpenGLRenderPass* pass) { wants = wants || vtkSSAOPass::SafeDownCast(pass); });
  return wants;
}

void vtkSVOPresenter::SelectDrawBuffers(vtkShaderProgram* program)
{
  svo::eachPass(this,
    [&](vtkOpenGLRenderPass* pass)
    {
      if (pass != this->Pass)
      {
        pass->SetShaderParameters(program, this->QuadMapper, this, nullptr);
      }
    });
}

bool vtkSVOPresenter::DrawFrame(vtkRenderer* renderer, vtkOpenGLRenderWindow* window)
{
  const svo::Frame& frame = *this->Frame;
  const bool writeNormals = frame.hasNormals();
  const bool writeSlopes = frame.hasSlopes() && this->Textures.bySamples();
  const bool writeLight = frame.hasLight();
  const std::string mark = "//VTK::System::Dec\n";
  std::string shader = svoPresentFS;
  shader.replace(shader.find(mark), mark.size(),
    mark + (writeNormals ? "#define SVO_WRITE_NORMALS\n" : "") +
      (writeSlopes ? "#define SVO_WRITE_SLOPES\n" : "") +
      (writeLight ? "#define SVO_WRITE_LIGHT\n" : ""));
  vtkShaderProgram* program =
    window->GetShaderCache()->ReadyShaderProgram(svoPresentVS, shader.c_str(), "");
  if (!program)
  {
    return false;
  }

  const float size[2] = { static_cast<float>(frame.width), static_cast<float>(frame.height) };
  program->SetUniform2f("frameSize", size);
  this->Array->ShaderProgramChanged(); // it keeps to one program, and there are several
  this->Array->Bind();
  this->Array->AddAttributeArray(
    program, this->Corners, "corner", 0, sizeof(glm::vec2), VTK_FLOAT, 2, false);
  this->Textures.activate(program);
  if (writeNormals)
  {
    vtkMatrix4x4 *worldToView, *viewToClip, *worldToClip;
    vtkMatrix3x3* normalMatrix;
    vtkOpenGLCamera::SafeDownCast(renderer->GetActiveCamera())
      ->GetKeyMatrices(renderer, worldToView, normalMatrix, viewToClip, worldToClip);
    vtkNew<vtkMatrix4x4> clipToView; // transposed, as the key matrices are
    vtkMatrix4x4::Invert(viewToClip, clipToView);
    program->SetUniformMatrix("clipToView", clipToView);
  }
  this->SelectDrawBuffers(program);

  bool drawn = false;
  vtkOpenGLState* state = window->GetState();
  {
    vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
    vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
    vtkOpenGLState::ScopedglEnableDisable cull(state, GL_CULL_FACE);
    vtkOpenGLState::ScopedglDepthMask depthMask(state);
    vtkOpenGLState::ScopedglDepthFunc depthFunction(state);
    state->vtkglEnable(GL_DEPTH_TEST);
    state->vtkglDepthFunc(GL_LEQUAL);
    state->vtkglDepthMask(GL_TRUE);
    if (!writeNormals) // else VTK's blending is part of the picture: see the shader
    {
      state->vtkglDisable(GL_BLEND);
    }
    state->vtkglDisable(GL_CULL_FACE);
    glDrawArrays(GL_TRIANGLES, 0, this->Drawn);
    this->Array->Release();
    drawn = this->Textures.drawParts(window, size);
  }
  this->Textures.deactivate();
  return drawn;
}

int vtkSVOPresenter::RenderOpaqueGeometry(vtkViewport* viewport)
{
  auto* renderer = vtkRenderer::SafeDownCast(viewport);
  auto* window =
    renderer ? vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow()) : nullptr;
  if (!window || renderer->GetSelector())
  {
    return 0;
  }
  if (this->PrepareFrame)
  {
    int rectangle[4];
    window->GetState()->vtkglGetIntegerv(GL_VIEWPORT, rectangle);
    this->PrepareFrame(rectangle[2], rectangle[3]);
  }
  const double start = vtkTimerLog::GetUniversalTime();
  if (this->DrawSurfaces)
  {
    this->DrawSurfaces(viewport);
    this->PresentTime += vtkTimerLog::GetUniversalTime() - start;
    return 1;
  }
  if (!this->Frame || this->Frame->covered.empty())
  {
    return 0;
  }
  vtkOpenGLClearErrorMacro();
  this->Enter(window);
  // What the window, the renderer or a layer below has kept is before what is shown now.
  const bool first = this->First && window->GetErase() && renderer->GetErase() &&
    !renderer->GetPreserveDepthBuffer();
  if (this->Textures.show(*this->Frame, this->FindSilhouettes, first, window) || !this->Corners)
  {
    this->UploadRectangles(this->Textures.rectangles());
  }
  const bool drawn = this->Drawn == 0 || this->DrawFrame(renderer, window);
  vtkOpenGLCheckErrorMacro("failed in vtkSVOPresenter");
  this->PresentTime += vtkTimerLog::GetUniversalTime() - start;
  return drawn ? 1 : 0;
}
