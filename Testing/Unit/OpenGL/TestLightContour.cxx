// Contours of meshes of all kinds are what their definition says, whatever was asked before, and
// whether or not triangles are asked by their normals.
#include "svoLightContour.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace
{
using svo::LightContour;
using svo::MeshEdges;
using svo::Surface;
using Place = std::array<float, 3>;

Place placeOf(const Surface& surface, std::uint32_t corner)
{
  const glm::vec3& point = surface.points[surface.triangles[corner / 3][corner % 3]];
  return { point.x, point.y, point.z };
}

/// In octree coordinates: a ball, closed but for its last `open` triangles, wound `inwards` or not.
/// Each triangle has points of its own if `apart`.
Surface ball(int rings, std::size_t open = 0, bool inwards = false, bool apart = false)
{
  Surface surface;
  const auto add = [&](int i, int j)
  {
    const double polar = 3.14159265358979 * i / rings;
    const double turn = 3.14159265358979 * (j % (2 * rings)) / rings;
    const bool pole = i == 0 || i == rings;
    const double size = pole ? 0.0 : 0.4 * std::sin(polar);
    surface.points.emplace_back(1.5 + size * std::cos(turn), 1.5 + size * std::sin(turn),
      i == rings ? 1.1 : 1.5 + 0.4 * std::cos(polar));
    return static_cast<unsigned>(surface.points.size() - 1);
  };
  for (int i = 0; i < rings; ++i)
  {
    for (int j = 0; j < 2 * rings; ++j)
    {
      const unsigned a = add(i, j), b = add(i + 1, j), c = add(i + 1, j + 1), d = add(i, j + 1);
      surface.triangles.emplace_back(a, b, c); // at poles some have no size
      surface.triangles.emplace_back(a, c, d);
    }
  }
  surface.triangles.resize(surface.triangles.size() - open);
  for (glm::uvec3& t : surface.triangles)
  {
    if (inwards)
    {
      std::swap(t[1], t[2]);
    }
  }
  if (!apart)
  {
    std::map<Place, unsigned> known;
    for (glm::uvec3& t : surface.triangles)
    {
      for (int k = 0; k < 3; ++k)
      {
        const glm::vec3& p = surface.points[t[k]];
        t[k] = known.try_emplace({ p.x, p.y, p.z }, t[k]).first->second;
      }
    }
  }
  return surface;
}

/// Triangles among few points: edges that many share, triangles that are there twice, or have no
/// size.
Surface heap(unsigned seed, unsigned points, unsigned triangles)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(1.1f, 1.9f);
  Surface surface;
  for (unsigned i = 0; i < points; ++i)
  {
    surface.points.emplace_back(place(random), place(random), place(random));
  }
  for (unsigned i = 0; i < triangles; ++i)
  {
    surface.triangles.emplace_back(random() % points, random() % points, random() % points);
  }
  return surface;
}

std::vector<Surface> surfaces()
{
  return { ball(12), ball(12, 7), ball(12, 0, true), ball(9, 0, false, true), heap(1, 9, 60),
    heap(2, 40, 300), heap(3, 4, 9) };
}

std::vector<glm::dvec4> lights(unsigned seed, int count)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> way;
  std::vector<glm::dvec4> lights;
  for (int i = 0; i < count; ++i)
  {
    const glm::dvec3 d = glm::normalize(glm::dvec3(way(random), way(random), way(random)));
    const double distances[] = { 0.2, 0.5, 0.9, 3.0, 1000.0 };
    lights.push_back(
      i % 6 == 0 ? glm::dvec4(d, 0.0) : glm::dvec4(1.5 + distances[i % 6 - 1] * d, 1.0));
  }
  return lights;
}

using Tally = std::map<std::pair<Place, Place>, int>;

/// By edge, from the lesser place to the greater: how often it is there, less how often the other
/// way round.
void count(Tally& tally, const Place& from, const Place& to, int times)
{
  if (from != to)
  {
    const bool reversed = to < from;
    int& number = tally[reversed ? std::make_pair(to, from) : std::make_pair(from, to)];
    number += reversed ? -times : times;
  }
}

/// Every triangle turned towards the light; twice what those of solid parts that face it give,
/// since all others of the same part give as much.
Tally expected(const Surface& surface, const MeshEdges& mesh, const glm::dvec4& light)
{
  const bool inside = light.w > 0.0 && glm::distance(glm::dvec3(light), mesh.centre) <= mesh.radius;
  Tally tally;
  for (std::uint32_t face = 0; face < surface.triangles.size(); ++face)
  {
    const glm::uvec3& t = surface.triangles[face];
    const glm::dvec3 a(surface.points[t[0]]), b(surface.points[t[1]]), c(surface.points[t[2]]);
    const bool towards = glm::dot(glm::cross(b - a, c - a), glm::dvec3(light) - light.w * a) > 0.0;
    const int sense = towards ? 1 : mesh.faces[face].solid && !inside ? 0 : -1;
    for (std::uint32_t k = 0; k < 3; ++k)
    {
      count(tally, placeOf(surface, 3 * face + k), placeOf(surface, 3 * face + (k + 1) % 3), sense);
    }
  }
  for (auto i = tally.begin(); i != tally.end();)
  {
    i = i->second == 0 ? tally.erase(i) : std::next(i);
  }
  return tally;
}

Tally found(const Surface& surface, const LightContour& contour)
{
  Tally tally;
  for (const LightContour::Edge& edge : contour.edges())
  {
    count(tally, placeOf(surface, edge.from), placeOf(surface, edge.to), 1);
  }
  return tally;
}

bool operator==(const LightContour::Edge& a, const LightContour::Edge& b)
{
  return a.from == b.from && a.to == b.to;
}
bool same(const LightContour& a, const LightContour& b)
{
  return std::equal(a.edges().begin(), a.edges().end(), b.edges().begin(), b.edges().end(),
           [](const auto& x, const auto& y) { return x == y; }) &&
    a.senses() == b.senses();
}
}

TEST(MeshEdges, KnowsWhatIsSolid)
{
  const auto solid = [](const Surface& surface)
  {
    const MeshEdges mesh(surface);
    return std::count_if(
      mesh.faces.begin(), mesh.faces.end(), [](const MeshEdges::Face& face) { return face.solid; });
  };
  const auto all = static_cast<std::ptrdiff_t>(ball(12).triangles.size());
  EXPECT_EQ(solid(ball(12)), all);
  EXPECT_EQ(solid(ball(12, 0, false, true)), all) << "points are joined where they lie";
  EXPECT_EQ(solid(ball(12, 1)), 0) << "one triangle is missing";
  EXPECT_EQ(solid(ball(12, 0, true)), 0) << "inside out";
  Surface both = ball(12);
  Surface open = ball(6, 3);
  for (glm::uvec3& t : open.triangles)
  {
    both.triangles.push_back(t + static_cast<unsigned>(both.points.size()));
  }
  for (const glm::vec3& point : open.points)
  {
    both.points.push_back(1.5f + 0.5f * (point - 1.5f));
  }
  EXPECT_EQ(solid(both), all) << "each part by itself";
}

TEST(MeshEdges, AreThoseOfAnEulerianSurface)
{
  const MeshEdges mesh(ball(12));
  // 24 triangles have no size: at each pole 24 edges join the pole with itself.
  const std::size_t triangles = 2 * 24 * 12 - 2 * 24;
  EXPECT_EQ(2 * mesh.edges.size(), 3 * triangles);
  EXPECT_EQ(MeshEdges(Surface()).edges.size(), 0u);
}

TEST(LightContour, IsWhatItsDefinitionSays)
{
  for (const Surface& surface : surfaces())
  {
    const MeshEdges mesh(surface);
    for (const glm::dvec4& light : lights(7, 60))
    {
      LightContour contour;
      contour.update(surface, mesh, light);
      ASSERT_EQ(found(surface, contour), expected(surface, mesh, light));
    }
  }
}

TEST(LightContour, ConsistsOfLoops)
{
  for (const Surface& surface : surfaces())
  {
    const MeshEdges mesh(surface);
    for (const glm::dvec4& light : lights(8, 60))
    {
      LightContour contour;
      contour.update(surface, mesh, light);
      std::map<Place, int> leaving;
      for (const LightContour::Edge& edge : contour.edges())
      {
        ++leaving[placeOf(surface, edge.from)];
        --leaving[placeOf(surface, edge.to)];
      }
      for (const auto& [place, surplus] : leaving)
      {
        ASSERT_EQ(surplus, 0);
      }
    }
  }
}

TEST(LightContour, HangsOnNoLightBefore)
{
  for (const Surface& surface : surfaces())
  {
    const MeshEdges mesh(surface);
    LightContour kept;
    glm::dvec4 last(0.0);
    for (const glm::dvec4& light : lights(9, 120))
    {
      LightContour fresh;
      fresh.update(surface, mesh, light);
      const LightContour before = kept;
      const bool other = kept.update(surface, mesh, light);
      ASSERT_TRUE(same(kept, fresh));
      ASSERT_TRUE(other || last == glm::dvec4(0.0) || same(kept, before));
      EXPECT_FALSE(kept.update(surface, mesh, light)) << "it is the same light";
      EXPECT_EQ(kept.turned(), 0u);
      last = light;
    }
  }
}

TEST(LightContour, AsksFewerTrianglesByTheirNormals)
{
  const Surface surface = ball(40);
  const MeshEdges mesh(surface);
  std::size_t one = 0, many = 0;
  LightContour kept;
  for (const glm::dvec4& light : lights(10, 120))
  {
    LightContour singly, bundled;
    singly.update(surface, mesh, light, false);
    bundled.update(surface, mesh, light);
    ASSERT_TRUE(same(singly, bundled));
    // A light that mixes the two ways.
    kept.update(surface, mesh, light, many % 2 == 0);
    ASSERT_TRUE(same(kept, singly));
    if (light.w == 0.0)
    {
      one += singly.asked();
      many += bundled.asked();
    }
  }
  EXPECT_LT(many, one / 2) << "of a light at infinity";
}

TEST(LightContour, TurnsFewTrianglesWhereALightMovesLittle)
{
  const Surface surface = ball(40);
  const MeshEdges mesh(surface);
  LightContour contour;
  contour.update(surface, mesh, { 3.0, 4.0, 5.0, 1.0 });
  EXPECT_TRUE(contour.update(surface, mesh, { 3.1, 4.0, 5.0, 1.0 }));
  EXPECT_GT(contour.turned(), 0u);
  EXPECT_LT(contour.turned(), surface.triangles.size() / 20);
  contour.forget();
  EXPECT_GT(contour.edges().size(), 0u) << "the contour stays";
  EXPECT_TRUE(contour.update(surface, mesh, { 3.1, 4.0, 5.0, 1.0 })) << "but all is asked again";
}
