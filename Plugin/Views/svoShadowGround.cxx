#include "svoShadowGround.h"

#include "vtkActor.h"
#include "vtkBoundingBox.h"
#include "vtkCollectionRange.h"
#include "vtkCommunicator.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkMultiProcessController.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSVORenderPass.h"

#include <string>

namespace svo
{
namespace
{
constexpr double Reach = 2.0;  // beyond the data, diagonals
constexpr double Below = 1e-3; // the same; a face of the data that lies on a ground hides nothing
constexpr double Around = 0.1; // the same, where bounds leave out how wide points and lines are

/// True if points or lines of a prop are drawn wider than its bounds tell.
bool drawsWider(vtkProp* prop)
{
  auto* actor = vtkActor::SafeDownCast(prop);
  vtkMapper* mapper = actor ? actor->GetMapper() : nullptr;
  return mapper &&
    (mapper->IsA("vtkPointGaussianMapper") || mapper->IsA("vtkMoleculeMapper") ||
      actor->GetProperty()->GetRenderLinesAsTubes() ||
      actor->GetProperty()->GetRenderPointsAsSpheres());
}

/// World coordinates. What ParaView knows of them is a frame late. `wider`: something drawsWider().
vtkBoundingBox boundsOfData(
  vtkRenderer* renderer, vtkMultiProcessController* processes, bool& wider)
{
  wider = false;
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
      wider = wider || drawsWider(prop);
    }
  }
  if (processes && processes->GetNumberOfProcesses() > 1)
  {
    double local[7], all[7]; // the largest of all, with the lower bounds turned round
    local[6] = wider;
    for (int i = 0; i < 3; ++i)
    {
      local[i] = box.IsValid() ? -box.GetMinPoint()[i] : VTK_DOUBLE_MIN;
      local[3 + i] = box.IsValid() ? box.GetMaxPoint()[i] : VTK_DOUBLE_MIN;
    }
    processes->AllReduce(local, all, 7, vtkCommunicator::MAX_OP);
    wider = all[6] > 0.0;
    box = vtkBoundingBox(-all[0], all[3], -all[1], all[4], -all[2], all[5]);
  }
  return box;
}

/// Adds where a light casts the shadow of a point on the plane that lies across an axis at a height
/// below it. False if there is no such place.
bool addShadow(vtkLight* light, const double point[3], int axis, double height, vtkBoundingBox& all)
{
  const double* from = light->GetTransformedPosition();
  const double* to = light->GetPositional() ? point : light->GetTransformedFocalPoint();
  const double falls = from[axis] - to[axis];
  if (!(falls > 0.0))
  {
    return false;
  }
  const double share = (point[axis] - height) / falls;
  double place[3];
  for (int i = 0; i < 3; ++i)
  {
    place[i] = point[i] + share * (to[i] - from[i]);
  }
  place[axis] = height;
  all.AddPoint(place);
  return true;
}

/// Where shadows of what is in a box may lie within `ground`, which is flat, across an axis. Not
/// valid if there is no such place.
vtkBoundingBox shadowsOf(
  const vtkBoundingBox& box, vtkRenderer* renderer, int axis, const vtkBoundingBox& ground)
{
  const double height = ground.GetMinPoint()[axis];
  vtkBoundingBox all;
  for (vtkLight* light : vtk::Range(renderer->GetLights()))
  {
    if (!light->GetSwitch() || !vtkSVORenderPass::GetCastShadow(light))
    {
      continue;
    }
    bool everywhere = false; // so far do shadows of what is no lower than a lamp reach
    for (int i = 0; i < 8; ++i)
    {
      double corner[3];
      box.GetCorner(i, corner);
      const bool falls = addShadow(light, corner, axis, height, all);
      everywhere = everywhere ||
        (!falls && light->GetPositional() && light->GetTransformedPosition()[axis] > height);
    }
    if (everywhere)
    {
      return ground;
    }
  }
  return all.IntersectBox(ground) ? all : vtkBoundingBox();
}

/// A box with other ends along an axis.
vtkBoundingBox withEnds(const vtkBoundingBox& box, int axis, double low, double high)
{
  double bounds[6];
  box.GetBounds(bounds);
  bounds[2 * axis] = low;
  bounds[2 * axis + 1] = high;
  return vtkBoundingBox(bounds);
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
  bool wider = false;
  if (axis >= 0 && axis < 3)
  {
    data = boundsOfData(renderer, processes, wider);
  }
  if (!data.IsValid())
  {
    this->remove(renderer);
    return;
  }
  const double diagonal = data.GetDiagonalLength();
  const double height = data.GetMinPoint()[axis] - Below * diagonal;
  const double width = (wider ? Around : Below) * diagonal;
  const double top = data.GetMaxPoint()[axis] + width;
  vtkBoundingBox around(data), ground(data);
  around.Inflate(width);
  ground.Inflate(Reach * diagonal);
  renderer->UpdateLightsGeometryToFollowCamera();
  ground = shadowsOf(
    withEnds(around, axis, height, top), renderer, axis, withEnds(ground, axis, height, height));
  if (!ground.IsValid())
  {
    this->remove(renderer);
    return;
  }
  double center[3], size[3];
  ground.GetCenter(center);
  ground.GetLengths(size);
  // Turned so that its normal is the axis, its x and y are the next two.
  constexpr double Turns[3][3] = { { 90.0, 0.0, 90.0 }, { 0.0, -90.0, -90.0 }, { 0.0, 0.0, 0.0 } };
  this->Actor->SetOrientation(const_cast<double*>(Turns[axis]));
  this->Actor->SetPosition(center);
  this->Actor->SetScale(size[(axis + 1) % 3], size[(axis + 2) % 3], 1.0);
  // The last of the opaque props: what is behind it has been drawn by then, and translucent ones
  // are drawn over it. It hides none of them, since it writes depth only where pictures of several
  // processes are composed by it, which are also cut off at the bounds of what is drawn.
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
