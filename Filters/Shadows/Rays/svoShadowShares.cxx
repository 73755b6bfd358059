#include "svoShadowShares.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
/// What one thread needs for a piece.
struct Scratch
{
  std::vector<std::uint32_t> places;
  std::vector<Sample> samples;
  std::vector<double> shadow;   // by place, then light
  std::vector<double> exposure; // by place
  bool faced = false;
};

/// Adds up to 64 samples of a piece for one light.
void addSamples(const Sample* samples, int count, const WeightedLight& source,
  const RayCasters& casters, const OwnMesh& own, const ShareOptions& options, std::size_t light,
  std::size_t lights, Scratch& scratch)
{
  std::uint64_t asked = 0;
  double cosines[PieceSamples];
  for (int i = 0; i < count && source.on; ++i)
  {
    const Sample& sample = samples[i];
    const glm::dvec3 along = source.light.along(sample.position);
    const double length = glm::length(along);
    const bool sided = sample.normal != glm::dvec3(0.0);
    const double cosine = sided ? -glm::dot(sample.normal, along) / length : 1.0;
    cosines[i] = std::abs(cosine);
    const bool inCone =
      source.cone < -1.0 || glm::dot(along, source.light.direction) >= source.cone * length;
    const bool faces = cosine > 0.0 || (options.twoSided && cosine < 0.0);
    asked |= std::uint64_t(length > 0.0 && inCone && faces) << i;
  }
  scratch.faced = scratch.faced || asked != 0;
  const std::uint64_t lit = asked == 0
    ? 0
    : asked & ~hiddenSamples(casters, own, source.light, samples, count, asked, options.singleRays);
  for (int i = 0; i < count; ++i)
  {
    const Sample& sample = samples[i];
    if (lit >> i & 1)
    {
      const double arrives = options.cosine ? cosines[i] : 1.0;
      scratch.exposure[sample.place] += source.weight * sample.share * arrives;
    }
    else
    {
      scratch.shadow[sample.place * lights + light] += sample.share;
    }
  }
}
}

bool computeShadowShares(const Samples& samples, const RayCasters& casters, const OwnMesh& own,
  const std::vector<WeightedLight>& lights, const ShareOptions& options, const ShareArrays& out)
{
  const auto shadePiece = [&](std::size_t index, Scratch& scratch)
  {
    samples.piece(index, scratch.places, scratch.samples);
    scratch.shadow.assign(scratch.places.size() * lights.size(), 0.0);
    scratch.exposure.assign(scratch.places.size(), 0.0);
    for (std::size_t first = 0; first < scratch.samples.size(); first += PieceSamples)
    {
      const auto count = static_cast<int>(std::min(PieceSamples, scratch.samples.size() - first));
      for (std::size_t l = 0; l < lights.size(); ++l)
      {
        addSamples(scratch.samples.data() + first, count, lights[l], casters, own, options, l,
          lights.size(), scratch);
      }
    }
    for (std::size_t p = 0; p < scratch.places.size(); ++p)
    {
      const std::size_t id = scratch.places[p];
      out.exposure[id] = scratch.exposure[p];
      for (std::size_t l = 0; out.shadow && l < lights.size(); ++l)
      {
        // All of a cell is exactly 1, whatever its samples' shares add up to.
        const double share = scratch.shadow[p * lights.size() + l];
        out.shadow[id * lights.size() + l] = static_cast<float>(share > 1.0 - 1e-9 ? 1.0 : share);
      }
    }
  };
  // Pieces go in batches, between which it is asked whether to go on.
  const std::size_t pieces = samples.pieces();
  const std::size_t rays = std::max<std::size_t>(1, lights.size()) * PieceSamples;
  const std::size_t batch = std::max<std::size_t>(16, 1000000 / rays);
  for (std::size_t first = 0; first < pieces; first += batch)
  {
    const double done = static_cast<double>(first) / static_cast<double>(pieces);
    if (options.progress && !options.progress(done))
    {
      return false;
    }
    options.parallelFor(first, std::min(first + batch, pieces), 4,
      [&](std::size_t begin, std::size_t end)
      {
        Scratch scratch;
        for (std::size_t i = begin; i < end; ++i)
        {
          shadePiece(i, scratch);
        }
        if (scratch.faced && out.faced)
        {
          *out.faced = true;
        }
      });
  }
  return !options.progress || options.progress(1.0);
}
}
