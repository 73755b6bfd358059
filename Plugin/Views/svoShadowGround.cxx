#include "svoShadowGround.h"

#include "vtkActor.h"
#include "vtkBoundingBox.h"
#include "vtkCommunicator.h"
#include "vtkMath.h"
#include "vtkMultiProcessController.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkSVORenderPass.h"

#include <string>

namespace svo
{
namespace
{
constexpr double Reach = 2.0;  // beyond the data, diagonals
constexpr double Below = 1e-3; // the same; a face of the data that lies on a ground hides nothing
}

namespace
{
/// World coordinates. What ParaView knows of them is a frame late.
vtkBoundingBox boundsOfData(vtkRenderer* renderer, vtkMultiProcessController* processes)
{
  vtkBoundingBox box;
  vtkCollectionSimpleIterator iterator;
  vtkPropCollection* props = renderer->GetViewProps();
  props->InitTraversal(iterator);
  while (vtkProp* prop = props->GetNextProp(iterator))
  {
    // What representations show; axes, annotations and widgets are other classes.
    const bool data = prop->IsA("vtkPVLODActor") || prop->IsA("vtkVolume") ||
      std::string(prop->GetClassName()) == "vtkOpenGLActor";
    const double* bounds =
      data && prop->GetVisibility() && prop->GetUseBounds() ? prop->GetBounds() : nullptr;
    if (bounds && vtkMath::AreBoundsInitialized(bounds))
    {
      box.AddBounds(bounds);
    }
  }
  if (processes && processes->GetNumberOfProcesses() > 1)
  {
    double local[6], all[6]; // the largest of all, with the lower bounds turned round
    for (int i = 0; i < 3; ++i)
    {
      local[i] = box.IsValid() ? -box.GetMinPoint()[i] : VTK_DOUBLE_MIN;
      local[3 + i] = box.IsValid() ? box.GetMaxPoint()[i] : VTK_DOUBLE_MIN;
    }
    processes->AllReduce(local, all, 6, vtkCommunicator::MAX_OP);
    box = vtkBoundingBox(-all[0], all[3], -all[1], all[4], -all[2], all[5]);
  }
  return box;
}
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
  this->Actor->ForceTranslucentOff();
  this->Actor->ForceOpaqueOn();
}

ShadowGround::~ShadowGround() = default;

void ShadowGround::place(vtkRenderer* renderer, int axis, vtkMultiProcessController* processes)
{
  vtkBoundingBox data;
  if (axis >= 0 && axis < 3)
  {
    data = boundsOfData(renderer, processes);
  }
  if (!data.IsValid())
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
  // The last of the opaque props: what is behind it has been drawn by then, and translucent ones,
  // of whose number the cost of each depends, are drawn over it. It hides none of them, since it
  // writes depth only where pictures of several processes are composed by it, which are also cut
  // off at the bounds of what is drawn.
  const bool together = processes && processes->GetNumberOfProcesses() > 1;
  this->Actor->SetIsRenderingTranslucentPolygonalGeometry(!together); // VTK clears it
  this->Actor->SetUseBounds(together);
  if (renderer->GetViewProps()->GetLastProp() != this->Actor)
  {
    renderer->RemoveViewProp(this->Actor);
    renderer->AddViewProp(this->Actor);
  }
  vtkBoundingBox all(data);
  all.AddBounds(this->Actor->GetBounds());
  double bounds[6];
  all.GetBounds(bounds);
  renderer->ResetCameraClippingRange(bounds);
}

void ShadowGround::endFrame()
{
  this->Actor->SetUseBounds(false);
}

void ShadowGround::remove(vtkRenderer* renderer)
{
  renderer->RemoveViewProp(this->Actor);
}
}
