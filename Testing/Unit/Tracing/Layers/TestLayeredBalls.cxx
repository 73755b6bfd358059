// Instances that stand for balls, as lights' views see them, against the nearest points where
// double rays meet the balls; and that neither memory of frames, threads, culling nor the
// instruction set changes a bit of that.
#include "svoInstructionSets.h"
#include "svoLayeredView.h"
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

using namespace svotest;

namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t Others = 2; // instances that are no balls come first

/// Balls of all sizes between and behind each other, some stretched or mirrored, with a torus and a
/// ground among them. Their mesh has few facets, so that nobody takes it for the ball.
svo::Scene crowd(int count)
{
  svo::Scene scene;
  scene.instances.push_back(instanceOf(makeOctree(square(3.0), 5), 1, movedTo(0.0, 0.0, -0.7)));
  scene.instances.push_back(instanceOf(makeOctree(torus(40, 30), 7), 2));
  const svo::Octree octree = makeOctree(sphere(4, 6), 4);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1.0, 1.0), exponent(-9.0, -1.5);
  for (int i = 0; i < count; ++i)
  {
    const double radius = std::exp2(exponent(random));
    glm::dmat4 matrix = movedTo(place(random), place(random), place(random));
    if (i % 5 == 0)
    {
      matrix = glm::rotate(matrix, 3.0 * place(random), glm::dvec3(1, 2, 3));
      matrix = glm::scale(matrix, glm::dvec3(1.0, 0.3, i % 10 == 0 ? -1.6 : 1.6));
    }
    svo::Instance ball = instanceOf(octree, 100 + i, glm::scale(matrix, glm::dvec3(radius)));
    ball.body.own().ball = true;
    scene.instances.push_back(ball);
  }
  return scene;
}

/// Of lights: parallel and not, far away, and in the midst of the balls.
std::vector<svo::View> views()
{
  return { lookAt({ 3.0, -2.0, 2.5 }, 200, 130), lookAtParallel({ 2.0, 1.0, 3.0 }, 160, 120, 1.2),
    lookAt({ 40.0, 30.0, 20.0 }, 160, 120, 3.0), lookAt({ 0.3, 0.1, 0.35 }, 120, 90, 120.0) };
}

void trace(svo::LayeredView& layers, const svo::Scene& scene, const svo::View& view, bool keep,
  const svo::ParallelFor& parallelFor = svo::serialFor)
{
  svo::LayerBudget budget{ std::size_t(1) << 28, 0 };
  layers.prepare(
    scene, view, [](const svo::Instance&) { return true; },
    [](const svo::Instance& i, const svo::LocalView&) { return i.body->octree.level(); }, keep,
    budget, parallelFor);
  layers.trace(parallelFor, nullptr);
}

struct Hit
{
  std::uint32_t instance = svo::NoInstance;
  double depth = Infinity;
};

Hit hitOf(const svo::LayeredView& layers, int x, int y)
{
  const svo::DepthBuffer& depth = layers.hits().depth;
  const std::size_t at = depth.at(x, y);
  if (!depth.hit[at >> 6] || depth.instance[at] == svo::NoInstance)
  {
    return {};
  }
  return { depth.instance[at], layers.hits().base(depth.instance[at]) + depth.t[at] };
}

/// The first point of a ray, from the near plane to the far one, on the unit ball of an instance.
/// `beside`: how far from the ball's outline it passes, in radii.
double meetBall(const svo::Instance& instance, const svo::View& view, int x, int y, double& beside)
{
  const double px = x + 0.5, py = y + 0.5;
  const glm::dmat4 inverse = glm::inverse(instance.localToWorld);
  const glm::dvec3 origin(
    inverse * glm::dvec4(view.origin + py * view.originY + px * view.originX, 1.0));
  const glm::dvec3 along(
    inverse * glm::dvec4(view.direction + py * view.directionY + px * view.directionX, 0.0));
  const double length2 = glm::dot(along, along);
  const double middle = -glm::dot(origin, along) / length2;
  const glm::dvec3 nearest = origin + middle * along;
  const double inside = 1.0 - glm::dot(nearest, nearest);
  beside = std::abs(inside);
  if (inside < 0.0)
  {
    return Infinity;
  }
  const double half = std::sqrt(inside / length2);
  const double first = middle - half >= view.tNear ? middle - half : middle + half;
  return first >= view.tNear && first <= view.tFar ? first : Infinity;
}

void expectSame(const svo::LayeredView& a, const svo::LayeredView& b, const svo::View& view)
{
  int different = 0, balls = 0;
  for (int y = 0; y < view.height; ++y)
  {
    for (int x = 0; x < view.width; ++x)
    {
      const Hit one = hitOf(a, x, y), other = hitOf(b, x, y);
      different += one.instance != other.instance || one.depth != other.depth;
      balls += one.instance != svo::NoInstance && one.instance >= Others;
    }
  }
  EXPECT_EQ(different, 0);
  EXPECT_GT(balls, 500);
}
}

TEST(LayeredBalls, AreMetWhereDoubleRaysMeetThem)
{
  const svo::Scene scene = crowd(120);
  svo::Scene others = scene;
  others.instances.resize(Others);
  int number = 0;
  for (const svo::View& view : views())
  {
    SCOPED_TRACE("view " + std::to_string(number++));
    svo::LayeredView withoutBalls(false);
    trace(withoutBalls, others, view, false);
    std::vector<Hit> allExpected;
    std::vector<bool> isSure;
    for (int y = 0; y < view.height; ++y)
    {
      for (int x = 0; x < view.width; ++x)
      {
        Hit expected = hitOf(withoutBalls, x, y);
        double second = Infinity;
        bool sure = true;
        for (std::uint32_t i = Others; i < scene.instances.size(); ++i)
        {
          double beside;
          const double depth = meetBall(scene.instances[i], view, x, y, beside);
          sure = sure && beside > 1e-3;
          second = std::min(second, std::max(depth, expected.depth));
          expected = depth < expected.depth ? Hit{ i, depth } : expected;
        }
        allExpected.push_back(expected);
        isSure.push_back(sure && (second == Infinity || second - expected.depth > 1e-4 * second));
      }
    }
    onEveryInstructionSet(
      [&]
      {
        svo::LayeredView layers(false);
        trace(layers, scene, view, false);
        int balls = 0, others = 0, doubtful = 0, wrong = 0;
        double farthest = 0.0;
        for (int y = 0; y < view.height; ++y)
        {
          for (int x = 0; x < view.width; ++x)
          {
            const std::size_t pixel = static_cast<std::size_t>(y) * view.width + x;
            const Hit expected = allExpected[pixel];
            const Hit hit = hitOf(layers, x, y);
            doubtful += !isSure[pixel];
            if (!isSure[pixel])
            {
              continue;
            }
            wrong += hit.instance != expected.instance;
            if (hit.instance == expected.instance && hit.instance != svo::NoInstance)
            {
              (hit.instance >= Others ? balls : others) += 1;
              farthest = std::max(farthest, std::abs(hit.depth - expected.depth) / expected.depth);
            }
          }
        }
        EXPECT_EQ(wrong, 0);
        EXPECT_LT(farthest, 1e-5);
        EXPECT_GT(balls, 500);
        EXPECT_GT(others, 500);
        EXPECT_LT(doubtful, view.width * view.height / 50);
      });
  }
}

TEST(LayeredBalls, FramesThreadsAndCullingChangeNoBit)
{
  for (const svo::View& view : views())
  {
    svo::Scene scene = crowd(120);
    svo::LayeredView kept(false);
    trace(kept, scene, view, true);
    std::mt19937 random(3);
    for (int frame = 0; frame < 12; ++frame)
    {
      SCOPED_TRACE("frame " + std::to_string(frame));
      // Some move: none, one, a few, or what is no ball.
      for (int k = 0; k < frame % 4; ++k)
      {
        svo::Instance& one = scene.instances[1 + random() % (scene.instances.size() - 1)];
        one.localToWorld = movedTo(0.05, -0.03, 0.02) * one.localToWorld;
      }
      trace(kept, scene, view, true, raggedFor(2));
      svo::LayeredView fresh(false), unculled(false);
      trace(fresh, scene, view, false);
      svo::Culling none;
      none.occlusion = false;
      unculled.setCulling(none);
      trace(unculled, scene, view, false);
      expectSame(kept, fresh, view);
      expectSame(unculled, fresh, view);
    }
  }
}

TEST(LayeredBalls, OfEquallyDeepOnesTheLaterIsSeen)
{
  svo::Scene scene = crowd(1);
  scene.instances[Others].localToWorld = glm::scale(glm::dmat4(1.0), glm::dvec3(0.9));
  scene.instances.push_back(scene.instances.back());
  scene.instances.back().id = 7;
  const svo::View view = views()[0];
  svo::LayeredView layers(false);
  trace(layers, scene, view, false);
  int later = 0;
  for (std::size_t i = 0; i < layers.hits().depth.instance.size(); ++i)
  {
    EXPECT_NE(layers.hits().depth.hit[i >> 6] ? layers.hits().depth.instance[i] : 0, Others);
    later += layers.hits().depth.hit[i >> 6] && layers.hits().depth.instance[i] == Others + 1;
  }
  EXPECT_GT(later, 1000);
}

TEST(LayeredBalls, TheEyeSeesTheirTriangles)
{
  svo::Scene scene = crowd(120);
  const svo::View view = views()[0];
  svo::LayeredView asBalls(true), asMeshes(true);
  trace(asBalls, scene, view, false);
  for (svo::Instance& instance : scene.instances)
  {
    instance.body.own().ball = false;
  }
  trace(asMeshes, scene, view, false);
  expectSame(asBalls, asMeshes, view);
}
