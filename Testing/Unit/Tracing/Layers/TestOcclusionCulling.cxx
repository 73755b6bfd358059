// Instances that are left out of groups of tiles because others hide them: every hit is what it is
// without that, to the bit, in random crowds with awkward places, matrices and views.
#include "svoLayeredView.h"
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
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
  const int count = 5 + random.upTo(60);
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
    svo::makeView(camera,
      glm::frustum(x - half * aspect, x + half * aspect, y - half, y + half, near, far), width,
      height, view);
  }
  return view;
}

void trace(const svo::Scene& scene, const svo::View& view, bool culling, svo::LayeredView& layers)
{
  svo::LayerBudget budget{ std::size_t(1) << 28, 0 };
  layers.setOcclusionCulling(culling);
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
  const char* asked = std::getenv("SVO_RANDOM_SCENES");
  const unsigned scenes = asked ? static_cast<unsigned>(std::atoi(asked)) : 400;
  std::size_t hits = 0, fewer = 0;
  for (unsigned seed = 0; seed < scenes; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const double size = random.once(6) ? std::pow(10.0, random.in(-6.0, 6.0)) : 1.0;
    const svo::Scene scene = crowd(random, shapes, size);
    const svo::View view = viewOf(random, size);
    const bool exact = !random.once(3); // or as for lights
    svo::LayeredView with(exact), without(exact);
    trace(scene, view, true, with);
    trace(scene, view, false, without);
    const svo::DepthBuffer &a = with.depthBuffer(), &b = without.depthBuffer();
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
    fewer += with.hiddenInstances() > 0;
    ASSERT_EQ(without.hiddenInstances(), 0u);
  }
  // Else nothing would have been tested.
  EXPECT_GT(hits, 1000u * scenes);
  EXPECT_GT(10 * fewer, scenes);
}
