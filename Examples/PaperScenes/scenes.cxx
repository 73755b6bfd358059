// Builds and animates the scenes.
#include "scenes.h"

#include "vtkSVORenderPass.h"

#include <vtkCamera.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkTextProperty.h>
#include <vtkTransform.h>

#include <algorithm>
#include <cmath>

namespace paper
{
namespace
{
constexpr int framesPerPose = 2;
constexpr double degreesPerFrame = 360.0 / 184;
constexpr double spotMargin = 1.1;

struct Movement
{
  unsigned int firstPose;
  unsigned int poses;
  unsigned int repeats;
  double stride; ///< a pose, in heights of B
};
// The poses as meshes.cxx orders them: run, crouched walk, jump, salute, wave, stand.
constexpr Movement movements[] = { { 0, 6, 5, 0.2 }, { 18, 11, 1, 0 }, { 6, 6, 4, 0.07 },
  { 29, 11, 1, 0 }, { 12, 6, 1, 0.12 }, { 40, 10, 1, 0 } };

struct Step
{
  unsigned int pose;
  double distance; ///< walked before this pose, in heights of B
  double stride;
};

const std::vector<Step>& steps()
{
  static const std::vector<Step> all = []
  {
    std::vector<Step> result;
    double distance = 0;
    for (const Movement& movement : movements)
    {
      for (unsigned int i = 0; i < movement.repeats * movement.poses; ++i)
      {
        result.push_back({ movement.firstPose + i % movement.poses, distance, movement.stride });
        distance += movement.stride;
      }
    }
    return result;
  }();
  return all;
}

struct Colour
{
  double r, g, b;
};
constexpr Colour jade{ 0.36, 0.64, 0.56 };
constexpr Colour ivory{ 0.90, 0.82, 0.68 };
constexpr Colour slate{ 0.50, 0.58, 0.70 };
constexpr Colour coral{ 0.93, 0.42, 0.33 };
constexpr Colour sand{ 0.80, 0.76, 0.70 };

vtkSmartPointer<vtkActor> makeActor(vtkMapper* mapper, const Colour& colour, double specular)
{
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty* property = actor->GetProperty();
  property->SetInterpolationToPhong();
  property->SetDiffuseColor(colour.r, colour.g, colour.b);
  property->SetDiffuse(0.85);
  // The sky's share, cooler than the light.
  property->SetAmbientColor(0.75 * colour.r, 0.85 * colour.g, colour.b);
  property->SetAmbient(0.24);
  property->SetSpecularColor(1, 0.97, 0.9);
  property->SetSpecular(specular);
  property->SetSpecularPower(40);
  return actor;
}

void place(vtkActor* actor, double x, double y, double heading, double size)
{
  vtkNew<vtkTransform> transform;
  transform->Translate(x, y, 0);
  transform->RotateZ(heading);
  transform->Scale(size, size, size);
  actor->SetUserMatrix(transform->GetMatrix());
}
}

Scene::Scene(const Experiment& experiment, const Objects& objects)
  : Setup(&experiment)
  , Shapes(&objects)
{
  this->Renderer->SetBackground(0.42, 0.50, 0.60);
  this->Renderer->SetBackground2(0.16, 0.20, 0.28);
  this->Renderer->GradientBackgroundOn();
  this->Renderer->AutomaticLightCreationOff();
  this->Renderer->RemoveAllLights();
  this->Renderer->AddLight(this->Light);
  this->Light->SetLightTypeToSceneLight();
  this->Light->PositionalOn();
  this->Light->SetPosition(experiment.light);
  this->Light->SetColor(1, 0.96, 0.88);
  this->Light->SetExponent(0);

  this->Ground = makeActor(objects.ground.poses.front(), sand, 0);
  this->Renderer->AddActor(this->Ground);
  // Nothing lies below the ground. Without it the light's one map closes in on the objects.
  vtkSVORenderPass::SetCastShadow(false, this->Ground);

  for (const Placement& placement : experiment.a)
  {
    const std::size_t i = this->A.size();
    const Colour& colour = i == 0 ? jade : i % 2 == 0 ? slate : ivory;
    this->A.push_back(makeActor(objects.a.poses.front(), colour, 0.35));
    place(this->A.back(), placement.x, placement.y, placement.heading, placement.size);
    this->Renderer->AddActor(this->A.back());
  }
  if (experiment.b.size > 0)
  {
    this->B = makeActor(objects.b.poses.front(), coral, 0.15);
    this->Renderer->AddActor(this->B);
  }
  this->Caption->GetTextProperty()->SetColor(1, 1, 1);
  this->Caption->GetTextProperty()->ShadowOn();
  this->Caption->VisibilityOff();
  this->Renderer->AddViewProp(this->Caption);

  this->setLight(LightKind::Point);
  this->setFrame(0);
  this->setView(experiment.views.front());
}

int Scene::period()
{
  return framesPerPose * static_cast<int>(steps().size());
}

void Scene::setFrame(int frame)
{
  if (!this->A.empty())
  {
    this->turnA(0, degreesPerFrame * frame);
  }
  if (this->B)
  {
    const Walk& walk = this->Setup->b;
    const int position = frame % Scene::period();
    const Step& step = steps()[position / framesPerPose];
    const double within = static_cast<double>(position % framesPerPose) / framesPerPose;
    const double walked = walk.pace * walk.size * (step.distance + within * step.stride);
    const double angle = walk.start + vtkMath::DegreesFromRadians(walked / walk.radius);
    const double radians = vtkMath::RadiansFromDegrees(angle);
    this->setPose(step.pose);
    place(this->B, walk.center[0] + walk.radius * std::cos(radians),
      walk.center[1] + walk.radius * std::sin(radians), angle + 90, walk.size);
  }
}

void Scene::turnA(std::size_t i, double degrees)
{
  const Placement& placement = this->Setup->a[i];
  place(this->A[i], placement.x, placement.y, placement.heading + degrees, placement.size);
}

void Scene::setView(const Viewpoint& view, double orbit)
{
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(view.position);
  camera->SetFocalPoint(view.focalPoint);
  camera->SetViewUp(0, 0, 1);
  camera->SetViewAngle(view.viewAngle);
  camera->Azimuth(orbit);
  camera->SetClippingRange(0.1, 60);
}

void Scene::setLight(LightKind kind)
{
  // Around the objects, of which the bounds of the spinning one change: a generous sphere.
  double radius = 0.6;
  for (const Placement& a : this->Setup->a)
  {
    radius = std::max(radius, std::hypot(a.x, a.y) + 0.8 * a.size);
  }
  const double middle[3] = { 0, 0, 0.4 };
  const double distance = std::sqrt(vtkMath::Distance2BetweenPoints(this->Setup->light, middle));
  this->Light->SetFocalPoint(middle);
  this->Light->SetConeAngle(kind == LightKind::Point
      ? 180
      : std::min(80.0, spotMargin * vtkMath::DegreesFromRadians(std::atan2(radius, distance))));
}

void Scene::setGroundVisible(bool visible)
{
  this->Ground->SetVisibility(visible);
}

void Scene::setAVisible(bool visible)
{
  for (vtkActor* actor : this->A)
  {
    actor->SetVisibility(visible);
  }
}

void Scene::setPose(std::size_t pose)
{
  if (this->B)
  {
    this->B->SetMapper(this->Shapes->b.poses[pose % this->Shapes->b.poses.size()]);
  }
}

void Scene::setCaption(const std::string& text)
{
  const int height = this->Renderer->GetRenderWindow()->GetSize()[1];
  this->Caption->GetTextProperty()->SetFontSize(std::max(8, height / 42));
  this->Caption->SetPosition(height / 34, height / 45);
  this->Caption->SetInput(text.c_str());
  this->Caption->SetVisibility(!text.empty());
}

vtkIdType Scene::trianglesShown() const
{
  const auto copies = static_cast<vtkIdType>(this->A.size());
  return this->Shapes->ground.trianglesShown + copies * this->Shapes->a.trianglesShown +
    (this->B ? this->Shapes->b.trianglesShown : 0);
}

template <class Figure>
Figure Scene::total(Figure Object::*figure) const
{
  Figure sum = this->Shapes->ground.*figure;
  if (!this->A.empty())
  {
    sum += this->Shapes->a.*figure;
  }
  if (this->B)
  {
    sum += this->Shapes->b.*figure;
  }
  return sum;
}

vtkIdType Scene::trianglesInMemory() const
{
  return this->total(&Object::trianglesInMemory);
}

double Scene::buildSeconds() const
{
  return this->total(&Object::buildSeconds);
}

double Scene::octreeMebibytes() const
{
  return this->total(&Object::octreeMebibytes);
}

vtkIdType Scene::voxels() const
{
  return this->total(&Object::voxels);
}
}
