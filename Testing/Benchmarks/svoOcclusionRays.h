// Rays of ambient occlusion, from what the pixels of pictures see, in batches.
#ifndef svoOcclusionRays_h
#define svoOcclusionRays_h

#include "svoIntersect.h"
#include "svoOcclusion.h"
#include "svoSurface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <glm/geometric.hpp>

namespace svobench
{
using svo::OcclusionRays;

constexpr int Directions = 8; // of a pixel
constexpr std::size_t Words = OcclusionRays::Most / 64;

/// Rays in batches, and what becomes of them.
struct Batches
{
  std::vector<OcclusionRays> rays;
  std::size_t count = 0;

  template <class Visit>
  void forEach(Visit&& visit) const
  {
    for (std::size_t b = 0; b < this->rays.size(); ++b)
    {
      for (int i = 0; i < this->rays[b].count; ++i)
      {
        visit(this->rays[b], i, b * Words + i / 64, std::uint64_t(1) << i % 64);
      }
    }
  }
};
using Answers = std::vector<std::uint64_t>;

/// Eyes look at random places of the surface, 8x8 pixels each; from what they see rays go into the
/// half space of the facet's normal, more of them along it.
class Pixels
{
public:
  Pixels(const svo::Octree& o, int rays)
    : octree(o)
  {
    const svo::Surface& surface = *o.surface();
    double area = 0.0;
    for (std::uint32_t i = 0; i < surface.triangles.size(); ++i)
    {
      this->areas.push_back(area += 0.5 * glm::length(this->normal(i)));
    }
    while (this->batches.count < static_cast<std::size_t>(rays))
    {
      this->look();
    }
  }

  /// The same rays up to an end.
  Batches upTo(float tMax) const
  {
    Batches result = this->batches;
    for (OcclusionRays& rays : result.rays)
    {
      std::fill_n(rays.tMax, rays.count, tMax);
    }
    return result;
  }

private:
  glm::dvec3 corner(std::uint32_t triangle, int k) const
  {
    const svo::Surface& surface = *this->octree.surface();
    return surface.points[surface.triangles[triangle][k]];
  }
  glm::dvec3 normal(std::uint32_t triangle) const
  {
    const glm::dvec3 a = this->corner(triangle, 0);
    return glm::cross(this->corner(triangle, 1) - a, this->corner(triangle, 2) - a);
  }
  double unit() { return std::uniform_real_distribution<double>(0.0, 1.0)(this->random); }
  /// In the half space of a unit vector, of a density as the cosine to it.
  glm::dvec3 around(const glm::dvec3& n)
  {
    const double z = 2.0 * this->unit() - 1.0, turn = 6.283185307179586 * this->unit();
    const double flat = std::sqrt(std::max(1.0 - z * z, 0.0));
    const glm::dvec3 d = n + glm::dvec3(flat * std::cos(turn), flat * std::sin(turn), z);
    return glm::length(d) > 1e-6 ? glm::normalize(d) : n;
  }

  void look()
  {
    const double edge = 1.0 / (1 << this->octree.rootBits(0));
    const auto at =
      std::upper_bound(this->areas.begin(), this->areas.end(), this->unit() * this->areas.back());
    const auto triangle = static_cast<std::uint32_t>(
      std::min<std::ptrdiff_t>(at - this->areas.begin(), this->areas.size() - 1));
    const glm::dvec3 n = this->normal(triangle);
    if (!(glm::length(n) > 0.0))
    {
      return;
    }
    const double u = std::sqrt(this->unit()), v = this->unit();
    const glm::dvec3 seen = (1.0 - u) * this->corner(triangle, 0) +
      u * (1.0 - v) * this->corner(triangle, 1) + u * v * this->corner(triangle, 2);
    const glm::dvec3 back = this->around(glm::normalize(n));
    const glm::dvec3 right = glm::normalize(
      glm::cross(back, std::abs(back.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const glm::dvec3 up = glm::cross(back, right);
    const glm::dvec3 eye = seen + 0.5 * edge * back;
    svo::RayBlock block;
    for (int i = 0; i < svo::RayBlock::Size; ++i)
    {
      const double pixel = 1e-3 * edge;
      block.aim(i, eye, -0.5 * edge * back + pixel * ((i % 8 - 3.5) * right + (i / 8 - 3.5) * up));
      block.tMin[i] = 0.0f;
      block.tMax[i] = 4.0f;
    }
    svo::HitBlock hits;
    svo::TraceOptions options;
    options.leafGeometry = svo::LeafGeometry::Triangle;
    svo::intersect(this->octree, block, options, hits);
    OcclusionRays& rays = this->batches.rays.emplace_back();
    for (int i = 0; i < svo::RayBlock::Size; ++i)
    {
      if (hits.primitive[i] == svo::NoPrimitive)
      {
        continue;
      }
      const glm::dvec3 direction(block.directionX[i], block.directionY[i], block.directionZ[i]);
      glm::dvec3 facing = glm::normalize(this->normal(hits.primitive[i]));
      facing = glm::dot(facing, direction) > 0.0 ? -facing : facing;
      const glm::dvec3 origin =
        eye + static_cast<double>(hits.t[i]) * direction + 1e-6 * edge * facing;
      for (int k = 0; k < Directions; ++k)
      {
        const int j = rays.count++;
        const glm::dvec3 way = this->around(facing);
        rays.originX[j] = static_cast<float>(origin.x);
        rays.originY[j] = static_cast<float>(origin.y);
        rays.originZ[j] = static_cast<float>(origin.z);
        rays.directionX[j] = static_cast<float>(way.x);
        rays.directionY[j] = static_cast<float>(way.y);
        rays.directionZ[j] = static_cast<float>(way.z);
      }
    }
    this->batches.count += static_cast<std::size_t>(rays.count);
  }

  const svo::Octree& octree;
  std::mt19937 random{ 1 };
  std::vector<double> areas; // of the triangles up to each
  Batches batches;
};
}

#endif
