// Intervals of tiles never lose a hit, and are narrow where an object is seen from outside.
#include "svoIntersect.h"
#include "svoTestScenes.h"
#include "svoTileIntervals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

namespace
{
using namespace svo;

constexpr LeafGeometry Geometries[] = { LeafGeometry::Voxel, LeafGeometry::Plane,
  LeafGeometry::Triangle, LeafGeometry::Automatic };

glm::dmat4 lookingAt(const glm::dvec3& eye, const glm::dvec3& target)
{
  const glm::dvec3 up = std::abs(target.y - eye.y) > 0.9 * glm::length(target - eye)
    ? glm::dvec3(1, 0, 0)
    : glm::dvec3(0, 1, 0);
  return glm::lookAt(eye, target, up);
}

View perspectiveView(const glm::dvec3& eye, const glm::dvec3& target, int width, int height)
{
  View view;
  EXPECT_TRUE(makeView(lookingAt(eye, target),
    glm::perspective(0.7, double(width) / height, 0.01, 100.0), width, height, view));
  return view;
}

View parallelView(
  const glm::dvec3& eye, const glm::dvec3& target, double half, int width, int height)
{
  View view;
  const double aspect = double(width) / height;
  EXPECT_TRUE(makeView(lookingAt(eye, target),
    glm::ortho(-half * aspect, half * aspect, -half, half, 0.1, 100.0), width, height, view));
  return view;
}

struct Counts
{
  int hits = 0;
  int lost = 0;
  int moved = 0;
  int emptyTiles = 0;
  double length = 0.0; // of all intervals that are not empty
};

/// Traces every pixel in double, once as it is and once within its tile's interval.
Counts compare(const Octree& octree, const glm::dmat4& localToWorld, const View& view,
  const PixelRect& rect, const TraceOptions& options, double base = 0.0)
{
  TileIntervals intervals;
  computeTileIntervals(octree, localToWorld, view, rect, options, base, serialFor, intervals);
  const glm::dmat4 worldToOctree = octree.localToOctree() * glm::inverse(localToWorld);
  Counts counts;
  for (std::size_t i = 0; i < intervals.tNear.size(); ++i)
  {
    const bool empty = intervals.tNear[i] > intervals.tFar[i];
    counts.emptyTiles += empty;
    counts.length += empty ? 0.0 : double(intervals.tFar[i]) - intervals.tNear[i];
  }
  for (int y = rect.y0; y < rect.y1; ++y)
  {
    for (int x = rect.x0; x < rect.x1; ++x)
    {
      Ray ray;
      ray.origin = glm::dvec3(worldToOctree * glm::dvec4(view.rayOrigin(x + 0.5, y + 0.5), 1.0));
      ray.direction =
        glm::dvec3(worldToOctree * glm::dvec4(view.rayDirection(x + 0.5, y + 0.5), 0.0));
      ray.tMin = view.tNear;
      ray.tMax = view.tFar;
      const Hit full = intersect(octree, ray, options);
      const std::size_t i = intervals.index(x / 8, y / 8);
      ray.tMin = std::max(ray.tMin, intervals.tNear[i] + base);
      ray.tMax = std::min(ray.tMax, intervals.tFar[i] + base);
      const Hit clipped = intersect(octree, ray, options);
      counts.hits += bool(full);
      counts.lost += bool(full) != bool(clipped);
      counts.moved += full && clipped && std::abs(full.t - clipped.t) > 1e-9 * full.t;
    }
  }
  return counts;
}

glm::dmat4 randomPlacement(std::mt19937& random)
{
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  glm::dmat4 m(1.0);
  for (int c = 0; c < 3; ++c)
  {
    for (int r = 0; r < 3; ++r)
    {
      m[c][r] += 0.4 * unit(random); // sheared and scaled
    }
  }
  if (unit(random) < 0.0)
  {
    m[0] = -m[0]; // mirrored
  }
  m[3] = { 5 * unit(random), 5 * unit(random), 5 * unit(random), 1.0 };
  return m;
}

TEST(TileIntervals, RandomViewsOfMovedObjectsLoseNoHit)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Octree octrees[] = { svotest::makeOctree(svotest::torus(24, 16), 6),
    svotest::makeOctree(svotest::torus(40, 24), 9),
    svotest::makeOctree(svotest::soup(60, 0.5, 9), 7) };
  for (int i = 0; i < 24; ++i)
  {
    const Octree& octree = octrees[i % 3];
    const glm::dmat4 placement = randomPlacement(random);
    const glm::dvec3 centre(placement * glm::dvec4(i % 3 == 2 ? 0.5 : 0.0, 0.0, 0.0, 1.0));
    const glm::dvec3 eye = centre +
      (1.5 + 2.0 * std::abs(unit(random))) *
        glm::normalize(glm::dvec3(unit(random), unit(random), unit(random)));
    const View view =
      i % 2 == 0 ? perspectiveView(eye, centre, 60, 44) : parallelView(eye, centre, 1.2, 60, 44);
    TraceOptions options;
    options.leafGeometry = Geometries[i / 3 % 4];
    options.level = i < 12 ? MaximumLevel : 4;
    const double base = i % 5 == 0 ? glm::distance(eye, centre) : 0.0;
    const Counts counts = compare(octree, placement, view, { 0, 0, 60, 44 }, options, base);
    EXPECT_GT(counts.hits, 0) << i;
    EXPECT_EQ(counts.lost, 0) << i;
    EXPECT_EQ(counts.moved, 0) << i;
  }
}

TEST(TileIntervals, CamerasInsideAnObjectLoseNoHit)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Octree octree = svotest::makeOctree(svotest::torus(40, 24), 8);
  int hits = 0;
  for (int i = 0; i < 12; ++i)
  {
    // In the tube, in the hole and in the surface itself.
    const double radius = i % 3 == 0 ? 1.0 : i % 3 == 1 ? 0.1 : 1.4;
    const double angle = 3.0 * unit(random);
    const glm::dvec3 eye(radius * std::cos(angle), radius * std::sin(angle), 0.05 * unit(random));
    const glm::dvec3 target = eye + glm::dvec3(unit(random), unit(random), unit(random));
    const View view =
      i % 4 == 3 ? parallelView(eye, target, 0.3, 48, 48) : perspectiveView(eye, target, 48, 48);
    for (const LeafGeometry geometry : { LeafGeometry::Voxel, LeafGeometry::Triangle })
    {
      TraceOptions options;
      options.leafGeometry = geometry;
      const Counts counts = compare(octree, glm::dmat4(1.0), view, { 0, 0, 48, 48 }, options);
      hits += counts.hits;
      EXPECT_EQ(counts.lost, 0) << i;
      EXPECT_EQ(counts.moved, 0) << i;
    }
  }
  EXPECT_GT(hits, 20000); // of 55 296 rays; some views look away
}

TEST(TileIntervals, ASphereSeenFromOutsideHasEmptyCornersAndNarrowIntervals)
{
  const Octree octree = svotest::makeOctree(svotest::sphere(40, 40), 9);
  const View view = perspectiveView({ 0, 0, 4 }, { 0, 0, 0 }, 160, 160);
  TraceOptions options;
  options.leafGeometry = LeafGeometry::Voxel;
  const Counts counts = compare(octree, glm::dmat4(1.0), view, { 0, 0, 160, 160 }, options);
  EXPECT_EQ(counts.lost, 0);
  // The disc of the sphere covers pi asin(1/4)^2 / 0.35^2 / 4 = 43 % of the picture; tiles that it
  // touches a few more.
  EXPECT_GT(counts.emptyTiles, 400 * 0.40);
  // Front to back a sphere of radius 1 is 2 deep at most, and 4/3 on average.
  EXPECT_LT(counts.length / (400 - counts.emptyTiles), 1.7);
}

TEST(TileIntervals, ARectangleHasTheTilesItTouchesAndTheSameIntervals)
{
  const Octree octree = svotest::makeOctree(svotest::sphere(20, 20), 7);
  const View view = perspectiveView({ 0.3, 0, 3 }, { 0, 0, 0 }, 100, 90);
  TileIntervals all, part;
  computeTileIntervals(
    octree, glm::dmat4(1.0), view, { 0, 0, 100, 90 }, TraceOptions{}, 1.0, serialFor, all);
  EXPECT_EQ(all.columns, 13);
  EXPECT_EQ(all.rows, 12);
  // An executor that cuts the range in ones and runs them backwards.
  const ParallelFor backwards = [](std::size_t begin, std::size_t end, std::size_t,
                                  const std::function<void(std::size_t, std::size_t)>& body)
  {
    for (std::size_t i = end; i > begin; --i)
    {
      body(i - 1, i);
    }
  };
  computeTileIntervals(
    octree, glm::dmat4(1.0), view, { 20, 30, 61, 200 }, TraceOptions{}, 1.0, backwards, part);
  EXPECT_EQ(part.column0, 2);
  EXPECT_EQ(part.row0, 3);
  EXPECT_EQ(part.columns, 6);
  EXPECT_EQ(part.rows, 9);
  for (int row = 3; row < 12; ++row)
  {
    for (int column = 2; column < 8; ++column)
    {
      EXPECT_EQ(part.tNear[part.index(column, row)], all.tNear[all.index(column, row)]);
      EXPECT_EQ(part.tFar[part.index(column, row)], all.tFar[all.index(column, row)]);
    }
  }
}

TEST(TileIntervals, NothingIsInViewOfAnEmptyOctreeOrBehindTheEye)
{
  const View away = perspectiveView({ 0, 0, 4 }, { 0, 0, 8 }, 32, 32);
  const Octree sphere = svotest::makeOctree(svotest::sphere(20, 20), 6);
  const Octree empty = svotest::makeOctree(std::vector<glm::ivec3>{}, 6);
  for (const Octree& octree : { sphere, empty, Octree() })
  {
    TileIntervals intervals;
    computeTileIntervals(
      octree, glm::dmat4(1.0), away, { 0, 0, 32, 32 }, TraceOptions{}, 0.0, serialFor, intervals);
    ASSERT_EQ(intervals.tNear.size(), 16u);
    for (std::size_t i = 0; i < 16; ++i)
    {
      EXPECT_GT(intervals.tNear[i], intervals.tFar[i]);
    }
  }
}
}
