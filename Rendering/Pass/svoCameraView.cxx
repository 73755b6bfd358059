#include "svoCameraView.h"

#include "vtkCamera.h"
#include "vtkFrameBufferObjectBase.h"
#include "vtkMatrix4x4.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"

#include <glm/matrix.hpp>

namespace svo
{
glm::dmat4 toGlm(const vtkMatrix4x4* matrix)
{
  glm::dmat4 result;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      result[column][row] = matrix->GetElement(row, column);
    }
  }
  return result;
}

void sizeOf(const vtkRenderState* state, int& width, int& height)
{
  if (vtkFrameBufferObjectBase* framebuffer = state->GetFrameBuffer())
  {
    int size[2];
    framebuffer->GetLastSize(size);
    width = size[0];
    height = size[1];
    return;
  }
  int left, bottom;
  state->GetRenderer()->GetTiledSizeAndOrigin(&width, &height, &left, &bottom);
}

glm::dmat4 modelTransform(vtkRenderer* renderer)
{
  return toGlm(renderer->GetActiveCamera()->GetModelTransformMatrix());
}

bool viewOfCamera(vtkRenderer* renderer, int width, int height, View& view)
{
  if (width <= 0 || height <= 0)
  {
    return false;
  }
  vtkCamera* camera = renderer->GetActiveCamera();
  glm::dmat4 worldToView = toGlm(camera->GetModelViewTransformMatrix());
  const glm::dmat4 model = modelTransform(renderer);
  if (model != glm::dmat4(1.0))
  {
    worldToView = worldToView * glm::inverse(model);
  }
  const glm::dmat4 viewToClip =
    toGlm(camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0));
  return makeView(worldToView, viewToClip, width, height, view);
}
}
