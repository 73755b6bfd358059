// The pixels on edges once more, with four rays each: anti-aliasing.
#include "svoDepthBuffer.h"
#include "svoEdges.h"
#include "svoHits.h"
#include "svoPixelShader.h"
#include "svoWorldSize.h"

#include <algorithm>
#include <atomic>
#include <limits>

namespace svo
{
namespace
{
/// The edges among the hits of the eye's rays, and where shadows begin on them.
struct DepthEdges
{
  const Hits& eye;
  const std::vector<Darkness>& darkness; // per pixel, as the view's depth buffer
  const View& view;

  /// Writes the pixels (8 * row + column) of the tile that are hits and edges; returns how many.
  int find(int tileX, int tileY, int pixels[64]) const
  {
    int count = 0;
    for (int k = 0; k < 64; ++k)
    {
      const int x = 8 * tileX + (k & 7);
      const int y = 8 * tileY + (k >> 3);
      if (this->instance(x, y) != NoInstance && isEdge(*this, x, y))
      {
        pixels[count++] = k;
      }
    }
    return count;
  }

  std::uint32_t instance(int x, int y) const
  {
    return x >= 0 && y >= 0 && x < view.width && y < view.height ? eye.depth.instanceAt(x, y)
                                                                 : NoInstance;
  }

  bool changes(int x, int y) const
  {
    return this->changes(x, y, 1, 0) || this->changes(x, y, 0, 1);
  }

  bool changes(int x, int y, int dx, int dy) const
  {
    const DepthBuffer& depth = eye.depth;
    const std::size_t at = depth.at(x, y);
    const std::size_t before = depth.at(x - dx, y - dy), after = depth.at(x + dx, y + dy);
    const double t = depth.t[at];
    return shadowChanges(darkness[before], darkness[at]) ||
      shadowChanges(darkness[after], darkness[at]) ||
      depthSteps<double>(
        depth.t[before], t, depth.t[after], worldPixel(view, eye.base(depth.instance[at]) + t));
  }
};
}

void PixelShader::smoothEdges(const ShadedScene& shaded, const ParallelFor& parallelFor,
  Frame& frame, FrameStatistics& statistics) const
{
  // A rotated grid: four points of a pixel that share no row and no column.
  constexpr double OffsetX[4] = { 0.375, 0.875, 0.125, 0.625 };
  constexpr double OffsetY[4] = { 0.125, 0.375, 0.625, 0.875 };
  const View& view = shaded.view;
  const DepthEdges edges{ shaded.eye, this->DarkPixels, view };
  Lit lit(shaded);
  lit.samples = true;
  // Of a sample, as of multisampled framebuffers of that kind.
  const float brightest = shaded.settings.writeLight ? std::numeric_limits<float>::max() : 1.0f;
  std::atomic<std::uint64_t> primaryRays{ 0 };
  std::atomic<std::uint64_t> shadowRays{ 0 };
  struct EdgeScratch
  {
    int pixels[64];
    TileSamples samples;
    TileHitList hits;
    glm::vec3 colors[64]; // of the samples
    PixelShader::Scratch shading;
  };
  const auto color = [&](int tileX, int tileY, EdgeScratch& scratch)
  {
    const TileSamples& samples = scratch.samples;
    scratch.hits.start(8 * tileX, 8 * tileY);
    for (int k = 0; k < 64; ++k)
    {
      const std::uint32_t instance = samples.instance[k];
      if (instance != NoInstance)
      {
        scratch.hits.put(k, samples.x[k], samples.y[k],
          static_cast<float>(samples.t[k] - shaded.eye.base(instance)), instance,
          samples.primitive[k]);
      }
    }
    this->shadePatches(lit, scratch.hits.hits, scratch.shading,
      [&]
      {
        const PixelVectors& found = scratch.shading.colors.rgb;
        eachBit(scratch.shading.patch.mask,
          [&](int i) { scratch.colors[i] = glm::clamp(found(i), 0.0f, brightest); });
      });
  };
  const auto smoothTile = [&](int tileX, int tileY, EdgeScratch& scratch)
  {
    int* pixels = scratch.pixels;
    const int count = edges.find(tileX, tileY, pixels);
    scratch.shading.rays = 0;
    for (int first = 0; first < count; first += 16)
    {
      TileSamples& samples = scratch.samples;
      for (int k = 0; k < 64; ++k)
      {
        const int pixel = pixels[std::min(first + k / 4, count - 1)];
        samples.x[k] = 8 * tileX + (pixel & 7) + OffsetX[k % 4];
        samples.y[k] = 8 * tileY + (pixel >> 3) + OffsetY[k % 4];
      }
      shaded.sampler.sample(tileX, tileY, &samples, 1);
      primaryRays.fetch_add(64, std::memory_order_relaxed);
      std::fill(samples.instance + 4 * std::min(16, count - first), samples.instance + 64,
        NoInstance); // of no further pixel
      color(tileX, tileY, scratch);
      for (int p = 0; p < std::min(16, count - first); ++p)
      {
        glm::vec3 sum(0.0f);
        int hits = 0;
        for (int k = 4 * p; k < 4 * p + 4; ++k)
        {
          if (samples.instance[k] != NoInstance)
          {
            ++hits;
            sum += scratch.colors[k];
          }
        }
        const int x = 8 * tileX + (pixels[first + p] & 7);
        const int y = 8 * tileY + (pixels[first + p] >> 3);
        const std::size_t pixel = static_cast<std::size_t>(y) * view.width + x;
        for (int c = 0; c < 3 && hits > 0; ++c)
        {
          const float mean = sum[c] / static_cast<float>(hits);
          frame.color[4 * pixel + c] = toByte(mean);
          if (shaded.settings.writeLight)
          {
            frame.light[3 * pixel + c] = mean;
          }
        }
      }
    }
    shadowRays.fetch_add(scratch.shading.rays, std::memory_order_relaxed);
  };
  shaded.tiles.each<EdgeScratch>(parallelFor, smoothTile);
  statistics.primaryRays += primaryRays;
  statistics.shadowRays += shadowRays;
}
}
