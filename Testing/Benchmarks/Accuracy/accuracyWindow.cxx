#include "accuracyWindow.h"

#include "vtkSVORenderPass.h"

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCamera.h>
#include <vtkCameraPass.h>
#include <vtkFloatArray.h>
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderPassCollection.h>
#include <vtkSequencePass.h>
#include <vtkShadowMapBakerPass.h>
#include <vtkShadowMapPass.h>
#include <vtkUnsignedCharArray.h>

#include <chrono>

namespace accuracy
{
namespace
{
vtkSmartPointer<vtkLight> lightFor(const svo::Light& light)
{
  auto result = vtkSmartPointer<vtkLight>::New();
  result->SetLightTypeToSceneLight();
  const bool far = light.kind == svo::Light::Kind::Directional;
  const glm::dvec3 position = far ? -10.0 * light.direction : light.position;
  const glm::dvec3 focus = position + light.direction;
  result->SetPosition(position.x, position.y, position.z);
  result->SetFocalPoint(focus.x, focus.y, focus.z);
  result->SetPositional(!far);
  result->SetConeAngle(light.kind == svo::Light::Kind::Spot ? light.coneAngle : 180.0);
  result->SetExponent(light.exponent);
  return result;
}
}

Window::Window(const Stage& stage)
{
  this->Target->SetOffScreenRendering(true);
  this->Target->SetMultiSamples(0);
  this->Target->SetSize(stage.camera.width, stage.camera.height);
  this->Target->AddRenderer(this->Renderer);
  this->Renderer->AutomaticLightCreationOff();
  for (const Object& object : stage.objects)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(object.shape->data);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(1.0, 1.0, 1.0);
    actor->GetProperty()->SetInterpolationToFlat();
    vtkNew<vtkMatrix4x4> matrix;
    for (int row = 0; row < 4; ++row)
    {
      for (int column = 0; column < 4; ++column)
      {
        matrix->SetElement(row, column, object.toWorld[column][row]);
      }
    }
    actor->SetUserMatrix(matrix);
    this->Renderer->AddActor(actor);
  }
  for (const svo::Light& light : stage.lights)
  {
    this->Renderer->AddLight(lightFor(light));
  }
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(stage.camera.eye.x, stage.camera.eye.y, stage.camera.eye.z);
  camera->SetFocalPoint(stage.camera.focus.x, stage.camera.focus.y, stage.camera.focus.z);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(stage.camera.angle);
  camera->SetClippingRange(stage.camera.near, stage.camera.far);
}

Window::~Window()
{
  this->removePass();
  this->Target->Finalize();
}

void Window::removePass()
{
  if (vtkRenderPass* pass = this->Renderer->GetPass())
  {
    pass->ReleaseGraphicsResources(this->Target);
    this->Renderer->SetPass(nullptr);
  }
}

void Window::useRasterizer()
{
  this->removePass();
}

void Window::useShadowMapPass(int resolution)
{
  this->removePass();
  vtkNew<vtkShadowMapPass> shadows;
  shadows->GetShadowMapBakerPass()->SetResolution(resolution);
  vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(shadows->GetShadowMapBakerPass());
  passes->AddItem(shadows);
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(passes);
  vtkNew<vtkCameraPass> camera;
  camera->SetDelegatePass(sequence);
  this->Renderer->SetPass(camera);
}

void Window::useOctrees(int level)
{
  this->removePass();
  vtkNew<vtkSVORenderPass> pass;
  pass->SetMaximumLevel(level);
  pass->SetFrameCoherence(false);
  this->Renderer->SetPass(pass);
}

Picture Window::draw(int repeat, Row& row)
{
  for (int i = 0; i <= repeat; ++i)
  {
    // vtkShadowMapPass bakes only what changed.
    this->Renderer->GetActors()->GetLastActor()->Modified();
    const double begin = processorSeconds();
    const auto start = std::chrono::steady_clock::now();
    this->Target->Render();
    this->Target->WaitForCompletion();
    const std::chrono::duration<double, std::milli> elapsed =
      std::chrono::steady_clock::now() - start;
    const double processor = 1e3 * (processorSeconds() - begin);
    if (i == 0 || (i > 1 && elapsed.count() >= row["frameMs"].asDouble()))
    {
      continue;
    }
    row["frameMs"] = elapsed.count();
    row["processorMs"] = processor;
    if (auto* pass = vtkSVORenderPass::SafeDownCast(this->Renderer->GetPass()))
    {
      row["collectMs"] = 1e3 * pass->GetCollectTime();
      row["traceMs"] = 1e3 * pass->GetTraceTime();
      row["shadowMs"] = 1e3 * pass->GetShadowTime();
      row["presentMs"] = 1e3 * pass->GetPresentTime();
      row["octreeKiB"] = static_cast<double>(pass->GetOctreeMemorySize());
      row["layerKiB"] = static_cast<double>(pass->GetLayerMemorySize());
    }
  }
  const int* size = this->Target->GetSize();
  vtkNew<vtkFloatArray> depth;
  this->Target->GetZbufferData(0, 0, size[0] - 1, size[1] - 1, depth);
  vtkNew<vtkUnsignedCharArray> colour;
  this->Target->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, colour);
  Picture picture;
  for (vtkIdType i = 0; i < depth->GetNumberOfTuples(); ++i)
  {
    picture.depth.push_back(depth->GetValue(i));
    picture.grey.push_back(colour->GetValue(3 * i));
  }
  return picture;
}
}
