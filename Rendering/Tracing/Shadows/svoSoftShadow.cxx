#include "svoSoftShadow.h"

#include "svoSampleDirections.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace svo
{
/// A point that asks.
struct SoftShadow::Asker
{
  glm::dvec3 position; // world
  glm::vec3 facet;     // unit, towards the viewer
  int pixel;           // of its patch
};

SoftShadow::SoftShadow(const Light& light, const ShadowRays& exact, const SampleRays& rays,
  const PixelRotations& rotations, int samples)
  : RayShadow(light, exact)
  , Sampler(rays)
  , Rotations(rotations)
  , Samples(firstPoints(samples))
{
}

/// Sets what the askers miss, by pixel.
void SoftShadow::ask(const ShadowQuery& query, const Asker* askers, int count, float* missed) const
{
  struct Cone
  {
    LightCone light;
    SquarePoint rotation;
    float lost = 0.0f;
    int seen = 0; // samples above the facet
  };
  std::vector<Cone> cones;
  cones.reserve(static_cast<std::size_t>(count));
  const TilePatch& patch = query.patch;
  for (int i = 0; i < count; ++i)
  {
    const Asker& asker = askers[i];
    cones.push_back({ LightCone(this->Source, asker.position),
      this->Rotations.at(patch.x(asker.pixel), patch.y(asker.pixel)) });
  }
  const auto trace = [&](SampleBatch& batch)
  {
    this->Sampler.trace(query.errors.ray, batch);
    for (int ray = 0; ray < batch.rays; ++ray)
    {
      Cone& cone = cones[batch.point[ray]];
      cone.lost += sampleShare(batch.blocked[ray]);
      ++cone.seen;
    }
    query.rays += static_cast<std::uint64_t>(batch.rays);
    batch.rays = 0;
  };
  SampleBatch batch;
  batch.own = query.patch.instance;
  for (int i = 0; i < count; ++i)
  {
    batch.addPoint(askers[i].position, askers[i].facet);
  }
  for (std::size_t s = static_cast<std::size_t>(query.firstSample()); s < this->Samples.size(); ++s)
  {
    const SquarePoint& sample = this->Samples[s];
    if (batch.rays + count > SampleBatch::MostRays)
    {
      trace(batch);
    }
    for (int i = 0; i < count; ++i)
    {
      float length;
      const glm::vec3 along = cones[i].light.direction(sample + cones[i].rotation, length);
      if (glm::dot(along, askers[i].facet) > 0.0f)
      {
        batch.addRay(i, along, length);
      }
    }
  }
  trace(batch);
  for (int i = 0; i < count; ++i)
  {
    const Asker& asker = askers[i];
    // Where no sample is above the facet, the exact ray to the light's middle says.
    const float seen = static_cast<float>(cones[i].seen);
    const float lost = seen > 0.0f ? cones[i].lost
                                   : static_cast<float>(this->Rays.shadows(this->Source,
                                       asker.position, asker.facet, query.errors.ray));
    missed[asker.pixel] = seen > 0.0f ? lost / seen : lost;
    if (query.sums)
    {
      query.sums->set(asker.pixel, lost, seen);
    }
  }
}

std::uint64_t SoftShadow::test(const ShadowQuery& query, float* missed) const
{
  Asker askers[TilePatch::Most];
  int count = 0;
  std::fill_n(missed, TilePatch::Most, 0.0f);
  eachBit(query.asked,
    [&](int i) {
      askers[count++] = { query.patch.position(i), query.patch.facet(i), i };
    });
  this->ask(query, askers, count, missed);
  std::uint64_t dark = 0;
  eachBit(query.asked, [&](int i) { dark |= std::uint64_t(missed[i] > 0.0f) << i; });
  return dark;
}

void SoftShadow::testTerminator(
  const ShadowQuery& query, const std::vector<TerminatorPoint>& points, float* missed) const
{
  Asker askers[TilePatch::Most];
  int count = 0;
  for (const TerminatorPoint& at : points)
  {
    assert(count < TilePatch::Most);
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
      askers[count++] = { at.point.position, at.point.facet, at.pixel };
    }
  }
  this->ask(query, askers, count, missed);
}
}
