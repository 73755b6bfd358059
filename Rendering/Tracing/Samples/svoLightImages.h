// What a frame's samples of light have found, pixel by pixel, and the surfaces that they lie on.
//
// Kept from frame to frame: where nothing has changed more samples are added, where something has
// pixels begin anew. Shading reads the means, as they are or filtered (svoLightFilter.h).
#ifndef svoLightImages_h
#define svoLightImages_h

#include "svoLightFilter.h"
#include "svoParallel.h"
#include "svoRawArray.h"
#include "svoReceivers.h"
#include "svoSampleSums.h"
#include "svoTilePatch.h"
#include "vtkSVOTracingModule.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
/// How far off means of samples may be by chance.
struct SampleNoise
{
  double squares = 0.0; // of a share, 0..1; a sum over ...
  double count = 0.0;   // pixels of planes

  void add(const SampleNoise& other)
  {
    this->squares += other.squares;
    this->count += other.count;
  }
  double rms() const { return this->count > 0.0 ? std::sqrt(this->squares / this->count) : 0.0; }
};

class VTKSVOTRACING_EXPORT LightImages
{
public:
  /// Begins a frame of so many tiles. `hit`: those that have surfaces, or null: they all may.
  /// `samples`: that it is to have. `more`: those of the last one are among them.
  void begin(const SampledPlanes& sampled, int tilesX, int tilesY, const std::uint8_t* hit,
    int samples, bool more);

  const SampledPlanes& sampled() const { return this->Sampled; }
  /// Number of the first sample that this frame takes.
  int firstSample() const { return this->First; }

  // Different tiles may be written at once.
  /// Nothing is known of a tile any more. For tiles that do not have more samples than before.
  void startTile(int tileX, int tileY);
  /// The surfaces of a patch.
  void put(const TilePatch& patch);
  /// Samples of its points in `mask`.
  void put(int plane, const TilePatch& patch, std::uint64_t mask, const SampleSums& sums);

  /// Finds the means of tiles that wants(tileX, tileY) says of; `filtered`: over neighbours.
  template <class Wants>
  void findMeans(const ParallelFor& parallelFor, bool filtered, const Wants& wants);

  /// Of the points of a patch of a tile's own pixels, after findMeans().
  float mean(int plane, const TilePatch& patch, int pixel) const
  {
    return this->Planes[static_cast<std::size_t>(plane)].mean[this->at(patch, pixel)];
  }
  /// ... and of any pixel; 0 where nothing was sampled.
  float mean(int plane, int x, int y) const
  {
    const Plane& of = this->Planes[static_cast<std::size_t>(plane)];
    const std::size_t pixel = this->at(x, y);
    return of.count[pixel] > 0.0f ? of.mean[pixel] : 0.0f;
  }

  /// Any was taken there.
  bool has(int plane, int x, int y) const
  {
    return this->Planes[static_cast<std::size_t>(plane)].count[this->at(x, y)] > 0.0f;
  }

  /// Of the means.
  SampleNoise noise() const;

private:
  struct Plane
  {
    RawArray<float> sum, count, mean;
  };
  std::size_t at(int x, int y) const
  {
    return static_cast<std::size_t>(y + LightFilter::Reach) * this->Stride + LightFilter::Margin +
      static_cast<std::size_t>(x);
  }
  std::size_t at(const TilePatch& patch, int pixel) const
  {
    return this->at(patch.hits->x0 + (pixel & 7), patch.hits->y0 + (pixel >> 3));
  }
  void resize(int tilesX, int tilesY);
  void findMeans(int blockX, int blockY, bool filtered);
  int blocksX() const { return (this->TilesX + BlockTiles - 1) / BlockTiles; }
  int blocksY() const { return (this->TilesY + BlockTiles - 1) / BlockTiles; }

  static constexpr int BlockTiles = LightFilter::Block / 8;
  int TilesX = 0, TilesY = 0;
  std::size_t Stride = 0;
  int First = 0, Samples = 0;
  std::vector<std::uint8_t> Held; // by tile
  SampledPlanes Sampled;
  std::vector<Plane> Planes;
  RawArray<float> Variance;       // of the means of one of them
  std::vector<SampleNoise> Noise; // by block
  SampledSurfaces Surfaces;
};

template <class Wants>
void LightImages::findMeans(const ParallelFor& parallelFor, bool filtered, const Wants& wants)
{
  const auto blocks = static_cast<std::size_t>(this->blocksX() * this->blocksY());
  forEach(parallelFor, blocks, 1,
    [&](std::size_t block)
    {
      const int blockX = static_cast<int>(block) % this->blocksX();
      const int blockY = static_cast<int>(block) / this->blocksX();
      const int x0 = BlockTiles * blockX, y0 = BlockTiles * blockY;
      bool wanted = false;
      for (int y = y0; y < std::min(y0 + BlockTiles, this->TilesY) && !wanted; ++y)
      {
        for (int x = x0; x < std::min(x0 + BlockTiles, this->TilesX) && !wanted; ++x)
        {
          wanted = wants(x, y);
        }
      }
      if (wanted)
      {
        this->findMeans(blockX, blockY, filtered);
      }
    });
}
}

#endif
