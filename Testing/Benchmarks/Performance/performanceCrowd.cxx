#include "performanceCrowd.h"

#include <vtkActorCollection.h>
#include <vtkCamera.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkLight.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkSphereSource.h>
#include <vtkSuperquadricSource.h>

#include <cmath>

namespace performance
{
namespace
{
/// Of about so many triangles and a radius of 1.
vtkSmartPointer<vtkPolyData> meshOf(int kind, int triangles)
{
  const int around = static_cast<int>(std::lround(std::sqrt(triangles)));
  const int along = around / 2 + 2;
  if (kind == 0)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetRadius(1.0);
    sphere->SetThetaResolution(around);
    sphere->SetPhiResolution(along);
    sphere->Update();
    return sphere->GetOutput();
  }
  vtkNew<vtkSuperquadricSource> shape;
  shape->SetToroidal(kind == 3);
  shape->SetThickness(0.5);
  shape->SetSize(1.0);
  shape->SetPhiRoundness(kind == 1 ? 0.4 : 1.5);
  shape->SetThetaRoundness(kind == 2 ? 0.4 : 1.0);
  shape->SetThetaResolution(around);
  shape->SetPhiResolution(along);
  shape->Update();
  return shape->GetOutput();
}
}

Crowd::Crowd(vtkRenderer* renderer, const CrowdOptions& options, int objects)
  : Renderer(renderer)
  , Asked(options)
{
  if (options.scene == "layers")
  {
    this->addLayers();
  }
  else
  {
    const int side = static_cast<int>(std::ceil(std::sqrt(objects)));
    this->Half = 1.5 * side;
    options.scene == "glyphs" ? this->addCopies(objects, side) : this->addObjects(objects, side);
    this->addGround();
  }
  vtkNew<vtkLight> sun;
  sun->SetPosition(-0.6 * this->Half, -0.9 * this->Half, 1.8 * this->Half);
  sun->SetFocalPoint(0.0, 0.0, 0.0);
  renderer->AddLight(sun);
  this->aim(0);
}

int Crowd::actors() const
{
  return this->Renderer->GetActors()->GetNumberOfItems();
}

vtkSmartPointer<vtkPolyDataMapper> Crowd::mapperOf(int kind, int triangles)
{
  auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
  mapper->SetInputData(meshOf(kind, triangles));
  mapper->ScalarVisibilityOff();
  return mapper;
}

vtkActor* Crowd::add(vtkPolyDataMapper* mapper, std::mt19937& random)
{
  std::uniform_real_distribution<double> share(0.3, 1.0);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(share(random), share(random), share(random));
  this->Renderer->AddActor(actor);
  this->Actors.push_back(actor);
  return actor;
}

void Crowd::addLayers()
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<vtkSmartPointer<vtkPolyDataMapper>> mappers;
  for (int kind = 0; kind < 4; ++kind)
  {
    mappers.push_back(this->mapperOf(kind, this->Asked.triangles));
  }
  for (int layer = 0; layer < this->Asked.complexity; ++layer)
  {
    for (int i = 0; i < 100; ++i)
    {
      vtkActor* actor = this->add(mappers[(i + layer) % mappers.size()], random);
      actor->SetScale(unit(random) < 0.1 ? 0.01 : 0.95);
      actor->SetPosition(2.0 * (i % 10) - 9.0, 3.0 * layer, 2.0 * (i / 10) - 9.0);
    }
  }
}

void Crowd::addObjects(int objects, int side)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const bool small = this->Asked.scene == "small" || this->Asked.scene == "inside";
  std::vector<vtkSmartPointer<vtkPolyDataMapper>> mappers;
  for (int kind = 0; kind < (small ? 1 : 4); ++kind)
  {
    mappers.push_back(this->mapperOf(kind, small ? 480 : this->Asked.triangles));
  }
  for (int i = 0; i < objects; ++i)
  {
    vtkActor* actor = this->add(mappers[i % mappers.size()], random);
    const double jitter = small ? 0.0 : 0.8;
    actor->SetPosition(3.0 * (i % side - 0.5 * (side - 1)) + jitter * (unit(random) - 0.5),
      3.0 * (i / side - 0.5 * (side - 1)) + jitter * (unit(random) - 0.5), 1.2);
    actor->RotateWXYZ(360.0 * unit(random), unit(random), unit(random), 1.0);
  }
}

void Crowd::addCopies(int objects, int side)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> values;
  for (int i = 0; i < objects; ++i)
  {
    points->InsertNextPoint(
      3.0 * (i % side - 0.5 * (side - 1)), 3.0 * (i / side - 0.5 * (side - 1)), 1.2);
    values->InsertNextValue(static_cast<float>(i % 97) / 96.0f);
  }
  this->Places->SetPoints(points);
  this->Places->GetPointData()->SetScalars(values);
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(this->Places);
  mapper->SetSourceData(meshOf(0, 1000));
  mapper->ScalingOff();
  mapper->OrientOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  this->Renderer->AddActor(actor);
}

void Crowd::addGround()
{
  const double half = this->Half;
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-half - 2.0, -half - 2.0, 0.0);
  plane->SetPoint1(half + 2.0, -half - 2.0, 0.0);
  plane->SetPoint2(-half - 2.0, half + 2.0, 0.0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(plane->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  this->Renderer->AddActor(actor);
}

void Crowd::aim(int k)
{
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  if (this->Asked.scene == "layers")
  {
    camera->SetPosition(0.3 * k, -30.0, 0.0);
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetViewUp(0.0, 0.0, 1.0);
    camera->SetViewAngle(30.0);
  }
  else if (this->Asked.scene == "inside")
  {
    const double turn = 0.02 * k + 0.3;
    camera->SetPosition(1.5, 1.5, 4.0);
    camera->SetFocalPoint(1.5 + 20.0 * std::sin(turn), 1.5 + 20.0 * std::cos(turn), 2.0);
    camera->SetViewUp(0.0, 0.0, 1.0);
    camera->SetViewAngle(40.0);
  }
  else if (this->Asked.scene == "field")
  {
    const double turn = 0.005 * k;
    camera->SetPosition(3.0 * std::sin(turn), -this->Half - 8.0, 4.0);
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetViewUp(0.0, 0.0, 1.0);
    camera->SetViewAngle(40.0);
  }
  else
  {
    const double turn = 0.02 * k - 0.3, far = 1.9 * this->Half;
    camera->SetPosition(far * std::sin(turn), -far * std::cos(turn), 0.75 * this->Half);
    camera->SetFocalPoint(0.0, -0.1 * this->Half, 0.0);
    camera->SetViewUp(0.0, 0.0, 1.0);
    camera->SetViewAngle(40.0);
  }
  this->Renderer->ResetCameraClippingRange();
}

void Crowd::move()
{
  for (std::size_t i = 0; i < this->Actors.size(); ++i)
  {
    this->Actors[i]->RotateZ(1.0);
    this->Actors[i]->AddPosition(0.0, 0.0, (this->Moves + i) % 8 < 4 ? 0.02 : -0.02);
  }
  if (vtkPoints* points = this->Places->GetPoints())
  {
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
    {
      double x[3];
      points->GetPoint(i, x);
      x[2] += (this->Moves + i) % 8 < 4 ? 0.02 : -0.02;
      points->SetPoint(i, x);
    }
    points->Modified();
    this->Places->Modified();
  }
  ++this->Moves;
}
}
