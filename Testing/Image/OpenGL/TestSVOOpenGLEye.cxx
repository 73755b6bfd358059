// Surfaces without triangles with the OpenGL backend: VTK's shaders trace them for the eye, and the
// picture is the CPU's.
#include "../../Unit/svoTestMessages.h"
#include "svoImageCases.h"
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkElevationFilter.h"
#include "vtkFloatArray.h"
#include "vtkGlyph3DMapper.h"
#include "vtkImageData.h"
#include "vtkImageToSVO.h"
#include "vtkImplicitFunctionToSVO.h"
#include "vtkIntArray.h"
#include "vtkLookupTable.h"
#include "vtkMapper.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkSphere.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <string>

using namespace svotest;

namespace
{
/// Pixels that may be others than the CPU's: 1e-4 that show another voxel, 3e-4 that are lit or
/// dark.
constexpr double MostOther = 4e-4;

/// An image's ring above the ground, coloured by height if `colored`.
vtkActor* addRing(Stage& stage, bool colored)
{
  const ImageCase ring = distanceCase();
  vtkNew<vtkElevationFilter> heights;
  heights->SetInputData(ring.image);
  heights->SetLowPoint(0.0, 0.0, -0.7);
  heights->SetHighPoint(0.0, 0.0, 0.7);
  heights->Update();
  vtkNew<vtkImageData> image;
  image->ShallowCopy(heights->GetOutput());
  vtkNew<vtkImageToSVO> surface;
  surface->SetInputData(image);
  surface->SetInputArrayToProcess(0, 0, 0, 0, ring.image->GetPointData()->GetScalars()->GetName());
  surface->SetValue(0, ring.value);
  surface->SetColorArrayName("Elevation");
  vtkActor* actor = stage.add(surface, 0.9, 0.5, 0.3);
  actor->SetPosition(0.0, 0.0, 1.2);
  actor->RotateWXYZ(40.0, 1.0, 0.3, 0.0);
  actor->GetProperty()->SetSpecular(0.4);
  actor->GetProperty()->SetSpecularPower(30.0);
  if (colored)
  {
    vtkMapper* mapper = actor->GetMapper();
    mapper->ScalarVisibilityOn();
    mapper->SetScalarModeToUseCellFieldData();
    mapper->SelectColorArray("Elevation");
  }
  return actor;
}

vtkActor* addBall(Stage& stage)
{
  vtkNew<vtkSphere> sphere;
  sphere->SetRadius(0.7);
  vtkNew<vtkImplicitFunctionToSVO> surface;
  surface->SetImplicitFunction(sphere);
  surface->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  surface->SetMaximumLevel(7);
  vtkActor* actor = stage.add(surface, 0.3, 0.6, 0.9);
  actor->SetPosition(0.8, -0.7, 0.8);
  return actor;
}

/// Turned, stretched, mirrored and coloured copies of a ball and of an image's ring.
vtkActor* addCopies(Stage& stage)
{
  vtkNew<vtkPoints> places;
  vtkNew<vtkFloatArray> scales, turns, heights;
  vtkNew<vtkIntArray> kinds;
  scales->SetName("scale");
  scales->SetNumberOfComponents(3);
  turns->SetName("turn");
  turns->SetNumberOfComponents(3);
  heights->SetName("height");
  kinds->SetName("kind");
  for (int i = 0; i < 12; ++i)
  {
    places->InsertNextPoint(0.9 * (i % 4) - 1.3, 0.9 * (i / 4) - 0.9, 0.4 + 0.07 * i);
    scales->InsertNextTuple3(i % 5 == 1 ? -0.4 : 0.4, 0.25 + 0.02 * i, 0.35);
    turns->InsertNextTuple3(20.0 * i, 7.0 * i, -30.0 * i);
    heights->InsertNextValue(static_cast<float>(i));
    kinds->InsertNextValue(i % 2);
  }
  vtkNew<vtkPolyData> points;
  points->SetPoints(places);
  points->GetPointData()->SetScalars(heights);
  points->GetPointData()->AddArray(scales);
  points->GetPointData()->AddArray(turns);
  points->GetPointData()->AddArray(kinds);
  vtkNew<vtkSphere> sphere;
  sphere->SetRadius(0.7);
  vtkNew<vtkImplicitFunctionToSVO> ball;
  ball->SetImplicitFunction(sphere);
  ball->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  ball->SetMaximumLevel(7);
  const ImageCase ring = distanceCase();
  vtkNew<vtkImageToSVO> image;
  image->SetInputData(ring.image);
  image->SetValue(0, ring.value);
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(points);
  mapper->SetSourceConnection(0, ball->GetOutputPort());
  mapper->SetSourceConnection(1, image->GetOutputPort());
  mapper->SourceIndexingOn();
  mapper->SetSourceIndexArray("kind");
  mapper->SetScaleArray("scale");
  mapper->SetScaleModeToScaleByVectorComponents();
  mapper->SetOrientationArray("turn");
  mapper->SetScalarRange(0.0, 11.0);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetSpecular(0.4);
  stage.renderer->AddActor(actor);
  return actor;
}

/// How far the picture of OpenGL is from the CPU's, with shadows, which is returned, and without.
Picture compare(const std::string& name, Stage& stage, int traced, Checks& checks)
{
  stage.pass->SetPixelError(0.0); // OpenGL stops at no nodes
  Picture found;
  for (const bool shadows : { false, true })
  {
    const auto draw = [&] { return shadows ? stage.shadowedByRays() : stage.unshadowed(); };
    stage.pass->SetBackendToCPU();
    const Picture expected = draw();
    stage.pass->SetBackendToOpenGL();
    found = draw();
    std::size_t other = 0, deeper = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      int most = 0;
      for (std::size_t k = 3 * i; k < 3 * i + 3; ++k)
      {
        most = std::max(most, std::abs(int(expected.rgb[k]) - int(found.rgb[k])));
      }
      other += most > 2;
      deeper += std::abs(expected.depth[i] - found.depth[i]) > 1e-5f;
    }
    std::cout << name << (shadows ? ", shadows: " : ": ") << other << " of " << found.size()
              << " pixels are others, " << deeper << " as deep\n";
    checks.expect(stage.pass->GetNumberOfTracedActors() == traced, name + ": they are traced");
    checks.expect(stage.pass->GetNumberOfPrimaryRays() == 0, name + ": and not by the CPU");
    checks.expect(other <= MostOther * found.size(), name + ": the CPU's colours");
    checks.expect(deeper <= MostOther * found.size(), name + ": the CPU's depths");
  }
  return found;
}

using Change = std::function<void(Stage&, vtkActor*)>;

void compareAll(Checks& checks)
{
  const auto camera = [](Stage& stage) { return stage.renderer->GetActiveCamera(); };
  const auto awayOf = [&camera](Stage& stage, vtkActor* actor)
  {
    const double* at = camera(stage)->GetPosition();
    const double* middle = actor->GetCenter();
    return std::hypot(at[0] - middle[0], at[1] - middle[1], at[2] - middle[2]);
  };
  const std::pair<const char*, Change> changes[] = {
    { "as it is", [](Stage&, vtkActor*) {} },
    { "flat", [](Stage&, vtkActor* a) { a->GetProperty()->SetInterpolationToFlat(); } },
    { "unlit", [](Stage&, vtkActor* a) { a->GetProperty()->LightingOff(); } },
    { "mirrored and stretched", [](Stage&, vtkActor* a) { a->SetScale(-1.0, 0.6, 1.3); } },
    { "tiny",
      [](Stage&, vtkActor* a)
      {
        a->SetScale(1e-3);
        a->AddPosition(0.9, -1.2, 0.1);
      } },
    { "parallel", [&](Stage& s, vtkActor*) { camera(s)->ParallelProjectionOn(); } },
    { "a mirrored picture",
      [&](Stage& s, vtkActor*)
      {
        vtkNew<vtkMatrix4x4> mirror;
        mirror->SetElement(0, 0, -1.0);
        vtkNew<vtkMatrix4x4> projection;
        projection->DeepCopy(camera(s)->GetProjectionTransformMatrix(1.0, -1.0, 1.0));
        vtkMatrix4x4::Multiply4x4(mirror, projection, projection);
        camera(s)->SetExplicitProjectionTransformMatrix(projection);
        camera(s)->UseExplicitProjectionTransformMatrixOn();
      } },
    { "cut by the near plane",
      [&](Stage& s, vtkActor* a)
      { camera(s)->SetClippingRange(awayOf(s, a), camera(s)->GetClippingRange()[1]); } },
    { "cut by the far plane",
      [&](Stage& s, vtkActor* a)
      { camera(s)->SetClippingRange(camera(s)->GetClippingRange()[0], awayOf(s, a)); } },
    { "from inside",
      [&](Stage& s, vtkActor* a)
      {
        const double* middle = a->GetCenter();
        camera(s)->SetPosition(middle[0] + 0.1, middle[1] - 0.2, middle[2] + 0.05);
        camera(s)->SetFocalPoint(1.0, 0.4, 0.2);
        camera(s)->SetViewAngle(75.0);
        s.renderer->ResetCameraClippingRange();
      } },
    { "translucent things before it",
      [](Stage& s, vtkActor*)
      {
        s.add(ball(0.5, 0.5, -1.2, 1.2), 0.9, 0.9, 0.9)->GetProperty()->SetOpacity(0.3);
        s.renderer->UseDepthPeelingOn();
      } },
    { "it receives nothing",
      [](Stage&, vtkActor* a) { vtkSVORenderPass::SetReceiveShadow(false, a); } },
  };
  for (const auto& [name, change] : changes)
  {
    Stage stage;
    stage.addGround();
    stage.add(box(0.5, 0.0, 0.0, 0.0), 0.3, 0.8, 0.4)->SetPosition(-0.9, 0.2, 0.6);
    vtkActor* ring = addRing(stage, true);
    addBall(stage);
    stage.addSun(2.0, -1.5, 4.0);
    stage.addBulb(-2.0, -1.0, 3.0)->SetIntensity(0.5);
    stage.renderer->ResetCameraClippingRange();
    change(stage, ring);
    compare(name, stage, 2, checks);
  }
}

void compareCopies(Checks& checks)
{
  Stage stage;
  stage.addGround();
  vtkActor* copies = addCopies(stage);
  stage.addSun(2.0, -1.5, 4.0);
  stage.addBulb(-2.0, -1.0, 3.0)->SetIntensity(0.5);
  stage.renderer->ResetCameraClippingRange();
  compare("copies", stage, 1, checks);
  copies->SetScale(0.7, -1.1, 0.9);
  compare("copies, mirrored", stage, 1, checks);
}

/// In a part of a window, beside another: strips of a picture are not those of the window.
void compareViewports(Checks& checks)
{
  Stage left(300, 700);
  left.renderer->SetViewport(0.0, 0.0, 0.5, 0.9);
  Stage right(left, 0.5, 0.35, 1.0, 1.0);
  Stage* const stages[] = { &left, &right };
  for (Stage* stage : stages)
  {
    stage->addGround();
    addRing(*stage, true);
    stage->addSun(2.0, -1.5, 4.0);
    stage->renderer->GetActiveCamera()->Zoom(1.5);
    stage->pass->SetPixelError(0.0);
    stage->pass->SetShadowTechniqueToShadowRays();
    stage->pass->SetBackendToCPU();
  }
  const Picture expected = capture(left.window);
  for (Stage* stage : stages)
  {
    stage->pass->SetBackendToOpenGL();
  }
  const Picture found = capture(left.window);
  std::size_t other = 0;
  for (std::size_t i = 0; i < found.rgb.size(); i += 3)
  {
    other += std::abs(int(expected.rgb[i]) - int(found.rgb[i])) > 2;
  }
  std::cout << "viewports: " << other << " of " << found.size() << " pixels are others\n";
  for (const Stage* stage : stages)
  {
    checks.expect(stage->pass->GetNumberOfTracedActors() == 1, "viewports: it is traced");
    checks.expect(stage->pass->GetNumberOfPrimaryRays() == 0, "viewports: and not by the CPU");
  }
  checks.expect(other <= MostOther * found.size(), "viewports: the CPU's colours");
}

/// What changes from frame to frame is another picture, as with the CPU.
void compareChanges(Checks& checks)
{
  Stage stage;
  stage.addGround();
  vtkActor* ring = addRing(stage, false);
  vtkActor* sphere = addBall(stage);
  stage.addSun(2.0, -1.5, 4.0);
  const std::pair<const char*, std::function<void()>> changes[] = {
    { "at first", [] {} },
    { "moved", [&] { sphere->AddPosition(-0.3, 0.5, 0.3); } },
    { "another material", [&] { ring->GetProperty()->SetColor(0.2, 0.9, 0.4); } },
    { "colours",
      [&]
      {
        ring->GetMapper()->ScalarVisibilityOn();
        ring->GetMapper()->SetScalarModeToUseCellFieldData();
        ring->GetMapper()->SelectColorArray("Elevation");
      } },
    { "another table",
      [&]
      {
        vtkNew<vtkLookupTable> gray;
        gray->SetSaturationRange(0.0, 0.0);
        gray->SetValueRange(0.2, 1.0);
        ring->GetMapper()->SetLookupTable(gray);
      } },
    { "no colours", [&] { ring->GetMapper()->ScalarVisibilityOff(); } },
    { "larger window", [&] { stage.window->SetSize(400, 260); } },
  };
  Picture before;
  for (const auto& [name, change] : changes)
  {
    change();
    const Picture found = compare(std::string("changes: ") + name, stage, 2, checks);
    checks.expect(found.rgb != before.rgb, std::string("changes: ") + name + ": is seen");
    before = found;
  }
  stage.window->Finalize();
  compare("changes: finalized", stage, 2, checks);
  ring->VisibilityOff(); // another one is the first
  compare("changes: one is hidden", stage, 1, checks);
}

/// Colours of voxels are none of the contour's: it has its own when the pass has gone.
void leaveColors(Checks& checks)
{
  const auto build = [](Stage& stage)
  {
    vtkMapper* mapper = addRing(stage, true)->GetMapper();
    stage.addSun(2.0, -1.5, 4.0);
    vtkNew<vtkLookupTable> table;
    mapper->SetLookupTable(table);
  };
  Stage plain, stage;
  build(plain);
  plain.usePass(false);
  const Picture expected = capture(plain.window);
  build(stage);
  for (const bool openGL : { false, true })
  {
    stage.usePass(true);
    stage.pass->SetBackend(
      openGL ? vtkSVORenderPass::BACKEND_OPENGL : vtkSVORenderPass::BACKEND_CPU);
    checks.expect(difference(expected, capture(stage.window)).largest > 0, "colours: it is traced");
    stage.usePass(false);
    checks.expect(difference(expected, capture(stage.window)).largest == 0,
      "colours: without the pass VTK's own picture");
  }
}

/// Who lets go of the pass, and of its renderer, has freed it.
void release(Checks& checks)
{
  vtkWeakPointer<vtkSVORenderPass> pass;
  {
    Stage stage;
    stage.addGround();
    addRing(stage, true);
    stage.addSun(2.0, -1.5, 4.0);
    stage.pass->SetBackendToOpenGL();
    stage.shadowedByRays();
    pass = stage.pass;
  }
  checks.expect(!pass, "the pass goes");
}

/// Where there is no room in OpenGL's memory the CPU traces the frame, and says so.
void fallBack(Checks& checks)
{
  Stage stage;
  svo::TestMessages messages{ stage.pass };
  stage.addGround();
  addRing(stage, true);
  stage.addSun(2.0, -1.5, 4.0);
  stage.pass->SetBackendToCPU();
  const Picture lit = stage.unshadowed();
  const Picture expected = stage.shadowedByBuffers();
  stage.pass->SetBackendToOpenGL();
  stage.pass->SetGPUMemoryLimit(1);
  const Picture found = stage.shadowedByRays();
  checks.expect(difference(expected, found, awayFromEdges(expected, 2)).mean < 0.5,
    "no room: the picture is complete");
  checks.expect(stage.pass->GetGPUMemory() == 0, "no room: the CPU traces it");
  checks.expect(messages.warnings.size() == 1, "no room: one message: " + messages.all());
  checks.expect(difference(stage.unshadowed(), lit, awayFromEdges(lit, 2)).mean < 0.5,
    "no room, no shadows: the CPU traces it");
  stage.pass->SetGPUMemoryLimit(1 << 20);
  compare("room again", stage, 1, checks);
}

/// With several samples a pixel, and below a pass that reads positions and normals, it is drawn.
void compareElsewhere(Checks& checks)
{
  for (const bool occlusion : { false, true })
  {
    Stage stage;
    stage.addGround();
    addRing(stage, true);
    stage.addSun(2.0, -1.5, 4.0);
    if (occlusion)
    {
      stage.renderer->UseSSAOOn();
      stage.renderer->SetSSAORadius(0.4);
    }
    else
    {
      stage.window->SetMultiSamples(4);
    }
    const std::string name = occlusion ? "ambient occlusion" : "four samples";
    stage.pass->SetBackendToCPU();
    const Picture expected = stage.shadowedByRays();
    stage.pass->SetBackendToOpenGL();
    const Picture found = stage.shadowedByRays();
    const Difference all = difference(expected, found);
    const Difference inside = difference(expected, found, awayFromEdges(expected, 2));
    std::cout << name << ": mean " << all.mean << ", away from edges " << inside.mean << ", p99 "
              << inside.p99 << '\n';
    checks.expect(inside.mean < 0.02, name + ": the CPU's away from edges");
    checks.expect(all.mean < (occlusion ? 0.02 : 0.1), name + ": at edges, too");
  }
}
}

int TestSVOOpenGLEye(int, char*[])
{
  Checks checks;
  compareAll(checks);
  compareCopies(checks);
  compareViewports(checks);
  compareChanges(checks);
  compareElsewhere(checks);
  fallBack(checks);
  leaveColors(checks);
  release(checks);
  return checks.exitCode();
}
