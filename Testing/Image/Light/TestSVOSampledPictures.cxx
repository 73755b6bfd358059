// Ambient occlusion, skies and lights with a size on what VTK draws, with samples of either
// backend: pictures against those that the CPU traces.
#include "../../Unit/svoTestMessages.h"
#include "svoImageCases.h"
#include "svoTestStage.h"

#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkImageData.h"
#include "vtkImageToSVO.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkProperty.h"
#include "vtkTexture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iostream>
#include <string>

namespace
{
using namespace svotest;

/// Rays that pass an edge as closely as floats tell may go either way: the project's bound.
constexpr double MostOther = 3e-4;

using Fill = std::function<void(svotest::Stage&)>;

/// A blue sky with a reddish horizon, a sun of four degrees, and a brown ground; up is z.
void addSkyPicture(vtkRenderer* renderer)
{
  constexpr int Columns = 90, Rows = 45;
  vtkNew<vtkImageData> image;
  image->SetDimensions(Columns, Rows, 1);
  image->AllocateScalars(VTK_FLOAT, 3);
  const double blue[] = { 0.3, 0.45, 0.7 }, red[] = { 0.7, 0.5, 0.4 },
               ground[] = { 0.2, 0.15, 0.1 };
  for (int y = 0; y < Rows; ++y)
  {
    for (int x = 0; x < Columns; ++x)
    {
      const double height = std::sin((y + 0.5 - 0.5 * Rows) / Rows * 3.14159265);
      for (int c = 0; c < 3; ++c)
      {
        const double sky = height > 0.0 ? red[c] + height * (blue[c] - red[c]) : ground[c];
        image->SetScalarComponentFromDouble(x, y, 0, c, y == 34 && x == 20 ? 300.0 : sky);
      }
    }
  }
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->SetColorModeToDirectScalars();
  renderer->SetEnvironmentTexture(texture);
  renderer->SetEnvironmentUp(0.0, 0.0, 1.0);
  renderer->SetEnvironmentRight(1.0, 0.0, 0.0);
}

/// Pictures of a scene with its 16 samples, each point by its own, traced, drawn by OpenGL, and
/// left to the rasteriser. Where VTK draws what the CPU traces colours are off by a level; else by
/// what a sample counts.
/// `contour`: the rasteriser has a contour of what is traced, whose colours are others.
void comparePictures(
  const std::string& name, const Fill& fill, Checks& checks, bool contour = false)
{
  constexpr int Few = 16;
  svotest::Stage stage(200, 200);
  svo::TestMessages messages{ stage.pass };
  stage.pass->SetFilterLightSamples(false);
  stage.pass->SetMaximumLightSamples(Few);
  fill(stage);
  stage.pass->SetBackendToCPU();
  const Picture expected = capture(stage.window);
  stage.pass->SetBackendToOpenGL();
  const Picture drawn = capture(stage.window);
  checks.expect(stage.pass->GetNumberOfLightSamples() == Few, name + ": all samples");
  stage.pass->SetBackendToCPU();
  rasterizeAll(stage);
  const Picture rasterized = capture(stage.window);
  checks.expect(stage.pass->GetNumberOfLightSamples() == Few, name + ": all of the CPU's");
  const int of = stage.pass->GetMaximumLightSamples();
  const bool on[] = { stage.pass->GetAmbientOcclusion(), stage.pass->GetSkyLight() };
  stage.pass->SetAmbientOcclusion(false);
  stage.pass->SetSkyLight(false);
  const Picture without = capture(stage.window);
  stage.pass->SetAmbientOcclusion(on[0]);
  stage.pass->SetSkyLight(on[1]);
  const Mask mask = awayFromEdges(expected, 2);
  for (const Picture* found : { &drawn, &rasterized })
  {
    std::size_t pixels = 0, others = 0;
    for (std::size_t i = 0; i < mask.size(); ++i)
    {
      int most = 0;
      for (std::size_t c = 3 * i; c < 3 * i + 3; ++c)
      {
        most = std::max(most, std::abs(int(expected.rgb[c]) - int(found->rgb[c])));
      }
      pixels += mask[i] != 0;
      others += mask[i] != 0 && most > 1;
    }
    const Difference apart = difference(expected, *found, mask);
    std::cout << name << (found == &drawn ? ", OpenGL" : ", rasterised") << ": of " << pixels
              << " pixels " << others << " are off by more than a level; " << apart.mean
              << " in the mean\n";
    checks.expect(others <= MostOther * of * pixels, name + ": as the CPU says");
    checks.expect(apart.mean <= 0.05 || (contour && found == &rasterized), name + ": in the mean");
    checks.expect(difference(without, *found).mean > 2.0, name + ": it is seen");
  }
  checks.expect(messages.errors.empty(), name + ": " + messages.all());
}

void comparePictures(Checks& checks)
{
  const auto with = [](const std::function<void(vtkSVORenderPass*)>& set, const Fill& light)
  {
    return [=](svotest::Stage& stage)
    {
      addThings(stage)->GetProperty()->SetAmbient(0.3);
      set(stage.pass);
      light(stage);
    };
  };
  const auto occlusion = [](vtkSVORenderPass* pass) { pass->SetAmbientOcclusion(true); };
  const auto sky = [](vtkSVORenderPass* pass) { pass->SetSkyLight(true); };
  const auto headlight = [](svotest::Stage&) {};
  const auto sun = [](svotest::Stage& stage) { stage.addSun(2.0, -1.5, 3.0); };
  const auto none = [](svotest::Stage& stage) { stage.renderer->AutomaticLightCreationOff(); };
  comparePictures("occlusion, a headlight", with(occlusion, headlight), checks);
  comparePictures("occlusion, a sun", with(occlusion, sun), checks);
  comparePictures("occlusion without a light", with(occlusion, none), checks);
  comparePictures("occlusion of the ambient part",
    with(
      [](vtkSVORenderPass* pass)
      {
        pass->SetAmbientOcclusion(true);
        pass->SetAmbientOcclusionOfAllLight(false);
      },
      [](svotest::Stage& stage)
      {
        vtkCollectionSimpleIterator at;
        vtkActorCollection* actors = stage.renderer->GetActors();
        actors->InitTraversal(at);
        while (vtkActor* actor = actors->GetNextActor(at))
        {
          actor->GetProperty()->SetAmbient(0.4);
        }
        stage.addSun(2.0, -1.5, 3.0);
      }),
    checks);
  comparePictures("a sky alone", with(sky, none), checks);
  comparePictures("a sky over what casts nothing",
    with(sky,
      [](svotest::Stage& stage)
      {
        vtkCollectionSimpleIterator at;
        vtkActorCollection* actors = stage.renderer->GetActors();
        actors->InitTraversal(at);
        while (vtkActor* actor = actors->GetNextActor(at))
        {
          vtkSVORenderPass::SetCastShadow(false, actor);
        }
        stage.renderer->AutomaticLightCreationOff();
      }),
    checks);
  comparePictures("a sky and a sun", with(sky, sun), checks);
  comparePictures("a sky's picture",
    with(
      [](vtkSVORenderPass* pass)
      {
        pass->SetSkyLight(true);
        pass->SetSkyFromEnvironment(true);
      },
      [](svotest::Stage& stage)
      {
        stage.renderer->AutomaticLightCreationOff();
        addSkyPicture(stage.renderer);
      }),
    checks);
  comparePictures("all, and lights with a size",
    with(
      [](vtkSVORenderPass* pass)
      {
        pass->SetAmbientOcclusion(true);
        pass->SetAmbientOcclusionStrength(0.7);
        pass->SetSkyLight(true);
        pass->SetSkyStrength(0.5);
        pass->SetShadowTechniqueToShadowRays();
      },
      [](svotest::Stage& stage)
      {
        vtkSVORenderPass::SetLightSize(6.0, stage.addSun(2.0, -1.5, 3.0));
        vtkLight* bulb = stage.addBulb(-2.0, -1.5, 3.0);
        bulb->SetIntensity(0.5);
        vtkSVORenderPass::SetLightSize(0.4, bulb);
      }),
    checks);
  comparePictures("a surface that receives none",
    with(
      [](vtkSVORenderPass* pass)
      {
        pass->SetAmbientOcclusion(true);
        pass->SetSkyLight(true);
        pass->SetSkyStrength(0.5);
      },
      [](svotest::Stage& stage)
      {
        vtkSVORenderPass::SetReceiveShadow(false, stage.renderer->GetActors()->GetLastActor());
        stage.addSun(2.0, -1.5, 3.0);
      }),
    checks);
  const ImageCase image = distanceCase();
  comparePictures("an image's surface",
    with(occlusion,
      [&](svotest::Stage& stage)
      {
        vtkNew<vtkImageToSVO> surface;
        surface->SetInputData(image.image);
        surface->SetValue(0, image.value);
        stage.add(surface, 0.9, 0.5, 0.3)->SetPosition(0.0, 0.0, 1.2);
        stage.addSun(2.0, -1.5, 3.0);
      }),
    checks, true);
  comparePictures("what is translucent takes its share",
    with(occlusion,
      [](svotest::Stage& stage)
      {
        stage.add(box(1.0, 0.5, -0.5, 0.7), 0.3, 0.5, 0.9)->GetProperty()->SetOpacity(0.5);
        stage.addSun(2.0, -1.5, 3.0);
      }),
    checks);
}

/// Of pixels with several samples parts show what their centres do not: where things touch there is
/// no light between them.
void expectNoDots(bool sky, Checks& checks)
{
  svotest::Stage stage(400, 300);
  stage.window->SetMultiSamples(4);
  stage.addGround();
  stage.add(ball(0.6, -1.0, 0.0, 0.6), 0.9, 0.5, 0.3);
  stage.add(ball(0.5, 0.3, 0.4, 0.5), 0.5, 0.8, 0.4);
  stage.add(ball(0.4, 0.2, -0.9, 0.4), 0.4, 0.6, 0.9);
  vtkCamera* camera = stage.renderer->GetActiveCamera();
  camera->SetPosition(4.0, -6.0, 4.0);
  camera->SetFocalPoint(0.0, 0.0, 0.5);
  camera->SetViewAngle(20.0);
  stage.renderer->ResetCameraClippingRange();
  std::size_t dots = 0, pixels = 0;
  vtkLight* sun = stage.addSun(-3.0, -2.0, 4.0);
  stage.pass->SetShadowTechniqueToShadowRays();
  stage.pass->SetSkyLight(sky);
  stage.pass->SetAmbientOcclusion(sky);
  for (const double y : { -2.0, 0.0, 3.0 })
  {
    sun->SetPosition(-3.0, y, 4.0);
    stage.pass->SetBackendToCPU();
    const Picture expected = capture(stage.window);
    stage.pass->SetBackendToOpenGL();
    const Picture found = capture(stage.window);
    pixels += found.size();
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      dots += found.grey(i) > expected.grey(i) + 50.0;
    }
  }
  // (1.4e-4 of them where what is as near as what it touches counts as hidden.)
  std::cout << "several samples: " << dots << " dots of " << pixels << " pixels\n";
  checks.expect(dots <= 5e-5 * pixels, "hardly a dot where things touch");
}

/// More samples come while nothing moves, and begin anew when something does.
void expectRefined(Checks& checks)
{
  svotest::Stage stage(120, 120);
  addThings(stage)->GetProperty()->SetAmbient(0.3);
  stage.pass->SetBackendToOpenGL();
  stage.pass->SetFilterLightSamples(false);
  stage.pass->SetAmbientOcclusion(true);
  stage.pass->SetAmbientOcclusionDistance(1.5);
  stage.pass->SetMaximumLightSamples(8);
  const Picture few = capture(stage.window);
  stage.pass->SetMaximumLightSamples(32);
  const Picture at_once = capture(stage.window);
  stage.window->SetDesiredUpdateRate(10.0);
  const Picture moving = capture(stage.window);
  const int first = stage.pass->GetNumberOfLightSamples();
  vtkActor* thing = stage.renderer->GetActors()->GetLastActor();
  thing->AddPosition(0.0, 0.0, 0.2);
  const Picture moved = capture(stage.window);
  checks.expect(stage.pass->GetNumberOfLightSamples() == 4, "few samples while something moves");
  thing->AddPosition(0.0, 0.0, -0.2);
  capture(stage.window);
  stage.window->SetDesiredUpdateRate(0.001);
  const Picture again = capture(stage.window);
  checks.expect(first == 32 && moving.rgb == at_once.rgb, "a picture keeps the samples it has");
  checks.expect(again.rgb == at_once.rgb, "sums of samples do not hang on the steps");
  checks.expect(difference(few, at_once).mean > 0.3, "more samples are seen");
  checks.expect(difference(moved, at_once).mean > 0.3, "what has moved is seen");
}
}

int TestSVOSampledPictures(int, char*[])
{
  Checks checks;
  comparePictures(checks);
  expectNoDots(false, checks);
  expectNoDots(true, checks);
  expectRefined(checks);
  return checks.exitCode();
}
