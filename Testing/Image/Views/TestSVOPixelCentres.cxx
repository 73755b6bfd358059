// Edges exactly through the centres of pixels, as parallel projections have them: the pixels belong
// to the side that OpenGL gives them to.
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkCubeSource.h"
#include "vtkPlaneSource.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkTrivialProducer.h"
#include "vtkUnsignedCharArray.h"

#include <iostream>
#include <string>

namespace
{
using namespace svotest;

/// 16 cells of two colours, 50 pixels wide each; half a pixel beside the middle of the picture.
vtkSmartPointer<vtkAlgorithm> chessboard()
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-1.005, -1.005, 0.0);
  plane->SetPoint1(0.995, -1.005, 0.0);
  plane->SetPoint2(-1.005, 0.995, 0.0);
  plane->SetResolution(4, 4);
  plane->Update();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  for (int i = 0; i < 16; ++i)
  {
    const bool odd = (i + i / 4) % 2 != 0;
    colors->InsertNextTuple3(odd ? 255 : 40, 40, odd ? 40 : 255);
  }
  plane->GetOutput()->GetCellData()->SetScalars(colors);
  auto producer = vtkSmartPointer<vtkTrivialProducer>::New();
  producer->SetOutput(plane->GetOutput());
  return producer;
}

void check(const std::string& name, vtkAlgorithm* source, bool scalars, Checks& checks)
{
  Stage stage(300, 300);
  vtkActor* actor = stage.add(source, 0.9, 0.8, 0.2);
  actor->GetProperty()->LightingOff();
  actor->GetMapper()->SetScalarVisibility(scalars);
  stage.addSun(3.0, -4.0, 5.0);
  vtkCamera* camera = stage.renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(1.5); // 100 pixels a unit
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetPosition(0.0, 0.0, 5.0);
  camera->SetViewUp(0.0, 1.0, 0.0);
  stage.renderer->ResetCameraClippingRange();
  stage.usePass(false);
  const Picture raster = capture(stage.window);
  stage.usePass(true);
  const Picture traced = stage.unshadowed();
  stage.expectTraced(checks, 1, name + ": is traced");
  std::size_t wrong = 0, seen = 0;
  for (std::size_t i = 0; i < raster.size(); ++i)
  {
    seen += raster.depth[i] < 1.0f;
    wrong += raster.grey(i) != traced.grey(i);
  }
  std::cout << name << ": " << wrong << " of " << seen << " pixels differ from VTK's\n";
  checks.expect(seen > 5000, name + ": is seen");
  checks.expect(wrong == 0, name + ": VTK's own picture");
}
}

int TestSVOPixelCentres(int, char*[])
{
  using svotest::Checks;
  Checks checks;
  check("a chessboard", chessboard(), true, checks);
  auto cube = vtkSmartPointer<vtkCubeSource>::New();
  cube->SetCenter(-0.005, -0.005, 0.0);
  check("a cube", cube, false, checks);
  return checks.exitCode();
}
