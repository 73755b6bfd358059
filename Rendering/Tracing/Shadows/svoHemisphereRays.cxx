#include "svoHemisphereRays.h"

#include "svoBox.h"
#include "svoSampleDirections.h"
#include "svoSampleRays.h"

#include <glm/geometric.hpp>

namespace svo
{
double usualOcclusionDistance(const Scene& scene)
{
  Box all;
  for (const Instance& instance : scene.instances)
  {
    const Octree& octree = instance.body->octree;
    if (!instance.castShadow || !octree || octree.header().pointCount == 0)
    {
      CasterBox(instance).addTo(all);
      continue;
    }
    // Without the margins of a caster's box, which depend on the octree's level.
    all.add(boxAround(octree.header().meshBounds, instance.localToWorld));
  }
  return all.known() ? 0.2 * glm::distance(all.low, all.high) : 1.0;
}

HemisphereRays::HemisphereRays(const RayCasters& casters, double distance,
  const PixelRotations& rotations, int samples, const SkyPicture* picture)
  : Casters(casters)
  , Distance(distance)
  , Rotations(rotations)
  , Picture(picture)
  , Samples(firstPoints(samples))
{
}

void HemisphereRays::each(
  const ShadowQuery& query, const std::function<void(int, const glm::vec3&, float)>& f) const
{
  const TilePatch& patch = query.patch;
  SampleBatch batch;
  batch.own = patch.instance;
  std::vector<Basis> bases;
  SquarePoint rotations[TilePatch::Most];
  int pixels[TilePatch::Most];
  eachBit(query.asked,
    [&](int i)
    {
      rotations[batch.points] = this->Rotations.at(patch.x(i), patch.y(i));
      pixels[batch.addPoint(patch.position(i), patch.facet(i))] = i;
      bases.emplace_back(normalOver(patch, i));
    });
  const auto trace = [&]
  {
    traceSamples(this->Casters, query.errors.ray, batch);
    for (int ray = 0; ray < batch.rays; ++ray)
    {
      f(pixels[batch.point[ray]], batch.direction[ray], batch.blocked[ray]);
    }
    query.rays += static_cast<std::uint64_t>(batch.rays);
    batch.rays = 0;
  };
  for (std::size_t s = static_cast<std::size_t>(query.firstSample()); s < this->Samples.size(); ++s)
  {
    const SquarePoint& sample = this->Samples[s];
    if (batch.rays + batch.points > SampleBatch::MostRays)
    {
      trace();
    }
    for (int i = 0; i < batch.points; ++i)
    {
      const SquarePoint at = sample + rotations[i];
      const glm::vec3 along =
        this->Picture ? this->Picture->direction(at.position()) : cosineDirection(bases[i], at);
      if (glm::dot(along, batch.side[i]) > 0.0f)
      {
        batch.addRay(i, along, static_cast<float>(this->Distance));
      }
      else if (this->Picture)
      {
        f(pixels[i], along, 0.0f);
      }
    }
  }
  trace();
}
}
