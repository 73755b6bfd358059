// Pictures that show the last one's pixels again: nothing is further from its place than was
// promised, what was hidden is traced, and what is still, or has changed, is exact.
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <vector>

using namespace svotest;

namespace
{
constexpr int Width = 250, Height = 180;

/// A ball, a ring and a ground, each of one colour.
svo::Scene plainScene()
{
  svo::Scene scene = ballRingAndGround();
  const glm::vec3 colors[] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  for (int i = 0; i < 3; ++i)
  {
    scene.instances[i].material.ambientColor = scene.instances[i].material.diffuseColor = colors[i];
    scene.instances[i].material.lighting = false;
  }
  stamp(scene);
  return scene;
}

struct Walker
{
  std::unique_ptr<svo::Tracer> tracer = svo::makeCPUTracer();
  svo::FrameSettings settings;

  explicit Walker(double error)
  {
    this->settings.imageCacheError = error;
    this->settings.mayWarp = true;
  }
  const svo::Frame& draw(const svo::Scene& scene, const svo::View& view)
  {
    this->tracer->render(scene, view, this->settings, raggedFor(3));
    return this->tracer->frame();
  }
  double shown() const { return this->tracer->statistics().warpedShare; }
};

/// Forward, backward, around and aside; the eye turns meanwhile.
svo::View viewOf(int path, int frame, double speed)
{
  const double s = speed * frame;
  const glm::dvec3 at(0.3 * std::sin(s), 0.2 * s, 0.5);
  switch (path)
  {
    case 0:
      return lookAt({ 3.0 - 0.4 * s, -5.0 + 0.8 * s, 3.0 }, Width, Height, 40.0, at);
    case 1:
      return lookAt({ 2.0 + 0.3 * s, -3.5 - 0.6 * s, 2.0 }, Width, Height, 40.0, at);
    case 2:
      return lookAt({ 5.0 * std::sin(s), -5.0 * std::cos(s), 2.5 }, Width, Height);
    default:
      return lookAt({ 3.0 - s, -4.0, 1.5 }, Width, Height, 50.0, { 1.0 - s, 0.0, 0.7 });
  }
}

/// Pixels, but for the border's, whose colour, or nothing, the other picture has nowhere within so
/// many pixels.
int displaced(const svo::Frame& mine, const svo::Frame& exact, int pixels)
{
  const auto colorAt = [](const svo::Frame& frame, int x, int y)
  {
    std::uint32_t color;
    std::memcpy(&color, &frame.color[4 * (static_cast<std::size_t>(y) * Width + x)], 4);
    return color;
  };
  int count = 0;
  const int side = 2 * pixels + 1;
  for (int y = pixels; y < Height - pixels; ++y)
  {
    for (int x = pixels; x < Width - pixels; ++x)
    {
      bool near = false;
      for (int k = 0; k < side * side && !near; ++k)
      {
        near = colorAt(exact, x + k % side - pixels, y + k / side - pixels) == colorAt(mine, x, y);
      }
      count += !near;
      const std::size_t pixel = static_cast<std::size_t>(y) * Width + x;
      EXPECT_EQ(mine.depth[pixel] < 1.0f, mine.color[4 * pixel + 3] != 0);
    }
  }
  return count;
}

void expectSame(const svo::Frame& mine, const svo::Frame& exact, const std::string& what)
{
  EXPECT_TRUE(mine.color == exact.color) << what;
  EXPECT_TRUE(mine.depth == exact.depth) << what;
}
}

TEST(ImageCache, NothingIsFurtherFromItsPlaceThanAPixel)
{
  const svo::Scene scene = plainScene();
  int beyond = 0;
  for (int path = 0; path < 4; ++path)
  {
    for (const double speed : { 0.002, 0.02 })
    {
      Walker cached(1.0), exact(0.0);
      double shown = 0.0;
      for (int frame = 0; frame < 40; ++frame)
      {
        const svo::View view = viewOf(path, frame, speed);
        const svo::Frame& mine = cached.draw(scene, view);
        const svo::Frame& truth = exact.draw(scene, view);
        beyond += displaced(mine, truth, 1);
        EXPECT_EQ(displaced(mine, truth, 2), 0)
          << "path " << path << ", speed " << speed << ", frame " << frame;
        EXPECT_EQ(exact.shown(), 0.0);
        EXPECT_EQ(cached.shown() > 0.0, frame > 0);
        shown += cached.shown();
      }
      EXPECT_GT(shown, 40 * 0.7);
    }
  }
  // Few, where a surface turns towards the eye at its outline.
  RecordProperty("PixelsBeyondTheError", beyond);
  EXPECT_LT(beyond, 1e-5 * 320 * Width * Height);
}

TEST(ImageCache, HalfAPixelShowsLess)
{
  const svo::Scene scene = plainScene();
  Walker wide(1.0), narrow(0.1);
  for (int frame = 0; frame < 10; ++frame)
  {
    wide.draw(scene, viewOf(0, frame, 0.02));
    narrow.draw(scene, viewOf(0, frame, 0.02));
  }
  EXPECT_GT(narrow.shown(), 0.3);
  EXPECT_LT(narrow.shown(), wide.shown());
  EXPECT_EQ(wide.tracer->statistics().warpError, 1.0);
  EXPECT_EQ(narrow.tracer->statistics().warpError, 0.5);
}

TEST(ImageCache, WhatIsStillOrHasChangedIsExact)
{
  using Change = std::function<void(svo::Scene&)>;
  const std::vector<std::pair<std::string, Change>> changes = {
    { "place", [](svo::Scene& s) { s.instances[1].localToWorld = movedTo(-0.7, 0.1, 1.0); } },
    { "colour", [](svo::Scene& s) { s.instances[2].material.diffuseColor.r = 0.5f; } },
    { "light", [](svo::Scene& s) { s.lights[0].position.x += 0.1; } },
    { "fewer", [](svo::Scene& s) { s.instances.pop_back(); } },
  };
  svo::Scene scene = stamped(ballRingAndGround());
  for (const auto& [what, change] : changes)
  {
    Walker cached(1.0);
    for (int frame = 0; frame < 5; ++frame)
    {
      cached.draw(scene, viewOf(2, frame, 0.01));
    }
    EXPECT_GT(cached.shown(), 0.5);
    // The same view, still; then one in which something has changed.
    cached.settings.mayWarp = false;
    expectSame(
      cached.draw(scene, viewOf(2, 4, 0.01)), Walker(0.0).draw(scene, viewOf(2, 4, 0.01)), "still");
    cached.settings.mayWarp = true;
    cached.draw(scene, viewOf(2, 5, 0.01));
    EXPECT_GT(cached.shown(), 0.5) << "what was still is shown again";
    change(scene);
    stamp(scene);
    for (const int frame : { 5, 6 }) // of the same view, and another
    {
      Walker fresh(0.0);
      const svo::View view = viewOf(2, 5, 0.01);
      const svo::Frame& exact = fresh.draw(scene, view);
      expectSame(cached.draw(scene, view), exact, what + (frame == 5 ? ", the same view" : ""));
      EXPECT_EQ(cached.shown(), 0.0);
      cached.draw(scene, viewOf(2, 7, 0.01));
      cached.tracer->releaseLayers();
    }
  }
}

TEST(ImageCache, ParallelViewsAreTraced)
{
  const svo::Scene scene = plainScene();
  Walker cached(1.0);
  for (int frame = 0; frame < 3; ++frame)
  {
    const svo::View view = lookAtParallel({ 3.0 + 0.01 * frame, -5, 4 }, Width, Height, 2.0);
    Walker fresh(0.0);
    expectSame(cached.draw(scene, view), fresh.draw(scene, view), "parallel");
  }
}
