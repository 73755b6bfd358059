#include "vtkSVOPresenter.h"

#include "svoOpenGL.h"
#include "svoPresentFS.h"
#include "svoPresentVS.h"

#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLCamera.h"
#include "vtkOpenGLError.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderPass.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
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

vtkSVOPresenter::vtkSVOPresenter() = default;
vtkSVOPresenter::~vtkSVOPresenter() = default;

void vtkSVOPresenter::SetFrame(
  svo::Frame* frame, const SilhouetteFinder& silhouettes, vtkOpenGLRenderPass* pass)
{
  this->Frame = frame;
  this->FindSilhouettes = silhouettes;
  this->Pass = pass;
  this->PresentTime = 0.0;
}

void vtkSVOPresenter::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Quad.reset();
  this->Colors = nullptr;
  this->Depths = nullptr;
  this->Normals = nullptr;
  this->Light = nullptr;
  this->Parts.release();
  this->Uploaded = 0;
  if (window)
  {
    this->QuadMapper->ReleaseGraphicsResources(window);
    this->Superclass::ReleaseGraphicsResources(window);
  }
}

namespace
{
/// A texture of the frame's size, made anew only when that changes.
void prepare(vtkSmartPointer<vtkTextureObject>& texture, vtkOpenGLRenderWindow* window,
  const svo::Frame& frame, int components, int type)
{
  const auto width = static_cast<unsigned int>(frame.width);
  const auto height = static_cast<unsigned int>(frame.height);
  if (!texture || texture->GetContext() != window || texture->GetWidth() != width ||
    texture->GetHeight() != height)
  {
    texture = vtkSmartPointer<vtkTextureObject>::New();
    texture->SetContext(window);
    texture->SetMinificationFilter(vtkTextureObject::Nearest);
    texture->SetMagnificationFilter(vtkTextureObject::Nearest);
    texture->SetWrapS(vtkTextureObject::ClampToEdge);
    texture->SetWrapT(vtkTextureObject::ClampToEdge);
    texture->Allocate2D(width, height, components, type);
  }
}

/// Sends the covered rectangle of an image with rows of the frame's width. VTK knows the alignment
/// that it has set, and relies on the other three being 0.
void send(vtkTextureObject* texture, const svo::Frame& frame, GLenum format, GLenum type,
  const void* pixels)
{
  const svo::PixelRect& rect = frame.covered;
  texture->Bind();
  texture->GetContext()->GetState()->vtkglPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, frame.width);
  glPixelStorei(GL_UNPACK_SKIP_PIXELS, rect.x0);
  glPixelStorei(GL_UNPACK_SKIP_ROWS, rect.y0);
  glTexSubImage2D(
    GL_TEXTURE_2D, 0, rect.x0, rect.y0, rect.x1 - rect.x0, rect.y1 - rect.y0, format, type, pixels);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glPixelStorei(GL_UNPACK_SKIP_PIXELS, 0);
  glPixelStorei(GL_UNPACK_SKIP_ROWS, 0);
}
}

void vtkSVOPresenter::Upload(vtkOpenGLRenderWindow* window)
{
  svo::Frame& frame = *this->Frame;
  svo::Silhouettes silhouettes;
  if (!this->SamplePositions.empty() && this->FindSilhouettes)
  {
    this->FindSilhouettes(this->SamplePositions, silhouettes);
  }
  this->Parts.upload(silhouettes.parts);
  silhouettes.exchange(frame);
  prepare(this->Colors, window, frame, 4, VTK_UNSIGNED_CHAR);
  prepare(this->Depths, window, frame, 1, VTK_FLOAT);
  send(this->Colors, frame, GL_RGBA, GL_UNSIGNED_BYTE, frame.color.data());
  send(this->Depths, frame, GL_RED, GL_FLOAT, frame.depth.data());
  if (!frame.normals.empty())
  {
    prepare(this->Normals, window, frame, 3, VTK_FLOAT);
    send(this->Normals, frame, GL_RGB, GL_FLOAT, frame.normals.data());
  }
  if (!frame.light.empty())
  {
    prepare(this->Light, window, frame, 3, VTK_FLOAT);
    send(this->Light, frame, GL_RGB, GL_FLOAT, frame.light.data());
  }
  silhouettes.exchange(frame); // back
}

namespace
{
/// Calls visit(pass) for the passes that a prop carries in this frame.
template <class Visit>
void eachPass(vtkProp* prop, const Visit& visit)
{
  vtkInformation* keys = prop->GetPropertyKeys();
  vtkInformationObjectBaseVectorKey* passes = vtkOpenGLRenderPass::RenderPasses();
  const int count = keys && keys->Has(passes) ? keys->Length(passes) : 0;
  for (int i = 0; i < count; ++i)
  {
    if (auto* pass = vtkOpenGLRenderPass::SafeDownCast(keys->Get(passes, i)))
    {
      visit(pass);
    }
  }
}
}

void vtkSVOPresenter::StandFor(vtkProp* prop)
{
  this->SetPropertyKeys(nullptr);
  if (prop)
  {
    vtkNew<vtkInformation> keys;
    int count = 0;
    // Not Append(): what it adds has to be removed one by one, or is never freed.
    eachPass(prop,
      [&](vtkOpenGLRenderPass* pass)
      { keys->Set(vtkOpenGLRenderPass::RenderPasses(), pass, count++); });
    this->SetPropertyKeys(keys);
  }
}

bool vtkSVOPresenter::WantsNormals()
{
  bool wants = false;
  eachPass(
    this, [&](vtkOpenGLRenderPass* pass) { wants = wants || vtkSSAOPass::SafeDownCast(pass); });
  return wants;
}

bool vtkSVOPresenter::KeepsLight()
{
  GLint buffer = GL_NONE;
  glGetIntegerv(GL_DRAW_BUFFER, &buffer);
  if (buffer < GL_COLOR_ATTACHMENT0 || buffer > GL_COLOR_ATTACHMENT15)
  {
    return false; // of the window itself, or none
  }
  const auto ask = [buffer](GLenum what)
  {
    GLint answer = GL_NONE;
    glGetFramebufferAttachmentParameteriv(
      GL_DRAW_FRAMEBUFFER, static_cast<GLenum>(buffer), what, &answer);
    return answer;
  };
  return ask(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) != GL_NONE &&
    ask(GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) == GL_FLOAT;
}

void vtkSVOPresenter::SelectDrawBuffers()
{
  eachPass(this,
    [&](vtkOpenGLRenderPass* pass)
    {
      if (pass != this->Pass)
      {
        pass->SetShaderParameters(this->Quad->Program, this->QuadMapper, this, nullptr);
      }
    });
}

bool vtkSVOPresenter::Draw(vtkRenderer* renderer, vtkOpenGLRenderWindow* window)
{
  const svo::Frame& frame = *this->Frame;
  const bool writeNormals = !frame.normals.empty();
  const bool writeLight = !frame.light.empty();
  const std::string mark = "//VTK::System::Dec\n";
  std::string shader = svoPresentFS;
  shader.replace(shader.find(mark), mark.size(),
    mark + (writeNormals ? "#define SVO_WRITE_NORMALS\n" : "") +
      (writeLight ? "#define SVO_WRITE_LIGHT\n" : ""));
  if (!this->Quad || this->QuadShader != shader)
  {
    this->Quad =
      std::make_unique<vtkOpenGLQuadHelper>(window, svoPresentVS, shader.c_str(), nullptr);
    this->QuadShader = shader;
  }
  else
  {
    window->GetShaderCache()->ReadyShaderProgram(this->Quad->Program);
  }
  vtkShaderProgram* program = this->Quad->Program;
  if (!program)
  {
    return false;
  }

  const glm::vec2 size(frame.width, frame.height);
  const svo::PixelRect& rect = frame.covered;
  const glm::vec2 low = glm::vec2(rect.x0, rect.y0) / size;
  const glm::vec2 high = glm::vec2(rect.x1, rect.y1) / size;
  const float rectangle[4] = { low.x, low.y, high.x, high.y };
  program->SetUniform4f("rectangle", rectangle);
  this->Colors->Activate();
  this->Depths->Activate();
  program->SetUniformi("colors", this->Colors->GetTextureUnit());
  program->SetUniformi("depths", this->Depths->GetTextureUnit());
  if (writeNormals)
  {
    vtkMatrix4x4 *worldToView, *viewToClip, *worldToClip;
    vtkMatrix3x3* normalMatrix;
    vtkOpenGLCamera::SafeDownCast(renderer->GetActiveCamera())
      ->GetKeyMatrices(renderer, worldToView, normalMatrix, viewToClip, worldToClip);
    vtkNew<vtkMatrix4x4> clipToView; // transposed, as the key matrices are
    vtkMatrix4x4::Invert(viewToClip, clipToView);
    program->SetUniformMatrix("clipToView", clipToView);
    this->Normals->Activate();
    program->SetUniformi("normals", this->Normals->GetTextureUnit());
  }
  if (writeLight)
  {
    this->Light->Activate();
    program->SetUniformi("light", this->Light->GetTextureUnit());
  }
  this->SelectDrawBuffers();

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
    this->Quad->Render();
    drawn = this->Parts.draw(window, &size.x);
  }
  this->Colors->Deactivate();
  this->Depths->Deactivate();
  if (writeNormals)
  {
    this->Normals->Deactivate();
  }
  if (writeLight)
  {
    this->Light->Deactivate();
  }
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
  if (!this->Frame || this->Frame->covered.empty())
  {
    return 0;
  }
  const double start = vtkTimerLog::GetUniversalTime();
  vtkOpenGLClearErrorMacro();
  std::vector<glm::vec2> positions = svo::samplePositions();
  if (this->Frame->version == 0 || this->Uploaded != this->Frame->version ||
    positions != this->SamplePositions ||
    !this->Colors || this->Colors->GetContext() != window)
  {
    this->SamplePositions = std::move(positions);
    this->Upload(window);
    this->Uploaded = this->Frame->version;
  }
  const bool drawn = this->Draw(renderer, window);
  vtkOpenGLCheckErrorMacro("failed in vtkSVOPresenter");
  this->PresentTime += vtkTimerLog::GetUniversalTime() - start;
  return drawn ? 1 : 0;
}
