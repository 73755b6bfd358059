#include "svoSampleRays.h"

#include "svoRayStream.h"
#include "svoTilePatch.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace svo
{
namespace
{
/// Of a start, in edges of the root cube, up to which a float tells it well enough.
constexpr double Near = 4.0;

/// A batch's rays in a caster's octree, and which they are.
class LocalRays
{
public:
  /// They start `offset` off their surface, world.
  LocalRays(const RayCaster& caster, double offset, const SampleBatch& batch)
    : Caster(caster)
    , Batch(batch)
    , Offset(offset)
  {
    // Directions of about unit length, however large the object is.
    const glm::dmat3 toOctree = caster.toOctree.inverse * caster.toOctree.scale;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Scale = std::max(this->Scale, glm::length(toOctree[axis]));
    }
    this->Turn = glm::mat3(toOctree / this->Scale);
  }

  glm::dvec3 start(int point) const
  {
    return this->Batch.position[point] + this->Offset * glm::dvec3(this->Batch.side[point]);
  }

  void add(int ray)
  {
    const int from = this->Batch.point[ray];
    if (!(this->Known >> from & 1))
    {
      this->Start[from] = this->Caster.toOctree.point(this->start(from));
      this->Far[from] = glm::distance(this->Start[from], glm::dvec3(1.5)) > Near;
      this->Known |= std::uint64_t(1) << from;
    }
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
    occluded(this->Caster.instance->body->octree, this->Rays,
      { this->Caster.geometry, MaximumLevel }, met);
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
  const double Offset;     // world
  double Scale = 0.0;      // world -> octree, of lengths at most
  glm::mat3 Turn;          // of directions, by that less
  std::uint64_t Known = 0; // points of which the start is
  glm::dvec3 Start[SampleBatch::MostPoints];
  bool Far[SampleBatch::MostPoints];
  OcclusionRays Rays;
  std::uint16_t Number[OcclusionRays::Most];
};
}

void traceSamples(const RayCasters& casters, double offset, SampleBatch& batch)
{
  if (batch.rays == 0)
  {
    return;
  }
  std::fill_n(batch.blocked, batch.rays, 0.0f);
  Box box;
  for (int i = 0; i < batch.points; ++i)
  {
    box.add(batch.position[i]);
  }
  RayStream stream(0.5 * (box.low + box.high));
  for (int ray = 0; ray < batch.rays; ++ray)
  {
    stream.add(batch.position[batch.point[ray]], batch.direction[ray], batch.length[ray]);
  }
  // Calls f(ray) for those that meet the caster.
  const auto eachMet = [&](const RayCaster& caster, const auto& f)
  {
    const double start = caster.startOffset(
      offset, batch.own == SampleBatch::AnyInstance || batch.own == caster.index);
    const RayStream::Mask mask =
      stream.reaching(caster.box.centre(), caster.box.extent() + glm::dvec3(start));
    if (mask.none())
    {
      return;
    }
    LocalRays rays(caster, start, batch);
    for (int word = 0; 64 * word < batch.rays; ++word)
    {
      eachBit(mask.word[word], [&](int bit) { rays.add(64 * word + bit); });
    }
    rays.eachMet([&](int ray) { f(rays, ray); });
  };
  const glm::dvec3 farthest(std::max(offset, casters.mostStartOffset()));
  casters.eachOpaque(
    0.5 * (box.low + box.high),
    [&](const glm::dvec3& centre, const glm::dvec3& extent)
    { return !stream.empty() && stream.reach(centre, extent + farthest); },
    [&](const RayCaster& caster)
    {
      eachMet(caster,
        [&](const LocalRays&, int ray)
        {
          batch.blocked[ray] = 1.0f;
          stream.end(ray);
        });
    });
  for (const RayCaster& caster : casters.translucent())
  {
    if (stream.empty())
    {
      return;
    }
    eachMet(caster,
      [&](const LocalRays& rays, int ray)
      {
        const float opacity =
          opacityMet(caster, rays.start(batch.point[ray]), batch.direction[ray], batch.length[ray]);
        batch.blocked[ray] = 1.0f - (1.0f - batch.blocked[ray]) * (1.0f - opacity);
      });
  }
}
}
