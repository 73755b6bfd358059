// Any affine matrix: the same octree moved and turned, stretched, mirrored and sheared. (VTK lights
// a mirrored mesh by normals that point inwards: it is dark, with the pass as without.)
#include "svoShadowOracle.h"
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkProperty.h"
#include "vtkTransform.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>

namespace
{
using namespace svotest;

/// A square above a ground, flattened by one of its own axes and tilted.
void addFlattened(Stage& stage, const double scale[3])
{
  stage.addGround();
  vtkActor* actor = stage.add(box(1.0, 0.0, 0.0, 0.0), 0.9, 0.5, 0.3);
  actor->SetScale(scale[0], scale[1], scale[2]);
  actor->SetPosition(0.2, -0.3, 1.2);
  actor->RotateX(20.0);
  actor->GetProperty()->LightingOff(); // VTK has no normals for it
  stage.addSun(1.0, -1.5, 4.0);
}

std::size_t changed(const Picture& a, const Picture& b)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    count += std::abs(a.grey(i) - b.grey(i)) > 20.0;
  }
  return count;
}

/// Singular matrices: VTK's picture, and the shadow of something a little thicker.
void compareFlattened(Checks& checks)
{
  const double flat[][3] = { { 1.0, 1.0, 0.0 }, { 0.0, 1.0, 1.0 }, { 1.3, 1.0, 1e-13 },
    { 1.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 } };
  for (const double(&scale)[3] : flat)
  {
    const std::string name =
      std::to_string(scale[0]) + " " + std::to_string(scale[1]) + " " + std::to_string(scale[2]);
    Stage stage, thick;
    addFlattened(stage, scale);
    double thicker[3];
    for (int i = 0; i < 3; ++i)
    {
      thicker[i] = std::max(scale[i], 1e-4);
    }
    addFlattened(thick, thicker);
    const Picture unshadowed = stage.unshadowed();
    const Picture shadowed = stage.shadowed();
    const Picture expected = thick.shadowed();
    stage.expectRasterized(checks, 1, name + ": it is rasterised");
    stage.usePass(false);
    const Picture raster = capture(stage.window);
    std::cout << "scale " << name << ": " << changed(raster, unshadowed)
              << " pixels are not the raster's, " << changed(shadowed, unshadowed) << " in shadow, "
              << changed(shadowed, expected) << " otherwise than if thicker\n";
    checks.expect(changed(raster, unshadowed) < 5, name + ": VTK's own picture");
    checks.expect(changed(shadowed, expected) < 5, name + ": its shadow");
  }
}

/// Matrices that the camera puts before its view are VTK's for normals and lights, too.
void compareModelTransforms(Checks& checks)
{
  const char* names[] = { "turned", "scaled", "mirrored", "sheared" };
  for (int i = 0; i < 4; ++i)
  {
    for (const bool bulb : { false, true })
    {
      Stage stage;
      stage.addGround();
      vtkActor* actor = stage.add(ball(0.7, 0.2, -0.3, 0.9), 0.9, 0.5, 0.3);
      actor->GetProperty()->SetSpecular(0.4);
      actor->GetProperty()->SetSpecularPower(15.0);
      bulb ? stage.addBulb(1.0, -1.5, 4.0)->SetAttenuationValues(0.2, 0.1, 0.02)
           : stage.addSun(1.0, -1.5, 4.0)->SetIntensity(1.0);
      vtkNew<vtkTransform> transform;
      const double sheared[16] = { 1, 0.3, 0, 0, 0, 1, 0.4, 0.2, 0, 0, 1, 0, 0, 0, 0, 1 };
      i == 0     ? transform->RotateWXYZ(25.0, 0.3, 0.2, 1.0)
        : i == 1 ? transform->Scale(1.2, 0.8, 1.5)
        : i == 2 ? transform->Scale(-1.0, 1.0, 1.0)
                 : transform->SetMatrix(sheared);
      stage.renderer->GetActiveCamera()->SetModelTransformMatrix(transform->GetMatrix());
      stage.pass->SetShadowTechniqueToNone();
      stage.usePass(false);
      const Picture raster = capture(stage.window);
      stage.usePass(true);
      const Picture traced = capture(stage.window);
      const std::size_t wrong = changed(raster, traced);
      const Difference look = difference(raster, traced);
      std::cout << "model transform " << names[i] << ": mean " << look.mean << ", p99 " << look.p99
                << ", " << wrong << " pixels differ\n";
      checks.expect(wrong < 10 && look.p99 <= 2,
        std::string("the camera's world is ") + names[i] + ": VTK's own picture");
    }
  }
}
}

int TestSVOMatrices(int argc, char* argv[])
{
  Checks checks;
  Stage stage(360, 300);
  ShadowOracle oracle;
  vtkActor* ground = stage.addGround();
  const auto source = spike(1.2, 0.0, 0.0, 0.6);
  vtkActor* moved = stage.add(source, 0.9, 0.5, 0.3);
  moved->SetPosition(-1.5, -0.8, 0.3);
  moved->RotateWXYZ(55.0, 1.0, 0.5, 0.2);
  vtkActor* stretched = stage.add(source, 0.4, 0.8, 0.4);
  stretched->SetPosition(-0.6, 1.2, 0.0);
  stretched->SetScale(0.5, 1.5, 1.8);

  const auto other = ring(0.7, 0.0, 0.0, 0.0);
  vtkActor* mirrored = stage.add(other, 0.4, 0.6, 0.9);
  mirrored->SetPosition(1.3, 0.9, 1.1);
  mirrored->SetScale(-1.0, 1.0, 1.0);
  mirrored->RotateY(30.0);
  vtkActor* sheared = stage.add(other, 0.9, 0.8, 0.3);
  vtkNew<vtkMatrix4x4> shear;
  shear->SetElement(0, 2, 0.8);
  shear->SetElement(1, 0, 0.3);
  shear->SetElement(0, 3, 0.7);
  shear->SetElement(1, 3, -1.1);
  shear->SetElement(2, 3, 0.9);
  sheared->SetUserMatrix(shear);
  for (vtkActor* actor : { ground, moved, stretched, mirrored, sheared })
  {
    oracle.add(actor);
  }
  oracle.add(stage.addSun(2.0, -1.5, 4.0));

  const Picture unshadowed = stage.unshadowed();
  const Picture shadowed = stage.shadowed();
  expectShadows(checks, oracle.judge(stage.renderer, shadowed, unshadowed), "matrices");
  stage.expectRasterized(checks, 0, "everything is traced");

  stage.usePass(false);
  const Picture raster = capture(stage.window);
  const Difference look = difference(raster, unshadowed, awayFromEdges(raster, 2));
  checks.expect(look.mean <= 2.0 && look.p99 <= 8, "without shadows it is VTK's own picture");

  compareFlattened(checks);
  compareModelTransforms(checks);
  stage.usePass(true);
  checks.expect(matchesBaseline(stage.window, argc, argv), "the baseline");
  return checks.exitCode();
}
