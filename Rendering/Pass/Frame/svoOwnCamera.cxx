#include "svoOwnCamera.h"

#include "svoCameraView.h"
#include "svoOpenGL.h"

#include "vtkCamera.h"
#include "vtkCameraPass.h"
#include "vtkImageProcessingPass.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderPassCollection.h"
#include "vtkRenderState.h"
#include "vtkRenderStepsPass.h"
#include "vtkRenderer.h"
#include "vtkSSAAPass.h"
#include "vtkSequencePass.h"

namespace svo
{
namespace
{
vtkOpenGLState* openGLOf(const vtkRenderState* state)
{
  auto* window = static_cast<vtkOpenGLRenderWindow*>(state->GetRenderer()->GetRenderWindow());
  return window->GetState();
}

/// Whether one of VTK's camera passes stands between the top of a chain and a pass. Chains of
/// others' classes cannot be looked into; what is inside is set up, as vtkRenderStepsPass does.
bool cameraAbove(vtkRenderPass* top, const vtkRenderPass* pass, bool camera = false)
{
  if (!top || top == pass)
  {
    return top && camera;
  }
  if (auto* own = vtkCameraPass::SafeDownCast(top))
  {
    return cameraAbove(own->GetDelegatePass(), pass, true);
  }
  if (auto* image = vtkImageProcessingPass::SafeDownCast(top))
  {
    return cameraAbove(image->GetDelegatePass(), pass, camera);
  }
  if (auto* smooth = vtkSSAAPass::SafeDownCast(top))
  {
    return cameraAbove(smooth->GetDelegatePass(), pass, camera);
  }
  if (auto* steps = vtkRenderStepsPass::SafeDownCast(top))
  {
    return cameraAbove(steps->GetCameraPass(), pass, camera) ||
      cameraAbove(steps->GetPostProcessPass(), pass, camera);
  }
  if (auto* sequence = vtkSequencePass::SafeDownCast(top))
  {
    vtkRenderPassCollection* passes = sequence->GetPasses();
    for (int i = 0; passes && i < passes->GetNumberOfItems(); ++i)
    {
      if (cameraAbove(vtkRenderPass::SafeDownCast(passes->GetItemAsObject(i)), pass, camera))
      {
        return true;
      }
    }
  }
  return false;
}
}

OwnCamera::Saved::Saved(vtkOpenGLState* state)
  : viewport(state)
  , scissor(state)
  , scissorTest(state, GL_SCISSOR_TEST)
{
}

OwnCamera::OwnCamera(const vtkRenderState* state, vtkRenderPass* pass)
  : State(state)
  , Needed(!cameraAbove(state->GetRenderer()->GetPass(), pass))
{
  if (this->Needed && state->GetRenderer()->GetPass() != pass)
  {
    this->Before.emplace(openGLOf(state));
  }
}

void OwnCamera::setUp() const
{
  if (!this->Needed)
  {
    return;
  }
  vtkRenderer* renderer = this->State->GetRenderer();
  if (!this->State->GetFrameBuffer())
  {
    renderer->GetActiveCamera()->Render(renderer);
    return;
  }
  int width, height;
  sizeOf(this->State, width, height);
  vtkOpenGLState* openGL = openGLOf(this->State);
  openGL->vtkglViewport(0, 0, width, height);
  openGL->vtkglEnable(GL_SCISSOR_TEST);
  openGL->vtkglScissor(0, 0, width, height);
  if (renderer->GetRenderWindow()->GetErase() && renderer->GetErase())
  {
    renderer->Clear();
  }
}
}
