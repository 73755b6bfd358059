// Colours the pixels of a frame: the hits of the eye's rays, lit by the lights that reach them.
#ifndef svoPixelShader_h
#define svoPixelShader_h

#include "svoDarkness.h"
#include "svoFrame.h"
#include "svoFrameTiles.h"
#include "svoHits.h"
#include "svoKeptTiles.h"
#include "svoParallel.h"
#include "svoShadows.h"
#include "svoSurfacePoint.h"
#include "svoTerminator.h"
#include "svoTileLighting.h"
#include "svoTileLook.h"
#include "svoTilePatch.h"
#include "svoTileSampler.h"
#include "svoViewLights.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
/// What is shaded; for the length of a frame.
struct ShadedScene
{
  const Scene& scene;
  const View& view;
  const FrameSettings& settings;
  const Hits& eye;
  const TileSampler& sampler; // of the eye
  const FrameTiles& tiles;    // of the frame that is written
  const Shadows& dark;
};

/// Two steps a frame: shade() gives each pixel its colour, smoothEdges() gives those on edges the
/// mean of four more rays.
class PixelShader
{
public:
  /// To be called once the eye has traced the scene.
  void prepare(const Scene& scene, const Hits& eye);

  /// Writes the tiles with hits that are stale, and notes which are at the terminator. Counts its
  /// shadow rays.
  void shade(const ShadedScene& shaded, const ParallelFor& parallelFor, KeptTiles& kept,
    Frame& frame, FrameStatistics& statistics);

  /// After shade() with FrameSettings::antiAliasing. Counts its rays.
  void smoothEdges(const ShadedScene& shaded, const ParallelFor& parallelFor, Frame& frame,
    FrameStatistics& statistics) const;

  /// What all points of a frame have in common.
  struct Lit
  {
    const ShadedScene& shaded;
    Lighting lighting;
    float remaining;      // of a light in its shadow
    bool samples = false; // points stand for a quarter of a pixel each, not for the pixel's centre

    explicit Lit(const ShadedScene& frame)
      : shaded(frame)
      , lighting(frame.scene, frame.view)
      , remaining(static_cast<float>(1.0 - frame.settings.shadowIntensity))
    {
    }
  };

  /// What a thread needs to shade up to 64 points.
  struct Scratch
  {
    TilePatch patch;
    TileTriangles triangles;
    TileLight light;
    TileColors colors;
    double extents[TilePatch::Most];         // world, as `missed`: MapTest::darkness()
    float missed[TilePatch::Most];           // by pixel: of one light
    Darkness darkness[TilePatch::Most];      // by pixel
    std::vector<TerminatorPoint> terminator; // of one light
    std::uint64_t rays;                      // of shadows
    KeptTiles::Tile* noted = nullptr;        // takes down what is asked; or null
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
  ShadowQuery allOf(Scratch& scratch) const;
  void shadow(std::size_t l, const Lit& lit, std::uint64_t reached, Scratch& scratch) const;
  void findTerminator(const LightShadow& shadow, const Light& light, const ShadowQuery& query,
    std::uint64_t dark, Scratch& scratch) const;
  void write(const Lit& lit, const TileHits& hits, Scratch& scratch, Frame& frame);

  // By index into Scene::instances.
  std::vector<SurfaceMatrices> Frames;
  std::vector<std::uint8_t> Smooth; // isSmooth()
  std::vector<PointErrors> Errors;  // of the instance's leaves as the eye sees them
  bool FindsEdges = false;
  std::vector<Darkness> DarkPixels; // per pixel, as the depth buffer, where edges are to be found
};
}

#endif
