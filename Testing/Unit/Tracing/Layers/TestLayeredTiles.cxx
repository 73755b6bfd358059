// What tiles find in one pass over all instances, against each instance's rays on their own, which
// is what LayeredView::sample() traces: the same instances, triangles and depths, to the bit. Other
// instruction sets find the same.
#include "svoInstructionSets.h"
#include "svoLayeredView.h"
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

using namespace svotest;

namespace
{
struct SceneCase
{
  std::string name;
  std::vector<Mesh> meshes; // of the instances, which the scene borrows points of
  svo::Scene scene;
};

void add(SceneCase& to, const Mesh& mesh, int level, const glm::dmat4& localToWorld)
{
  to.meshes.push_back(mesh);
  to.scene.instances.push_back(instanceOf(makeOctree(mesh, level), to.meshes.size(), localToWorld));
}

std::vector<SceneCase> scenes()
{
  std::vector<SceneCase> all;
  const glm::dmat4 one(1.0);
  SceneCase crossing;
  crossing.name = "instances through each other, on a wide ground";
  add(crossing, square(30.0), 6, movedTo(0.0, 0.0, -0.5));
  add(crossing, torus(40, 30), 8, one);
  add(crossing, sphere(16, 24), 7, movedTo(0.6, 0.2, 0.1));
  add(crossing, soup(300, 0.3, 3), 7, glm::rotate(one, 0.7, glm::dvec3(1, 2, 3)));
  all.push_back(crossing);
  SceneCase same;
  same.name = "the same surface three times, once a little lower";
  for (const double z : { 0.0, 0.0, -1e-7 })
  {
    add(same, sphere(16, 24), 7, movedTo(0.0, 0.0, z));
  }
  all.push_back(same);
  SceneCase walked;
  walked.name = "beside triangles smaller than pixels";
  add(walked, sphere(300, 400), 8, movedTo(0.0, 0.0, 0.4));
  add(walked, square(3.0), 6, one);
  add(walked, torus(20, 16), 7, movedTo(0.1, 0.0, 0.0));
  all.push_back(walked);
  for (SceneCase& c : all)
  {
    for (std::size_t i = 0; i < c.meshes.size(); ++i)
    {
      c.scene.instances[i].body.own().points.doubles = &c.meshes[i].points.data()->x;
      c.scene.instances[i].body.own().points.count = c.meshes[i].points.size();
    }
  }
  return all;
}

std::vector<svo::View> views()
{
  svo::View aside, clipped;
  svo::makeView(glm::lookAt(glm::dvec3(3.0, -2.0, 2.5), glm::dvec3(0.0), glm::dvec3(0, 0, 1)),
    glm::frustum(-0.09, 0.02, -0.01, 0.07, 0.1, 100.0), 200, 120, aside);
  svo::makeView(glm::lookAt(glm::dvec3(2.0, -1.5, 1.5), glm::dvec3(0.0), glm::dvec3(0, 0, 1)),
    glm::perspective(0.8, 1.5, 2.3, 3.4), 180, 120, clipped);
  return { lookAt({ 3.0, -2.0, 1.5 }, 200, 130), lookAt({ 0.3, 0.1, 0.35 }, 120, 90, 120.0),
    lookAtParallel({ 2.0, 1.0, 3.0 }, 160, 120, 1.2),
    lookAtParallel({ 3.0, 0.0, 0.0 }, 128, 128, 1.0), lookAt({ 40.0, 30.0, 20.0 }, 160, 120, 3.0),
    aside, clipped };
}

void prepare(svo::LayeredView& layers, const svo::Scene& scene, const svo::View& view, bool keep)
{
  svo::LayerBudget budget{ std::size_t(1) << 28, 0 };
  layers.prepare(
    scene, view, [](const svo::Instance&) { return true; },
    [](const svo::Instance& i, const svo::LocalView&) { return i.body->octree.level(); }, keep,
    budget);
}

/// Returns the number of hits.
int compare(const svo::LayeredView& layers, const svo::View& view)
{
  const svo::DepthBuffer& depth = layers.hits().depth;
  int hits = 0;
  for (int tileY = 0; tileY < depth.grid.tilesY; ++tileY)
  {
    for (int tileX = 0; tileX < depth.grid.tilesX; ++tileX)
    {
      svo::TileSamples samples;
      for (int i = 0; i < 64; ++i)
      {
        samples.x[i] = 8 * tileX + (i & 7) + 0.5;
        samples.y[i] = 8 * tileY + (i >> 3) + 0.5;
      }
      layers.sample(tileX, tileY, &samples, 1);
      for (int i = 0; i < 64; ++i)
      {
        const int x = 8 * tileX + (i & 7), y = 8 * tileY + (i >> 3);
        if (x >= view.width || y >= view.height)
        {
          continue;
        }
        const std::size_t at = depth.at(x, y);
        const std::uint32_t instance = depth.hit[at >> 6] ? depth.instance[at] : svo::NoInstance;
        EXPECT_EQ(instance, samples.instance[i]) << x << ", " << y;
        if (instance == svo::NoInstance || instance != samples.instance[i])
        {
          continue;
        }
        ++hits;
        EXPECT_EQ(depth.primitive[at], samples.primitive[i]) << x << ", " << y;
        EXPECT_EQ(layers.hits().base(instance) + depth.t[at], samples.t[i]) << x << ", " << y;
      }
      if (testing::Test::HasFailure()) // of one tile is enough
      {
        return hits;
      }
    }
  }
  return hits;
}

void expectSame(const svo::Hits& first, const svo::Hits& second)
{
  const svo::DepthBuffer &a = first.depth, &b = second.depth;
  ASSERT_EQ(a.hit, b.hit);
  for (std::size_t at = 0; at < 64 * a.hit.size(); ++at)
  {
    if (a.hit[at / 64])
    {
      ASSERT_EQ(a.instance[at], b.instance[at]);
      if (a.instance[at] != svo::NoInstance)
      {
        ASSERT_EQ(a.primitive[at], b.primitive[at]);
        ASSERT_EQ(first.base(a.instance[at]) + a.t[at], second.base(b.instance[at]) + b.t[at]);
      }
    }
  }
}
}

TEST(LayeredTiles, FindWhatEachInstancesRaysFind)
{
  for (SceneCase& c : scenes())
  {
    SCOPED_TRACE(c.name);
    int number = 0;
    for (const svo::View& view : views())
    {
      SCOPED_TRACE("view " + std::to_string(number++));
      for (const bool exact : { true, false })
      {
        for (const int offset : { 0, 1, 2 })
        {
          c.scene.instances[1].depthOffset.units = offset > 0 ? 1e-5f : 0.0f;
          c.scene.instances[1].depthOffset.factor = offset > 1 ? 2.0f : 0.0f;
          const char* const shifted[] = { "", ", shifted", ", shifted by slopes" };
          SCOPED_TRACE(std::string(exact ? "eye" : "light") + shifted[offset]);
          svo::LayeredView layers(exact);
          prepare(layers, c.scene, view, false);
          layers.trace(svo::serialFor, nullptr);
          EXPECT_GT(compare(layers, view), 200);
          bool keep = (number + offset) % 2 != 0;
          onEveryInstructionSet(
            [&]
            {
              keep = !keep;
              svo::LayeredView others(exact);
              prepare(others, c.scene, view, keep);
              others.trace(svo::serialFor, nullptr);
              expectSame(others.hits(), layers.hits());
              if (exact && offset == 1)
              {
                compare(others, view);
              }
            });
          if (HasFailure())
          {
            return;
          }
        }
      }
    }
  }
}
