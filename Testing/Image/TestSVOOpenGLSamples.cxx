// Ambient occlusion, skies and lights with a size by rays in OpenGL's shaders: what a shadow mask
// says of a plane against closed forms and against the CPU with the same samples, computed and by
// fragments; and pictures of what VTK draws, with samples of either backend, against those that the
// CPU traces.
#include "../Unit/svoClosedForms.h"
#include "../Unit/svoTestMessages.h"
#include "svoFragments.h"
#include "svoImageCases.h"
#include "svoTestStage.h"

#include "svoLightCode.h"
#include "svoOpenGLTracer.h"
#include "svoShadowMask.h"
#include "svoShadowReceivers.h"

#include "vtkActorCollection.h"
#include "vtkCamera.h"
#include "vtkImageData.h"
#include "vtkImageToSVO.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkProperty.h"
#include "vtkTexture.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace
{
using namespace svotest;

/// Rays that pass an edge as closely as floats tell may go either way: the project's bound.
constexpr double MostOther = 3e-4;
constexpr int Samples = 256;
/// As Bar of svoSoftScenes.h, of so many samples: a straight edge passes at most 32 of 16 x 16
/// cells, whose answers are off by half a sample in the mean square at most.
constexpr double EdgeError = 0.5 * 5.66 / Samples;

/// Octrees of unit tests do not know their mesh's bounds: their cubes take their place.
void boundMeshes(const svo::Scene& scene)
{
  for (const svo::Instance& instance : scene.instances)
  {
    auto& header = const_cast<svo::Header&>(instance.body->octree.header());
    for (int i = 0; i < 6; ++i)
    {
      header.meshBounds[i] =
        header.origin[i / 2] + (i % 2) * header.voxelSize * static_cast<double>(1u << header.level);
    }
  }
}

struct Shares
{
  std::vector<double> cpu, computed, fragments;
};

/// What a plane that is seen from above has of numbers first, first + 1 ... of the code, red, green
/// and blue or only one: as the CPU's picture has it, and as the mask says.
Shares sharesOf(vtkOpenGLRenderWindow* window, svo::Scene scene, const svo::View& view,
  svo::FrameSettings settings, bool sky, Checks& checks)
{
  Shares shares;
  const svo::Frame frame = rendered(scene, view, settings);
  boundMeshes(scene);
  scene.instances[0].visible = false;
  settings.lightCode = true;
  const std::unique_ptr<svo::Tracer> tracer = svo::makeOpenGLTracer(svo::makeCPUTracer());
  tracer->render(scene, view, settings, svo::ParallelFor());
  const svo::LightCode& code = tracer->lightCode();
  checks.expect(code.complaint.empty() && code.samples == settings.lightSamples, "there is code");
  std::vector<std::vector<FourFloats>> inputs(1);
  for (std::size_t i = 0; i < static_cast<std::size_t>(view.width * view.height); ++i)
  {
    const glm::vec3 at(view.worldToView * glm::dvec4(onPlane(view, i), 1.0));
    inputs[0].push_back({ at.x, at.y, at.z, 1.0f });
    for (int c = 0; c < (sky ? 3 : 1); ++c)
    {
      shares.cpu.push_back(frame.light[3 * i + static_cast<std::size_t>(c)]);
    }
  }
  for (const svo::ShadowMask::Way way :
    { svo::ShadowMask::Way::Compute, svo::ShadowMask::Way::Fragments })
  {
    svo::ShadowMask mask;
    mask.setWay(way);
    svo::ShadowReceivers looking;
    looking.update(window, mask.lookUp(code, view.width, view.height, false, 1 << 28), 1.0, false);
    checks.expect(looking.gathers(), "a mask: " + mask.refusal());
    mask.find(window->GetState(), code, false,
      [&](int, int)
      {
        drawFragments(window, view.width, inputs, "",
          "  gl_FragData[0] = vec4(texelFetch(input0, at, 0).xyz, 0.0);\n"
          "  gl_FragData[1] = vec4(0.5);\n", // the z axis
          [](vtkShaderProgram*) {});
      });
    looking.activate();
    const std::string number = std::to_string(sky ? code.sky : code.occlusion);
    const std::vector<FourFloats> found =
      runFragments(window, view.width, inputs, looking.declarations(),
        "  vec3 zero = vec3(0.0);\n"
        "  gl_FragData[0].a = svoShown(0.0) + at.x;\n" // else these are not there
        "  for (int i = 0; i < " +
          std::string(sky ? "3" : "1") +
          "; ++i)\n"
          "  {\n"
          "    gl_FragData[0][i] = svoLeft(" +
          number + " + i, zero, zero, zero, zero, 0.0)" + (sky ? " * svoBrightestSky()[i]" : "") +
          ";\n"
          "  }\n",
        [&](vtkShaderProgram* program) { looking.setUniforms(program, true, false); });
    looking.deactivate();
    std::vector<double>& all =
      way == svo::ShadowMask::Way::Compute ? shares.computed : shares.fragments;
    for (const FourFloats& pixel : found)
    {
      all.insert(all.end(), pixel.begin(), pixel.begin() + (sky ? 3 : 1));
    }
    mask.release();
  }
  tracer->releaseGraphicsResources();
  return shares;
}

/// The same rays but for those that pass edges: a ray of N counts 1 / N.
void expectSame(const std::string& name, const Shares& shares, Checks& checks)
{
  for (const std::vector<double>* found : { &shares.computed, &shares.fragments })
  {
    std::size_t other = 0;
    double mean = 0.0;
    for (std::size_t i = 0; i < found->size(); ++i)
    {
      const double off = std::abs((*found)[i] - shares.cpu[i]);
      other += off > 0.5 / Samples;
      mean += off / static_cast<double>(found->size());
    }
    std::cout << "  " << name << ": of " << found->size() << " " << other
              << " have other samples than the CPU; off by " << mean << " in the mean\n";
    checks.expect(found->size() == shares.cpu.size(), name + ": all are found");
    checks.expect(static_cast<double>(other) <= MostOther * Samples * found->size(),
      name + ": the CPU's samples");
    checks.expect(mean <= MostOther + 1.0 / 65535, name + ": the CPU's means");
  }
}

/// Against what is true.
void expectTrue(const std::string& name, const std::vector<double>& expected, const Shares& shares,
  Checks& checks)
{
  for (const std::vector<double>* found : { &shares.computed, &shares.fragments })
  {
    double most = 0.0, square = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      const double off = std::abs(expected[i] - (*found)[i]);
      most = std::max(most, off);
      square += off * off / static_cast<double>(expected.size());
    }
    std::cout << "  " << name << ": RMS " << std::sqrt(square) << ", at most " << most << "\n";
    checks.expect(std::sqrt(square) <= EdgeError, name + ": RMS");
    checks.expect(most <= 3.5 * EdgeError, name + ": the worst pixel");
  }
}

void compareClosedForms(vtkOpenGLRenderWindow* window, Checks& checks)
{
  constexpr double Length = 15.0, Half = 0.5, Height = 2.0;
  svo::FrameSettings settings = sampled(Samples);
  settings.ambientOcclusion = true;
  settings.ambientOcclusionDistance = Unlimited;
  const auto compare = [&](const std::string& name, const svo::Scene& lit, const svo::View& view,
                         const std::function<double(const glm::dvec3&)>& open)
  {
    svo::Scene scene = lit;
    scene.lights.clear();
    const Shares shares = sharesOf(window, scene, view, settings, false, checks);
    expectSame(name, shares, checks);
    expectTrue(name, onPixels(view, open), shares, checks);
  };
  compare("beside a wall", planeUnder({ wall(0.0, 1.0, Length) }),
    fromAbove(1.0, 1.0, 48, 48, { 1.0, 0.5, 0 }),
    [](const glm::dvec3& at)
    { return 1.0 - besideWall(at.x, 1.0, Length - at.y) - besideWall(at.x, 1.0, Length + at.y); });
  compare("in a canyon", planeUnder({ wall(-Half, Height, Length), wall(Half, Height, Length) }),
    fromAbove(Half, Half, 48, 48),
    [](const glm::dvec3& at)
    {
      double open = 1.0;
      for (const double distance : { Half - at.x, Half + at.x })
      {
        open -=
          besideWall(distance, Height, Length - at.y) + besideWall(distance, Height, Length + at.y);
      }
      return open;
    });
  compare("in a box", planeUnder({ caster(closedBox()) }), fromAbove(0.999, 0.999, 48, 48),
    [](const glm::dvec3&) { return 0.0; });
  settings.ambientOcclusionDistance = 1.2;
  compare("under a ceiling", planeUnder({ caster(square(20.0), movedTo(0, 0, 1)) }),
    fromAbove(1.0, 1.0, 48, 48), [](const glm::dvec3&) { return 1.0 / 1.44; });
  svo::Instance glass = caster(square(20.0), movedTo(0, 0, 1));
  glass.opacity = 0.25f;
  settings.ambientOcclusionDistance = Unlimited;
  compare("under glass", planeUnder({ glass }), fromAbove(1.0, 1.0, 48, 48),
    [](const glm::dvec3& at)
    {
      // Beyond its edges, 20 away, the sky is free: 1 / 401 of it, and less.
      return 0.75 + 0.0 * at.x;
    });
}

void compareSkies(vtkOpenGLRenderWindow* window, Checks& checks)
{
  svo::FrameSettings settings = sampled(Samples);
  settings.skyLight = true;
  settings.skyColor = glm::dvec3(0.8, 0.6, 0.4);
  settings.groundColor = glm::dvec3(0.2, 0.3, 0.1);
  for (const glm::dvec3& up : { glm::dvec3(0, 0, 2), glm::dvec3(3, 0, 4), glm::dvec3(0.0) })
  {
    settings.skyUp = up;
    svo::Scene scene = planeUnder({ caster(sphere(24, 48), movedTo(30.0, 0.0, -40.0), 5) });
    scene.lights.clear();
    const svo::View view = fromAbove(2.0, 2.0, 32, 32);
    const Shares shares = sharesOf(window, scene, view, settings, true, checks);
    expectSame("a sky", shares, checks);
    const double cosine = up == glm::dvec3(0.0) ? 0.0 : up.z / glm::length(up);
    const glm::dvec3 open =
      glm::mix(settings.groundColor, settings.skyColor, glm::dvec3(0.5 + cosine / 3.0));
    std::vector<double> expected;
    for (std::size_t i = 0; i < shares.cpu.size(); ++i)
    {
      expected.push_back(open[static_cast<int>(i % 3)]);
    }
    expectTrue("an open sky", expected, shares, checks);
  }
  svo::Scene scene = planeUnder({ wall(0.0, 1.0, 15.0) });
  scene.lights.clear();
  expectSame("a sky beside a wall",
    sharesOf(window, scene, fromAbove(1.0, 1.0, 48, 48, { 1.0, 0.5, 0 }), settings, true, checks),
    checks);
}

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

void addThings(svotest::Stage& stage)
{
  stage.addGround();
  stage.add(box(1.0, -0.7, 0.0, 0.5), 0.9, 0.5, 0.3);
  stage.add(ball(0.5, 0.6, 0.5, 0.5), 0.5, 0.8, 0.4);
  stage.add(ring(0.4, 0.5, -0.8, 0.6), 0.8, 0.8, 0.3)->GetProperty()->SetAmbient(0.3);
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
      addThings(stage);
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
  addThings(stage);
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

int TestSVOOpenGLSamples(int, char*[])
{
  Checks checks;
  svotest::Stage stage(64, 64);
  stage.window->Render();
  auto* context = vtkOpenGLRenderWindow::SafeDownCast(stage.window);
  compareClosedForms(context, checks);
  compareSkies(context, checks);
  comparePictures(checks);
  expectNoDots(false, checks);
  expectNoDots(true, checks);
  expectRefined(checks);
  return checks.exitCode();
}
