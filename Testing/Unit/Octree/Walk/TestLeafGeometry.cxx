// What rays meet in a leaf, against a loop over all triangles in double precision.
#include "svoIntersect.h"
#include "svoLeafGeometry.h"
#include "svoTestScenes.h"

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
  return 1.0 / double(1 << octree.rootBits(octree.level()));
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
      block.aim(i, ray.origin, ray.direction);
      block.tMin[i] = float(ray.tMin);
      block.tMax[i] = float(std::min(ray.tMax, 1e30));
    }
  }

  struct Answer
  {
    float t;
    svo::Primitive primitive;
  };
  std::vector<Answer> trace(const svo::Octree& octree, const svo::TraceOptions& options) const
  {
    std::vector<Answer> answers;
    for (const svo::RayBlock& block : blocks)
    {
      svo::HitBlock hits;
      svo::intersectBlockScalar(octree, block, options, hits);
      for (int i = 0; i < 64; ++i)
      {
        answers.push_back({ hits.t[i], hits.primitive[i] });
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
          const glm::ivec3 cell((rays[i].origin - 1.0) * double(1 << octree.rootBits(stop)));
          if (octree.occupied(cell, stop) && stop < level - 2)
          {
            continue; // it starts in a cell of the surface: inside or outside is not defined
          }
          ASSERT_TRUE(svo::intersect(octree, rays[i], { geometry, stop }))
            << "level " << stop << " of " << level << " ray " << i;
          ASSERT_TRUE(svo::occluded(octree, rays[i], { geometry, stop }));
          ASSERT_NE(blocks[i].primitive, svo::NoPrimitive);
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
      const glm::ivec3 cell((rays[i].origin - 1.0) * double(1 << octree.rootBits(8)));
      const Exact exact = bruteForce(*octree.surface(), rays[i]);
      if (exact.hit && exact.margin > 1e-5 && !octree.occupied(cell, 8))
      {
        ASSERT_TRUE(svo::intersect(octree, rays[i], { geometry })) << i;
        ASSERT_NE(blocks[i].primitive, svo::NoPrimitive) << i;
      }
    }
  }
}
