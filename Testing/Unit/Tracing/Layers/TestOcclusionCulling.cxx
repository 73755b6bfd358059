// Instances that a loose octree finds outside of a view, or that are left out of groups of tiles
// because others hide them: every hit, and every picture, is what it is without that, to the bit,
// in random crowds with awkward places, matrices and views.
#include "svoInstanceTree.h"
#include "svoLayeredView.h"
#include "svoRandomScenes.h"
#include "svoTracer.h"
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

using namespace svotest;

namespace
{
class Random
{
public:
  explicit Random(unsigned seed)
    : Engine(seed)
  {
  }
  double in(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(this->Engine);
  }
  int upTo(int last) { return std::uniform_int_distribution<int>(0, last)(this->Engine); }
  bool once(int in) { return this->upTo(in - 1) == 0; }
  glm::dvec3 point(double reach)
  {
    const double x = this->in(-reach, reach), y = this->in(-reach, reach);
    return { x, y, this->in(-reach, reach) };
  }

private:
  std::mt19937 Engine;
};

/// Their octrees, with triangles from many pixels to parts of one.
struct Shapes
{
  std::vector<Mesh> meshes{ sphere(8, 12), sphere(60, 80), torus(40, 30), soup(200, 0.4, 3),
    square(1.0) };
  std::vector<svo::Octree> octrees;
  Shapes()
  {
    for (const Mesh& mesh : this->meshes)
    {
      this->octrees.push_back(makeOctree(mesh, 7));
    }
  }
};

glm::dmat4 place(Random& random, double size)
{
  glm::dmat4 m = glm::translate(glm::dmat4(1.0), size * random.point(2.0));
  m = glm::rotate(m, random.in(0.0, 6.0), random.point(1.0) + glm::dvec3(0.0, 0.0, 1.5));
  glm::dvec3 scale(random.in(0.2, 1.0));
  if (random.once(4))
  {
    scale *= glm::dvec3(1.0, random.in(0.05, 1.0), random.once(2) ? -1.0 : 1.0); // mirrored
  }
  if (random.once(20))
  {
    scale *= random.once(2) ? 1e-6 : 1e6;
  }
  if (random.once(60))
  {
    scale[random.upTo(2)] = random.once(2) ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  }
  m = glm::scale(m, size * scale);
  if (random.once(5))
  {
    m[1] += random.in(-1.0, 1.0) * m[0]; // sheared
  }
  return m;
}

svo::Scene crowd(Random& random, const Shapes& shapes, double size)
{
  svo::Scene scene;
  const int count = 5 + random.upTo(random.once(3) ? 200 : 60);
  for (int i = 0; i < count; ++i)
  {
    const int shape = random.upTo(static_cast<int>(shapes.meshes.size()) - 1);
    const bool again = i > 0 && random.once(10); // the same place once more
    const glm::dmat4 m = again ? scene.instances.back().localToWorld : place(random, size);
    scene.instances.push_back(instanceOf(shapes.octrees[shape], i + 1, m));
    scene.instances.back().body.own().points.doubles = &shapes.meshes[shape].points.data()->x;
    scene.instances.back().body.own().points.count = shapes.meshes[shape].points.size();
  }
  return scene;
}

svo::View viewOf(Random& random, double size)
{
  svo::View view;
  const int width = 40 + random.upTo(160), height = 40 + random.upTo(120);
  // In an object, near the near plane, or beyond all of them.
  const glm::dvec3 eye = size * random.point(random.once(4) ? 1.0 : 6.0);
  const glm::dmat4 camera = glm::lookAt(
    eye, eye + size * (random.point(1.0) - eye / size), random.point(1.0) + glm::dvec3(0, 0, 3));
  const double aspect = static_cast<double>(width) / height, far = 40.0 * size;
  if (random.once(3))
  {
    const double half = size * random.in(0.5, 4.0);
    svo::makeView(camera, glm::ortho(-half * aspect, half * aspect, -half, half, 0.0, far), width,
      height, view);
  }
  else
  {
    const double near = size * random.in(0.01, 1.0), half = near * random.in(0.2, 1.0);
    const double x = random.in(-half, half), y = random.in(-half, half); // off centre, as of tiles
    // Depths are not counted from the eye, as with explicit projections.
    const double apart = random.once(3) ? size * random.in(-3.0, 3.0) : 0.0;
    const glm::dvec3 along(0.0, 0.0, apart);
    svo::makeView(glm::translate(glm::dmat4(1.0), -along) * camera,
      glm::frustum(x - half * aspect, x + half * aspect, y - half, y + half, near, far) *
        glm::translate(glm::dmat4(1.0), along),
      width, height, view);
  }
  return view;
}

void trace(const svo::Scene& scene, const svo::View& view, const svo::LooseOctree* tree,
  bool culling, svo::LayeredView& layers)
{
  svo::LayerBudget budget{ std::size_t(1) << 28, 0 };
  svo::Culling cull;
  cull.tree = tree;
  cull.occlusion = culling;
  layers.setCulling(cull);
  layers.prepare(
    scene, view, [](const svo::Instance&) { return true; },
    [](const svo::Instance& i, const svo::LocalView&) { return i.body->octree.level(); }, false,
    budget);
  layers.trace(svo::serialFor, nullptr);
}
}

TEST(OcclusionCulling, ChangesNoBit)
{
  const Shapes shapes;
  const unsigned scenes = scenesOr(400);
  std::size_t hits = 0, fewer = 0, trees = 0;
  for (unsigned seed = 0; seed < scenes; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const double size = random.once(6) ? std::pow(10.0, random.in(-6.0, 6.0)) : 1.0;
    const svo::Scene scene = crowd(random, shapes, size);
    const svo::View view = viewOf(random, size);
    const bool exact = !random.once(3); // or as for lights
    svo::LayeredView with(exact), without(exact);
    svo::InstanceTree tree;
    tree.follow(scene, svo::SceneFollower().follow(scene), svo::serialFor);
    trees += tree.tree() != nullptr;
    trace(scene, view, tree.tree(), true, with);
    trace(scene, view, nullptr, false, without);
    const svo::DepthBuffer &a = with.hits().depth, &b = without.hits().depth;
    ASSERT_EQ(a.hit, b.hit);
    for (std::size_t tile = 0; tile < a.tiles(); ++tile)
    {
      if (!a.hit[tile])
      {
        continue;
      }
      for (std::size_t i = 64 * tile; i < 64 * (tile + 1); ++i)
      {
        ASSERT_EQ(a.instance[i], b.instance[i]);
        if (a.instance[i] != svo::NoInstance)
        {
          ++hits;
          ASSERT_EQ(a.primitive[i], b.primitive[i]);
          ASSERT_EQ(std::memcmp(&a.t[i], &b.t[i], sizeof(float)), 0);
        }
      }
    }
    fewer += with.spared().hidden > 0;
    ASSERT_EQ(without.spared().hidden, 0u);
  }
  // Else nothing would have been tested.
  EXPECT_GT(hits, 1000u * scenes);
  EXPECT_GT(10 * fewer, scenes);
  EXPECT_GT(10 * trees, scenes);
}

namespace
{
svo::Light lightOf(Random& random, double size)
{
  svo::Light light;
  light.kind = random.once(2) ? svo::Light::Kind::Point : svo::Light::Kind::Directional;
  light.position = size * (random.point(2.0) + glm::dvec3(0.0, 0.0, 6.0));
  light.direction = glm::normalize(random.point(1.0) - glm::dvec3(0.0, 0.0, 1.5));
  light.castShadow = true;
  light.id = 1 + static_cast<std::uint64_t>(random.upTo(1));
  return light;
}

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b)
{
  return a.size() == b.size() &&
    (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}
}

TEST(OcclusionCulling, ChangesNoBitOfPicturesShadowsAndNames)
{
  const Shapes shapes;
  const unsigned scenes = scenesOr(40);
  std::uint64_t outside = 0, hidden = 0, casters = 0;
  std::size_t covered = 0;
  // And one in which a point is dark or lit by which others ask with it.
  constexpr unsigned Known = 4753;
  for (unsigned k = 0; k <= scenes; ++k)
  {
    const unsigned seed = k < scenes ? k : Known;
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(1000000 + seed);
    const double size = random.once(6) ? std::pow(10.0, random.in(-6.0, 6.0)) : 1.0;
    svo::Scene scene = crowd(random, shapes, size);
    scene.lights.push_back(lightOf(random, size));
    svo::View view = viewOf(random, size);
    svo::FrameSettings settings;
    settings.shadowResolution = 128;
    settings.antiAliasing = random.once(5);
    settings.shadowTechnique =
      random.once(4) ? svo::ShadowTechnique::Rays : svo::ShadowTechnique::Buffer;
    const auto with = svo::makeCPUTracer(), without = svo::makeCPUTracer();
    const svo::Frame &a = with->frame(), &b = without->frame();
    // Layers, buffers and the tree are kept from frame to frame.
    for (int frame = 0; frame < 4; ++frame)
    {
      if (frame == 2)
      {
        for (svo::Instance& instance : scene.instances)
        {
          instance.localToWorld[3] += glm::dvec4(size * random.point(0.5), 0.0);
        }
      }
      else if (frame == 3)
      {
        view = viewOf(random, size);
        scene.instances.erase(scene.instances.begin() + random.upTo(3));
        scene.instances.back().localToWorld[3].x += 100.0 * size;
      }
      settings.viewCulling = settings.occlusionCulling = true;
      with->render(stamped(scene), view, settings, svo::serialFor);
      settings.viewCulling = settings.occlusionCulling = false;
      without->render(stamped(scene), view, settings, svo::serialFor);
      ASSERT_TRUE(same(a.color, b.color)) << "frame " << frame;
      ASSERT_TRUE(same(a.depth, b.depth)) << "frame " << frame;
      ASSERT_TRUE(same(a.instance, b.instance)) << "frame " << frame;
      ASSERT_TRUE(same(a.primitive, b.primitive)) << "frame " << frame;
      outside += with->statistics().outsideInstances;
      hidden += with->statistics().hiddenInstances;
      casters += with->statistics().sparedCasters;
      covered += static_cast<std::size_t>(std::count_if(
        a.instance.begin(), a.instance.end(), [](std::uint32_t i) { return i != ~0u; }));
    }
  }
  EXPECT_GT(outside, scenes);
  EXPECT_GT(hidden, scenes / 4);
  EXPECT_GT(casters, scenes);
  EXPECT_GT(covered, 1000u * scenes);
}

TEST(OcclusionCulling, SmallInstancesAreLeftOutWhereThatIsAskedForAndCastAllTheSame)
{
  svo::Scene scene;
  const svo::Octree ball = makeOctree(sphere(20, 30), 6);
  for (int i = 0; i < 100; ++i)
  {
    const double radius = i < 10 ? 0.5 : 0.03;
    const glm::dmat4 at =
      glm::translate(glm::dmat4(1.0), glm::dvec3(i % 10 - 4.5, 0.0, i / 10 - 4.5));
    scene.instances.push_back(instanceOf(ball, i + 1, glm::scale(at, glm::dvec3(radius))));
  }
  // A wall behind them, which gets all of their shadows.
  const Mesh wall = square(20.0);
  const glm::dmat4 upright = glm::rotate(
    glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 3.0, 0.0)), 1.5707963, glm::dvec3(1, 0, 0));
  scene.instances.push_back(instanceOf(makeOctree(wall, 6), 1000, upright));
  svo::Light light;
  light.direction = glm::normalize(glm::dvec3(0.2, 1.0, -0.3));
  light.castShadow = true;
  scene.lights.push_back(light);
  const svo::View view = lookAt({ 0.0, -20.0, 0.0 }, 200, 200);
  svo::FrameSettings settings;
  const auto tracer = svo::makeCPUTracer();
  const svo::Frame all = rendered(*tracer, scene, view, settings);
  EXPECT_EQ(tracer->statistics().smallInstances, 0u);
  EXPECT_EQ(tracer->statistics().largestSmallInstance, 0.0);
  settings.detailThreshold = 25.0;
  const svo::Frame large = rendered(*tracer, scene, view, settings);
  EXPECT_EQ(tracer->statistics().smallInstances, 90u);
  EXPECT_GE(tracer->statistics().largestSmallInstance, 1.0);
  EXPECT_LE(tracer->statistics().largestSmallInstance, 5.0);
  for (svo::Instance& instance : scene.instances)
  {
    instance.castShadow = instance.id <= 10;
  }
  const svo::Frame fewerShadows = rendered(*tracer, scene, view, settings);
  std::size_t behind = 0, shadows = 0;
  for (std::size_t i = 0; i < all.instance.size(); ++i)
  {
    const std::uint32_t instance = all.instance[i];
    const bool small = instance >= 10 && instance < 100;
    EXPECT_EQ(large.instance[i], small ? 100u : instance);
    behind += small;
    if (instance == 100)
    {
      EXPECT_EQ(large.color[4 * i], all.color[4 * i]) << "the shadow of what is left out";
      shadows += fewerShadows.color[4 * i] != all.color[4 * i];
    }
  }
  EXPECT_GT(behind, 30u);
  EXPECT_GT(shadows, 30u);
}
