// Samples of the light on surfaces that VTK draws, taken by the CPU and by OpenGL: against closed
// forms of penumbras, and as pictures change, are refined, and have parts of pixels.
// (TestSVOSampledPictures compares them with what the CPU traces.)
#include "../../Unit/svoTestMessages.h"
#include "svoTestStage.h"

#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkLightCollection.h"
#include "vtkPlaneSource.h"
#include "vtkProperty.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace
{
using namespace svotest;

const double Pi = std::acos(-1.0);

/// What of a disc of radius 1 lies beyond a line so far from its middle.
double segment(double c)
{
  c = std::clamp(c, -1.0, 1.0);
  return (std::acos(c) - c * std::sqrt(1.0 - c * c)) / Pi;
}

struct Edge
{
  const char* name;
  double at[3]; // the ball, or the way to the disc
  double size;
  bool ball;
  double turn; // of the half plane, radians
};

/// A light over a half plane at height 1 whose edge goes through the z axis, seen from above
/// without it. A straight edge passes at most 32 of the 16 x 16 cells that samples lie in, whose
/// answers are off by half a sample in the mean square at most.
void expectEdge(const Edge& c, Checks& checks)
{
  constexpr double Half = 1.2; // of what is seen
  constexpr int Pixels = 200;
  const double back = c.ball ? 1.0 / (c.at[2] - 1.0) : 1.0 / c.at[2];
  const double middle[] = { -c.at[0] * back, -c.at[1] * back };
  const auto fill = [&](Stage& stage)
  {
    stage.addGround(5.0);
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(0.0, -6.0, 1.0);
    plane->SetPoint1(6.0, -6.0, 1.0);
    plane->SetPoint2(0.0, 6.0, 1.0);
    stage.add(plane, 0.8, 0.8, 0.8)->RotateZ(c.turn * 180.0 / Pi);
    c.ball ? stage.addBulb(c.at[0], c.at[1], c.at[2]) : stage.addSun(c.at[0], c.at[1], c.at[2]);
    vtkCamera* camera = stage.renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetParallelScale(Half);
    camera->SetPosition(middle[0], middle[1], 50.0);
    camera->SetFocalPoint(middle[0], middle[1], 0.0);
    camera->SetViewUp(0.0, 1.0, 0.0);
    camera->SetClippingRange(49.5, 51.0); // nothing of what casts
  };
  Stage stage(Pixels, Pixels);
  stage.pass->SetFilterLightSamples(false);
  stage.pass->SetMaximumLightSamples(256);
  fill(stage);
  rasterizeAll(stage);
  auto* light = vtkLight::SafeDownCast(stage.renderer->GetLights()->GetItemAsObject(0));
  vtkSVORenderPass::SetLightSize(c.size, light);
  stage.pass->SetShadowTechniqueToNone();
  const Picture all = capture(stage.window);
  stage.pass->SetShadowTechniqueToShadowBuffer();
  for (const bool openGL : { false, true })
  {
    openGL ? stage.pass->SetBackendToOpenGL() : stage.pass->SetBackendToCPU();
    const Picture found = capture(stage.window);
    double square = 0.0;
    std::size_t penumbra = 0;
    for (int i = 0; i < Pixels * Pixels; ++i)
    {
      const double p[] = { middle[0] + Half * (2.0 * (i % Pixels + 0.5) / Pixels - 1.0),
        middle[1] + Half * (2.0 * (i / Pixels + 0.5) / Pixels - 1.0) };
      const double to[] = { c.at[0] - c.ball * p[0], c.at[1] - c.ball * p[1], c.at[2] };
      const double length = std::hypot(to[0], to[1], to[2]);
      // The sine of the way to the light with the plane through the point and the edge.
      const double beyond[] = { std::cos(c.turn), std::sin(c.turn) };
      const double along = p[0] * beyond[0] + p[1] * beyond[1];
      const double sine =
        (to[0] * beyond[0] + to[1] * beyond[1] + to[2] * along) / (length * std::hypot(1.0, along));
      const double share = c.size / length;
      const double rim =
        c.ball ? share / std::sqrt(1.0 - share * share) : std::tan(c.size * Pi / 360.0);
      const double truth = segment(sine / std::sqrt(1.0 - sine * sine) / rim);
      const double off =
        found.grey(static_cast<std::size_t>(i)) / all.grey(static_cast<std::size_t>(i)) - truth;
      square += truth > 0.0 && truth < 1.0 ? off * off : 0.0;
      penumbra += truth > 0.0 && truth < 1.0;
    }
    const double rms = std::sqrt(square / static_cast<double>(std::max<std::size_t>(penumbra, 1)));
    std::cout << c.name << (openGL ? ", OpenGL" : ", CPU") << ": RMS " << rms << " of " << penumbra
              << " pixels in penumbras\n";
    checks.expect(penumbra > 25, std::string(c.name) + ": there are penumbras");
    // And a grey level, of about 200.
    checks.expect(rms < 0.5 * 5.66 / 256 + 0.5 / 200, std::string(c.name) + ": penumbras");
  }
}

/// All that is sampled, on things that are all drawn by VTK.
struct SampledStage : Stage
{
  explicit SampledStage(int edge = 150, bool rasterized = true)
    : Stage(edge, edge)
    , messages{ this->pass }
  {
    this->pass->SetBackendToCPU();
    this->pass->SetFilterLightSamples(false);
    this->pass->SetAmbientOcclusion(true);
    this->pass->SetSkyLight(true);
    this->pass->SetSkyStrength(0.5);
    this->pass->SetMaximumLightSamples(16);
    addThings(*this);
    this->sun = this->addSun(2.0, -1.5, 3.0);
    this->sun->SetIntensity(0.5);
    vtkSVORenderPass::SetLightSize(6.0, this->sun);
    if (rasterized)
    {
      rasterizeAll(*this);
    }
  }

  vtkActor* thing() { return this->renderer->GetActors()->GetLastActor(); }

  svo::TestMessages messages;
  vtkLight* sun;
};

/// Sums do not hang on the steps, and begin anew where something has changed that is seen.
void expectRefined(Checks& checks)
{
  SampledStage fresh;
  const Picture expected = capture(fresh.window);
  SampledStage stage;
  stage.window->SetDesiredUpdateRate(10.0);
  stage.pass->AutoAdjustSampleDistancesOff();
  capture(stage.window);
  checks.expect(stage.pass->GetNumberOfLightSamples() == 4, "few samples while somebody interacts");
  stage.window->SetDesiredUpdateRate(0.001);
  checks.expect(capture(stage.window).rgb == expected.rgb, "sums do not hang on the steps");
  const int rays = stage.pass->GetNumberOfLightSamples();
  checks.expect(capture(stage.window).rgb == expected.rgb && rays == 16, "nothing has changed");

  stage.window->Finalize();
  checks.expect(capture(stage.window).rgb == expected.rgb, "in another context");

  vtkSVORenderPass::SetCastShadow(false, fresh.thing());
  vtkSVORenderPass::SetCastShadow(false, stage.thing());
  const Picture still = capture(fresh.window);
  capture(stage.window);
  stage.thing()->AddPosition(0.3, 0.0, 0.0);
  const Picture moved = capture(stage.window);
  fresh.thing()->AddPosition(0.3, 0.0, 0.0);
  SampledStage other;
  vtkSVORenderPass::SetCastShadow(false, other.thing());
  other.thing()->AddPosition(0.3, 0.0, 0.0);
  checks.expect(moved.rgb == capture(other.window).rgb, "what moves and casts nothing is found");
  stage.thing()->VisibilityOff();
  other.renderer->RemoveActor(other.thing());
  checks.expect(capture(stage.window).rgb == capture(other.window).rgb, "so is what lay behind it");
  checks.expect(difference(still, moved).mean > 0.3, "it is seen");
  checks.expect(stage.messages.errors.empty(), stage.messages.all());
}

/// Straight to an error: of surfaces that are all VTK's there is no other picture than theirs.
void expectError(Checks& checks)
{
  SampledStage stage;
  stage.pass->SetMaximumLightSamples(1024);
  stage.pass->SetLightError(2.0);
  const Picture picture = capture(stage.window);
  const int samples = stage.pass->GetNumberOfLightSamples();
  const double error = stage.pass->GetAcceptedLightError();
  std::cout << "an error of " << error << " after " << samples << " samples\n";
  checks.expect(samples > 4 && samples < 1024, "it ends");
  checks.expect(error > 0.0, "the error is known");
  SampledStage straight;
  straight.pass->SetMaximumLightSamples(samples);
  const Picture once = capture(straight.window);
  checks.expect(once.rgb == picture.rgb, "as so many at once");
}

/// Rays that lie apart, and windows with several samples a pixel: pixels of the mask are others
/// than those that are seen.
void expectParts(Checks& checks)
{
  SampledStage traced(150, false), drawn;
  const Picture one = capture(drawn.window);
  for (SampledStage* stage : { &traced, &drawn })
  {
    stage->window->SetMultiSamples(4);
  }
  const Picture expected = capture(traced.window), found = capture(drawn.window);
  std::size_t dots = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    dots += std::abs(found.grey(i) - expected.grey(i)) > 50.0;
  }
  std::cout << "several samples: " << dots << " of " << found.size() << " are others\n";
  checks.expect(dots <= 3, "parts of pixels");
  SampledStage apart;
  apart.window->SetDesiredUpdateRate(10.0);
  apart.pass->AutoAdjustSampleDistancesOff();
  apart.pass->SetImageReductionFactor(2);
  const Picture coarse = capture(apart.window);
  const Difference off = difference(one, coarse);
  std::size_t wrong = 0; // dark or light by more than what 4 samples in the place of 16 explain
  for (std::size_t i = 0; i < coarse.size(); ++i)
  {
    wrong += std::abs(coarse.grey(i) - one.grey(i)) > 90.0;
  }
  std::cout << "rays apart: off by " << off.mean << " in the mean, " << wrong
            << " by more than 90\n";
  checks.expect(apart.pass->GetImageSampleDistance() == 2.0, "rays lie apart");
  checks.expect(wrong <= 3, "no dots where rays lie apart");
}

/// The same as traced, to a level and but for a ray in 3333, wherever and however large.
void expectExtremes(Checks& checks)
{
  struct Place
  {
    double origin, scale;
  };
  for (const Place& place : { Place{ 0.0, 1.0 }, Place{ 1e6, 1.0 }, Place{ 1e7, 1.0 },
         Place{ 0.0, 1e6 }, Place{ 0.0, 1e-6 } })
  {
    SampledStage traced(150, false), drawn;
    for (SampledStage* stage : { &traced, &drawn })
    {
      vtkCollectionSimpleIterator at;
      vtkActorCollection* actors = stage->renderer->GetActors();
      actors->InitTraversal(at);
      while (vtkActor* actor = actors->GetNextActor(at))
      {
        actor->SetScale(place.scale);
        actor->AddPosition(place.origin, place.origin, place.origin);
      }
      vtkCamera* camera = stage->renderer->GetActiveCamera();
      const auto moved = [&](const double* from, double* to) {
        std::transform(
          from, from + 3, to, [&](double x) { return place.origin + place.scale * x; });
      };
      double to[3];
      moved(camera->GetPosition(), to);
      camera->SetPosition(to);
      moved(camera->GetFocalPoint(), to);
      camera->SetFocalPoint(to);
      stage->renderer->ResetCameraClippingRange();
    }
    const Picture expected = capture(traced.window), found = capture(drawn.window);
    const Mask mask = awayFromEdges(expected, 2);
    std::size_t pixels = 0, others = 0;
    for (std::size_t i = 0; i < mask.size(); ++i)
    {
      pixels += mask[i] != 0;
      others += mask[i] != 0 && std::abs(expected.grey(i) - found.grey(i)) > 1.0;
    }
    std::cout << "at " << place.origin << ", scaled by " << place.scale << ": " << others << " of "
              << pixels << " are others\n";
    checks.expect(pixels > 10000 && others <= 3e-4 * 3 * 16 * static_cast<double>(pixels),
      "as traced, wherever and however large");
  }
}

/// Two sheets, one before the other, that cast nothing; over things that do.
struct Sheets : SampledStage
{
  Sheets()
  {
    this->renderer->SetUseDepthPeeling(true);
    this->renderer->SetOcclusionRatio(0.0);
    for (int i = 0; i < 2; ++i)
    {
      vtkNew<vtkPlaneSource> plane;
      plane->SetOrigin(-1.5, -0.9, 0.9 + 0.2 * i);
      plane->SetPoint1(1.5, -0.9, 0.8 + 0.2 * i);
      plane->SetPoint2(-1.5, 1.6, 0.7 + 0.2 * i);
      this->sheets[i] = this->add(plane, 0.2, 0.3, 0.9);
      vtkSVORenderPass::SetCastShadow(false, this->sheets[i]);
      vtkSVORenderPass::SetUseSVO(false, this->sheets[i]);
    }
  }

  vtkActor* sheets[2];
};

/// What is translucent is lit as if it were opaque, in two layers; and mixed by VTK.
void expectTranslucent(Checks& checks)
{
  for (const bool openGL : { false, true })
  {
    const std::string name = openGL ? "translucent, OpenGL: " : "translucent, CPU: ";
    Sheets stage;
    openGL ? stage.pass->SetBackendToOpenGL() : stage.pass->SetBackendToCPU();
    const auto shown = [&](int sheets)
    {
      for (int i = 0; i < 2; ++i)
      {
        stage.sheets[i]->SetVisibility((sheets >> i & 1) != 0);
      }
      return capture(stage.window);
    };
    const Picture ground = shown(0), low = shown(1), high = shown(2);
    stage.pass->SetAmbientOcclusion(false);
    stage.pass->SetSkyLight(false);
    vtkSVORenderPass::SetLightSize(0.0, stage.sun);
    const Picture hard = shown(1);
    stage.pass->SetAmbientOcclusion(true);
    stage.pass->SetSkyLight(true);
    vtkSVORenderPass::SetLightSize(6.0, stage.sun);
    for (vtkActor* sheet : stage.sheets)
    {
      sheet->GetProperty()->SetOpacity(0.5);
    }
    const Picture found = shown(3);
    checks.expect(stage.pass->GetNumberOfLightSamples() == 16, name + "all samples");
    std::size_t pixels = 0, others = 0;
    double off = 0.0, sampled = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      const bool both = std::abs(low.grey(i) - ground.grey(i)) > 4.0 &&
        std::abs(high.grey(i) - ground.grey(i)) > 4.0;
      const double expected = 0.5 * high.grey(i) + 0.25 * low.grey(i) + 0.25 * ground.grey(i);
      const double difference = std::abs(found.grey(i) - expected);
      pixels += both;
      others += both && difference > 1.5; // what mixing rounds
      off += both ? difference : 0.0;
      sampled += both ? std::abs(hard.grey(i) - low.grey(i)) : 0.0;
    }
    std::cout << name << "of " << pixels << " pixels that show two layers " << others
              << " are others, off by " << off / static_cast<double>(pixels) << " in the mean\n";
    checks.expect(pixels > 1000, name + "there are two layers");
    checks.expect(sampled > 10.0 * static_cast<double>(pixels), name + "samples are seen");
    checks.expect(others <= pixels / 1000, name + "both layers"); // a ray that grazes something
    // More of them, of the same, in steps.
    stage.window->SetDesiredUpdateRate(10.0);
    stage.pass->AutoAdjustSampleDistancesOff();
    stage.sheets[0]->AddPosition(0.0, 0.0, 0.1);
    capture(stage.window);
    stage.sheets[0]->AddPosition(0.0, 0.0, -0.1);
    capture(stage.window);
    checks.expect(stage.pass->GetNumberOfLightSamples() == 4, name + "few samples");
    stage.window->SetDesiredUpdateRate(0.001);
    checks.expect(capture(stage.window).rgb == found.rgb, name + "sums do not hang on the steps");
    checks.expect(stage.messages.errors.empty(), stage.messages.all());
  }
}

/// A light without a size stays what it is: after another size, and beside lights that have one.
void expectSharp(Checks& checks)
{
  for (const bool openGL : { false, true })
  {
    Stage stage;
    addThings(stage);
    rasterizeAll(stage);
    stage.pass->SetShadowTechniqueToShadowBuffer();
    openGL ? stage.pass->SetBackendToOpenGL() : stage.pass->SetBackendToCPU();
    vtkLight* sun = stage.addSun(2.0, -1.5, 3.0);
    const Picture sharp = capture(stage.window);
    vtkSVORenderPass::SetLightSize(8.0, sun);
    const Picture soft = capture(stage.window);
    vtkSVORenderPass::SetLightSize(0.0, sun);
    checks.expect(capture(stage.window).rgb == sharp.rgb, "no size: the picture of before");
    checks.expect(difference(sharp, soft).largest > 50, "a size is seen");
    vtkLight* black = stage.addBulb(1.0, 1.0, 3.0);
    black->SetIntensity(0.0);
    vtkSVORenderPass::SetLightSize(0.5, black);
    const Picture beside = capture(stage.window);
    // OpenGL has rays for all of its lights then.
    checks.expect(
      openGL ? difference(beside, sharp).mean < 0.5 : difference(beside, sharp).largest <= 1,
      "sharp beside a light with a size");
  }
}
}

int TestSVOSoftReceivers(int, char*[])
{
  Checks checks;
  for (const Edge& edge : { Edge{ "disc of 2 degrees", { 0.0, 0.0, 1.0 }, 2.0, false, 0.4 },
         Edge{ "disc of 10 degrees", { 0.0, 0.0, 1.0 }, 10.0, false, 0.4 },
         Edge{ "disc of 25 degrees aside", { 0.3, -0.8, 1.5 }, 25.0, false, 0.0 },
         Edge{ "ball of 0.1", { 0.0, 0.0, 3.0 }, 0.1, true, 0.3 },
         Edge{ "ball of 0.4", { 0.5, 0.3, 4.0 }, 0.4, true, 0.78 },
         Edge{ "ball of 1", { 0.5, 0.3, 4.0 }, 1.0, true, 1.0 } })
  {
    expectEdge(edge, checks);
  }
  expectRefined(checks);
  expectError(checks);
  expectParts(checks);
  expectExtremes(checks);
  expectTranslucent(checks);
  expectSharp(checks);
  return checks.exitCode();
}
