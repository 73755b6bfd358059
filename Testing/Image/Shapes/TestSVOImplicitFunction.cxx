// The sphere of an implicit function beside a finely triangulated one, drawn by VTK's rasteriser
// and traced: outline, depth, shading and shadows.
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkImplicitFunctionToSVO.h"
#include "vtkMapper.h"
#include "vtkPlane.h"
#include "vtkPointData.h"
#include "vtkProperty.h"
#include "vtkSphere.h"
#include "vtkSphereSource.h"

#include <cmath>
#include <functional>
#include <iostream>
#include <utility>

namespace
{
using namespace svotest;

constexpr double Radius = 0.9;
constexpr double Height = 1.2;

vtkSmartPointer<vtkAlgorithm> functionBall(int level)
{
  vtkNew<vtkSphere> sphere;
  sphere->SetRadius(Radius);
  sphere->SetCenter(0.0, 0.0, Height);
  auto filter = vtkSmartPointer<vtkImplicitFunctionToSVO>::New();
  filter->SetImplicitFunction(sphere);
  filter->SetModelBounds(-1.0, 1.0, -1.0, 1.0, Height - 1.0, Height + 1.0);
  filter->SetMaximumLevel(level);
  return filter;
}

vtkSmartPointer<vtkAlgorithm> meshBall()
{
  auto source = vtkSmartPointer<vtkSphereSource>::New();
  source->SetRadius(Radius);
  source->SetCenter(0.0, 0.0, Height);
  source->SetThetaResolution(400);
  source->SetPhiResolution(400);
  return source;
}

struct Scene : Stage
{
  vtkActor* actor;
  explicit Scene(vtkAlgorithm* source)
  {
    this->addGround();
    this->actor = this->add(source, 0.9, 0.5, 0.3);
    this->actor->GetProperty()->SetSpecular(0.3);
    this->actor->GetProperty()->SetSpecularPower(20.0);
    this->addSun(2.0, -1.5, 4.0);
  }
};

std::size_t count(const Picture& a, const Picture& b, int most)
{
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    int largest = 0;
    for (int c = 0; c < 3; ++c)
    {
      largest = std::max(largest, std::abs(int(a.rgb[3 * i + c]) - int(b.rgb[3 * i + c])));
    }
    pixels += largest > most;
  }
  return pixels;
}

/// Pixels that one picture shows nothing in and the other does.
std::size_t outlineDifference(const Picture& a, const Picture& b)
{
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    pixels += (a.depth[i] < 1.0f) != (b.depth[i] < 1.0f);
  }
  return pixels;
}

void compare(int level, Checks& checks)
{
  const std::string name = "level " + std::to_string(level) + ": ";
  const auto functions = functionBall(level);
  const auto triangles = meshBall();
  Scene scene(functions), mesh(triangles);
  const Picture traced = scene.unshadowed();
  scene.expectTraced(checks, 2, name + "both are traced", 1);
  scene.expectRasterized(checks, 0, name + "nothing is rasterised");
  mesh.usePass(false);
  const Picture raster = capture(mesh.window);
  mesh.usePass(true);
  const Picture exact = mesh.unshadowed();
  const Difference look = difference(raster, traced, awayFromEdges(raster, 2));
  const Difference shape = difference(exact, traced);
  std::cout << name << "beside the raster mean " << look.mean << ", p99 " << look.p99
            << "; beside the traced mesh mean " << shape.mean << ", " << count(exact, traced, 24)
            << " pixels by more than 24 grey levels; outlines differ in "
            << outlineDifference(exact, traced) << " pixels\n";
  checks.expect(look.mean <= 1.0 && look.p99 <= 8, name + "it is shaded as VTK shades it");
  // Of some 350 pixels around.
  checks.expect(outlineDifference(exact, traced) <= 12, name + "its outline is the sphere's");

  for (const bool rays : { false, true })
  {
    const Picture dark = rays ? scene.shadowedByRays() : scene.shadowedByBuffers();
    const Picture expected = rays ? mesh.shadowedByRays() : mesh.shadowedByBuffers();
    const std::size_t wrong = count(dark, expected, 24);
    std::cout << name << (rays ? "rays" : "buffer") << ": " << wrong
              << " pixels are otherwise than the mesh's\n";
    // The shadow on the ground is as long; the sphere has no acne.
    checks.expect(wrong <= 60, name + (rays ? "shadow rays" : "shadow buffer"));
  }
}

/// What is left to the rasteriser looks as a mesh does.
void compareRasterised(Checks& checks)
{
  const auto clip = [](vtkActor* actor)
  {
    vtkNew<vtkPlane> plane;
    plane->SetOrigin(0.0, 0.0, Height);
    plane->SetNormal(0.0, 1.0, 0.3);
    actor->GetMapper()->AddClippingPlane(plane);
  };
  const std::pair<const char*, std::function<void(vtkActor*)>> changes[] = {
    { "clipped", clip },
    { "translucent", [](vtkActor* a) { a->GetProperty()->SetOpacity(0.4); } },
    { "physically based", [](vtkActor* a) { a->GetProperty()->SetInterpolationToPBR(); } },
  };
  for (const auto& [name, change] : changes)
  {
    const auto functions = functionBall(8);
    const auto triangles = meshBall();
    Scene scene(functions), mesh(triangles);
    for (Scene* s : { &scene, &mesh })
    {
      change(s->actor);
      s->renderer->SetUseDepthPeeling(true);
      s->renderer->SetOcclusionRatio(0.0);
      s->renderer->SetMaximumNumberOfPeels(20);
    }
    const Picture ours = scene.shadowed(), expected = mesh.shadowed();
    scene.expectRasterized(checks, 1, name + std::string(": rasterised"));
    const std::size_t wrong = count(ours, expected, 24);
    std::cout << name << ": " << wrong << " pixels are otherwise than the mesh's\n";
    // The ball has some 10 000.
    checks.expect(wrong <= 100, name + std::string(": it looks as a mesh does"));
  }
}
}

int TestSVOImplicitFunction(int, char*[])
{
  Checks checks;
  compare(7, checks);
  compare(9, checks);
  compareRasterised(checks);

  // Where rays stop at nodes of 4 pixels the outline, some 350 pixels around, is up to that much
  // wider.
  const auto coarse = functionBall(9);
  Scene scene(coarse);
  const Picture full = scene.unshadowed();
  scene.pass->SetPixelError(4.0);
  const Picture nodes = scene.unshadowed();
  std::cout << "nodes: " << count(full, nodes, 24) << " pixels differ\n";
  checks.expect(drawnByOpenGL() || count(full, nodes, 24) > 0, "nodes are drawn");
  checks.expect(count(full, nodes, 24) < 4 * 350, "nodes look much the same");
  scene.pass->SetPixelError(0.0);

  // The rasteriser shows the contour.
  scene.usePass(false);
  const std::size_t beside = outlineDifference(capture(scene.window), full);
  std::cout << "contour: outlines differ in " << beside << " pixels\n";
  checks.expect(beside <= 12, "the rasteriser draws the same outline");
  scene.usePass(true);

  scene.actor->SetScale(1.0, 0.6, 1.3);
  scene.actor->RotateY(30.0);
  scene.shadowed();
  scene.expectTraced(checks, 2, "a stretched one is traced", 1);
  return checks.exitCode();
}
