// The pixels on edges once more, with four rays each: anti-aliasing.
#include "svoPixelShader.h"

#include "svoTerminator.h"
#include "svoTileLighting.h"
#include "svoWorldSize.h"

#include <algorithm>
#include <atomic>
#include <limits>

namespace svo
{
void PixelShader::smoothEdges(const ShadedScene& shaded, const ParallelFor& parallelFor,
  Frame& frame, FrameStatistics& statistics) const
{
  // A rotated grid: four points of a pixel that share no row and no column.
  constexpr double OffsetX[4] = { 0.375, 0.875, 0.125, 0.625 };
  constexpr double OffsetY[4] = { 0.125, 0.375, 0.625, 0.875 };
  const Scene& scene = shaded.scene;
  const View& view = shaded.view;
  const EdgeFinder edges(shaded.eye.depthBuffer(), shaded.eye, this->DarkPixels, view);
  const Lighting lighting(scene, view);
  const float remaining = static_cast<float>(1.0 - shaded.settings.shadowIntensity);
  // Of a sample, as of multisampled framebuffers of that kind.
  const float brightest = shaded.settings.writeLight ? std::numeric_limits<float>::max() : 1.0f;
  std::atomic<std::uint64_t> primaryRays{ 0 };
  std::atomic<std::uint64_t> shadowRays{ 0 };
  struct Scratch
  {
    int pixels[64];
    TileSamples samples;
  };
  const auto smoothTile = [&](int tileX, int tileY, Scratch& scratch)
  {
    int* pixels = scratch.pixels;
    const int count = edges.find(tileX, tileY, pixels);
    std::uint64_t rays = 0;
    for (int first = 0; first < count; first += 16)
    {
      TileSamples& samples = scratch.samples;
      for (int k = 0; k < 64; ++k)
      {
        const int pixel = pixels[std::min(first + k / 4, count - 1)];
        samples.x[k] = 8 * tileX + (pixel & 7) + OffsetX[k % 4];
        samples.y[k] = 8 * tileY + (pixel >> 3) + OffsetY[k % 4];
      }
      shaded.eye.sample(tileX, tileY, &samples, 1);
      primaryRays.fetch_add(64, std::memory_order_relaxed);
      for (int p = 0; p < std::min(16, count - first); ++p)
      {
        glm::vec3 sum(0.0f);
        int hits = 0;
        for (int k = 4 * p; k < 4 * p + 4; ++k)
        {
          const std::uint32_t i = samples.instance[k];
          if (i == NoInstance)
          {
            continue;
          }
          ++hits;
          const double extent = 0.5 * worldPixel(view, samples.t[k]);
          const SurfacePoint point = surfacePoint(
            this->Frames[i], view, samples.x[k], samples.y[k], samples.t[k], samples.primitive[k]);
          const glm::vec3 towards(-view.rayDirection(samples.x[k], samples.y[k]));
          const auto darkness = [&](std::size_t l)
          {
            const Shadows& dark = shaded.dark;
            const float plain = dark.darkness(l, point, this->Errors[i], extent, rays);
            if (this->Smooth[i] && dark.knowsTerminator(l))
            {
              const TerminatorPoint at = atTerminator(this->Frames[i], scene.lights[l],
                dark.grazing(), plain > 0.0f, point, towards, samples.primitive[k]);
              if (at.kind != TerminatorPoint::Kind::Plain)
              {
                return dark.darkness(l, point, at, plain, this->Errors[i], extent, rays);
              }
            }
            return plain;
          };
          sum += glm::clamp(
            svo::shade(lighting, scene.instances[i], point, remaining, darkness), 0.0f, brightest);
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
    shadowRays.fetch_add(rays, std::memory_order_relaxed);
  };
  shaded.tiles.each<Scratch>(parallelFor, smoothTile);
  statistics.primaryRays += primaryRays;
  statistics.shadowRays += shadowRays;
}
}
