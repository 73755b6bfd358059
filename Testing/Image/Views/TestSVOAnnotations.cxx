// Actors that draw in ways of their own (axes, cube axes, text that follows the camera, glyphs)
// show as they do without the pass.
#include "svoTestStage.h"

#include "vtkAxesActor.h"
#include "vtkCubeAxesActor.h"
#include "vtkFollower.h"
#include "vtkGlyph3DMapper.h"
#include "vtkPlaneSource.h"
#include "vtkProperty.h"
#include "vtkRegularPolygonSource.h"
#include "vtkTransform.h"

#include <cmath>
#include <iostream>

int TestSVOAnnotations(int, char*[])
{
  using namespace svotest;
  Checks checks;
  Stage stage;
  stage.addGround(2.0);
  stage.add(ball(0.6, -0.8, -0.5, 0.7), 0.9, 0.5, 0.3);
  stage.addSun(2.0, -1.5, 4.0);
  stage.usePass(false);
  const Picture bare = capture(stage.window);

  vtkNew<vtkCubeAxesActor> box;
  box->SetBounds(-2.2, 2.2, -2.2, 2.2, 0.1, 1.5); // nothing of it lies in the ground
  box->SetCamera(stage.renderer->GetActiveCamera());
  stage.renderer->AddActor(box);
  vtkNew<vtkAxesActor> axes;
  vtkNew<vtkTransform> above;
  above->Translate(0.0, 0.0, 0.2);
  axes->SetUserTransform(above);
  axes->AxisLabelsOff(); // their size settles over several renders
  stage.renderer->AddActor(axes);
  vtkNew<vtkRegularPolygonSource> disc;
  disc->SetNumberOfSides(12);
  disc->SetRadius(0.3);
  vtkNew<vtkPolyDataMapper> discMapper;
  discMapper->SetInputConnection(disc->GetOutputPort());
  vtkNew<vtkFollower> follower;
  follower->SetMapper(discMapper);
  follower->SetCamera(stage.renderer->GetActiveCamera());
  follower->SetPosition(1.2, 0.5, 1.2);
  follower->GetProperty()->SetColor(0.9, 0.9, 0.2);
  stage.renderer->AddActor(follower);
  vtkNew<vtkPlaneSource> points;
  points->SetOrigin(-1.5, 1.0, 0.2);
  points->SetPoint1(1.5, 1.0, 0.2);
  points->SetPoint2(-1.5, 1.5, 0.6);
  points->SetResolution(6, 1);
  vtkNew<vtkGlyph3DMapper> glyphs;
  glyphs->SetInputConnection(points->GetOutputPort());
  glyphs->SetSourceConnection(disc->GetOutputPort());
  glyphs->SetScaleFactor(0.4);
  vtkNew<vtkActor> glyphActor;
  glyphActor->SetMapper(glyphs);
  glyphActor->GetProperty()->SetColor(0.2, 0.7, 0.9);
  stage.renderer->AddActor(glyphActor);

  const Picture raster = capture(stage.window);
  stage.usePass(true);
  const Picture traced = stage.unshadowed();
  stage.expectTraced(checks, 2, "the ground and the ball are traced");

  std::size_t drawn = 0;
  std::size_t apart = 0;
  for (std::size_t i = 0; i < raster.size(); ++i)
  {
    if (std::abs(raster.grey(i) - bare.grey(i)) > 10.0)
    {
      ++drawn;
      apart += std::abs(raster.grey(i) - traced.grey(i)) > 10.0;
    }
  }
  std::cout << drawn << " pixels of annotations, " << apart << " differ\n";
  checks.expect(drawn > 2000, "there are annotations");
  checks.expect(apart < drawn / 100, "they are as without the pass");
  return checks.exitCode();
}
