// Ambient occlusion, skies and lights with a size by rays in OpenGL's shaders: what a shadow mask
// says of a plane against closed forms and against the CPU with the same samples, computed and by
// fragments. (TestSVOSampledPictures compares pictures.)
#include "../../Unit/svoClosedForms.h"
#include "svoFragments.h"
#include "svoTestStage.h"

#include "svoLightCode.h"
#include "svoOpenGLTracer.h"
#include "svoShadowMask.h"
#include "svoShadowReceivers.h"

#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"

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
  for (const svo::ShadowMask::Method way :
    { svo::ShadowMask::Method::Compute, svo::ShadowMask::Method::Fragments })
  {
    svo::ShadowMask mask;
    mask.setMethod(way);
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
      way == svo::ShadowMask::Method::Compute ? shares.computed : shares.fragments;
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
}

int TestSVOOpenGLSamples(int, char*[])
{
  Checks checks;
  svotest::Stage stage(64, 64);
  stage.window->Render();
  auto* context = vtkOpenGLRenderWindow::SafeDownCast(stage.window);
  compareClosedForms(context, checks);
  compareSkies(context, checks);
  return checks.exitCode();
}
