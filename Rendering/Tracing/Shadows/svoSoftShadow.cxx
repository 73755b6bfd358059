#include "svoSoftShadow.h"

#include "svoSampleDirections.h"

#include <algorithm>

namespace svo
{
SoftShadow::SoftShadow(const Light& light, const ShadowRays& exact, const RayCasters& casters,
  const PixelRotations& rotations, int samples, const LightBuffers* maps)
  : RayShadow(light, exact, maps)
  , Casters(casters)
  , Rotations(rotations)
  , Samples(firstPoints(samples))
{
}

/// Sets what the points of a batch miss, by pixel.
void SoftShadow::ask(
  const ShadowQuery& query, SampleBatch& batch, const int* pixels, float* missed) const
{
  struct Cone
  {
    LightCone light;
    SquarePoint rotation;
    float lost = 0.0f;
    int seen = 0; // samples above the facet
  };
  std::vector<Cone> cones;
  cones.reserve(static_cast<std::size_t>(batch.points));
  const TilePatch& patch = query.patch;
  batch.own = patch.instance;
  for (int i = 0; i < batch.points; ++i)
  {
    cones.push_back({ LightCone(this->Source, batch.position[i]),
      this->Rotations.at(patch.x(pixels[i]), patch.y(pixels[i])) });
  }
  const auto trace = [&]
  {
    traceSamples(this->Casters, query.errors.ray, batch);
    for (int ray = 0; ray < batch.rays; ++ray)
    {
      Cone& cone = cones[batch.point[ray]];
      cone.lost += sampleShare(batch.blocked[ray]);
      ++cone.seen;
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
      float length;
      const glm::vec3 along = cones[i].light.direction(sample + cones[i].rotation, length);
      if (glm::dot(along, batch.side[i]) > 0.0f)
      {
        batch.addRay(i, along, length);
      }
    }
  }
  trace();
  for (int i = 0; i < batch.points; ++i)
  {
    // Where no sample is above the facet, the exact ray to the light's middle says.
    const float seen = static_cast<float>(cones[i].seen);
    const float lost = seen > 0.0f ? cones[i].lost
                                   : static_cast<float>(this->Rays.shadows(this->Source,
                                       batch.position[i], batch.side[i], query.errors.ray));
    missed[pixels[i]] = seen > 0.0f ? lost / seen : lost;
    if (query.sums)
    {
      query.sums->set(pixels[i], lost, seen);
    }
  }
}

std::uint64_t SoftShadow::test(const ShadowQuery& query, float* missed) const
{
  SampleBatch batch;
  int pixels[SampleBatch::MostPoints];
  std::fill_n(missed, TilePatch::Most, 0.0f);
  eachBit(query.asked,
    [&](int i) { pixels[batch.addPoint(query.patch.position(i), query.patch.facet(i))] = i; });
  this->ask(query, batch, pixels, missed);
  std::uint64_t dark = 0;
  eachBit(query.asked, [&](int i) { dark |= std::uint64_t(missed[i] > 0.0f) << i; });
  return dark;
}

void SoftShadow::testTerminator(
  const ShadowQuery& query, const std::vector<TerminatorPoint>& points, float* missed) const
{
  SampleBatch batch;
  int pixels[SampleBatch::MostPoints];
  for (const TerminatorPoint& at : points)
  {
    // Doubted ones have been asked for: what the samples above their facets say is true.
    if (at.kind == TerminatorPoint::Kind::Hidden)
    {
      missed[at.pixel] = 1.0f;
      if (query.sums)
      {
        const float seen = query.sums->count[at.pixel];
        query.sums->set(at.pixel, std::max(seen, 1.0f), seen);
      }
    }
    else if (at.kind == TerminatorPoint::Kind::Raised)
    {
      pixels[batch.addPoint(at.point.position, at.point.facet)] = at.pixel;
    }
  }
  this->ask(query, batch, pixels, missed);
}
}
