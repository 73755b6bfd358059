// Shadow volumes find what rays to the lights find: of meshes that are closed and open, for all
// kinds of lights and views, wherever the eye is.
#include "../../Unit/svoTestMessages.h"
#include "svoImageCases.h"
#include "svoTestStage.h"

#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkDiskSource.h"
#include "vtkImageToSVO.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"
#include "vtkReverseSense.h"
#include "vtkTrivialProducer.h"

#include <cmath>
#include <cstddef>
#include <iostream>
#include <string>

#include <glm/vec3.hpp>

using namespace svotest;

namespace
{
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

/// Solids, one of them mirrored.
void addMirrored(Stage& stage)
{
  addShapes(stage)->SetScale(1.0, 0.5, -1.6);
}

/// With things that have no volume, rays go to these alone.
void compareWithOthers(Checks& checks)
{
  Stage stage;
  addMirrored(stage);
  vtkActor* glass = stage.add(ball(0.6, 0.4, -1.2, 0.9), 0.6, 0.8, 0.9);
  glass->GetProperty()->SetOpacity(0.4);
  const ImageCase ring = distanceCase();
  vtkNew<vtkImageToSVO> surface;
  surface->SetInputData(ring.image);
  surface->SetValue(0, ring.value);
  stage.add(surface, 0.9, 0.5, 0.3)->SetPosition(-0.8, -0.8, 1.4);
  stage.addSun(3.0, -2.0, 4.0);
  stage.addBulb(-1.0, 0.6, 3.5);
  compare("translucent, and without triangles", stage, 40, checks);
  checks.expect(stage.pass->GetNumberOfShadowVolumes() == 10, "they have no volumes");
  stage.window->SetMultiSamples(4);
  compare("several samples", stage, 40, checks);
}

/// Nothing hangs on the frames before.
void compareAgain(Checks& checks)
{
  Stage stage;
  addMirrored(stage);
  vtkLight* bulb = stage.addBulb(-1.0, 0.6, 2.5);
  stage.addSun(3.0, -2.0, 4.0);
  stage.pass->SetBackendToOpenGL();
  vtkActor* last = stage.renderer->GetActors()->GetLastActor();
  for (int i = 0; i < 24; ++i)
  {
    last->AddPosition(0.02, -0.05, 0.0);
    last->RotateZ(i % 3 == 0 ? 20.0 : 0.0);
    bulb->SetPosition(-1.0 + 0.1 * i, 0.6, i % 5 == 0 ? 2.5 : 0.8);
    stage.renderer->GetActiveCamera()->Azimuth(i % 4 == 0 ? 5.0 : 0.0);
    last->SetVisibility(i % 7 != 6);
    stage.pass->SetFrameCoherence(i % 8 != 7);
    if (i == 10)
    {
      stage.window->SetSize(250, 200);
    }
    if (i == 15)
    {
      stage.pass->ReleaseGraphicsResources(stage.window);
    }
    if (i == 18)
    {
      stage.window->Finalize();
    }
    const Picture expected = stage.shadowedByRays();
    const std::size_t others =
      (stage.pass->SetShadowTechniqueToShadowVolumes(), differing(expected, capture(stage.window)));
    const Picture known = capture(stage.window);
    checks.expect(others <= 10, "frame " + std::to_string(i) + ": lit and dark as rays say");
    checks.expect(difference(known, capture(stage.window)).largest == 0, "and once more");
  }
}

/// Casters whose shadows nobody sees have no volumes, and no pixel shows that, wherever lights and
/// eye are.
void compareCulled(Checks& checks)
{
  Stage stage;
  addMirrored(stage);
  for (int i = 0; i < 12; ++i)
  {
    stage.add(ball(0.4, 6.0 * std::cos(0.5 * i), 0.2, 6.0 * std::sin(0.5 * i)), 0.9, 0.7, 0.3);
  }
  vtkLight* sun = stage.addSun(3.0, -2.0, 4.0);
  vtkLight* bulb = stage.addBulb(-1.0, 0.6, 2.5);
  stage.pass->SetBackendToOpenGL();
  vtkCamera* camera = stage.renderer->GetActiveCamera();
  vtkIdType spared = 0;
  for (int i = 0; i < 16; ++i)
  {
    camera->Azimuth(23.0);
    camera->SetParallelProjection(i >= 12);
    camera->Zoom(i % 4 == 3 ? 2.0 : i % 4 == 0 && i > 0 ? 0.5 : 1.0);
    sun->SetPosition(3.0 - i, -2.0, 4.0);
    bulb->SetPosition(-1.0 + 0.4 * i, 0.6, 2.5);
    bulb->SetConeAngle(i % 3 == 2 ? 25.0 : 180.0);
    stage.renderer->ResetCameraClippingRange();
    stage.pass->SetShadowTechniqueToShadowVolumes();
    stage.pass->OcclusionCullingOff();
    const Picture all = capture(stage.window);
    const vtkIdType volumes = stage.pass->GetNumberOfShadowVolumes();
    stage.pass->OcclusionCullingOn();
    const std::string name = "culled, frame " + std::to_string(i);
    checks.expect(difference(all, capture(stage.window)).largest == 0, name + ": the same");
    const vtkIdType left = stage.pass->GetNumberOfCulledInstances(vtkSVORenderPass::CULLED_CASTERS);
    checks.expect(volumes == left + stage.pass->GetNumberOfShadowVolumes(), name + ": counted");
    spared += left;
  }
  std::cout << "culled: " << spared << " volumes less\n";
  checks.expect(spared > 20, "some casters shadow nothing that is seen");
}

/// Of what a shadow falls on nothing is seen; before and behind that something is, past which the
/// eye looks through the shadow.
void compareThrough(Checks& checks)
{
  Stage stage;
  stage.add(ball(1.0, 0.0, 7.0, 0.0), 0.9, 0.7, 0.3);
  vtkNew<vtkPlaneSource> ground;
  ground->SetOrigin(-200.0, 0.0, 200.0);
  ground->SetPoint1(200.0, 0.0, 200.0);
  ground->SetPoint2(-200.0, 0.0, -200.0);
  stage.add(ground, 0.8, 0.8, 0.8);
  stage.addSun(0.0, 1.0, 0.0);
  stage.pass->SetBackendToOpenGL();
  vtkCamera* camera = stage.renderer->GetActiveCamera();
  camera->SetPosition(0.0, 10.0, 28.0);
  camera->SetFocalPoint(0.0, 10.0 - 28.0 * std::tan(0.122), 0.0);
  camera->SetViewUp(0.0, 1.0, 0.0);
  camera->SetViewAngle(12.0);
  stage.renderer->ResetCameraClippingRange();
  const Picture expected = stage.shadowedByRays();
  stage.pass->SetShadowTechniqueToShadowVolumes();
  checks.expect(
    differing(expected, capture(stage.window)) <= 2, "seen through a shadow that falls elsewhere");
  checks.expect(stage.pass->GetNumberOfShadowVolumes() > 0, "which has a volume");
}

/// Nothing is in the way of a light on bare ground, not even where a side of its volume ends, far
/// away, at the centre of a pixel.
void compareFarEnds(Checks& checks)
{
  Stage stage(600, 450);
  vtkNew<vtkPlaneSource> ground;
  ground->SetOrigin(-10.0, -10.0, 0.0);
  ground->SetPoint1(10.0, -10.0, 0.0);
  ground->SetPoint2(-10.0, 10.0, 0.0);
  stage.add(ground, 0.8, 0.8, 0.8);
  vtkLight* bulb = stage.addBulb(0.0, 0.0, 7.0);
  stage.pass->SetBackendToOpenGL();
  vtkCamera* camera = stage.renderer->GetActiveCamera();
  camera->SetPosition(2.0, -14.0, 14.0);
  camera->SetFocalPoint(0.0, 0.0, 0.0);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetViewAngle(30.0);
  stage.renderer->ResetCameraClippingRange();
  std::size_t wrong = 0;
  // Of lights at random places these are some of which pixels were dark.
  for (const glm::dvec3& at :
    { glm::dvec3(5.604358068164121, 0.5667869901086675, 7.918053079894653),
      glm::dvec3(-4.829596779006581, 3.134996600098276, 5.740813919498981),
      glm::dvec3(-0.8913430737732506, 3.7750048859346315, 7.206191870599039),
      glm::dvec3(-1.3827225657990745, 4.316494159087428, 7.83259890742226),
      glm::dvec3(0.562669873744257, 3.5747882553912635, 7.4612056396951445) })
  {
    bulb->SetPosition(at.x, at.y, at.z);
    const Picture lit = stage.unshadowed();
    stage.pass->SetShadowTechniqueToShadowVolumes();
    wrong += differing(lit, capture(stage.window));
    checks.expect(stage.pass->GetNumberOfShadowVolumes() == 1, "the ground has a volume");
  }
  std::cout << "bare ground: " << wrong << " dark pixels\n";
  checks.expect(wrong == 0, "bare ground is lit");
}

void tellsWhatIsMissing(Checks& checks)
{
  Stage stage;
  addMirrored(stage);
  vtkLight* sun = stage.addSun(3.0, -2.0, 4.0);
  stage.pass->SetBackendToCPU();
  const Picture expected = stage.shadowedByRays();
  const auto expectOne = [&](const std::string& words)
  {
    svo::TestMessages messages{ stage.pass };
    const Picture found = capture(stage.window);
    capture(stage.window);
    checks.expect(stage.pass->GetNumberOfShadowVolumes() == 0, words + ": there are none");
    checks.expect(messages.errors.empty() && messages.warnings.size() == 1 &&
        messages.warnings[0].find(words) != std::string::npos,
      words + ": one message, " + messages.all());
    return found;
  };
  stage.pass->SetShadowTechniqueToShadowVolumes();
  checks.expect(
    difference(expected, expectOne("OpenGL draws")).largest == 0, "the CPU's rays in their place");
  stage.pass->SetBackendToAuto();
  stage.window->Render();
  checks.expect(stage.pass->GetActiveBackend() == vtkSVORenderPass::BACKEND_OPENGL &&
      stage.pass->GetNumberOfShadowVolumes() > 0,
    "Auto has OpenGL draw them");
  // Octrees fit, but no mask.
  const vtkIdType whole = stage.pass->GetGPUMemory();
  stage.pass->SetGPUMemoryLimit(static_cast<int>(whole - 1));
  checks.expect(
    differing(expected, expectOne("GPUMemoryLimit")) < 30, "without memory: rays in their place");
  stage.pass->SetGPUMemoryLimit(1 << 20);
  stage.window->Render();
  checks.expect(stage.pass->GetNumberOfShadowVolumes() > 0, "with memory: volumes again");
  vtkSVORenderPass::SetLightSize(3.0, sun);
  stage.pass->SetBackendToOpenGL();
  expectOne("sampled by rays");
  stage.pass->SetBackendToAuto();
  expectOne("OpenGL draws shadow volumes"); // without advice, as they are sampled
  vtkSVORenderPass::SetLightSize(0.0, sun);
  stage.pass->AntiAliasingOn();
  svo::TestMessages messages{ stage.pass };
  capture(stage.window);
  capture(stage.window);
  checks.expect(messages.errors.empty() && messages.warnings.size() == 1 &&
      messages.warnings[0].find("of AntiAliasing it does no more") != std::string::npos,
    "OpenGL smooths nothing, and says so: " + messages.all());
}

/// Octrees of another renderer go where they are in the way of volumes.
void makesRoom(Checks& checks)
{
  Stage left(240, 120);
  left.renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  Stage right(left, 0.5, 0.0, 1.0, 1.0);
  left.add(ring(0.5, -0.8, 0.0, 0.8), 0.3, 0.5, 0.9);
  right.add(ball(0.6, 0.4, 0.0, 1.2), 0.9, 0.5, 0.2);
  svo::TestMessages messages{ left.pass }, others{ right.pass };
  for (Stage* stage : { &left, &right })
  {
    stage->addGround();
    stage->addSun(3.0, -2.0, 4.0);
    stage->pass->SetBackendToOpenGL();
    stage->pass->SetShadowTechniqueToShadowVolumes();
  }
  const Picture expected = capture(left.window);
  const int all = static_cast<int>(right.pass->GetGPUMemory()); // with octrees of both
  for (Stage* stage : { &left, &right })
  {
    stage->pass->SetGPUMemoryLimit(all - 1);
  }
  for (int frame = 0; frame < 2; ++frame)
  {
    checks.expect(difference(expected, capture(left.window)).largest == 0, "the same picture");
    for (const Stage* stage : { &left, &right })
    {
      checks.expect(stage->pass->GetNumberOfShadowVolumes() > 0, "there is room for one's volumes");
      checks.expect(stage->pass->GetGPUMemory() < all, "they stay within the limit");
    }
  }
  checks.expect(messages.warnings.empty() && others.warnings.empty(),
    "nothing is missing: " + messages.all() + others.all());
  for (Stage* stage : { &left, &right })
  {
    stage->pass->SetGPUMemoryLimit(all / 4);
  }
  for (int frame = 0; frame < 2; ++frame)
  {
    checks.expect(differing(expected, capture(left.window)) < 10, "rays in their place");
    checks.expect(left.pass->GetNumberOfShadowVolumes() == 0, "there is no room for one's");
  }
  checks.expect(messages.warnings.size() == 1 && others.warnings.size() == 1,
    "each says so once: " + messages.all() + others.all());
  for (Stage* stage : { &left, &right })
  {
    stage->pass->SetGPUMemoryLimit(all - 1);
  }
  checks.expect(difference(expected, capture(left.window)).largest == 0, "there is room again");
}
}

int TestSVOShadowVolumes(int, char*[])
{
  Checks checks;
  {
    Stage stage;
    addMirrored(stage);
    stage.addSun(3.0, -2.0, 4.0);
    compare("a sun", stage, 10, checks);
    vtkActorCollection* actors = stage.renderer->GetActors();
    actors->InitTraversal();
    while (vtkActor* actor = actors->GetNextActor())
    {
      actor->GetProperty()->EdgeVisibilityOn(); // facets are drawn wider
    }
    compare("with edges", stage, 60, checks);
    actors->InitTraversal();
    while (vtkActor* actor = actors->GetNextActor())
    {
      actor->GetProperty()->EdgeVisibilityOff();
    }
    stage.renderer->GetActiveCamera()->ParallelProjectionOn();
    stage.renderer->GetActiveCamera()->SetParallelScale(2.5);
    compare("parallel", stage, 10, checks);
  }
  {
    Stage stage;
    addMirrored(stage);
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
    addMirrored(stage);
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
    stage.addGround();
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> triangles;
    for (const double z : { std::nan(""), 0.8, 1.2 }) // the octree leaves out the first one
    {
      const vtkIdType first = points->InsertNextPoint(-1.0, -1.0, z);
      points->InsertNextPoint(0.8, -0.5, 1.0);
      points->InsertNextPoint(-0.5, 0.7, 1.0);
      triangles->InsertNextCell({ first, first + 1, first + 2 });
    }
    vtkNew<vtkPolyData> mesh;
    mesh->SetPoints(points);
    mesh->SetPolys(triangles);
    vtkNew<vtkTrivialProducer> source;
    source->SetOutput(mesh);
    stage.add(source, 0.9, 0.3, 0.2);
    stage.addSun(2.0, -1.0, 4.0);
    compare("a triangle that is none", stage, 10, checks);
  }
  {
    Stage stage;
    addMirrored(stage);
    stage.add(box(30.0, 0.0, 14.0, -17.0), 0.5, 0.5, 0.5);
    vtkNew<vtkPlaneSource> roof;
    roof->SetOrigin(-4.0, -9.0, 0.0);
    roof->SetPoint1(4.0, -9.0, 0.0);
    roof->SetPoint2(-4.0, -1.0, 0.0);
    stage.add(roof, 0.5, 0.5, 0.5)->SetPosition(0.0, 0.0, 9.0);
    stage.addSun(0.0, -2.0, 4.0);
    compare("the eye in a shadow", stage, 10, checks);
  }
  {
    Stage stage;
    addMirrored(stage);
    stage.addSun(3.0, -2.0, 4.0);
    vtkActorCollection* actors = stage.renderer->GetActors();
    actors->InitTraversal();
    while (vtkActor* actor = actors->GetNextActor())
    {
      actor->AddPosition(3e4, 0.0, 0.0);
    }
    vtkCamera* camera = stage.renderer->GetActiveCamera();
    camera->SetPosition(
      camera->GetPosition()[0] + 3e4, camera->GetPosition()[1], camera->GetPosition()[2]);
    camera->SetFocalPoint(
      camera->GetFocalPoint()[0] + 3e4, camera->GetFocalPoint()[1], camera->GetFocalPoint()[2]);
    compare("far from the origin", stage, 20, checks);
  }
  compareWithOthers(checks);
  compareAgain(checks);
  compareCulled(checks);
  compareThrough(checks);
  compareFarEnds(checks);
  tellsWhatIsMissing(checks);
  makesRoom(checks);
  return checks.exitCode();
}
