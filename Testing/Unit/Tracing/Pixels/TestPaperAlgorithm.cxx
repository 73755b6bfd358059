// The paper's own steps, written down as literally as they are printed, as a second opinion on the
// whole frame: one Z-buffer table per object, merged into ZBT; the same from the light, merged into
// SZBT; a visible point is in shadow if its distance is greater than the depth in SZBT.
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <limits>

using namespace svotest;

namespace
{
constexpr double Nothing = std::numeric_limits<double>::infinity();

/// Depths of one object as a view sees it, pixel by pixel.
std::vector<double> zTable(const svo::Instance& instance, const svo::View& view)
{
  std::vector<double> table;
  for (int y = 0; y < view.height; ++y)
  {
    for (int x = 0; x < view.width; ++x)
    {
      const svo::Hit hit = hitAlone(instance, view, x, y);
      table.push_back(hit ? hit.t : Nothing);
    }
  }
  return table;
}

std::vector<double> mergedTable(const svo::Scene& scene, const svo::View& view)
{
  std::vector<double> merged(std::size_t(view.width) * view.height, Nothing);
  for (const svo::Instance& instance : scene.instances)
  {
    const std::vector<double> table = zTable(instance, view);
    for (std::size_t i = 0; i < merged.size(); ++i)
    {
      merged[i] = std::min(merged[i], table[i]);
    }
  }
  return merged;
}
}

TEST(PaperAlgorithm, FramesAgreeWithItsStepsWrittenDownLiterally)
{
  svo::Scene scene;
  const auto voxels = svo::LeafGeometry::Voxel;
  scene.instances = { instanceOf(makeOctree(square(3.0), 6), 1, glm::dmat4(1.0), voxels),
    instanceOf(makeOctree(sphere(24, 40), 6), 2, movedTo(-0.8, 0.0, 1.0), voxels),
    instanceOf(makeOctree(torus(40, 24), 6), 3, movedTo(1.2, 0.3, 0.8), voxels) };
  scene.lights = { lightOf(svo::Light::Kind::Point, { 2, -3, 9 }) };
  svo::FrameSettings settings;
  settings.pixelError = 0.0;
  settings.automaticBias = false;
  settings.shadowResolution = 96;
  settings.wholeShadowBuffers = true;
  const svo::View eye = lookAt({ 1, -6, 4 }, 100, 76);
  svo::CPUTracer tracer;
  const svo::Frame frame = rendered(tracer, scene, eye, settings);
  ASSERT_EQ(tracer.shadowMaps().size(), 1u);
  const svo::View light = tracer.shadowMaps()[0].view;
  settings.shadowTechnique = svo::ShadowTechnique::None;
  const svo::Frame unshadowed = rendered(scene, eye, settings);

  const std::vector<double> zbt = mergedTable(scene, eye);
  const std::vector<double> szbt = mergedTable(scene, light);
  int visible = 0;
  int dark = 0;
  int differ = 0;
  for (int y = 0; y < eye.height; ++y)
  {
    for (int x = 0; x < eye.width; ++x)
    {
      const std::size_t at = std::size_t(y) * eye.width + x;
      if (zbt[at] == Nothing)
      {
        differ += frame.instance[at] != ~0u;
        continue;
      }
      ++visible;
      if (unshadowed.color[4 * at] == 0)
      {
        continue; // turned away from the light: nothing is tested
      }
      const glm::dvec3 point =
        eye.rayOrigin(x + 0.5, y + 0.5) + zbt[at] * eye.rayDirection(x + 0.5, y + 0.5);
      const glm::dvec4 seen = light.worldToView * glm::dvec4(point, 1.0);
      const glm::dvec4 clip = light.viewToClip * seen;
      const int u = static_cast<int>(std::floor((clip.x / clip.w + 1.0) / 2.0 * light.width));
      const int v = static_cast<int>(std::floor((clip.y / clip.w + 1.0) / 2.0 * light.height));
      const bool inside = u >= 0 && v >= 0 && u < light.width && v < light.height;
      const bool shadow = inside && -seen.z > szbt[std::size_t(v) * light.width + u];
      dark += shadow;
      differ += shadow != (frame.color[4 * at] == 0);
    }
  }
  EXPECT_GT(visible, 4000);
  EXPECT_GT(dark, 500);
  // A depth or a texel's border that a float decides otherwise.
  EXPECT_LE(differ, visible / 500);
}
