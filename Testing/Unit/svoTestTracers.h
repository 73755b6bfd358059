// Tracers under test and the comparison of each with the reference octree.
#ifndef svoTestTracers_h
#define svoTestTracers_h

#include "svoIntersect.h"
#include "svoLeafGeometry.h"
#include "svoReference.h"
#include "svoTestScenes.h"
#include "svoTraverse.h"

namespace svotest
{
inline std::vector<glm::ivec3> noise(int level, unsigned count, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> coordinate(0, (1 << level) - 1);
  std::vector<glm::ivec3> voxels(count);
  for (glm::ivec3& v : voxels)
  {
    v = { coordinate(random), coordinate(random), coordinate(random) };
  }
  return voxels;
}

/// Edge of a cell of a level in octree coordinates.
inline double cellEdge(const svo::Octree& octree, int level)
{
  return 1.0 / double(1 << octree.rootBits(level));
}

inline svo::ReferenceHit trace(
  const svo::Octree& octree, const svo::ReferenceOctree& reference, const svo::Ray& ray)
{
  const double edge = cellEdge(octree, reference.level);
  return svo::intersect(
    reference, (ray.origin - 1.0) / edge, ray.direction / edge, ray.tMin, ray.tMax);
}

struct FoundCell
{
  bool hit;
  glm::ivec3 cell;
  double t;
};

inline FoundCell traceDouble(const svo::Octree& octree, const svo::Ray& ray, int level)
{
  const svo::Hit hit = svo::intersect(octree, ray, { svo::LeafGeometry::Voxel, level });
  return { bool(hit), hit.cell, hit.t };
}

inline FoundCell traceFloat(const svo::Octree& octree, const svo::Ray& ray, int level)
{
  svo::ClippedRay<float> clipped;
  if (!svo::clip(octree, glm::vec3(ray.origin), glm::vec3(ray.direction), float(ray.tMin),
        float(ray.tMax), clipped))
  {
    return { false, {}, 0.0 };
  }
  const svo::LeafQuery query(octree, { svo::LeafGeometry::Voxel, level });
  const svo::LeafHit<float> hit = svo::intersectLeaves(query, clipped, false);
  return { hit.primitive != svo::NoPrimitive, hit.cell, hit.t };
}

struct Agreement
{
  int rays = 0;
  int hits = 0;
  int ties = 0;      // another voxel, and the ray grazes one of the two within 1e-6
  int wrong = 0;     // another voxel without such an excuse
  int missTies = 0;  // hit against miss, and the ray grazes the voxel within 1e-6
  double worstT = 0; // largest difference of t where the voxel is the same, along the ray
};

/// Compares a tracer with the reference at the reference's level.
template <class Tracer>
void compare(const svo::Octree& octree, const svo::ReferenceOctree& reference, int rays,
  unsigned seed, Tracer&& tracer, Agreement& agreement)
{
  const int level = reference.level;
  const double edge = cellEdge(octree, level);
  RandomRays random(octree, seed);
  const auto grazesCell = [&](const svo::Ray& ray, const glm::ivec3& cell)
  {
    const glm::dvec3 low = 1.0 + glm::dvec3(cell) * edge;
    return grazes(ray, low, low + edge, 1e-6);
  };
  for (int i = 0; i < rays; ++i)
  {
    const svo::Ray ray = random.next();
    const svo::ReferenceHit expected = trace(octree, reference, ray);
    const FoundCell found = tracer(octree, ray, level);
    ++agreement.rays;
    agreement.hits += expected.hit;
    if (expected.hit != found.hit)
    {
      ++(grazesCell(ray, expected.hit ? expected.voxel : found.cell) ? agreement.missTies
                                                                     : agreement.wrong);
    }
    else if (expected.hit && expected.voxel != found.cell)
    {
      // One saw a voxel in front of the other's. The ray must all but miss that one.
      ++(grazesCell(ray, expected.voxel) || grazesCell(ray, found.cell) ? agreement.ties
                                                                        : agreement.wrong);
    }
    else if (expected.hit)
    {
      agreement.worstT =
        std::max(agreement.worstT, std::abs(expected.t - found.t) * glm::length(ray.direction));
    }
  }
}
}

#endif
