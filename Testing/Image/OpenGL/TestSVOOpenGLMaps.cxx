// Shadow maps that OpenGL draws: what lies at their texels, and the pictures that look them up, are
// those of the CPU's.
#include "../../Unit/svoTestMessages.h"
#include "svoImageCases.h"
#include "svoMapsBeside.h"
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkElevationFilter.h"
#include "vtkGlyph3DMapper.h"
#include "vtkImageData.h"
#include "vtkImageToSVO.h"
#include "vtkLookupTable.h"
#include "vtkMapper.h"
#include "vtkOpenGLSphereMapper.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

using namespace svotest;

namespace
{
/// Texels at which one of both has nothing, or another share of light is taken; and of those at
/// which both have something, at which it lies elsewhere: another voxel where rays are traced.
constexpr double MostOther = 1e-5, MostOfHits = 1e-4;

/// An image's ring above the ground.
vtkActor* addRing(Stage& stage)
{
  const ImageCase ring = distanceCase();
  vtkNew<vtkImageToSVO> surface;
  surface->SetInputData(ring.image);
  surface->SetValue(0, ring.value);
  vtkActor* actor = stage.add(surface, 0.9, 0.5, 0.3);
  actor->SetPosition(0.0, 0.0, 1.2);
  actor->RotateWXYZ(40.0, 1.0, 0.3, 0.0);
  return actor;
}

/// Alpha from point to point.
void addVeil(Stage& stage)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(0.5);
  sphere->SetThetaResolution(40);
  sphere->SetPhiResolution(40);
  vtkNew<vtkElevationFilter> heights;
  heights->SetInputConnection(sphere->GetOutputPort());
  heights->SetLowPoint(0.0, 0.0, -0.5);
  heights->SetHighPoint(0.0, 0.0, 0.5);
  vtkNew<vtkLookupTable> table;
  table->SetAlphaRange(0.0, 0.9);
  table->Build();
  vtkActor* actor = stage.add(heights, 1.0, 1.0, 1.0);
  actor->GetMapper()->ScalarVisibilityOn();
  actor->GetMapper()->SetLookupTable(table);
  actor->SetPosition(0.3, -1.2, 0.8);
}

/// VTK's balls without triangles, one around the bulb.
void addBalls(Stage& stage)
{
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 20; ++i)
  {
    points->InsertNextPoint(0.3 * (i % 5) - 0.5, 0.4 * (i / 5) - 0.5, 0.8 + 0.05 * (i % 7));
  }
  points->InsertNextPoint(0.1, 0.1, 1.4);
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  vtkNew<vtkOpenGLSphereMapper> mapper;
  mapper->SetInputData(mesh);
  mapper->SetRadius(0.12f);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetScale(1.0, 1.0, 1.3);
  stage.renderer->AddActor(actor);
}

/// Three times nine of two shapes.
void addCopies(Stage& stage)
{
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 27; ++i)
  {
    points->InsertNextPoint(0.4 * (i % 3) - 0.4, 0.3 * (i / 9) - 1.5, 0.6 + 0.3 * (i / 3 % 3));
  }
  vtkNew<vtkPolyData> places;
  places->SetPoints(points);
  for (const bool round : { true, false })
  {
    const vtkSmartPointer<vtkAlgorithm> shape =
      round ? ball(0.1, 0.0, 0.0, 0.0) : ring(0.1, 0.1, 0.0, 0.0);
    vtkNew<vtkGlyph3DMapper> mapper;
    mapper->SetInputData(places);
    mapper->SetSourceConnection(shape->GetOutputPort());
    mapper->ScalingOff();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    stage.renderer->AddActor(actor);
  }
}

void expectSame(const std::string& name, Checks& checks)
{
  const MapsBeside& found = MapsBeside::Last;
  std::cout << name << ": " << found.maps << " maps of " << found.texels << " texels, "
            << found.held << " held; others: " << found.edges << " at edges, " << found.depths
            << " depths (by " << found.worst << " texels), " << found.shares << " shares\n";
  checks.expect(found.same, name + ": the same maps");
  checks.expect(found.held > 0, name + ": something casts");
  checks.expect(found.edges + found.shares <= MostOther * found.texels, name + ": who casts");
  checks.expect(found.depths <= MostOfHits * found.held, name + ": where they lie");
}

void compareMaps(Checks& checks)
{
  using Change = std::function<void(Stage&)>;
  const std::pair<const char*, Change> scenes[] = {
    { "a sun", [](Stage& s) { s.addSun(2.0, -1.5, 4.0); } },
    { "a bulb far away", [](Stage& s) { s.addBulb(-4.0, -3.0, 9.0); } },
    { "a bulb among them", [](Stage& s) { s.addBulb(-0.313, 0.487, 0.723); } },
    { "a spot",
      [](Stage& s)
      {
        vtkLight* light = s.addBulb(-2.0, -1.0, 3.0);
        light->SetConeAngle(25.0);
      } },
    { "planes",
      [](Stage& s)
      {
        addRing(s);
        s.addSun(2.0, -1.5, 4.0);
        s.addBulb(0.0, 0.2, 1.3);
      } },
    { "cubes",
      [](Stage& s)
      {
        addRing(s);
        s.addSun(2.0, -1.5, 4.0);
      } },
    { "translucent",
      [](Stage& s)
      {
        s.add(ball(0.4, 0.9, -0.9, 0.9), 0.2, 0.3, 0.9)->GetProperty()->SetOpacity(0.4);
        s.add(ball(0.3, 1.1, -0.6, 1.7), 0.2, 0.9, 0.3)->GetProperty()->SetOpacity(0.7);
        s.addSun(2.0, -1.5, 4.0);
        s.addBulb(-0.3, -0.4, 2.6);
      } },
    { "colours with alpha",
      [](Stage& s)
      {
        addVeil(s);
        s.addSun(2.0, -1.5, 4.0);
      } },
    { "balls",
      [](Stage& s)
      {
        addBalls(s);
        s.addSun(2.0, -1.5, 4.0);
        s.addBulb(0.1, 0.1, 1.4);
      } },
    { "copies",
      [](Stage& s)
      {
        addCopies(s);
        s.addSun(2.0, -1.5, 4.0);
      } },
    { "no casters that it sees",
      [](Stage& s)
      {
        vtkLight* light = s.addBulb(-2.0, -1.0, 3.0);
        light->SetConeAngle(5.0);
        light->SetFocalPoint(-9.0, -1.0, 3.0);
        s.addSun(2.0, -1.5, 4.0);
      } },
    { "mirrored, stretched and far from the origin",
      [](Stage& s)
      {
        vtkActor* odd = s.add(ring(0.5, 0.0, 0.0, 0.0), 0.9, 0.9, 0.2);
        odd->SetScale(-1.0, 1e-3, 2.0);
        odd->SetPosition(0.5, -1.0, 1.5);
        s.addSun(2.0, -1.5, 4.0);
      } },
  };
  for (const auto& [name, change] : scenes)
  {
    Stage stage;
    const vtkSmartPointer<vtkSVORenderPass> pass = makePassBeside();
    stage.addGround();
    const bool cubes = std::string(name) == "cubes"; // OpenGL meets triangles whatever leaves are
    if (cubes)
    {
      pass->SetLeafGeometryToVoxel();
    }
    else
    {
      stage.add(box(0.5, 0.0, 0.0, 0.0), 0.3, 0.8, 0.4)->SetPosition(-0.9, 0.2, 0.6);
      stage.add(ball(0.5, 0.2, 0.9, 0.8), 0.9, 0.3, 0.3);
    }
    change(stage);
    pass->SetBackendToOpenGL();
    pass->SetMaximumLevel(8);
    pass->SetShadowBufferResolution(1024);
    pass->SetShadowTechniqueToShadowBuffer();
    stage.renderer->SetPass(pass);
    stage.renderer->ResetCameraClippingRange();
    capture(stage.window);
    expectSame(name, checks);
    stage.renderer->SetPass(nullptr);
    capture(stage.window);
  }
}

/// What changes from frame to frame changes maps and picture as with the CPU; what does not,
/// nothing.
void compareChanges(Checks& checks)
{
  Stage stage;
  stage.addGround();
  vtkActor* cube = stage.add(box(0.5, 0.0, 0.0, 0.0), 0.3, 0.8, 0.4);
  cube->SetPosition(-0.9, 0.2, 0.6);
  vtkActor* sphere = stage.add(ball(0.5, 0.2, 0.9, 0.8), 0.9, 0.3, 0.3);
  vtkLight* sun = stage.addSun(2.0, -1.5, 4.0);
  vtkLight* bulb = stage.addBulb(-2.0, -1.0, 3.0);
  bulb->SetIntensity(0.4);
  const vtkSmartPointer<vtkSVORenderPass> pass = makePassBeside();
  pass->SetMaximumLevel(8);
  pass->SetShadowBufferResolution(1024);
  stage.pass->SetMaximumLevel(8);
  stage.pass->SetShadowBufferResolution(1024);
  for (vtkSVORenderPass* one : { stage.pass.Get(), pass.Get() })
  {
    one->SetShadowTechniqueToShadowBuffer();
  }
  stage.pass->SetBackendToCPU();
  pass->SetBackendToOpenGL();
  const std::pair<const char*, std::function<void()>> changes[] = {
    { "at first", [] {} },
    { "a caster moves", [&] { sphere->AddPosition(1.0, -1.0, 0.3); } },
    { "a little", [&] { sphere->AddPosition(0.002, 0.0, 0.0); } },
    { "one is gone", [&] { cube->VisibilityOff(); } },
    { "it is back", [&] { cube->VisibilityOn(); } },
    { "the sun moves", [&] { sun->SetPosition(-1.0, -2.5, 3.0); } },
    { "a bulb is off", [&] { bulb->SwitchOff(); } },
    { "one is translucent", [&] { sphere->GetProperty()->SetOpacity(0.5); } },
    { "and opaque", [&] { sphere->GetProperty()->SetOpacity(1.0); } },
    { "another camera", [&] { stage.renderer->GetActiveCamera()->Azimuth(30.0); } },
    { "coarser maps",
      [&]
      {
        pass->SetShadowBufferResolution(64);
        stage.pass->SetShadowBufferResolution(64);
      } },
    { "filtered",
      [&]
      {
        pass->FilterShadowsOn();
        stage.pass->FilterShadowsOn();
      } },
  };
  Picture before;
  for (const auto& [name, change] : changes)
  {
    change();
    stage.renderer->SetPass(stage.pass);
    const Picture expected = capture(stage.window);
    stage.renderer->SetPass(pass);
    const Picture found = capture(stage.window);
    const vtkIdType drawn = pass->GetNumberOfRetracedLayers();
    std::cout << drawn << " drawn: ";
    expectSame(name, checks);
    std::size_t other = 0;
    for (std::size_t i = 0; i < found.rgb.size(); i += 3)
    {
      other += std::abs(int(found.rgb[i]) - int(expected.rgb[i])) > 8;
    }
    std::cout << "  " << other << " of " << found.size() << " pixels are others\n";
    checks.expect(other <= 2e-3 * found.size(), std::string(name) + ": the CPU's picture");
    checks.expect(found.rgb != before.rgb, std::string(name) + ": is seen");
    // Of two lights; the ground casts nothing, the cube lies beside the sphere.
    checks.expect(std::string(name) != "a little" || drawn == 2, "what has moved is drawn alone");
    checks.expect(capture(stage.window).rgb == found.rgb, std::string(name) + ": and stays");
    checks.expect(before.rgb.empty() || pass->GetNumberOfRetracedLayers() == 0,
      std::string(name) + ": nothing is drawn");
    before = found;
  }
  const auto size = pass->GetGPUMemory();
  checks.expect(size > 0, "maps are accounted for");
  for (int i = 0; i < 50; ++i)
  {
    sphere->AddPosition(i % 2 ? 0.01 : -0.01, 0.0, 0.0);
    capture(stage.window);
  }
  checks.expect(pass->GetGPUMemory() == size, "memory does not grow");
  // Where they do not fit the CPU has them, and that is said once.
  svo::TestMessages messages{ pass };
  pass->SetGPUMemoryLimit(static_cast<int>(size - 1));
  for (int i = 0; i < 2; ++i)
  {
    const Picture found = capture(stage.window);
    checks.expect(difference(before, found).mean < 0.2, "without room there are shadows");
    sphere->AddPosition(0.001, 0.0, 0.0);
  }
  std::cout << messages.all();
  checks.expect(messages.errors.empty() && messages.warnings.size() == 1 &&
      messages.warnings[0].find("GPUMemoryLimit") != std::string::npos,
    "that there is no room is said once");
  stage.renderer->SetPass(nullptr);
  capture(stage.window);
}

/// Meshes of a thousand poses that are not seen again make room for the maps of the next one, or
/// for the mask that rays are looked up in.
void forgetPoses(Checks& checks)
{
  for (const bool rays : { false, true })
  {
    Stage stage;
    stage.addGround();
    vtkNew<vtkSphereSource> pose;
    pose->SetRadius(0.5);
    pose->SetCenter(0.0, 0.0, 0.8);
    pose->SetThetaResolution(100);
    pose->SetPhiResolution(100);
    stage.add(pose, 0.9, 0.3, 0.3);
    stage.addSun(2.0, -1.5, 4.0);
    stage.pass->SetBackendToOpenGL();
    stage.pass->SetMaximumLevel(7);
    stage.pass->SetShadowBufferResolution(1024);
    svo::TestMessages messages{ stage.pass };
    const auto draw = [&] { return rays ? stage.shadowedByRays() : stage.shadowedByBuffers(); };
    draw();
    const auto alone = stage.pass->GetGPUMemory();
    // Room for a few.
    stage.pass->SetGPUMemoryLimit(static_cast<int>(alone + alone / 2));
    vtkIdType most = 0, least = alone;
    for (int i = 0; i < 40; ++i)
    {
      pose->SetRadius(0.5 + 0.001 * i);
      draw();
      most = std::max(most, stage.pass->GetGPUMemory());
      least = std::min(least, stage.pass->GetGPUMemory());
    }
    std::cout << (rays ? "rays: " : "maps: ") << alone << " KiB for a pose, " << least << " to "
              << most << " for many\n";
    checks.expect(most <= stage.pass->GetGPUMemoryLimit(), "the limit is kept");
    // Without maps, or without a mask, there is less.
    checks.expect(least >= alone - alone / 10, "the newest pose has all that it needs");
    checks.expect(messages.all().empty(), "nothing is said: " + messages.all());
  }
}
}

int TestSVOOpenGLMaps(int, char*[])
{
  Checks checks;
  compareMaps(checks);
  compareChanges(checks);
  forgetPoses(checks);
  return checks.exitCode();
}
