// Colours the pixels of a frame: the hits of the eye's rays, lit by the lights that reach them.
#ifndef svoPixelShader_h
#define svoPixelShader_h

#include "svoFrame.h"
#include "svoLightImages.h"
#include "svoParallel.h"
#include "svoPatchShadows.h"
#include "svoShadedScene.h"
#include "svoShadedTiles.h"
#include "svoTileLighting.h"
#include "svoTileLook.h"
#include "svoTilePatch.h"
#include "svoViewLights.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <glm/vec2.hpp>

namespace svo
{
/// How dark a pixel is in the shadows of the lights: four bits for each of the first eight lights;
/// the others share theirs with these.
using Darkness = std::uint32_t;

/// `share` of light number l, 0..1.
inline void darken(Darkness& darkness, std::size_t l, float share)
{
  const unsigned shift = 4 * (l % 8);
  const Darkness held = (darkness >> shift) & 15u;
  const Darkness more = static_cast<Darkness>(std::clamp(share, 0.0f, 1.0f) * 15.0f + 0.5f);
  darkness = (darkness & ~(15u << shift)) | (std::min(held + more, 15u) << shift);
}

/// True if one light's shadow changes from the one to the other by more than an eighth of the
/// light; a gentler change needs no further rays.
inline bool shadowChanges(Darkness a, Darkness b)
{
  if (a == b)
  {
    return false;
  }
  for (unsigned shift = 0; shift < 32; shift += 4)
  {
    const int change = static_cast<int>((a >> shift) & 15u) - static_cast<int>((b >> shift) & 15u);
    if (std::abs(change) > 2)
    {
      return true;
    }
  }
  return false;
}

/// Two steps a frame: shade() gives each pixel its colour, smoothEdges() gives those on edges the
/// mean of four more rays.
class PixelShader
{
public:
  /// To be called once the eye has traced the scene.
  void prepare(const Scene& scene, const Hits& eye) { this->Points.prepare(scene, eye); }
  const PatchShadows& points() const { return this->Points; }

  /// Writes the tiles with hits that are to be shaded anew, and notes of stale ones what the
  /// answers hang on. What samples found is in `sampled`. Counts its shadow rays.
  void shade(const ShadedScene& shaded, const LightImages& sampled, const ParallelFor& parallelFor,
    ShadedTiles& kept, Frame& frame, FrameStatistics& statistics);

  /// After shade() with FrameSettings::antiAliasing. Counts its rays.
  void smoothEdges(const ShadedScene& shaded, const ParallelFor& parallelFor, Frame& frame,
    FrameStatistics& statistics) const;

  /// What all points of a frame have in common.
  struct Lit
  {
    const ShadedScene& shaded;
    Lighting lighting;
    float remaining;                     // of a light in its shadow
    const LightImages* images = nullptr; // what samples found at pixels' centres; null: points
                                         // take their own
    bool samples = false; // points stand for a quarter of a pixel each, not for the pixel's centre

    explicit Lit(const ShadedScene& frame)
      : shaded(frame)
      , lighting(frame.scene, frame.view)
      , remaining(static_cast<float>(1.0 - frame.settings.shadowIntensity))
    {
    }
  };

  /// What a thread needs to shade up to 64 points.
  struct Scratch : PatchShadows::Scratch
  {
    TileColors colors;
    Darkness darkness[TilePatch::Most]; // by pixel
    /// By point: the pixel whose samples of light it takes from Lit::images; null: its own.
    const glm::ivec2* pixels = nullptr;

    /// Those of the points that a light reaches of which samples were taken. Another pixel may be
    /// turned away from the light.
    std::uint64_t sampled(const LightImages& images, int plane, std::uint64_t reached) const;
    /// What they found.
    float mean(const LightImages& images, int plane, int i) const
    {
      return this->pixels ? images.mean(plane, this->pixels[i].x, this->pixels[i].y)
                          : images.mean(plane, this->patch, i);
    }
  };

  /// After shade(): colours the points of hits anywhere in a tile, patch by patch: sets `colors`
  /// and `darkness` where the patch is and calls f(). Adds to the rays.
  template <class F>
  void shadePatches(const Lit& lit, const TileHits& hits, Scratch& scratch, F&& f) const
  {
    eachPatch(
      lit.shaded.view, hits, [](std::uint32_t) { return true; },
      [&](std::uint32_t i) { return lit.shaded.eye.base(i); }, scratch.patch,
      [&](const TilePatch&)
      {
        this->shadePatch(lit, scratch);
        f();
      });
  }

private:
  void shadePatch(const Lit& lit, Scratch& scratch) const;
  void occlude(const Lit& lit, Scratch& scratch) const;
  void addSky(const Lit& lit, Scratch& scratch) const;
  void shadow(std::size_t l, const Lit& lit, std::uint64_t reached, Scratch& scratch) const;
  void write(const Lit& lit, const TileHits& hits, Scratch& scratch, Frame& frame);

  PatchShadows Points;
  bool FindsEdges = false;
  std::vector<Darkness> DarkPixels; // per pixel, as the depth buffer, where edges are to be found
};
}

#endif
