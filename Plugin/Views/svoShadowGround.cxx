#include "svoShadowGround.h"

#include "vtkActor.h"
#include "vtkBoundingBox.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderer.h"
#include "vtkSVORenderPass.h"

namespace svo
{
namespace
{
constexpr double Reach = 2.0;  // beyond the data, diagonals
constexpr double Below = 1e-3; // the same; a face of the data that lies on a ground hides nothing
}

ShadowGround::ShadowGround()
{
  vtkNew<vtkPlaneSource> unit; // -0.5..0.5 in x and y
  unit->Update();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(unit->GetOutput());
  mapper->SetStatic(true);
  this->Actor->SetMapper(mapper);
  this->Actor->SetPickable(false);
  this->Actor->SetUseBounds(false);
  vtkSVORenderPass::SetShadowCatcher(true, this->Actor);
}

ShadowGround::~ShadowGround() = default;

void ShadowGround::place(vtkRenderer* renderer, const vtkBoundingBox& data, int axis)
{
  if (axis < 0 || axis > 2 || !data.IsValid())
  {
    this->remove(renderer);
    return;
  }
  const double diagonal = data.GetDiagonalLength();
  double center[3], size[3];
  data.GetCenter(center);
  data.GetLengths(size);
  center[axis] = data.GetMinPoint()[axis] - Below * diagonal;
  // Turned so that its normal is the axis, its x and y are the next two.
  constexpr double Turns[3][3] = { { 90.0, 0.0, 90.0 }, { 0.0, -90.0, -90.0 }, { 0.0, 0.0, 0.0 } };
  this->Actor->SetOrientation(const_cast<double*>(Turns[axis]));
  this->Actor->SetPosition(center);
  this->Actor->SetScale(size[(axis + 1) % 3] + 2.0 * Reach * diagonal,
    size[(axis + 2) % 3] + 2.0 * Reach * diagonal, 1.0);
  if (!renderer->HasViewProp(this->Actor))
  {
    renderer->AddViewProp(this->Actor);
  }
  vtkBoundingBox all(data);
  all.AddBounds(this->Actor->GetBounds());
  double bounds[6];
  all.GetBounds(bounds);
  renderer->ResetCameraClippingRange(bounds);
}

void ShadowGround::remove(vtkRenderer* renderer)
{
  renderer->RemoveViewProp(this->Actor);
}
}
