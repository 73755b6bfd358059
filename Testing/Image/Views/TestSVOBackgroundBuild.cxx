// While the user interacts, a surface without an octree is rasterised until a background build is
// through; a still render waits for it and says how far it is.
#include "svoTestStage.h"

#include "vtkCallbackCommand.h"
#include "vtkSphereSource.h"

#include <chrono>
#include <iostream>
#include <thread>

int TestSVOBackgroundBuild(int, char*[])
{
  using namespace svotest;
  Checks checks;
  Stage stage;
  stage.addSun(2.0, -1.5, 4.0);
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(200);
  source->SetPhiResolution(200);
  source->SetCenter(0.0, 0.0, 1.0);
  stage.add(source, 0.9, 0.5, 0.3);

  stage.window->SetDesiredUpdateRate(15.0);
  const Picture first = stage.shadowed();
  const auto hasOctree = [&] { return stage.pass->GetNumberOfInstances() == 1; };
  checks.expect(stage.pass->GetNumberOfRasterizedActors() == 1 && !hasOctree(),
    "the first interactive frame does not wait");
  Picture later;
  for (int i = 0; i < 600 && !hasOctree(); ++i)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    later = stage.shadowed();
  }
  checks.expect(hasOctree(), "a later frame has its octree");
  stage.expectTraced(checks, 1, "and traces it");
  stage.usePass(false);
  const Picture raster = capture(stage.window);
  stage.usePass(true);
  const Difference change = difference(first, raster, awayFromEdges(raster, 2));
  checks.expect(change.mean < 1.0, "meanwhile it was shown as VTK draws it");

  // A new mesh and a still render: it waits, and reports.
  source->SetRadius(0.7);
  stage.window->SetDesiredUpdateRate(0.0001);
  struct Progress
  {
    int calls = 0;
    double last = -1.0;
    bool ordered = true;
  } progress;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&progress);
  observer->SetCallback(
    [](vtkObject*, unsigned long, void* client, void* amount)
    {
      auto& p = *static_cast<Progress*>(client);
      const double now = *static_cast<double*>(amount);
      p.ordered = p.ordered && now >= p.last && now <= 1.0;
      p.last = now;
      ++p.calls;
    });
  stage.pass->AddObserver(vtkCommand::ProgressEvent, observer);
  capture(stage.window);
  checks.expect(hasOctree(), "a still render waits");
  stage.expectTraced(checks, 1, "and traces");
  std::cout << progress.calls << " reports of progress\n";
  checks.expect(progress.calls > 0 && progress.ordered, "progress goes from 0 to 1");

  // A build that nobody waits for does not outlive the pass.
  source->SetRadius(0.8);
  stage.window->SetDesiredUpdateRate(15.0);
  capture(stage.window);
  stage.expectRasterized(checks, 1, "it is built in the background");
  checks.expect(!hasOctree(), "so it has none yet");
  return checks.exitCode();
}
