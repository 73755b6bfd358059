#include "svoLightImages.h"

#include "svoWorldSize.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

namespace svo
{
void LightImages::resize(int tilesX, int tilesY)
{
  this->TilesX = tilesX;
  this->TilesY = tilesY;
  const int columns = LightFilter::Block * this->blocksX() + 2 * LightFilter::Margin;
  const int rows = 8 * tilesY + 2 * LightFilter::Reach;
  this->Stride = static_cast<std::size_t>(columns);
  this->Surfaces.resize(this->Stride * static_cast<std::size_t>(rows));
  this->Noise.assign(static_cast<std::size_t>(this->blocksX() * this->blocksY()), {});
  this->Held.assign(static_cast<std::size_t>(tilesX) * static_cast<std::size_t>(tilesY), 0);
}

void LightImages::begin(const SampledPlanes& sampled, int tilesX, int tilesY,
  const std::uint8_t* hit, int samples, bool more)
{
  if (!sampled.any())
  {
    *this = LightImages();
    return;
  }
  assert(!more || sampled.count == this->Sampled.count);
  this->Sampled = sampled;
  this->First = more ? this->Samples : 0;
  this->Samples = samples;
  if (this->TilesX != tilesX || this->TilesY != tilesY)
  {
    this->resize(tilesX, tilesY);
  }
  this->Planes.resize(static_cast<std::size_t>(sampled.count));
  for (Plane& plane : this->Planes)
  {
    if (plane.count.size() == this->Surfaces.depth.size())
    {
      continue;
    }
    for (RawArray<float>* part : { &plane.sum, &plane.count, &plane.mean })
    {
      part->resize(this->Surfaces.depth.size());
      std::fill_n(part->data(), part->size(), 0.0f); // of tiles that are never started
    }
  }
  this->Variance.resize(this->Surfaces.depth.size());
  for (std::size_t tile = 0; hit && tile < this->Held.size(); ++tile)
  {
    if (this->Held[tile] && !hit[tile])
    {
      this->startTile(static_cast<int>(tile) % this->TilesX, static_cast<int>(tile) / this->TilesX);
      this->Held[tile] = 0;
    }
  }
}

void LightImages::startTile(int tileX, int tileY)
{
  this->Held[static_cast<std::size_t>(tileY) * static_cast<std::size_t>(this->TilesX) +
    static_cast<std::size_t>(tileX)] = 1;
  for (int row = 0; row < 8; ++row)
  {
    const std::size_t at = this->at(8 * tileX, 8 * tileY + row);
    this->Surfaces.remove(at, 8);
    for (Plane& plane : this->Planes)
    {
      std::fill_n(plane.sum.data() + at, 8, 0.0f);
      std::fill_n(plane.count.data() + at, 8, 0.0f);
    }
  }
}

void LightImages::put(const TilePatch& patch)
{
  const View& view = *patch.view;
  SampledSurfaces& all = this->Surfaces;
  eachBit(patch.mask,
    [&](int i)
    {
      const std::size_t at = this->at(patch, i);
      const double t = patch.t(i);
      const glm::dvec3 facet(patch.facet(i));
      // As seen from the side it bends away soon.
      const double along = glm::dot(facet, view.rayDirection(patch.x(i), patch.y(i)));
      const double facing = std::copysign(std::max(std::abs(along), 1e-3), along);
      // A point on the facet stays there: dot(facet, its way) is 0.
      const double tX = -glm::dot(facet, view.originX + t * view.directionX) / facing;
      const double tY = -glm::dot(facet, view.originY + t * view.directionY) / facing;
      const double perT = view.parallel ? 1.0 : -1.0 / (t * t);
      all.normalX[at] = patch.normal.x[i];
      all.normalY[at] = patch.normal.y[i];
      all.normalZ[at] = patch.normal.z[i];
      all.depth[at] = static_cast<float>(view.parallel ? t : 1.0 / t);
      all.depthX[at] = static_cast<float>(tX * perT);
      all.depthY[at] = static_cast<float>(tY * perT);
      all.pixel[at] = static_cast<float>(std::abs(widerWorldPixel(view, t) / facing * perT));
    });
}

void LightImages::put(int plane, const TilePatch& patch, std::uint64_t mask, const SampleSums& sums)
{
  Plane& of = this->Planes[static_cast<std::size_t>(plane)];
  eachBit(mask,
    [&](int i)
    {
      const std::size_t at = this->at(patch, i);
      const float count = sums.count[i];
      if (count > 0.0f && of.count[at] >= 1.0f)
      {
        of.sum[at] += sums.sum[i];
        of.count[at] += count;
      }
      else if (of.count[at] < 1.0f)
      {
        // What is known without samples counts as long as there are none, and hardly.
        constexpr float Hardly = 1.0f / 1024.0f;
        of.count[at] = count > 0.0f ? count : Hardly;
        of.sum[at] = count > 0.0f ? sums.sum[i] : Hardly * sums.sum[i];
      }
    });
}

void LightImages::findMeans(int blockX, int blockY, bool filtered)
{
  const int y0 = LightFilter::Block * blockY;
  const int rows = std::min(LightFilter::Block, 8 * this->TilesY - y0);
  const std::size_t first = this->at(LightFilter::Block * blockX, y0);
  SampleNoise noise;
  for (std::size_t p = 0; p < this->Planes.size(); ++p)
  {
    Plane& plane = this->Planes[p];
    const LightFilter::Evenness even = this->Sampled.isOfLight(static_cast<int>(p))
      ? LightFilter::Evenness::ofLight(this->Samples)
      : LightFilter::Evenness::allAround(this->Samples);
    if (filtered)
    {
      LightFilter::filter({ this->Surfaces, this->Stride, plane.sum.data(), plane.count.data(),
                            plane.mean.data(), this->Variance.data(), even },
        first, rows);
    }
    for (int row = 0; row < rows; ++row)
    {
      const std::size_t at = first + static_cast<std::size_t>(row) * this->Stride;
      for (std::size_t i = at; i < at + LightFilter::Block; ++i)
      {
        const float count = plane.count[i];
        if (!filtered)
        {
          // No mean is read where there is no count.
          plane.mean[i] = count > 0.0f ? plane.sum[i] / count : 0.0f;
          this->Variance[i] = LightFilter::varianceOf(plane.sum[i], count, even);
        }
        const bool sampled = this->Surfaces.pixel[i] >= 0.0f && count >= 1.0f;
        noise.squares += sampled ? static_cast<double>(this->Variance[i]) : 0.0;
        noise.count += sampled ? 1.0 : 0.0;
      }
    }
  }
  this->Noise[static_cast<std::size_t>(blockY * this->blocksX() + blockX)] = noise;
}

SampleNoise LightImages::noise() const
{
  SampleNoise all;
  for (const SampleNoise& block : this->Noise)
  {
    all.add(block);
  }
  return all;
}
}
