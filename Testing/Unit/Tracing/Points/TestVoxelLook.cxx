// Normals and colours between the middles of voxels: against a plain sum over all voxels around,
// against the surfaces' own, and continuity; the voxel below a node that is nearest to a point.
#include "svoVoxelLook.h"

#include "svoIntersect.h"
#include "svoMorton.h"
#include "svoNode.h"
#include "svoPlane.h"
#include "svoTestFields.h"

#include <iostream>
#include <map>
#include <random>
#include <tuple>

namespace
{
using namespace svotest;

/// Of a torus around z: the distance from it.
struct TorusField : svo::ScalarField
{
  double large = 0.6, small = 0.25;
  double value(const glm::dvec3& at) const override
  {
    return std::hypot(std::hypot(at.x, at.y) - large, at.z) - small;
  }
  glm::dvec3 gradient(const glm::dvec3& at) const override
  {
    const double around = std::hypot(at.x, at.y);
    const double out = (around - large) / around;
    return glm::normalize(glm::dvec3(at.x * out, at.y * out, at.z));
  }
};

struct BoxField : svo::ScalarField
{
  double value(const glm::dvec3& at) const override
  {
    return std::max({ std::abs(at.x), std::abs(at.y), std::abs(at.z) }) - 0.503;
  }
  glm::dvec3 gradient(const glm::dvec3& at) const override
  {
    const glm::dvec3 d = glm::abs(at);
    const int axis = d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
    glm::dvec3 g(0.0);
    g[axis] = at[axis] < 0.0 ? -1.0 : 1.0;
    return g;
  }
};

/// All voxels with their normals, by their place in the root cube.
using Voxels = std::map<std::tuple<int, int, int>, glm::vec3>;

void collect(const svo::Octree& octree, std::uint32_t node, const glm::ivec3& block, Voxels& all)
{
  for (std::uint64_t mask = octree.nodes()[node].mask; mask != 0; mask &= mask - 1)
  {
    const int i = svo::lowestBit(mask);
    const glm::ivec3 cell = 4 * block + svo::cellOfIndex(i);
    if (node < octree.brickBegin())
    {
      collect(octree, svo::child(octree.nodes()[node], i), cell, all);
    }
    else
    {
      all[{ cell.x, cell.y, cell.z }] =
        svo::decodePlane(octree.lists()[octree.planeOf(node, i)]).normal;
    }
  }
}

/// Trilinear weights of whatever voxels there are.
glm::vec3 plainNormal(
  const svo::Octree& octree, const Voxels& all, const glm::dvec3& at, const glm::vec3& own)
{
  const glm::dvec3 place = (at - 1.0) * std::ldexp(1.0, 2 * octree.depthCount());
  glm::dvec3 sum(0.0);
  const glm::ivec3 here(glm::floor(place));
  for (int i = 0; i < 27; ++i)
  {
    const glm::ivec3 cell = here + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1;
    const auto found = all.find({ cell.x, cell.y, cell.z });
    if (found == all.end() || glm::dot(found->second, own) <= 0.5f)
    {
      continue;
    }
    const glm::dvec3 share = glm::max(1.0 - glm::abs(place - (glm::dvec3(cell) + 0.5)), 0.0);
    sum += share.x * share.y * share.z * glm::dvec3(found->second);
  }
  return glm::length(sum) > 1e-6 ? glm::vec3(glm::normalize(sum)) : own;
}

glm::vec3 normalAt(const svo::Octree& octree, const glm::dvec3& at, const glm::vec3& own)
{
  return svo::smoothNormal(svo::voxelsAround(octree, at, own), own);
}

struct Shot
{
  glm::dvec3 at; // octree coordinates
  glm::dvec3 local;
  glm::vec3 own;
};

template <class Visit>
void shoot(const svo::Octree& octree, int count, const Visit& visit)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const glm::dmat4 toOctree = octree.localToOctree();
  const glm::dmat4 toLocal = glm::inverse(toOctree);
  int hits = 0;
  for (int i = 0; i < count; ++i)
  {
    const glm::dvec3 from =
      3.0 * glm::normalize(glm::dvec3(number(random), number(random), number(random)));
    const glm::dvec3 to(number(random), number(random), 0.3 * number(random));
    const svo::Ray ray{ glm::dvec3(toOctree * glm::dvec4(from, 1.0)),
      glm::dvec3(toOctree * glm::dvec4(to - from, 0.0)), 0.0, 2.0 };
    const svo::Hit hit = svo::intersect(octree, ray, { svo::LeafGeometry::Plane });
    if (hit)
    {
      const glm::dvec3 at = ray.origin + hit.t * ray.direction;
      visit(Shot{ at, glm::dvec3(toLocal * glm::dvec4(at, 1.0)),
        svo::decodePlane(octree.lists()[hit.primitive]).normal });
      ++hits;
    }
  }
  EXPECT_GT(hits, count / 10);
}

double degrees(double cosine)
{
  return std::acos(std::min(1.0, cosine)) * 57.29577951308232;
}

void compareNormals(const svo::ScalarField& field, int level, double bar)
{
  const svo::Octree octree = octreeOfField(field, boxOfInterest(level));
  double own = 0.0, smooth = 0.0, largest[2] = {};
  int count = 0;
  shoot(octree, 20000,
    [&](const Shot& shot)
    {
      const glm::dvec3 truth = glm::normalize(field.gradient(shot.local));
      const double a = degrees(glm::dot(truth, glm::dvec3(shot.own)));
      const double b = degrees(glm::dot(truth, glm::dvec3(normalAt(octree, shot.at, shot.own))));
      own += a * a;
      smooth += b * b;
      largest[0] = std::max(largest[0], a);
      largest[1] = std::max(largest[1], b);
      ++count;
    });
  own = std::sqrt(own / count);
  smooth = std::sqrt(smooth / count);
  std::cout << "level " << level << ": RMS error of normals " << own << " (at most " << largest[0]
            << ") degrees of planes, " << smooth << " (" << largest[1] << ") interpolated\n";
  EXPECT_LT(smooth, bar * own);
}
}

TEST(VoxelLook, NormalsAreThoseOfAPlainSum)
{
  for (const int level : { 3, 4, 6 })
  {
    const TorusField torus;
    const BoxField box;
    for (const svo::ScalarField* field :
      { static_cast<const svo::ScalarField*>(&torus), static_cast<const svo::ScalarField*>(&box) })
    {
      const svo::Octree octree = octreeOfField(*field, boxOfInterest(level));
      Voxels all;
      collect(octree, 0, glm::ivec3(0), all);
      ASSERT_EQ(all.size(), octree.header().voxelCount);
      shoot(octree, 3000,
        [&](const Shot& shot)
        {
          const glm::vec3 expected = plainNormal(octree, all, shot.at, shot.own);
          const glm::vec3 normal = normalAt(octree, shot.at, shot.own);
          ASSERT_LT(glm::length(normal - expected), 1e-4f) << level;
        });
    }
  }
}

TEST(VoxelLook, NormalsAreNearerToTheSurfacesOwn)
{
  for (const int level : { 5, 6, 7 })
  {
    compareNormals(SphereField(0.7), level, 0.5);
    compareNormals(TorusField(), level, 0.5);
  }
}

TEST(VoxelLook, EdgesStaySharp)
{
  const BoxField box;
  const svo::Octree octree = octreeOfField(box, boxOfInterest(6));
  shoot(octree, 3000,
    [&](const Shot& shot)
    {
      // Voxels of a face alone, and those on an edge that were met as that face's.
      const glm::vec3 normal = normalAt(octree, shot.at, shot.own);
      if (std::max({ std::abs(shot.own.x), std::abs(shot.own.y), std::abs(shot.own.z) }) > 0.999f)
      {
        ASSERT_GT(glm::dot(normal, shot.own), 0.86f);
      }
    });
}

TEST(VoxelLook, NoJumpsOnASmoothSurface)
{
  const SphereField sphere(0.7);
  const svo::Octree octree = octreeOfField(sphere, boxOfInterest(5));
  const glm::dmat4 toOctree = octree.localToOctree();
  glm::vec3 before(0.0f);
  constexpr int Steps = 20000;
  for (int i = 0; i <= Steps; ++i)
  {
    const double angle = 6.283185307179586 * i / Steps;
    const glm::dvec3 out = glm::normalize(glm::dvec3(std::cos(angle), std::sin(angle), 0.37));
    const glm::vec3 normal =
      normalAt(octree, glm::dvec3(toOctree * glm::dvec4(0.7 * out, 1.0)), glm::vec3(out));
    if (i > 0)
    {
      // Planes of neighbours are some 3 degrees apart: a step is a hundredth of a voxel.
      ASSERT_LT(degrees(glm::dot(normal, before)), 0.2) << i;
    }
    before = normal;
  }
}

/// Calls visit(brick, voxel's plane, its middle in octree coordinates) for all voxels.
template <class Visit>
void eachVoxel(const svo::Octree& octree, const Visit& visit, std::uint32_t node = 0,
  const glm::ivec3& block = glm::ivec3(0))
{
  for (std::uint64_t mask = octree.nodes()[node].mask; mask != 0; mask &= mask - 1)
  {
    const int i = svo::lowestBit(mask);
    const glm::ivec3 cell = 4 * block + svo::cellOfIndex(i);
    if (node < octree.brickBegin())
    {
      eachVoxel(octree, visit, svo::child(octree.nodes()[node], i), cell);
      continue;
    }
    visit(node, octree.planeOf(node, i),
      1.0 + std::ldexp(1.0, -2 * octree.depthCount()) * (glm::dvec3(cell) + 0.5));
  }
}

/// The middles of all voxels, by the indices of their planes; octree coordinates.
std::vector<glm::dvec3> middlesOf(const svo::Octree& octree)
{
  std::vector<glm::dvec3> middles(octree.header().voxelCount);
  eachVoxel(octree,
    [&](std::uint32_t, std::uint32_t plane, const glm::dvec3& middle) { middles[plane] = middle; });
  return middles;
}

TEST(VoxelLook, ColorsHaveNoStepsBetweenVoxels)
{
  const SphereField sphere(0.7);
  const svo::Octree octree = octreeOfField(sphere, boxOfInterest(5));
  const glm::dmat4 toOctree = octree.localToOctree();
  const std::vector<glm::dvec3> middles = middlesOf(octree);
  const double voxel = std::ldexp(1.0, -2 * octree.depthCount());
  const auto colorOf = [&](std::uint32_t plane) { return glm::vec3(middles[plane] - 1.0); };
  glm::vec3 before(0.0f);
  constexpr int Steps = 20000;
  for (int i = 0; i <= Steps; ++i)
  {
    const double angle = 6.283185307179586 * i / Steps;
    const glm::dvec3 out = glm::normalize(glm::dvec3(std::cos(angle), std::sin(angle), 0.37));
    const glm::dvec3 at(toOctree * glm::dvec4(0.7 * out, 1.0));
    const svo::VoxelsAround around = svo::voxelsAround(octree, at, glm::vec3(out));
    ASSERT_GT(around.count, 0);
    // A colour that is the place: that of the voxels around is near, and moves with the point.
    const glm::vec3 color = svo::smoothColor(around, glm::vec3(9.0f), colorOf);
    ASSERT_LT(glm::length(glm::dvec3(color) + 1.0 - at), 0.9 * voxel) << i;
    if (i > 0)
    {
      ASSERT_LT(glm::length(color - before), 0.1 * voxel) << i;
    }
    before = color;
  }
  EXPECT_EQ(svo::smoothColor({}, glm::vec3(9.0f), colorOf), glm::vec3(9.0f));
}

TEST(VoxelLook, OfAPointBelowANodeTheVoxelThatItIsIn)
{
  const SphereField sphere(0.7);
  for (const int level : { 6, 7 })
  {
    const svo::Octree octree = octreeOfField(sphere, boxOfInterest(level));
    std::uint32_t voxel = 0;
    eachVoxel(octree,
      [&](std::uint32_t brick, std::uint32_t, const glm::dvec3& middle)
      {
        ASSERT_EQ(svo::nearestVoxel(octree, brick, middle), voxel);
        ASSERT_EQ(svo::nearestVoxel(octree, 0, middle), voxel);
        ++voxel;
      });
    EXPECT_EQ(voxel, octree.header().voxelCount);
  }
}
