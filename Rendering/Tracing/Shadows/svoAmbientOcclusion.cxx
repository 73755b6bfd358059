#include "svoAmbientOcclusion.h"

#include "svoSampleDirections.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace svo
{
double usualOcclusionDistance(const Scene& scene)
{
  PointBox all;
  for (const Instance& instance : scene.instances)
  {
    CasterBox(instance).addTo(all);
  }
  return all.empty() ? 1.0 : 0.2 * glm::distance(all.low, all.high);
}

AmbientOcclusion::AmbientOcclusion(const SampleRays& rays, double distance, int samples)
  : Rays(rays)
  , Distance(distance)
{
  for (int i = 0; i < samples; ++i)
  {
    this->Samples.push_back(sequencePoint(static_cast<std::uint32_t>(i)));
  }
}

void AmbientOcclusion::test(const ShadowQuery& query, float* closed) const
{
  constexpr unsigned Stream = ~0u; // no light's
  const TilePatch& patch = query.patch;
  SampleBatch batch;
  batch.own = patch.instance;
  PointBox box;
  std::vector<Basis> bases;
  SquarePoint rotations[TilePatch::Most];
  int pixels[TilePatch::Most];
  std::fill_n(closed, TilePatch::Most, 0.0f);
  eachBit(query.asked,
    [&](int i)
    {
      const glm::dvec3 position = patch.position(i);
      rotations[batch.points] = pixelRotation(
        static_cast<int>(std::floor(patch.x(i))), static_cast<int>(std::floor(patch.y(i))), Stream);
      pixels[batch.points] = i;
      batch.addPoint(position, patch.facet(i));
      bases.emplace_back(patch.facet(i));
      box.add(position, glm::dvec3(query.errors.ray));
    });
  const auto trace = [&]
  {
    this->Rays.trace(this->way(box), query.errors.ray, batch);
    for (int ray = 0; ray < batch.rays; ++ray)
    {
      closed[pixels[batch.point[ray]]] += batch.blocked[ray];
    }
    query.rays += static_cast<std::uint64_t>(batch.rays);
    batch.rays = 0;
  };
  for (const SquarePoint& sample : this->Samples)
  {
    if (batch.rays + batch.points > SampleBatch::MostRays)
    {
      trace();
    }
    for (int i = 0; i < batch.points; ++i)
    {
      batch.addRay(
        i, cosineDirection(bases[i], sample + rotations[i]), static_cast<float>(this->Distance));
    }
  }
  trace();
  for (int i = 0; i < batch.points; ++i)
  {
    closed[pixels[i]] /= static_cast<float>(this->Samples.size());
  }
}
}
