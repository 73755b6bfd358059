// Cameras whose matrices are not those of an ordinary one: views that scale, mirror and shear, and
// projections whose rays do not come from the eye. Surfaces look as VTK's rasteriser draws them,
// and shadow buffers agree with rays.
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkProperty.h"
#include "vtkTransform.h"

#include <cmath>
#include <functional>
#include <iostream>
#include <string>

namespace
{
using namespace svotest;

struct Case
{
  std::string name;
  std::function<void(vtkCamera*)> set;
};

Case view(const std::string& name, const std::function<void(vtkTransform*)>& make)
{
  return { "the view is " + name,
    [make](vtkCamera* camera)
    {
      vtkNew<vtkTransform> transform;
      make(transform);
      camera->SetUserViewTransform(transform);
    } };
}

Case projection(const std::string& name, const std::function<void(vtkTransform*)>& make)
{
  return { "the projection is " + name,
    [make](vtkCamera* camera)
    {
      vtkNew<vtkTransform> transform;
      make(transform);
      camera->SetUserTransform(transform);
    } };
}

std::size_t changed(const Picture& a, const Picture& b, const Mask& where)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    count += where[i] && std::abs(a.grey(i) - b.grey(i)) > 8.0;
  }
  return count;
}

void compare(Checks& checks, const Case& camera, bool bulb)
{
  Stage stage;
  stage.addGround();
  vtkProperty* shining = stage.add(ball(0.7, 0.9, -0.3, 0.9), 0.9, 0.5, 0.3)->GetProperty();
  shining->SetSpecular(0.4);
  shining->SetSpecularPower(15.0);
  const auto flat = [&](const vtkSmartPointer<vtkAlgorithm>& source, double red)
  { stage.add(source, red, 0.7, 0.9)->GetProperty()->SetInterpolationToFlat(); };
  flat(spike(1.2, -0.9, -0.5, 0.6), 0.4); // without normals
  flat(ring(0.5, -0.6, 1.0, 0.7), 0.8);
  flat(box(0.6, 0.9, 1.2, 0.5), 0.6);
  bulb ? stage.addBulb(1.0, -1.5, 4.0)->SetAttenuationValues(0.2, 0.1, 0.02)
       : stage.addSun(1.0, -1.5, 4.0)->SetIntensity(1.0);
  camera.set(stage.renderer->GetActiveCamera());
  stage.usePass(false);
  const Picture raster = capture(stage.window);
  const Mask inner = awayFromEdges(raster, 2);
  stage.usePass(true);
  const Picture unshadowed = stage.unshadowed();
  const Picture shadowed = stage.shadowedByBuffers();
  const Picture byRays = stage.shadowedByRays();
  const std::size_t wrong = changed(raster, unshadowed, inner);
  const std::size_t dark = changed(unshadowed, shadowed, inner);
  const std::size_t apart = changed(shadowed, byRays, inner);
  std::cout << camera.name << (bulb ? ", bulb: " : ", sun: ") << wrong
            << " pixels are not the raster's, " << dark << " in shadow, " << apart
            << " of them otherwise by rays\n";
  stage.expectTraced(checks, 5, camera.name + ": all is traced");
  checks.expect(wrong <= 4, camera.name + ": VTK's own picture");
  checks.expect(apart <= 25, camera.name + ": buffers and rays agree");
}
}

int TestSVOCameraMatrices(int, char*[])
{
  Checks checks;
  const double sheared[16] = { 1, 0.3, 0, 0, 0, 1, 0.1, 0.8, 0, 0, 1, 0, 0, 0, 0, 1 };
  const auto parallel = [](vtkCamera* camera)
  {
    camera->ParallelProjectionOn();
    camera->SetParallelScale(3.0);
  };
  for (const Case& camera :
    {
      view("turned", [](vtkTransform* t) { t->RotateZ(20.0); }),
      view("magnified", [](vtkTransform* t) { t->Scale(1.3, 1.3, 1.3); }),
      view("stretched", [](vtkTransform* t) { t->Scale(1.0, 1.5, 1.0); }),
      view("mirrored", [](vtkTransform* t) { t->Scale(-1.0, 1.0, 1.0); }),
      view("sheared", [&](vtkTransform* t) { t->SetMatrix(sheared); }),
      projection("stretched", [](vtkTransform* t) { t->Scale(1.2, 0.8, 1.0); }),
      projection("mirrored", [](vtkTransform* t) { t->Scale(-1.0, 1.0, 1.0); }),
      Case{ "the rays are sheared", [](vtkCamera* c) { c->SetViewShear(0.3, 0.1, 1.0); } },
      Case{ "the rays are sheared far", [](vtkCamera* c) { c->SetViewShear(1.2, 0.8, 1.0); } },
      Case{ "the rays are parallel though the camera's are not",
        [&](vtkCamera* c)
        {
          // The eye is lower than the top of the box, which rays see as they go down.
          c->SetPosition(1.5, 7.0, 0.5);
          c->SetFocalPoint(0.0, 0.0, -2.0);
          parallel(c);
          vtkNew<vtkMatrix4x4> matrix;
          matrix->DeepCopy(c->GetProjectionTransformMatrix(1.0, -1.0, 1.0));
          c->ParallelProjectionOff();
          c->SetExplicitProjectionTransformMatrix(matrix);
          c->UseExplicitProjectionTransformMatrixOn();
        } },
      Case{ "parallel rays are oblique",
        [&](vtkCamera* c)
        {
          parallel(c);
          c->SetObliqueAngles(60.0, 40.0);
        } },
      Case{ "parallel rays are mirrored",
        [&](vtkCamera* c)
        {
          parallel(c);
          vtkNew<vtkTransform> transform;
          transform->Scale(1.0, -1.0, 1.0);
          c->SetUserTransform(transform);
        } },
      Case{ "the projection is off the axis",
        [](vtkCamera* c)
        {
          c->UseOffAxisProjectionOn();
          c->SetScreenBottomLeft(-0.5, -0.4, -1.0);
          c->SetScreenBottomRight(0.6, -0.4, -1.0);
          c->SetScreenTopRight(0.6, 0.5, -1.0);
        } },
    })
  {
    for (const bool bulb : { false, true })
    {
      compare(checks, camera, bulb);
    }
  }
  return checks.exitCode();
}
