// With the OpenGL backend VTK draws all that is seen, and its shaders send a ray through the
// octrees to each light: the picture is VTK's own where light comes, and lit or dark as the CPU's
// exact rays say.
#include "../../Unit/svoTestMessages.h"
#include "svoImageCases.h"
#include "svoOpenGL.h"
#include "svoPixelProgram.h"
#include "svoTestStage.h"

#include "vtkActorCollection.h"
#include "vtkElevationFilter.h"
#include "vtkImageToSVO.h"
#include "vtkLight.h"
#include "vtkLookupTable.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

using namespace svotest;

namespace
{
struct Tally
{
  std::size_t pixels = 0, inShadow = 0, other = 0;
};

Tally compare(const Picture& lit, const Picture& expected, const Picture& found)
{
  Tally tally;
  tally.pixels = found.rgb.size() / 3;
  tally.inShadow = differing(lit, expected);
  tally.other = differing(expected, found);
  return tally;
}

void compare(const std::string& name, Stage& stage, double mostOther, Checks& checks)
{
  stage.pass->SetBackendToCPU();
  const Picture lit = stage.unshadowed();
  const Picture expected = stage.shadowedByRays();
  stage.pass->SetBackendToOpenGL();
  const Picture found = stage.shadowedByRays();
  const Tally tally = compare(lit, expected, found);
  std::cout << name << ": " << tally.inShadow << " of " << tally.pixels << " pixels in shadow, "
            << tally.other << " others, " << stage.pass->GetGPUMemory() << " KiB\n";
  checks.expect(tally.inShadow > tally.pixels / 50, name + ": there are shadows");
  checks.expect(stage.pass->GetActiveBackend() == vtkSVORenderPass::BACKEND_OPENGL,
    name + ": OpenGL is at work");
  checks.expect(stage.pass->GetGPUMemory() > 0, name + ": octrees lie in the GPU's memory");
  checks.expect(stage.pass->GetNumberOfPrimaryRays() == 0, name + ": the CPU traces nothing");
  checks.expect(tally.other <= mostOther * tally.pixels, name + ": lit and dark as the CPU says");
}

/// A ball whose colours have alpha from 0 to 1 across it, in steps where `textured`.
void addFading(Stage& stage, bool textured)
{
  vtkNew<vtkElevationFilter> heights;
  heights->SetInputConnection(ball(0.6, 0.4, -1.2, 0.9)->GetOutputPort());
  heights->SetLowPoint(-0.2, 0.0, 0.0);
  heights->SetHighPoint(1.0, 0.0, 0.0);
  vtkNew<vtkLookupTable> fading;
  fading->SetNumberOfTableValues(textured ? 6 : 64);
  for (int i = 0; i < fading->GetNumberOfTableValues(); ++i)
  {
    fading->SetTableValue(i, 0.6, 0.8, 0.9, i / (fading->GetNumberOfTableValues() - 1.0));
  }
  vtkMapper* mapper = stage.add(heights, 0.6, 0.8, 0.9)->GetMapper();
  mapper->ScalarVisibilityOn();
  mapper->SetLookupTable(fading);
  mapper->SetInterpolateScalarsBeforeMapping(textured);
}

void addCrowd(Stage& stage, int across)
{
  const vtkSmartPointer<vtkAlgorithm> one = box(0.16, 0.0, 0.0, 0.0);
  for (int i = 0; i < across * across; ++i)
  {
    vtkActor* actor = stage.add(one, 0.3 + 0.03 * (i % 20), 0.6, 0.9 - 0.03 * (i % 17));
    const double x = i % across - 0.5 * (across - 1);
    const double y = i / across - 0.5 * (across - 1);
    actor->SetPosition(0.28 * x, 0.28 * y, 0.1 + 0.02 * (i * 7 % 23));
    actor->RotateWXYZ(37.0 * i, 0.3, 0.5, 1.0);
  }
}

/// What was sent stays, moves, goes with the context and comes again.
void compareAgain(Stage& stage, Checks& checks)
{
  const Picture expected = stage.shadowedByRays();
  const vtkIdType memory = stage.pass->GetGPUMemory();
  vtkActor* last = stage.renderer->GetActors()->GetLastActor();
  for (int i = 0; i < 20; ++i)
  {
    last->AddPosition(0.1, 0.0, 0.0);
    stage.window->Render();
  }
  checks.expect(difference(expected, capture(stage.window)).largest > 30, "the object has moved");
  checks.expect(stage.pass->GetGPUMemory() == memory, "memory does not grow with movements");
  last->AddPosition(-2.0, 0.0, 0.0);
  for (int i = 0; i < 20; ++i)
  {
    stage.pass->SetBackend(i % 2 == 0 ? stage.pass->BACKEND_CPU : stage.pass->BACKEND_OPENGL);
    stage.window->Render();
  }
  checks.expect(difference(expected, capture(stage.window)).largest <= 1, "as it was");
  checks.expect(stage.pass->GetGPUMemory() == memory, "memory does not grow with switches");
  stage.window->Finalize();
  checks.expect(difference(expected, capture(stage.window)).largest <= 1, "in a new context");
  stage.pass->ReleaseGraphicsResources(stage.window);
  checks.expect(difference(expected, capture(stage.window)).largest <= 1, "sent again");
}

/// Frames that shaders cannot light: they have the CPU's shadows, and that is said once.
void expectCPU(const std::string& name, Stage& stage, const Picture& lit, const Picture& expected,
  const std::string& why, Checks& checks)
{
  svo::TestMessages messages{ stage.pass };
  const Picture found = stage.shadowedByRays();
  capture(stage.window);
  const Tally tally = compare(lit, expected, found);
  std::cout << name << ": " << tally.inShadow << " pixels in shadow, " << tally.other << " others; "
            << messages.all() << "\n";
  checks.expect(tally.inShadow > tally.pixels / 50, name + ": there are shadows");
  checks.expect(tally.other < tally.inShadow / 10, name + ": they are the same");
  checks.expect(stage.pass->GetGPUMemory() == 0, name + ": nothing is there");
  checks.expect(messages.errors.empty() && messages.warnings.size() == 1 &&
      messages.warnings[0].find(why) != std::string::npos,
    name + ": one message");
}

void fallBack(Checks& checks)
{
  Stage stage;
  addShapes(stage);
  vtkLight* sun = stage.addSun(3.0, -2.0, 4.0);
  const Picture lit = stage.unshadowed();
  stage.pass->SetBackendToOpenGL();
  const Picture expected = stage.shadowedByRays();
  stage.pass->SetGPUMemoryLimit(1);
  expectCPU("without memory", stage, lit, expected, "GPUMemoryLimit", checks);
  stage.pass->SetGPUMemoryLimit(1 << 20);
  checks.expect(
    difference(expected, stage.shadowedByRays()).largest <= 1, "with memory: rays again");
  // A mask takes 32 bytes a pixel here.
  svo::TestMessages messages{ stage.pass };
  const vtkIdType whole = stage.pass->GetGPUMemory();
  stage.pass->SetGPUMemoryLimit(static_cast<int>(whole - 1));
  const Tally unmasked = compare(lit, expected, stage.shadowedByRays());
  const vtkIdType octrees = stage.pass->GetGPUMemory();
  std::cout << "without memory for a mask: " << octrees << " of " << whole << " KiB, "
            << unmasked.other << " pixels others; " << messages.all() << "\n";
  checks.expect(
    octrees > 0 && octrees <= whole - 32 * 300 * 300 / 1024, "a mask counts in the memory");
  checks.expect(unmasked.other < unmasked.pixels / 3000, "without one: the same shadows");
  checks.expect(messages.all().empty(), "nothing is to be said");
  stage.pass->SetGPUMemoryLimit(1 << 20);
  stage.shadowedByRays();
  checks.expect(stage.pass->GetGPUMemory() == whole, "with memory: a mask again");
  vtkSVORenderPass::SetCastShadow(false, sun);
  const Picture unlit = capture(stage.window);
  stage.usePass(false);
  checks.expect(unlit.rgb == capture(stage.window).rgb, "no light casts: VTK's own picture");
}
}

int TestSVOOpenGLRays(int, char*[])
{
  Checks checks;
  // Where a surface ends, and a shadow, the rasteriser and rays may differ by a pixel.
  constexpr double AtEdges = 3e-4;
  {
    Stage stage;
    addShapes(stage);
    stage.addSun(3.0, -2.0, 4.0);
    compare("a sun", stage, AtEdges, checks);
    compareAgain(stage, checks);
    const std::string version = reinterpret_cast<const char*>(glGetString(GL_VERSION));
    const bool computes = svo::PixelProgram::hasCompute();
    std::cout << version << (computes ? ": compute shaders ask\n" : ": fragments ask\n");
    const char* asked = std::getenv("MESA_GL_VERSION_OVERRIDE");
    const bool least =
      asked && asked == std::string("3.2") && version.find("Mesa") < version.size();
    checks.expect(!least || !computes, "OpenGL 3.2 has no compute shaders");
  }
  {
    Stage stage;
    addShapes(stage);
    stage.addSun(3.0, -2.0, 4.0);
    stage.addBulb(-1.0, 0.6, 2.5);
    compare("a sun and a bulb", stage, AtEdges, checks);
    stage.window->SetMultiSamples(4);
    compare("several samples", stage, AtEdges, checks);
  }
  {
    Stage stage;
    addShapes(stage);
    vtkActor* glass = stage.add(ball(0.6, 0.4, -1.2, 0.9), 0.6, 0.8, 0.9);
    glass->GetProperty()->SetOpacity(0.4);
    stage.addSun(3.0, -2.0, 4.0);
    compare("a translucent ball", stage, AtEdges, checks);
  }
  for (const bool textured : { false, true })
  {
    Stage stage;
    addShapes(stage);
    stage.addSun(3.0, -2.0, 4.0);
    addFading(stage, textured);
    compare(textured ? "steps of alpha" : "alpha", stage, AtEdges, checks);
    stage.renderer->GetActors()->GetLastActor()->GetMapper()->ScalarVisibilityOff();
    stage.window->Render();
    checks.expect(glGetError() == GL_NO_ERROR, "no colour has alpha any more: OpenGL complains");
  }
  {
    Stage stage;
    stage.addGround();
    addCrowd(stage, 20);
    stage.addSun(3.0, -2.0, 4.0);
    compare("400 boxes", stage, 2e-3, checks); // edges are all that there is to them
  }
  {
    Stage stage;
    stage.addGround();
    vtkActor* metal = stage.add(ball(0.6, 0.0, 0.0, 0.8), 0.9, 0.7, 0.3);
    metal->GetProperty()->SetInterpolationToPBR();
    metal->GetProperty()->SetMetallic(0.6);
    metal->GetProperty()->SetRoughness(0.3);
    stage.add(ring(0.5, 1.2, -0.6, 0.6), 0.3, 0.4, 0.9)->GetProperty()->EdgeVisibilityOn();
    stage.addBulb(2.0, -1.5, 4.0);
    compare("what the CPU does not trace", stage, AtEdges, checks);
  }
  {
    Stage stage;
    stage.addGround();
    const ImageCase ring = distanceCase();
    vtkNew<vtkImageToSVO> surface;
    surface->SetInputData(ring.image);
    surface->SetValue(0, ring.value);
    stage.add(surface, 0.9, 0.5, 0.3)->SetPosition(0.0, 0.0, 1.2);
    stage.addSun(3.0, -2.0, 4.0);
    compare("an image's surface", stage, AtEdges, checks);
  }
  for (const double height : { 1e-7, 1e-9 })
  {
    Stage stage;
    stage.addGround();
    stage.add(box(0.7, 0.2, 0.0, 0.4), 0.9, 0.3, 0.2); // its sides stand on the sheet's plane
    vtkActor* sheet = stage.add(ball(0.5, 0.0, 0.0, 0.0), 0.9, 0.5, 0.3);
    sheet->SetScale(1.0, 1.0, height);
    sheet->SetPosition(0.2, -0.3, 1.2);
    sheet->GetProperty()->LightingOff();
    stage.addSun(1.0, -1.5, 4.0);
    compare(
      "flattened by a power of 10, " + std::to_string(std::log10(height)), stage, AtEdges, checks);
  }
  fallBack(checks);
  return checks.exitCode();
}
