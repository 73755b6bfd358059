// A sphere above a plane, with its shadow: the smallest complete program with vtkSVO.
// Usage: ShadowedSphere [picture.png]; without a file name a window opens.
#include "vtkSVORenderPass.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkWindowToImageFilter.h>

#include <iostream>

namespace
{
void addShape(vtkRenderer* renderer, vtkAlgorithm* source, double red, double green, double blue)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(red, green, blue);
  actor->GetProperty()->SetAmbient(0.15);
  actor->GetProperty()->SetDiffuse(0.85);
  renderer->AddActor(actor);
}

bool writePicture(vtkRenderWindow* window, const char* path)
{
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(path);
  writer->Write();
  return writer->GetErrorCode() == 0;
}
}

int main(int argc, char* argv[])
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetCenter(0, 0, 0.7);
  sphere->SetThetaResolution(64);
  sphere->SetPhiResolution(64);
  vtkNew<vtkPlaneSource> ground;
  ground->SetOrigin(-2, -2, 0);
  ground->SetPoint1(2, -2, 0);
  ground->SetPoint2(-2, 2, 0);

  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.16, 0.2, 0.28);
  addShape(renderer, sphere, 0.93, 0.42, 0.33);
  addShape(renderer, ground, 0.8, 0.76, 0.7);
  renderer->GetActiveCamera()->SetPosition(1.5, -4, 2.2);
  renderer->GetActiveCamera()->SetFocalPoint(0, 0, 0.4);
  renderer->GetActiveCamera()->SetViewUp(0, 0, 1);

  // A positional light shines into a cone of 30 degrees unless told otherwise.
  vtkNew<vtkLight> light;
  light->PositionalOn();
  light->SetConeAngle(180);
  light->SetPosition(-1.5, -1.5, 3);
  renderer->AddLight(light);

  // That is all. Octrees are built at the first frame and kept.
  vtkNew<vtkSVORenderPass> pass;
  renderer->SetPass(pass);

  vtkNew<vtkRenderWindow> window;
  window->SetSize(800, 600);
  window->SetMultiSamples(0);
  window->AddRenderer(renderer);
  if (argc > 1)
  {
    window->SetOffScreenRendering(true);
    window->Render();
    if (!writePicture(window, argv[1]))
    {
      std::cerr << "ShadowedSphere: cannot write \"" << argv[1] << "\".\n";
      return 1;
    }
    return 0;
  }
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  window->Render();
  interactor->Start();
  return 0;
}
