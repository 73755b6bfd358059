#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <cmath>

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
  const int finer = 8;
  const svo::View view = lookAt(From, 96, 64);
  const svo::Frame plain = rendered(ballAndRing(), view, rays(false));
  const svo::Frame smooth = rendered(ballAndRing(), view, rays(true));
  const svo::Frame fine =
    rendered(ballAndRing(), lookAt(From, 96 * finer, 64 * finer), rays(false));
  double errorPlain = 0.0;
  double errorSmooth = 0.0;
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
      const double truth = sum / (finer * finer);
      const std::size_t at = 4 * (std::size_t(y) * 96 + x);
      errorPlain += std::pow(plain.color[at] - truth, 2);
      errorSmooth += std::pow(smooth.color[at] - truth, 2);
    }
  }
  EXPECT_LT(errorSmooth, errorPlain / 4);
}

TEST(AntiAliasing, DoesNotDependOnThreadsOrKeptLayers)
{
  const svo::View view = lookAt(From, 96, 64);
  svo::FrameSettings settings;
  settings.antiAliasing = true;
  settings.shadowResolution = 128;
  const svo::Frame one = rendered(ballAndRing(), view, settings);
  svo::Tracer tracer;
  EXPECT_TRUE(identical(one, rendered(tracer, ballAndRing(), view, settings, raggedFor(7))));
  const svo::Scene scene = ballAndRing();
  rendered(tracer, scene, view, settings);
  EXPECT_TRUE(identical(one, rendered(tracer, scene, view, settings, raggedFor(2))));
}
