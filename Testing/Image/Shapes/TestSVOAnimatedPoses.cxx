// A mesh that changes its shape or its cells and an actor that moves: each frame is what a fresh
// start would have drawn, whatever was kept from the frames before.
#include "svoShadowOracle.h"
#include "svoTestStage.h"

#include "vtkCellArray.h"
#include "vtkPolyData.h"
#include "vtkSuperquadricSource.h"
#include "vtkTrivialProducer.h"

#include <iostream>

namespace
{
struct Act
{
  svotest::Stage stage;
  vtkSmartPointer<vtkAlgorithm> shape = svotest::ring(0.9, -0.5, 0.0, 1.2);
  vtkActor* ground = stage.addGround();
  vtkActor* changing = stage.add(shape, 0.9, 0.5, 0.3);
  vtkActor* moving = stage.add(svotest::spike(0.9, 0.0, 0.0, 0.45), 0.3, 0.6, 0.9);
  vtkLight* sun = stage.addSun(2.0, -1.5, 4.0);

  void pose(int frame)
  {
    auto* source = vtkSuperquadricSource::SafeDownCast(this->shape);
    source->SetThickness(0.2 + 0.1 * (frame % 4));
    source->SetPhiRoundness(0.5 + 0.5 * (frame % 4));
    this->moving->SetPosition(1.2, -1.2 + 0.4 * frame, 0.0);
    this->moving->SetOrientation(0.0, 0.0, 15.0 * frame);
  }
};

/// Cells are replaced in place, and only the mesh is told so.
void testCellsInPlace(svotest::Checks& checks)
{
  const auto source = svotest::ball(0.9, 0.0, 0.0, 1.0);
  source->Update();
  vtkNew<vtkPolyData> mesh;
  mesh->DeepCopy(source->GetOutputDataObject(0));
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(mesh);
  svotest::Stage stage;
  stage.add(producer, 0.9, 0.5, 0.3);
  const svotest::Picture whole = stage.unshadowed();
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfPolys() / 2; ++cell)
  {
    mesh->GetPolys()->ReplaceCellAtId(cell, { 0, 0, 0 });
  }
  mesh->Modified();
  const svotest::Picture traced = stage.unshadowed();
  stage.usePass(false);
  const svotest::Picture raster = svotest::capture(stage.window);
  const double change = svotest::difference(raster, whole).mean;
  const double error = svotest::difference(traced, raster).mean;
  std::cout << "cells in place: " << change << " from the whole ball, " << error
            << " from the rasteriser\n";
  checks.expect(change > 0.2, "the rasteriser shows half a ball");
  checks.expect(error < 0.2 * change, "and so does the pass");
}
}

int TestSVOAnimatedPoses(int argc, char* argv[])
{
  using namespace svotest;
  Checks checks;
  testCellsInPlace(checks);
  Act running;
  // The poses come round again: the fifth frame has the shape of the first.
  for (int frame = 0; frame < 6; ++frame)
  {
    running.pose(frame);
    const Picture picture = running.stage.shadowed();
    Act fresh;
    fresh.pose(frame);
    fresh.stage.pass->FrameCoherenceOff();
    const Picture expected = fresh.stage.shadowed();
    checks.expect(difference(picture, expected).largest == 0,
      "frame " + std::to_string(frame) + " does not depend on the frames before it");
  }
  ShadowOracle oracle;
  oracle.add(running.ground);
  oracle.add(running.changing);
  oracle.add(running.moving);
  oracle.add(running.sun);
  const Picture unshadowed = running.stage.unshadowed();
  const Picture shadowed = running.stage.shadowed();
  expectShadows(checks, oracle.judge(running.stage.renderer, shadowed, unshadowed), "last pose");

  // What stands still is kept from its second frame on.
  capture(running.stage.window);
  capture(running.stage.window);
  checks.expect(
    running.stage.pass->GetNumberOfRetracedLayers() == 0, "an unchanged frame retraces nothing");
  checks.expect(matchesBaseline(running.stage.window, argc, argv), "the baseline");
  return checks.exitCode();
}
