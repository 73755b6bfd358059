#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace svotest;

namespace
{
const glm::dvec3 From(1, -6, 4);

svo::Scene ballAndRing()
{
  svo::Scene scene;
  scene.instances = { instanceOf(makeOctree(square(12.0), 8), 1),
    instanceOf(makeOctree(sphere(40, 64), 8), 2, movedTo(-0.8, 0.0, 1.0)),
    instanceOf(makeOctree(torus(40, 24), 8), 3, movedTo(1.2, 0.3, 0.8)) };
  scene.lights = { lightOf(svo::Light::Kind::Point, { 2, -3, 6 }) };
  scene.instances[1].material.diffuseColor = { 0.9f, 0.2f, 0.1f };
  return scene;
}

svo::FrameSettings rays(bool antiAliasing)
{
  svo::FrameSettings settings;
  settings.shadowTechnique = svo::ShadowTechnique::Rays;
  settings.pixelError = 0.0;
  settings.antiAliasing = antiAliasing;
  return settings;
}

/// Red, 0..255, as the mean of 8 x 8 rays of each of 96 x 64 pixels.
std::vector<double> meanOfRays()
{
  const int finer = 8;
  const svo::Frame fine =
    rendered(ballAndRing(), lookAt(From, 96 * finer, 64 * finer), rays(false));
  std::vector<double> means;
  for (int y = 0; y < 64; ++y)
  {
    for (int x = 0; x < 96; ++x)
    {
      double sum = 0.0;
      for (int j = 0; j < finer; ++j)
      {
        for (int i = 0; i < finer; ++i)
        {
          sum += fine.color[4 * (std::size_t(y * finer + j) * 96 * finer + x * finer + i)];
        }
      }
      means.push_back(sum / (finer * finer));
    }
  }
  return means;
}

/// Sum of squared errors.
double squares(const svo::Frame& frame, const std::vector<double>& truth)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    sum += std::pow(frame.color[4 * i] - truth[i], 2);
  }
  return sum;
}
}

TEST(AntiAliasing, ChangesColoursOfSomePixelsAndNothingElse)
{
  const svo::View view = lookAt(From, 96, 64);
  const svo::Frame plain = rendered(ballAndRing(), view, rays(false));
  const svo::Frame smooth = rendered(ballAndRing(), view, rays(true));
  EXPECT_EQ(plain.depth, smooth.depth);
  EXPECT_EQ(plain.instance, smooth.instance);
  EXPECT_EQ(plain.primitive, smooth.primitive);
  std::size_t changed = 0;
  for (std::size_t i = 0; i < plain.instance.size(); ++i)
  {
    EXPECT_EQ(plain.color[4 * i + 3], smooth.color[4 * i + 3]);
    changed += plain.color[4 * i] != smooth.color[4 * i];
  }
  EXPECT_GT(changed, 200u);
  EXPECT_LT(changed, plain.instance.size() / 4);
}

// The mean of 8 x 8 rays a pixel is the picture that both approach; four rays come much nearer.
TEST(AntiAliasing, BringsEdgesNearerToTheTrueCoverage)
{
  const svo::View view = lookAt(From, 96, 64);
  const svo::Frame plain = rendered(ballAndRing(), view, rays(false));
  const svo::Frame smooth = rendered(ballAndRing(), view, rays(true));
  const std::vector<double> truth = meanOfRays();
  EXPECT_LT(squares(smooth, truth), squares(plain, truth) / 4);
}

// The same with a shadow buffer of few texels, whose steps further rays do not mend.
TEST(AntiAliasing, FilteredShadowsAreNearerToTheTruth)
{
  const svo::View view = lookAt(From, 96, 64);
  svo::FrameSettings settings = rays(true);
  settings.shadowTechnique = svo::ShadowTechnique::Buffer;
  settings.shadowResolution = 64;
  const svo::Frame smooth = rendered(ballAndRing(), view, settings);
  settings.filterShadows = true;
  const svo::Frame filtered = rendered(ballAndRing(), view, settings);
  const std::vector<double> truth = meanOfRays();
  EXPECT_LT(squares(filtered, truth), 0.6 * squares(smooth, truth));
  // A filter alone changes colours, and of few pixels.
  settings.antiAliasing = false;
  const svo::Frame alone = rendered(ballAndRing(), view, settings);
  settings.filterShadows = false;
  const svo::Frame plain = rendered(ballAndRing(), view, settings);
  EXPECT_EQ(plain.depth, alone.depth);
  EXPECT_LT(squares(alone, truth), squares(plain, truth));
  settings.filterShadows = true;
  settings.automaticBias = false;
  const svo::Frame bare = rendered(ballAndRing(), view, settings);
  settings.filterShadows = false;
  EXPECT_TRUE(identical(bare, rendered(ballAndRing(), view, settings)))
    << "the paper's bare test knows yes and no";
}

TEST(AntiAliasing, DoesNotDependOnThreadsOrKeptLayers)
{
  const svo::View view = lookAt(From, 96, 64);
  svo::FrameSettings settings;
  settings.antiAliasing = true;
  settings.shadowResolution = 128;
  const svo::Frame one = rendered(ballAndRing(), view, settings);
  svo::CPUTracer tracer;
  EXPECT_TRUE(identical(one, rendered(tracer, ballAndRing(), view, settings, raggedFor(7))));
  const svo::Scene scene = ballAndRing();
  rendered(tracer, scene, view, settings);
  EXPECT_TRUE(identical(one, rendered(tracer, scene, view, settings, raggedFor(2))));
}

// Points mark the tiles that their filters look up; all others of a map are not traced. At the
// borders of small pictures nobody else marks them.
TEST(AntiAliasing, FiltersLookUpNothingThatNobodyMarked)
{
  svo::FrameSettings settings;
  settings.filterShadows = true;
  for (const int resolution : { 64, 256, 1024 })
  {
    settings.shadowResolution = resolution;
    svo::CPUTracer tracer, whole; // which keep what they can
    svo::Scene scene = ballAndRing();
    for (int frame = 0; frame < 60; ++frame)
    {
      const double turned = 0.4 * (frame / 2);
      const glm::dvec3 from(2.5 * std::cos(turned), 2.5 * std::sin(turned), 3.0);
      const svo::View view = lookAt(from, 24, 16);
      scene.instances.back().localToWorld[3].x += frame % 2 ? 0.02 : 0.0;
      settings.wholeShadowBuffers = false;
      const svo::Frame marked = rendered(tracer, scene, view, settings);
      settings.wholeShadowBuffers = true;
      EXPECT_TRUE(identical(marked, rendered(whole, scene, view, settings)))
        << resolution << " texels, frame " << frame;
    }
  }
}
