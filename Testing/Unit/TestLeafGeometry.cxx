// What rays meet in a leaf, against a loop over all triangles in double precision.
#include "svoIntersect.h"
#include "svoIntersectScalar.h"
#include "svoLeafGeometry.h"
#include "svoTestScenes.h"
#include "svoTriangle.h"

#include <gtest/gtest.h>

using namespace svotest;
using svo::LeafGeometry;

namespace
{
constexpr LeafGeometry AllGeometries[] = { LeafGeometry::Voxel, LeafGeometry::Plane,
  LeafGeometry::Triangle, LeafGeometry::Automatic };

struct Exact
{
  bool hit = false;
  double t = 1e300;
  svo::Primitive triangle = svo::NoPrimitive;
  double cosine = 0.0;   // between the ray and the triangle's normal
  double margin = 1e300; // smallest barycentric distance to an edge that decided anything
};

/// Moeller and Trumbore, over all triangles.
Exact bruteForce(const svo::Surface& surface, const svo::Ray& ray)
{
  Exact best;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
  {
    const glm::dvec3 a(surface.points[surface.triangles[i].x]);
    const glm::dvec3 e1 = glm::dvec3(surface.points[surface.triangles[i].y]) - a;
    const glm::dvec3 e2 = glm::dvec3(surface.points[surface.triangles[i].z]) - a;
    const glm::dvec3 p = glm::cross(ray.direction, e2);
    const double determinant = glm::dot(e1, p);
    if (determinant == 0.0)
    {
      continue;
    }
    const glm::dvec3 s = ray.origin - a;
    const double u = glm::dot(s, p) / determinant;
    const glm::dvec3 q = glm::cross(s, e1);
    const double v = glm::dot(ray.direction, q) / determinant;
    const double t = glm::dot(e2, q) / determinant;
    const double inside = std::min({ u, v, 1.0 - u - v });
    if (t >= ray.tMin && t <= ray.tMax)
    {
      best.margin = std::min(best.margin, std::abs(inside));
      if (inside >= 0.0 && t < best.t)
      {
        const glm::dvec3 n = glm::normalize(glm::cross(e1, e2));
        best = { true, t, static_cast<svo::Primitive>(i),
          std::abs(glm::dot(n, glm::normalize(ray.direction))), best.margin };
      }
    }
  }
  return best;
}

double voxelEdge(const svo::Octree& octree)
{
  return 1.0 / double(1 << svo::rootBits(octree, octree.level()));
}

/// A block of rays, the last one repeated to fill it.
struct Blocks
{
  explicit Blocks(const std::vector<svo::Ray>& rays)
    : blocks((rays.size() + 63) / 64)
    , count(rays.size())
  {
    for (std::size_t k = 0; k < blocks.size() * 64; ++k)
    {
      const svo::Ray& ray = rays[std::min(k, rays.size() - 1)];
      svo::RayBlock& block = blocks[k / 64];
      const std::size_t i = k % 64;
      block.originX[i] = float(ray.origin.x);
      block.originY[i] = float(ray.origin.y);
      block.originZ[i] = float(ray.origin.z);
      block.directionX[i] = float(ray.direction.x);
      block.directionY[i] = float(ray.direction.y);
      block.directionZ[i] = float(ray.direction.z);
      block.tMin[i] = float(ray.tMin);
      block.tMax[i] = float(std::min(ray.tMax, 1e30));
    }
  }

  struct Answer
  {
    float t;
    svo::Primitive primitive;
    bool occluded;
  };
  std::vector<Answer> trace(const svo::Octree& octree, const svo::TraceOptions& options) const
  {
    std::vector<Answer> answers;
    for (const svo::RayBlock& block : blocks)
    {
      svo::HitBlock hits;
      svo::intersectBlockScalar(octree, block, options, hits);
      const std::uint64_t occluded = svo::occludedBlockScalar(octree, block, options);
      for (int i = 0; i < 64; ++i)
      {
        answers.push_back({ hits.t[i], hits.primitive[i], bool(occluded >> i & 1) });
      }
    }
    answers.resize(count);
    return answers;
  }

  std::vector<svo::RayBlock> blocks;
  std::size_t count;
};

std::vector<svo::Ray> randomRays(const svo::Octree& octree, int count, unsigned seed)
{
  RandomRays random(octree, seed);
  std::vector<svo::Ray> rays;
  for (int i = 0; i < count; ++i)
  {
    rays.push_back(random.next());
  }
  return rays;
}

/// Origins inside a closed mesh with directions: the axes, the diagonals, and random ones.
std::vector<svo::Ray> raysFrom(const std::vector<glm::dvec3>& origins, int random, unsigned seed)
{
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  std::vector<svo::Ray> rays;
  for (const glm::dvec3& origin : origins)
  {
    for (int i = 0; i < 27; ++i)
    {
      const glm::dvec3 d(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (d != glm::dvec3(0.0))
      {
        rays.push_back({ glm::dvec3(glm::vec3(origin)), d });
      }
    }
    for (int i = 0; i < random; ++i)
    {
      const glm::dvec3 d(normal(engine), normal(engine), normal(engine));
      rays.push_back({ glm::dvec3(glm::vec3(origin)), glm::dvec3(glm::vec3(d)) });
    }
  }
  return rays;
}

/// Points on the torus's core circle, in octree coordinates.
std::vector<glm::dvec3> torusCore(const svo::Octree& octree, int count)
{
  std::vector<glm::dvec3> points;
  for (int i = 0; i < count; ++i)
  {
    const double u = 2.0 * Pi * (i + 0.3) / count;
    points.push_back(
      glm::dvec3(octree.localToOctree() * glm::dvec4(std::cos(u), std::sin(u), 0.01, 1.0)));
  }
  return points;
}
}

TEST(TriangleIntersection, MeetsTheTriangleFromBothSides)
{
  const glm::vec3 a(0.0f, 0.0f, 2.0f), b(1.0f, 0.0f, 2.0f), c(0.0f, 1.0f, 2.0f);
  for (double side : { -1.0, 1.0 })
  {
    const svo::ShearedRay<double> ray({ 0.25, 0.25, 2.0 + 3.0 * side }, { 0.0, 0.0, -0.5 * side });
    double t = 0.0;
    ASSERT_TRUE(svo::intersectTriangle(ray, a, b, c, t));
    EXPECT_EQ(t, 6.0);
    ASSERT_TRUE(svo::intersectTriangle(ray, c, b, a, t));
    EXPECT_EQ(t, 6.0);
  }
  double t = 0.0;
  const svo::ShearedRay<double> past({ 0.75, 0.75, 0.0 }, { 0.0, 0.0, 1.0 });
  EXPECT_FALSE(svo::intersectTriangle(past, a, b, c, t));
}

TEST(TriangleIntersection, ARayThroughASharedEdgeOrVertexHitsEveryTriangleThatHasIt)
{
  const glm::vec3 a(0.0f, 0.0f, 1.0f), b(1.0f, 0.0f, 1.0f), c(0.0f, 1.0f, 1.0f),
    d(1.0f, 1.0f, 1.0f);
  for (const glm::vec2& p : { glm::vec2(0.5f, 0.5f), glm::vec2(1.0f, 0.0f), glm::vec2(0.0f, 1.0f) })
  {
    const svo::ShearedRay<float> ray({ p.x, p.y, 0.0f }, { 0.0f, 0.0f, 1.0f });
    float t = 0.0f;
    EXPECT_TRUE(svo::intersectTriangle(ray, a, b, c, t));
    EXPECT_TRUE(svo::intersectTriangle(ray, b, d, c, t));
  }
}

TEST(TriangleIntersection, EdgeOnAndDegenerateTrianglesAreMissed)
{
  const svo::ShearedRay<float> ray({ 0.0f, 0.0f, 0.0f }, { 0.0f, 0.0f, 1.0f });
  float t = 0.0f;
  EXPECT_FALSE(
    svo::intersectTriangle(ray, { 0, -1, 1 }, { 0, 1, 1 }, { 0, 0, 2 }, t)); // contains the ray
  EXPECT_FALSE(svo::intersectTriangle(ray, { -1, 0, 1 }, { 1, 0, 1 }, { 0, 0, 1 }, t));
  EXPECT_FALSE(svo::intersectTriangle(ray, { 0, 0, 1 }, { 0, 0, 1 }, { 0, 0, 1 }, t));
}

TEST(TriangleIntersection, TheSignOfADifferenceOfProductsIsExact)
{
  const float a = 1.0f + 1.0f / (1 << 20), b = 1.0f - 1.0f / (1 << 20);
  EXPECT_EQ(a * b, 1.0f); // rounding hides that a b < 1
  EXPECT_LT(svo::differenceOfProducts(a, b, 1.0f, 1.0f), 0.0f);
  EXPECT_GT(svo::differenceOfProducts(1.0f, 1.0f, a, b), 0.0f);
  EXPECT_EQ(svo::differenceOfProducts(a, b, b, a), 0.0f);
}

TEST(TriangleLeaves, AgreeWithAllTrianglesInDouble)
{
  const std::pair<Mesh, int> scenes[] = { { sphere(16, 20), 8 }, { torus(24, 16), 7 },
    { soup(300, 0.3, 3), 8 } };
  for (const auto& [mesh, level] : scenes)
  {
    const svo::Octree octree = makeOctree(mesh, level);
    const double voxel = voxelEdge(octree);
    const std::vector<svo::Ray> rays = randomRays(octree, 8000, 1);
    const auto blocks = Blocks(rays).trace(octree, { LeafGeometry::Triangle });
    int hits = 0, doubtful = 0;
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
      const svo::Ray& ray = rays[i];
      const Exact exact = bruteForce(*octree.surface(), ray);
      const svo::Hit hit = svo::intersect(octree, ray, { LeafGeometry::Triangle });
      ASSERT_EQ(svo::occluded(octree, ray, { LeafGeometry::Triangle }), bool(hit));
      ASSERT_EQ(blocks[i].occluded, blocks[i].primitive != svo::NoPrimitive);
      if (exact.margin > 1e-9) // else an edge decides, and the brute force is no judge of it
      {
        ASSERT_EQ(bool(hit), exact.hit) << "ray " << i;
        if (hit)
        {
          ASSERT_NEAR(hit.t, exact.t, 1e-9) << "ray " << i;
          ASSERT_EQ(hit.primitive, exact.triangle);
        }
      }
      if (exact.margin > 1e-4)
      {
        ASSERT_EQ(blocks[i].primitive != svo::NoPrimitive, exact.hit) << "ray " << i;
        if (exact.hit && exact.cosine > 0.1)
        {
          ASSERT_LT(std::abs(blocks[i].t - exact.t) * glm::length(ray.direction), 1e-3 * voxel);
        }
      }
      hits += exact.hit;
      doubtful += exact.margin <= 1e-4;
    }
    EXPECT_GT(hits, 2000);
    EXPECT_LT(doubtful, 400);
  }
}

TEST(TriangleLeaves, TheCellOfAHitHoldsThePointThatWasHit)
{
  const svo::Octree octree = makeOctree(torus(24, 16), 8);
  for (const svo::Ray& ray : randomRays(octree, 5000, 4))
  {
    for (int level : { 8, 7, 6 })
    {
      const svo::Hit hit = svo::intersect(octree, ray, { LeafGeometry::Triangle, level });
      if (hit)
      {
        EXPECT_EQ(hit.level, level);
        EXPECT_TRUE(octree.occupied(hit.cell, level));
      }
    }
  }
}

TEST(TriangleLeaves, TheThreeFinestLevelsGiveTheSameAnswer)
{
  for (int level : { 7, 8 })
  {
    const svo::Octree octree = makeOctree(torus(30, 30), level);
    for (const svo::Ray& ray : randomRays(octree, 5000, 5))
    {
      const svo::Hit fine = svo::intersect(octree, ray, { LeafGeometry::Triangle, level });
      for (int coarser : { level - 1, level - 2 })
      {
        const svo::Hit hit = svo::intersect(octree, ray, { LeafGeometry::Triangle, coarser });
        ASSERT_EQ(hit.primitive, fine.primitive);
        ASSERT_EQ(hit.t, fine.t);
      }
    }
  }
}

TEST(TriangleLeaves, NoHoleAtASharedVertexOrEdge)
{
  const svo::Octree octree = makeOctree(torus(40, 30), 7);
  const svo::Surface& surface = *octree.surface();
  std::vector<svo::Ray> exact; // through the vertex to the last bit, in float too
  std::vector<svo::Ray>
    rounded; // through vertices and edges as nearly as floats can say, from inside
  for (const glm::vec3& p : surface.points)
  {
    for (int a = 0; a < 3; ++a)
    {
      svo::Ray ray{ glm::dvec3(p), glm::dvec3(0.0) };
      ray.origin[a] = 0.5;
      ray.direction[a] = 1.0;
      exact.push_back(ray);
      ray.origin[a] = 2.5;
      ray.direction[a] = -1.0;
      exact.push_back(ray);
    }
  }
  for (const glm::uvec3& triangle : surface.triangles)
  {
    const glm::dvec3 a(surface.points[triangle.x]), b(surface.points[triangle.y]);
    for (const glm::dvec3& target : { a, 0.5 * (a + b), 0.3 * a + 0.7 * b })
    {
      const glm::dvec3 local = (target - 1.0) * octree.rootEdge() +
        glm::dvec3(octree.header().origin[0], octree.header().origin[1], octree.header().origin[2]);
      const double angle = std::atan2(local.y, local.x);
      const glm::dvec3 core(
        octree.localToOctree() * glm::dvec4(std::cos(angle), std::sin(angle), 0.0, 1.0));
      const glm::dvec3 origin = glm::dvec3(glm::vec3(core));
      rounded.push_back({ origin, glm::dvec3(glm::vec3(target - origin)) });
    }
  }
  for (const std::vector<svo::Ray>* rays : { &exact, &rounded })
  {
    const auto blocks = Blocks(*rays).trace(octree, { LeafGeometry::Triangle });
    for (std::size_t i = 0; i < rays->size(); ++i)
    {
      ASSERT_TRUE(svo::intersect(octree, (*rays)[i], { LeafGeometry::Triangle })) << i;
      ASSERT_NE(blocks[i].primitive, svo::NoPrimitive) << i;
    }
  }
}

TEST(LeafGeometry, RaysFromInsideAClosedMeshNeverEscape)
{
  for (int level : { 6, 9 })
  {
    const svo::Octree octree = makeOctree(torus(40, 30), level);
    const std::vector<glm::dvec3> origins = torusCore(octree, 20);
    const std::vector<svo::Ray> rays = raysFrom(origins, 60, 7);
    for (LeafGeometry geometry : AllGeometries)
    {
      for (int stop = 1; stop <= level; ++stop)
      {
        const auto blocks = Blocks(rays).trace(octree, { geometry, stop });
        for (std::size_t i = 0; i < rays.size(); ++i)
        {
          const glm::ivec3 cell((rays[i].origin - 1.0) * double(1 << svo::rootBits(octree, stop)));
          if (octree.occupied(cell, stop) && stop < level - 2)
          {
            continue; // it starts in a cell of the surface: inside or outside is not defined
          }
          ASSERT_TRUE(svo::intersect(octree, rays[i], { geometry, stop }))
            << "level " << stop << " of " << level << " ray " << i;
          ASSERT_TRUE(svo::occluded(octree, rays[i], { geometry, stop }));
          ASSERT_NE(blocks[i].primitive, svo::NoPrimitive);
          ASSERT_TRUE(blocks[i].occluded);
        }
      }
    }
  }
}

TEST(LeafGeometry, NoRayThatHitsAClosedMeshIsLost)
{
  const svo::Octree octree = makeOctree(sphere(24, 24), 8);
  const std::vector<svo::Ray> rays = randomRays(octree, 6000, 8);
  for (LeafGeometry geometry : AllGeometries)
  {
    const auto blocks = Blocks(rays).trace(octree, { geometry });
    for (std::size_t i = 0; i < rays.size(); ++i)
    {
      const glm::ivec3 cell((rays[i].origin - 1.0) * double(1 << svo::rootBits(octree, 8)));
      const Exact exact = bruteForce(*octree.surface(), rays[i]);
      if (exact.hit && exact.margin > 1e-5 && !octree.occupied(cell, 8))
      {
        ASSERT_TRUE(svo::intersect(octree, rays[i], { geometry })) << i;
        ASSERT_NE(blocks[i].primitive, svo::NoPrimitive) << i;
      }
    }
  }
}

TEST(PlaneLeaves, LieWithinAVoxelOfTheTriangles)
{
  const svo::Octree octree = makeOctree(torus(60, 40), 9);
  const double voxel = voxelEdge(octree);
  std::vector<double> errors;
  for (const svo::Ray& ray : randomRays(octree, 20000, 9))
  {
    const svo::Hit exact = svo::intersect(octree, ray, { LeafGeometry::Triangle });
    const svo::Hit plane = svo::intersect(octree, ray, { LeafGeometry::Plane });
    if (exact && plane)
    {
      errors.push_back(std::abs(exact.t - plane.t) * glm::length(ray.direction) / voxel);
    }
  }
  std::sort(errors.begin(), errors.end());
  ASSERT_GT(errors.size(), 5000u);
  EXPECT_LT(errors[errors.size() / 2], 0.01);
  EXPECT_LT(errors[errors.size() * 99 / 100], 2.0);
}

TEST(VoxelLeaves, NameATriangleNearTheCell)
{
  const svo::Octree octree = makeOctree(torus(60, 40), 8);
  const double voxel = voxelEdge(octree);
  const svo::Surface& surface = *octree.surface();
  int hits = 0;
  for (const svo::Ray& ray : randomRays(octree, 5000, 10))
  {
    const svo::Hit hit = svo::intersect(octree, ray, { LeafGeometry::Voxel });
    if (!hit)
    {
      continue;
    }
    ++hits;
    ASSERT_LT(hit.primitive, surface.triangles.size());
    const glm::uvec3 t = surface.triangles[hit.primitive];
    const glm::vec3 low =
      glm::min(surface.points[t.x], glm::min(surface.points[t.y], surface.points[t.z]));
    const glm::vec3 high =
      glm::max(surface.points[t.x], glm::max(surface.points[t.y], surface.points[t.z]));
    for (int a = 0; a < 3; ++a) // with the builder's lattice around it
    {
      ASSERT_LE(low[a], 1.0 + (hit.cell[a] + 1.02) * voxel);
      ASSERT_GE(high[a], 1.0 + (hit.cell[a] - 0.02) * voxel);
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST(AutomaticLeaves, AreTrianglesWhereListsAreShort)
{
  const svo::Octree octree = makeOctree(sphere(8, 8), 8);
  std::uint32_t longest = 0;
  for (std::uint32_t b = octree.brickBegin(); b < octree.header().nodeCount; ++b)
  {
    std::uint32_t count = 0, id = 0;
    octree.brickTriangles(b, count, id);
    longest = std::max(longest, count);
  }
  ASSERT_LE(longest, svo::ShortList);
  for (const svo::Ray& ray : randomRays(octree, 5000, 11))
  {
    const svo::Hit a = svo::intersect(octree, ray, { LeafGeometry::Triangle });
    const svo::Hit b = svo::intersect(octree, ray, { LeafGeometry::Automatic });
    ASSERT_EQ(a.primitive, b.primitive);
    ASSERT_EQ(a.t, b.t);
  }
}

TEST(AutomaticLeaves, ArePlanesWhereListsAreLong)
{
  const svo::Octree octree = makeOctree(sphere(60, 60), 4); // some hundred triangles a brick
  for (std::uint32_t b = octree.brickBegin(); b < octree.header().nodeCount; ++b)
  {
    std::uint32_t count = 0, id = 0;
    octree.brickTriangles(b, count, id);
    ASSERT_GT(count, svo::ShortList);
  }
  for (const svo::Ray& ray : randomRays(octree, 2000, 12))
  {
    const svo::Hit a = svo::intersect(octree, ray, { LeafGeometry::Plane });
    const svo::Hit b = svo::intersect(octree, ray, { LeafGeometry::Automatic });
    ASSERT_EQ(a.primitive, b.primitive);
    ASSERT_EQ(a.t, b.t);
  }
}

namespace
{
/// One horizontal triangle at z = 0 in local coordinates, as an octree of level 5.
svo::Octree oneTriangle()
{
  Mesh mesh;
  mesh.points = { { -1.0, -1.0, 0.0 }, { 1.0, -1.0, 0.0 }, { 0.0, 1.0, 0.0 } };
  mesh.triangles = { { 0, 1, 2 } };
  return makeOctree(mesh, 5);
}

svo::Ray localRay(const svo::Octree& octree, glm::dvec3 origin, glm::dvec3 direction)
{
  return { glm::dvec3(octree.localToOctree() * glm::dvec4(origin, 1.0)),
    glm::dvec3(octree.localToOctree() * glm::dvec4(direction, 0.0)) };
}
}

TEST(PlaneLeaves, ARefusedRayGetsTheEntryOfTheFirstVoxelThatRefusedIt)
{
  const svo::Octree octree = oneTriangle();
  // Parallel to the plane, just above it, inside its voxels.
  const svo::Ray ray = localRay(octree, { -3.0, -0.5, 0.01 }, { 1.0, 0.0, 0.0 });
  const svo::Hit cube = svo::intersect(octree, ray, { LeafGeometry::Voxel });
  const svo::Hit plane = svo::intersect(octree, ray, { LeafGeometry::Plane });
  ASSERT_TRUE(cube);
  ASSERT_TRUE(plane);
  EXPECT_EQ(plane.t, cube.t);
  EXPECT_EQ(plane.cell, cube.cell);
  EXPECT_TRUE(svo::occluded(octree, ray, { LeafGeometry::Plane }));
  EXPECT_FALSE(svo::intersect(octree, ray, { LeafGeometry::Triangle }));
}

TEST(PlaneLeaves, ARayThatLeavesTheSurfaceDoesNotHitIt)
{
  const svo::Octree octree = oneTriangle();
  const svo::Ray up = localRay(octree, { 0.0, 0.0, 0.01 }, { 0.1, 0.0, 1.0 });
  EXPECT_TRUE(svo::intersect(octree, up, { LeafGeometry::Voxel }));
  EXPECT_FALSE(svo::intersect(octree, up, { LeafGeometry::Plane }));
  EXPECT_FALSE(svo::occluded(octree, up, { LeafGeometry::Plane }));
  EXPECT_FALSE(svo::intersect(octree, up, { LeafGeometry::Triangle }));
  const svo::Ray down = localRay(octree, { 0.0, 0.0, 0.01 }, { 0.1, 0.0, -1.0 });
  EXPECT_NEAR(svo::intersect(octree, down, { LeafGeometry::Plane }).t, 0.01, 1e-6);
  EXPECT_NEAR(svo::intersect(octree, down, { LeafGeometry::Triangle }).t, 0.01, 1e-6);
}

TEST(LevelOfDetail, RaysStopOnTheMeanPlaneOfTheNode)
{
  for (int level : { 8, 9 })
  {
    const svo::Octree octree = makeOctree(torus(60, 40), level);
    for (int stop = 1; stop < level - 2; ++stop)
    {
      const double cell = 1.0 / double(1 << svo::rootBits(octree, stop));
      int hits = 0;
      for (const svo::Ray& ray : randomRays(octree, 500, 13))
      {
        for (LeafGeometry geometry : AllGeometries)
        {
          const svo::Hit hit = svo::intersect(octree, ray, { geometry, stop });
          if (!hit)
          {
            continue;
          }
          ++hits;
          ASSERT_EQ(hit.level, stop);
          ASSERT_TRUE(octree.occupied(hit.cell, stop));
          ASSERT_TRUE(hit.primitive & svo::NodePrimitive);
          // The node has the depth that the level asks for.
          const std::uint32_t node = hit.primitive & ~svo::NodePrimitive;
          const int depth = (svo::rootBits(octree, stop) + 1) / 2;
          ASSERT_GE(node, octree.header().depthBegin[depth]);
          ASSERT_LT(node, octree.header().depthBegin[depth + 1]);
          const glm::dvec3 x = ray.origin + hit.t * ray.direction;
          const glm::dvec3 away = glm::abs(x - (1.0 + (glm::dvec3(hit.cell) + 0.5) * cell));
          ASSERT_LE(std::max({ away.x, away.y, away.z }), 1.5 * cell + 1e-9);
        }
      }
      EXPECT_GT(hits, 100);
    }
  }
}

TEST(LeafGeometry, AnOctreeWithoutItsSurfaceIsTracedAsVoxels)
{
  const svo::Octree octree = makeOctree(std::vector<glm::ivec3>{ { 1, 1, 1 } }, 3);
  const svo::Ray ray{ { 0.0, 1.1, 1.1 }, { 1.0, 0.0, 0.0 } };
  for (LeafGeometry geometry : AllGeometries)
  {
    const svo::Hit hit = svo::intersect(octree, ray, { geometry });
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit.primitive, 0u);
    EXPECT_EQ(hit.t, 1.0 + 1.0 / 16);
  }
}
