#include "svoRandomViews.h"

#include "svoSeenObjects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace svotest;

namespace
{
/// A crowd about `middle`, of the size `scale`, and a tree of it.
struct Placed
{
  Crowd crowd;
  svo::LooseOctree tree;
  Placed(RandomBalls& random, double scale, const glm::dvec3& middle)
    : tree(middle, 16.0 * scale)
  {
    for (std::uint32_t i = 0; i < 4000; ++i)
    {
      svo::Ball ball = random.ball();
      ball.centre = middle + scale * ball.centre;
      ball.radius *= scale;
      this->crowd[i] = ball;
      this->tree.insert(i, ball.centre, ball.radius);
    }
  }
};

/// True if a point is surely seen at a pixel of the rectangle.
bool seen(const svo::View& view, const svo::PixelRect& rect, const glm::dvec3& p)
{
  const glm::dvec4 v = view.worldToView * glm::dvec4(p, 1.0);
  const glm::dvec4 clip = view.viewToClip * v;
  const double x = (clip.x / clip.w + 1.0) * 0.5 * view.width;
  const double y = (clip.y / clip.w + 1.0) * 0.5 * view.height;
  return -v.z >= view.tNear && -v.z <= view.tFar && x >= rect.x0 && x <= rect.x1 && y >= rect.y0 &&
    y <= rect.y1;
}
}

TEST(SeenObjects, AreThoseOfAFlatTestAndAmongThemAllThatAreSeen)
{
  RandomBalls random(21);
  std::size_t flatly = 0, reallySeen = 0, hidden = 0;
  for (int round = 0; round < 40; ++round)
  {
    const double scale = std::pow(10.0, random.between(-6.0, 6.0));
    const glm::dvec3 middle = random.below(2)
      ? glm::dvec3(0.0)
      : scale * std::pow(10.0, random.between(0.0, 5.0)) * glm::dvec3(1.0, -0.3, 0.6);
    const Placed placed(random, scale, middle);
    const Crowd balls = keptBalls(placed.tree);
    for (int v = 0; v < 12; ++v)
    {
      const svo::View view = randomView(random, scale, middle);
      const svo::PixelRect rect = randomRect(random, view);
      const svo::Frustum frustum = frustumOf(view, rect);
      std::set<std::uint32_t> found;
      svo::eachSeen(
        placed.tree, frustum, svo::VisitOrder::of(view), [](const svo::LooseNode&) {},
        [&](std::uint32_t object) { EXPECT_TRUE(found.insert(object).second) << "only once"; });
      for (const auto& [name, given] : placed.crowd)
      {
        const svo::Ball& kept = balls.at(name);
        const std::size_t flat = !outside(frustum, kept.centre, kept.radius);
        const std::size_t nearly =
          !outside(frustum, kept.centre, kept.radius + 16.0 * scale / 32768.0);
        EXPECT_GE(found.count(name), flat) << name << " in round " << round;
        EXPECT_LE(found.count(name), nearly) << name << " in round " << round;
        flatly += flat;
        hidden += !flat;
        // Points of the ball, its surface among them.
        for (int k = 0; k < 4; ++k)
        {
          const glm::dvec3 to(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
          const double length = given.radius * random.between(0.9, 1.0 - 1e-9);
          const glm::dvec3 p = given.centre + length * glm::normalize(to);
          if (seen(view, rect, p))
          {
            ++reallySeen;
            EXPECT_TRUE(found.count(name)) << name << " in round " << round;
          }
        }
      }
    }
  }
  EXPECT_GT(flatly, 100000u);
  EXPECT_GT(hidden, 100000u);
  EXPECT_GT(reallySeen, 50000u);
}

TEST(SeenObjects, OfAllGroupsOfTilesAreThoseOfTheImage)
{
  RandomBalls random(22);
  const Placed placed(random, 1.0, glm::dvec3(0.0));
  for (int v = 0; v < 20; ++v)
  {
    const svo::View view = randomView(random, 1.0, glm::dvec3(0.0));
    const auto seenBy = [&](const svo::PixelRect& rect, double margin)
    {
      std::set<std::uint32_t> found;
      svo::eachSeen(
        placed.tree, frustumOf(view, rect, margin), svo::VisitOrder::of(view),
        [](const svo::LooseNode&) {}, [&](std::uint32_t object) { found.insert(object); });
      return found;
    };
    std::set<std::uint32_t> together;
    for (int y = 0; y < view.height; y += 128)
    {
      for (int x = 0; x < view.width; x += 128)
      {
        const std::set<std::uint32_t> some =
          seenBy({ x, y, std::min(x + 128, view.width), std::min(y + 128, view.height) }, 1.0);
        together.insert(some.begin(), some.end());
      }
    }
    const svo::PixelRect all{ 0, 0, view.width, view.height };
    for (const std::uint32_t object : seenBy(all, 0.0))
    {
      EXPECT_TRUE(together.count(object)) << object;
    }
  }
}

TEST(SeenObjects, BallsThatTouchTheFrustumFromOutsideAreAmongThem)
{
  RandomBalls random(23);
  int touching = 0, beside = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const svo::View view = randomView(random, 1.0, glm::dvec3(0.0));
    const svo::Frustum frustum(view, 0.0);
    const double y = random.between(0.0, view.height);
    const double t = random.between(view.tNear, std::min(view.tFar, view.tNear + 10.0));
    const glm::dvec3 p = view.rayOrigin(0.0, y) + t * view.rayDirection(0.0, y);
    const double radius = std::exp2(random.between(-20.0, 1.0));
    const glm::dvec3 centre = p - radius * (1.0 - 1e-9) * glm::dvec3(frustum.plane(0));
    const std::uint32_t others = random.below(2) ? 0 : 100;
    svo::LooseOctree tree(glm::dvec3(0.0), 32.0);
    for (std::uint32_t k = 1; k <= others; ++k)
    {
      // Small ones, so that the cell becomes a smaller one, too.
      tree.insert(k, centre + 1e-3 * glm::dvec3(k % 10, k / 10, 0.0), 1e-9);
    }
    const auto isSeen = [&](const glm::dvec3& at)
    {
      bool seen = false;
      tree.insert(0, at, radius);
      svo::eachSeen(
        tree, frustum, svo::VisitOrder::of(view), [](const svo::LooseNode&) {},
        [&](std::uint32_t object) { seen = seen || object == 0; });
      return seen;
    };
    ASSERT_TRUE(isSeen(centre)) << "view " << i;
    ++touching;
    // Three steps of the root's cell are more than what is allowed for.
    const glm::dvec3 away = centre - 3.0 * 32.0 / 65536.0 * glm::dvec3(frustum.plane(0));
    beside += !isSeen(away) && tree.outsiders().empty();
  }
  EXPECT_GT(beside, touching / 4);
}
