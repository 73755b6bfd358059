// Shadow volumes find what rays to the lights find: of meshes that are closed and open, for all
// kinds of lights and views, wherever the eye is.
#include "../Unit/svoTestMessages.h"
#include "svoTestStage.h"

#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkCubeSource.h"
#include "vtkDiskSource.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkReverseSense.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

using namespace svotest;

namespace
{
/// Pixels that are lit in the one picture and dark in the other: by far, of 255.
std::size_t differing(const Picture& a, const Picture& b)
{
  constexpr int Lit = 24;
  std::size_t count = 0;
  for (std::size_t i = 0; i + 2 < a.rgb.size(); i += 3)
  {
    int most = 0;
    for (std::size_t k = i; k < i + 3; ++k)
    {
      most = std::max(most, std::abs(int(a.rgb[k]) - int(b.rgb[k])));
    }
    count += most > Lit;
  }
  return count;
}

/// How many pixels at edges of shadows may be either's: rays begin in floats, and volumes are drawn
/// in them.
void compare(const std::string& name, Stage& stage, std::size_t ties, Checks& checks)
{
  stage.pass->SetBackendToOpenGL();
  const Picture lit = stage.unshadowed();
  const Picture expected = stage.shadowedByRays();
  stage.pass->SetShadowTechniqueToShadowVolumes();
  const Picture found = capture(stage.window);
  const std::size_t dark = differing(lit, expected), others = differing(expected, found);
  std::cout << name << ": " << dark << " pixels in shadow, " << others << " others, "
            << stage.pass->GetNumberOfShadowVolumes() << " volumes, "
            << stage.pass->GetNumberOfContourEdges() << " edges\n";
  checks.expect(dark > 100, name + ": there are shadows");
  checks.expect(stage.pass->GetNumberOfShadowVolumes() > 0, name + ": there are volumes");
  checks.expect(others <= ties, name + ": lit and dark as rays say");
}

/// Solids on a ground, moved, stretched and mirrored.
void addSolids(Stage& stage)
{
  stage.addGround();
  stage.add(ball(0.5, 0.0, 0.0, 0.8), 0.9, 0.3, 0.2);
  vtkActor* boxActor = stage.add(box(0.6, 0.0, 0.0, 0.0), 0.2, 0.6, 0.3);
  boxActor->SetPosition(-1.1, 0.4, 0.5);
  boxActor->RotateWXYZ(33.0, 1.0, 2.0, 0.5);
  boxActor->SetScale(1.0, 0.5, -1.6);
  stage.add(ring(0.5, 1.0, -0.6, 0.6), 0.3, 0.4, 0.9);
  vtkActor* spikeActor = stage.add(spike(1.4, 0.0, 0.0, 0.7), 0.8, 0.8, 0.3);
  spikeActor->SetPosition(0.6, 1.2, 0.0);
}
}

int TestSVOShadowVolumes(int, char*[])
{
  Checks checks;
  {
    Stage stage;
    addSolids(stage);
    stage.addSun(3.0, -2.0, 4.0);
    compare("a sun", stage, 10, checks);
    stage.renderer->GetActiveCamera()->ParallelProjectionOn();
    stage.renderer->GetActiveCamera()->SetParallelScale(2.5);
    compare("parallel", stage, 10, checks);
  }
  {
    Stage stage;
    addSolids(stage);
    vtkLight* bulb = stage.addBulb(-1.0, 0.6, 2.5);
    compare("a bulb", stage, 10, checks);
    bulb->SetConeAngle(40.0);
    compare("a spot", stage, 10, checks);
    bulb->SetConeAngle(90.0);
    bulb->SetPosition(-0.3, 0.2, 0.7); // in the ball
    compare("a bulb among them", stage, 10, checks);
    stage.renderer->GetActiveCamera()->ParallelProjectionOn();
    stage.renderer->GetActiveCamera()->SetParallelScale(2.5);
    compare("a bulb among them, parallel", stage, 10, checks);
  }
  {
    Stage stage;
    addSolids(stage);
    stage.addSun(3.0, -2.0, 4.0);
    stage.addBulb(-1.0, 0.6, 2.5);
    stage.addBulb(1.5, 1.5, 1.5);
    stage.addSun(-3.0, -2.0, 2.0);
    stage.addSun(-3.0, 2.0, 2.0);
    compare("five lights", stage, 20, checks);
  }
  {
    Stage stage;
    stage.addGround();
    vtkNew<vtkDiskSource> disk;
    disk->SetCircumferentialResolution(40);
    vtkActor* open = stage.add(disk, 0.9, 0.3, 0.2);
    open->SetPosition(0.0, 0.0, 1.0);
    open->RotateX(20.0);
    vtkNew<vtkReverseSense> insideOut;
    insideOut->SetInputConnection(ring(0.4, -0.9, 0.3, 0.7)->GetOutputPort());
    stage.add(insideOut, 0.3, 0.8, 0.4);
    stage.addSun(2.0, -1.0, 4.0);
    compare("open and inside out", stage, 10, checks);
  }
  {
    Stage stage;
    addSolids(stage);
    stage.add(box(30.0, 0.0, 14.0, -17.0), 0.5, 0.5, 0.5);
    vtkNew<vtkPlaneSource> roof;
    roof->SetOrigin(-4.0, -9.0, 0.0);
    roof->SetPoint1(4.0, -9.0, 0.0);
    roof->SetPoint2(-4.0, -1.0, 0.0);
    stage.add(roof, 0.5, 0.5, 0.5)->SetPosition(0.0, 0.0, 9.0);
    stage.addSun(0.0, -2.0, 4.0);
    compare("the eye in a shadow", stage, 10, checks);
  }
  return checks.exitCode();
}
