#include "svoSampleRays.h"

#include "svoWorldSize.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace svo
{
namespace
{
/// How far off the caster's own surface rays have to begin in float, of the edge of its root cube:
/// the roundings of the start and of a triangle's corners, and as much again.
constexpr double FloatOffset = 1e-6;

/// Of a start, in edges of the root cube, up to which a float tells it well enough.
constexpr double Near = 4.0;

/// A batch's rays in a caster's octree, and which they are.
class LocalRays
{
public:
  LocalRays(const RayCaster& caster, double offset, const SampleBatch& batch)
    : Caster(caster)
    , Batch(batch)
    , Offset(std::max({ offset, caster.planeError,
        caster.index == batch.own ? FloatOffset * worldVoxel(*caster.instance, 0) : 0.0 }))
  {
    // Directions of about unit length, however large the object is.
    const glm::dmat3 toOctree = caster.toOctree.inverse * caster.toOctree.scale;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Scale = std::max(this->Scale, glm::length(toOctree[axis]));
    }
    this->Turn = glm::mat3(toOctree / this->Scale);
    for (int i = 0; i < batch.points; ++i)
    {
      this->Start[i] = caster.toOctree.point(this->start(i));
      this->Far[i] = glm::distance(this->Start[i], glm::dvec3(1.5)) > Near;
    }
  }

  glm::dvec3 start(int point) const
  {
    return this->Batch.position[point] + this->Offset * glm::dvec3(this->Batch.side[point]);
  }

  void add(int ray)
  {
    const int from = this->Batch.point[ray];
    glm::dvec3 at = this->Start[from];
    const glm::vec3 along = this->Turn * this->Batch.direction[ray];
    double length = this->Scale * this->Batch.length[ray];
    if (this->Far[from])
    {
      // To where it comes near the cube.
      const glm::dvec3 d(along);
      const double ahead =
        glm::dot(glm::dvec3(1.5) - at, d) / glm::dot(d, d) - Near / glm::length(d);
      at += std::max(ahead, 0.0) * d;
      length -= std::max(ahead, 0.0);
    }
    this->Number[this->Rays.count] = static_cast<std::uint16_t>(ray);
    this->Rays.add(glm::vec3(at), along, static_cast<float>(std::min(length, 1e30)));
  }

  /// Calls f(ray) for those that meet something.
  template <class F>
  void eachMet(F&& f)
  {
    std::uint64_t met[OcclusionRays::Most / 64];
    if (this->Rays.count > 0)
    {
      occluded(this->Caster.instance->body->octree, this->Rays,
        { this->Caster.geometry, MaximumLevel }, met);
    }
    for (int i = 0; i < this->Rays.count; ++i)
    {
      if (met[i / 64] >> (i % 64) & 1)
      {
        f(this->Number[i]);
      }
    }
  }

private:
  const RayCaster& Caster;
  const SampleBatch& Batch;
  const double Offset; // world
  double Scale = 0.0;  // world -> octree, of lengths at most
  glm::mat3 Turn;      // of directions, by that less
  glm::dvec3 Start[SampleBatch::MostPoints];
  bool Far[SampleBatch::MostPoints];
  OcclusionRays Rays;
  std::uint16_t Number[OcclusionRays::Most];
};
}

void SampleRays::trace(const BoxWay& way, double offset, SampleBatch& batch) const
{
  std::fill_n(batch.blocked, batch.rays, 0.0f);
  std::uint16_t left[SampleBatch::MostRays];
  int count = 0;
  for (int ray = 0; ray < batch.rays; ++ray)
  {
    left[count] = static_cast<std::uint16_t>(ray);
    count += batch.length[ray] > 0.0f;
  }
  if (count == 0)
  {
    return;
  }
  this->Casters.anyOpaque(way,
    [&](const RayCaster& caster)
    {
      LocalRays rays(caster, offset, batch);
      std::for_each(left, left + count, [&](int ray) { rays.add(ray); });
      rays.eachMet([&](int ray) { batch.blocked[ray] = 1.0f; });
      count = static_cast<int>(
        std::remove_if(left, left + count, [&](int ray) { return batch.blocked[ray] >= 1.0f; }) -
        left);
      return count == 0;
    });
  for (const RayCaster& caster : this->Casters.translucent())
  {
    if (count == 0 || !caster.box.mayMeet(way))
    {
      continue;
    }
    LocalRays rays(caster, offset, batch);
    std::for_each(left, left + count, [&](int ray) { rays.add(ray); });
    rays.eachMet(
      [&](int ray)
      {
        const float opacity =
          opacityMet(caster, rays.start(batch.point[ray]), batch.direction[ray], batch.length[ray]);
        batch.blocked[ray] = 1.0f - (1.0f - batch.blocked[ray]) * (1.0f - opacity);
      });
  }
}
}
