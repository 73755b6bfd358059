// Meshes at the extremes: whatever a triangle is like, a ray that meets it in exact arithmetic
// meets the octree, with every leaf geometry; and what cannot be met does no harm.
#include "svoExtremes.h"

#include "svoIntersect.h"
#include "svoLeafGeometry.h"

#include <gtest/gtest.h>

#include <cstring>

using namespace svotest;

namespace
{
struct Case
{
  std::string name;
  Mesh mesh;
  int level;
};

Mesh transformed(Mesh mesh, const glm::dmat3& linear, const glm::dvec3& translation)
{
  for (glm::dvec3& p : mesh.points)
  {
    p = linear * p + translation;
  }
  return mesh;
}

Mesh joined(Mesh a, const Mesh& b)
{
  const auto first = static_cast<unsigned>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const glm::uvec3& t : b.triangles)
  {
    a.triangles.push_back(t + first);
  }
  return a;
}

/// Triangles a million times as long as wide, in all directions.
Mesh needles(int count)
{
  Chance chance(3);
  Mesh mesh;
  for (int i = 0; i < count; ++i)
  {
    const glm::dvec3 a = chance.direction() * chance.unit(), along = chance.direction();
    const glm::dvec3 across = glm::normalize(glm::cross(along, chance.direction()));
    const auto n = static_cast<unsigned>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), { a, a + along, a + 1e-6 * across });
    mesh.triangles.push_back({ n, n + 1, n + 2 });
  }
  return mesh;
}

/// Every triangle three times, and once the other way round.
Mesh repeated(Mesh mesh)
{
  const std::vector<glm::uvec3> once = mesh.triangles;
  for (const glm::uvec3& t : once)
  {
    mesh.triangles.insert(mesh.triangles.end(), { t, t, { t.x, t.z, t.y } });
  }
  return mesh;
}

std::vector<Case> cases()
{
  const Mesh ring = torus(40, 20);
  const glm::dmat3 one(1.0);
  Mesh detail = transformed(soup(400, 0.3, 5), 1e-3 * one, glm::dvec3(0.0));
  std::vector<Case> all;
  all.push_back({ "an ordinary torus", ring, 9 });
  all.push_back(
    { "at 1e8 with features of 1e-3", transformed(detail, one, glm::dvec3(1e8, -1e8, 3e7)), 6 });
  all.push_back({ "features of 1e-3 in a mesh 1e3 large",
    joined(transformed(ring, 1e3 * one, {}), detail), 9 });
  all.push_back({ "1e-200 large", transformed(ring, 1e-200 * one, {}), 8 });
  all.push_back({ "1e200 large", transformed(ring, 1e200 * one, {}), 8 });
  all.push_back({ "planar, along an axis", square(1.0), 8 });
  all.push_back({ "planar, at a slant",
    transformed(square(1.0), Chance(4).rotation(), glm::dvec3(0.1, 0.2, 0.3)), 8 });
  all.push_back(
    { "flat to 1e-6", transformed(ring, glm::dmat3(1, 0, 0, 0, 1, 0, 0, 0, 1e-6), {}), 9 });
  all.push_back({ "needles of aspect 1e6", needles(300), 8 });
  all.push_back({ "triangles thrice, and inverted", repeated(ring), 8 });
  return all;
}

std::string text(const glm::dvec3& v)
{
  std::ostringstream out;
  out.precision(17);
  out << v.x << " " << v.y << " " << v.z;
  return out.str();
}
}

// Rays at random points of random triangles. Something before the target may be hit first; what is
// hit is never behind it, by more than the float of a vertex. The rays are made in the octree's
// coordinates: differences of points there are exact, however far away the mesh lies.
TEST(ExtremeMeshes, ARayThatMeetsATriangleMeetsTheOctree)
{
  constexpr double VertexError = 5e-7; // octree coordinates: 2^-23 and what the edge test adds
  for (const Case& c : cases())
  {
    const svo::Octree octree = makeOctree(c.mesh, c.level);
    ASSERT_TRUE(octree) << c.name;
    const svo::Header& h = octree.header();
    const glm::dvec3 corner(h.origin[0], h.origin[1], h.origin[2]);
    const double scale = 1.0 / octree.rootEdge();
    const double edge = octree.level() % 2 == 0 ? 1.0 : 0.5;
    const auto place = [&](unsigned point)
    { return 1.0 + (c.mesh.points[point] - corner) * scale; };
    Chance chance(17);
    long misses[4] = {}, rays = 0, late = 0;
    for (long i = 0; i < scaled(20000); ++i)
    {
      const glm::uvec3 t =
        c.mesh.triangles[chance.below(static_cast<int>(c.mesh.triangles.size()))];
      const double u = chance.between(0.01, 0.98), v = chance.between(0.01, 0.98);
      if (u + v > 0.99)
      {
        continue;
      }
      const glm::dvec3 a = place(t.x), ab = place(t.y) - a, ac = place(t.z) - a;
      const glm::dvec3 target = a + u * ab + v * ac;
      svo::Ray ray;
      ray.origin = 1.0 + 0.5 * edge + 2.0 * edge * chance.direction();
      ray.direction = target - ray.origin;
      ray.tMax = 10.0;
      ++rays;
      // How far inside of its edges the target is, in octree coordinates, seen along the ray.
      const glm::dvec3 normal = glm::cross(ab, ac);
      const double area = glm::length(normal);
      const glm::dvec3 bc = ac - ab;
      const double inside = area *
        std::min({ v / glm::length(ab), u / glm::length(ac), (1.0 - u - v) / glm::length(bc) });
      const double slope =
        std::abs(glm::dot(normal, ray.direction)) / (area * glm::length(ray.direction));
      for (int g = 0; g < 4; ++g)
      {
        const svo::Hit hit =
          svo::intersect(octree, ray, { static_cast<svo::LeafGeometry>(g), octree.level() });
        if (!hit)
        {
          ++misses[g];
          // Where the triangle is as thin as a float's step its float vertices may not be met.
          EXPECT_TRUE(g >= 2 && inside * slope < VertexError)
            << c.name << ", leaves " << g << ", from " << text(ray.origin) << " to "
            << text(target);
          continue;
        }
        const double behind = (hit.t - 1.0) * glm::length(ray.direction) * slope; // on the normal
        if (g == 2 && behind > VertexError && inside * slope > VertexError)
        {
          ++late;
          ADD_FAILURE() << c.name << ", hit " << behind << " behind the target, from "
                        << text(ray.origin) << " to " << text(target);
        }
      }
    }
    std::printf("%s: %ld rays; missed by cubes %ld, planes %ld, triangles %ld, automatic %ld; %ld "
                "late\n",
      c.name.c_str(), rays, misses[0], misses[1], misses[2], misses[3], late);
    EXPECT_EQ(misses[0], 0);
    EXPECT_EQ(misses[1], 0);
  }
}

// Nothing of these can be met by a line but by chance. They are built, their cubes are hit, and no
// kind of leaf does any harm.
TEST(ExtremeMeshes, WhatHasNoAreaDoesNoHarm)
{
  const double tiny = 1e-310; // denormal
  const std::vector<std::pair<std::string, Mesh>> meshes = {
    { "a point", { { { 1, 2, 3 }, { 1, 2, 3 }, { 1, 2, 3 } }, { { 0, 1, 2 } } } },
    { "one vertex thrice", { { { 1, 2, 3 } }, { { 0, 0, 0 } } } },
    { "collinear", { { { 0, 0, 0 }, { 1, 1, 1 }, { 2, 2, 2 } }, { { 0, 1, 2 } } } },
    { "collinear along an axis", { { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } }, { { 0, 1, 2 } } } },
    { "denormal coordinates",
      { { { 0, 0, 0 }, { tiny, 0, 0 }, { 0, tiny, 0 }, { 0, 0, tiny } },
        { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 2, 3 }, { 1, 2, 3 } } } },
    { "a denormal triangle at 1e8",
      { { { 1e8, 0, 0 }, { 1e8, tiny, 0 }, { 1e8, 0, tiny } }, { { 0, 1, 2 } } } },
    { "the largest doubles",
      { { { 1e290, 0, 0 }, { -1e290, 1e290, 0 }, { 0, -1e290, 1e290 } }, { { 0, 1, 2 } } } },
  };
  for (const auto& [name, mesh] : meshes)
  {
    for (const int level : { 1, 5, 10 })
    {
      const svo::Octree octree = makeOctree(mesh, level);
      ASSERT_TRUE(octree) << name;
      EXPECT_FALSE(octree.empty()) << name;
      const svo::ReferenceOctree reference = svo::makeReference(octree, octree.level());
      RandomRays random(octree, 3);
      long hits = 0;
      for (int i = 0; i < 2000; ++i)
      {
        const svo::Ray ray = random.next();
        for (int g = 0; g < 4; ++g)
        {
          const svo::Hit hit = svo::intersect(octree, ray, { static_cast<svo::LeafGeometry>(g) });
          ASSERT_FALSE(hit && !(hit.t >= 0.0 && hit.t <= ray.tMax)) << name;
          hits += bool(hit);
          if (g == 0)
          {
            EXPECT_EQ(bool(hit), trace(octree, reference, ray).hit) << name << ", ray " << i;
          }
        }
      }
      EXPECT_TRUE(hits > 0 || level > 5) << name << ", level " << level;
    }
  }
}

// A million triangles in one voxel: built in a moment, and a ray costs no more than its list.
TEST(ExtremeMeshes, AMillionTrianglesInOneVoxel)
{
  Mesh mesh = square(1.0);
  const Mesh crowd = transformed(soup(static_cast<unsigned>(scaled(1000000)), 0.2, 9),
    1e-4 * glm::dmat3(1.0), glm::dvec3(0.25, 0.35, 0.0));
  mesh = joined(mesh, crowd);
  const svo::Octree octree = makeOctree(mesh, 6);
  ASSERT_TRUE(octree);
  EXPECT_GE(octree.longestList(), crowd.triangles.size());
  const glm::dmat4 toOctree = octree.localToOctree();
  Chance chance(2);
  for (int g = 0; g < 4; ++g)
  {
    long hits = 0;
    for (int i = 0; i < 40; ++i)
    {
      // At a vertex of the crowd, moved into its triangle.
      const glm::uvec3 t = crowd.triangles[chance.below(static_cast<int>(crowd.triangles.size()))];
      const glm::dvec3 target = (crowd.points[t.x] + crowd.points[t.y] + crowd.points[t.z]) / 3.0;
      const glm::dvec3 from = target + 3.0 * chance.direction();
      svo::Ray ray;
      ray.origin = glm::dvec3(toOctree * glm::dvec4(from, 1.0));
      ray.direction = glm::dvec3(toOctree * glm::dvec4(target - from, 0.0));
      ray.tMax = 10.0;
      hits += bool(svo::intersect(octree, ray, { static_cast<svo::LeafGeometry>(g) }));
    }
    EXPECT_EQ(hits, 40) << "leaves " << g;
  }
}

// NaN and infinite points are left out, triangle by triangle; the others are what they were.
TEST(ExtremeMeshes, PointsThatAreNoneTakeOnlyTheirOwnTriangles)
{
  const Mesh ring = torus(20, 12);
  const svo::Octree expected = makeOctree(ring, 7);
  for (const double value : { std::nan(""), HUGE_VAL, -HUGE_VAL, 1e300 })
  {
    Mesh mesh = ring;
    const auto first = static_cast<unsigned>(mesh.points.size());
    mesh.points.push_back({ value, 0.0, 0.0 });
    mesh.points.push_back({ 0.0, 0.0, value });
    mesh.triangles.push_back({ 0, first, 1 });
    mesh.triangles.push_back({ first, first + 1, first });
    const svo::Octree octree = makeOctree(mesh, 7);
    ASSERT_TRUE(octree);
    ASSERT_EQ(octree.header().nodeCount, expected.header().nodeCount);
    EXPECT_EQ(std::memcmp(octree.nodes(), expected.nodes(), 16 * expected.header().nodeCount), 0);
  }
}
