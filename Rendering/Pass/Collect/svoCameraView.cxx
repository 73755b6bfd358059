#include "svoCameraView.h"

#include "vtkCamera.h"
#include "vtkFrameBufferObjectBase.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPerspectiveTransform.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace svo
{
glm::dmat4 toGlm(const vtkMatrix4x4* matrix)
{
  return glm::transpose(glm::make_mat4(matrix->GetData()));
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

namespace
{
bool isRigid(const glm::dmat4& m)
{
  constexpr double Rounding = 1e-9;
  const glm::dmat3 linear(m);
  const glm::dmat3 square = glm::transpose(linear) * linear;
  double most = std::abs(m[0][3]) + std::abs(m[1][3]) + std::abs(m[2][3]) + std::abs(m[3][3] - 1.0);
  for (int i = 0; i < 9; ++i)
  {
    most = std::max(most, std::abs(square[i / 3][i % 3] - (i % 4 == 0 ? 1.0 : 0.0)));
  }
  return most < Rounding && glm::determinant(linear) > 0.0;
}

/// The camera's matrix as two: what it makes of the world, and the rigid view of that.
struct CameraMatrices
{
  glm::dmat4 scene;
  glm::dmat4 view;
};

CameraMatrices matricesOf(vtkCamera* camera)
{
  const glm::dmat4 whole = toGlm(camera->GetModelViewTransformMatrix());
  const glm::dmat4 model = toGlm(camera->GetModelTransformMatrix());
  const CameraMatrices usual = { model,
    model != glm::dmat4(1.0) ? whole * glm::inverse(model) : whole };
  if (!camera->GetUserViewTransform() || isRigid(usual.view))
  {
    return usual;
  }
  vtkNew<vtkPerspectiveTransform> own;
  own->SetupCamera(camera->GetPosition(), camera->GetFocalPoint(), camera->GetViewUp());
  const glm::dmat4 view = toGlm(own->GetMatrix());
  return { glm::affineInverse(view) * whole, view };
}
}

glm::dmat4 sceneTransform(vtkRenderer* renderer)
{
  return matricesOf(renderer->GetActiveCamera()).scene;
}

bool viewOfCamera(vtkRenderer* renderer, int width, int height, View& view)
{
  if (width <= 0 || height <= 0)
  {
    return false;
  }
  vtkCamera* camera = renderer->GetActiveCamera();
  // Where an edge runs exactly through pixels' centres, OpenGL gives the pixels to what lies to the
  // right or above; so rays go that much beside the centres.
  constexpr double Beside = 1.0 / (1 << 15); // pixels
  const glm::dmat4 beside =
    glm::translate(glm::dmat4(1.0), glm::dvec3(-2.0 * Beside / width, -2.0 * Beside / height, 0.0));
  const glm::dmat4 viewToClip = beside *
    toGlm(camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0));
  if (!makeView(matricesOf(camera).view, viewToClip, width, height, view))
  {
    return false;
  }
  // VTK's shaders go by what the camera says, not by its matrix.
  view.facetsFaceAxis = camera->GetParallelProjection() != 0;
  view.plain = view.plain && view.facetsFaceAxis == view.parallel;
  return true;
}
}
