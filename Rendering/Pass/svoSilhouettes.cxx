#include "svoSilhouettes.h"

#include "svoDepthBuffer.h"
#include "svoIntersect.h"
#include "svoLocalView.h"
#include "svoSelect.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace svo
{
namespace
{
constexpr int MostSamples = 32;

/// An instance as the view sees it.
struct SeenInstance
{
  LocalView local;
  TraceOptions options;
};

/// The inverse of View::windowDepth.
double linearDepth(const View& view, double window)
{
  const glm::dmat4& p = view.viewToClip;
  const double ndc = 2.0 * window - 1.0;
  return (p[3][2] - ndc * p[3][3]) / (p[2][2] - ndc * p[2][3]);
}

/// The nearest hits of 64 points of the image.
struct Samples
{
  double x[64];
  double y[64];
  double t[64]; // linear depth
  std::uint32_t instance[64];
};

class Finder
{
public:
  Finder(const Scene& scene, const View& view, double pixelError, const Frame& frame,
    const std::vector<glm::vec2>& positions)
    : Instances(scene.instances)
    , Of(view)
    , Picture(frame)
    , Positions(positions)
    , SampleCount(std::min(static_cast<int>(positions.size()), MostSamples))
  {
    for (const Instance& instance : scene.instances)
    {
      SeenInstance seen;
      if (instance.visible && instance.octree && !instance.octree.empty())
      {
        seen.local = makeLocalView(instance.octree, instance.localToWorld, view);
        seen.options = { instance.leafGeometry,
          selectLevel(instance, seen.local, view, pixelError) };
      }
      this->Seen.push_back(seen);
    }
  }

  /// The tile's pixels that are shared.
  void find(int tileX, int tileY, Silhouettes& result) const
  {
    Tile tile(*this, 8 * tileX, 8 * tileY);
    if (tile.present.empty())
    {
      return;
    }
    const int atOnce = 64 / this->SampleCount;
    std::array<int, 64> edges;
    int count = 0;
    for (int k = 0; k < 64; ++k)
    {
      if (tile.x0 + (k & 7) < this->Of.width && tile.y0 + (k >> 3) < this->Of.height &&
        (this->edge(tile, k, 1, 0) || this->edge(tile, k, 0, 1)))
      {
        edges[count++] = k;
      }
    }
    for (int first = 0; first < count; first += atOnce)
    {
      Samples samples;
      for (int s = 0; s < 64; ++s)
      {
        const int k = edges[std::min(first + s / this->SampleCount, count - 1)];
        const glm::vec2 position = this->Positions[s % this->SampleCount];
        samples.x[s] = tile.x0 + (k & 7) + static_cast<double>(position.x);
        samples.y[s] = tile.y0 + (k >> 3) + static_cast<double>(position.y);
      }
      this->trace(tile, samples);
      for (int e = first; e < std::min(first + atOnce, count); ++e)
      {
        this->divide(tile, edges[e], samples, (e - first) * this->SampleCount, result);
      }
    }
  }

private:
  /// A tile with a border of one pixel.
  struct Tile
  {
    static constexpr int Width = 10;

    Tile(const Finder& finder, int left, int bottom)
      : x0(left)
      , y0(bottom)
    {
      for (int j = 0; j < Width; ++j)
      {
        for (int i = 0; i < Width; ++i)
        {
          const int x = this->x0 + i - 1;
          const int y = this->y0 + j - 1;
          const bool inside = x >= 0 && y >= 0 && x < finder.Of.width && y < finder.Of.height;
          const std::size_t pixel = static_cast<std::size_t>(y) * finder.Of.width + x;
          const std::uint32_t found = inside ? finder.Picture.instance[pixel] : NoInstance;
          this->instance[Width * j + i] = found;
          if (found != NoInstance)
          {
            this->depth[Width * j + i] = linearDepth(finder.Of,
              finder.Picture.depth[pixel] - double(finder.Instances[found].depthOffsetUnits));
            if (this->present.empty() || this->present.back() != found)
            {
              this->present.push_back(found);
            }
          }
        }
      }
      std::sort(this->present.begin(), this->present.end());
      this->present.erase(
        std::unique(this->present.begin(), this->present.end()), this->present.end());
    }

    /// Index of pixel k (8 * row + column) of the tile proper.
    static int at(int k) { return Width * ((k >> 3) + 1) + (k & 7) + 1; }

    int x0, y0;
    std::uint32_t instance[Width * Width];
    double depth[Width * Width];        // linear, where there is an instance
    std::vector<std::uint32_t> present; // instances, ascending
  };

  /// Compares a pixel with its two neighbours in one direction.
  bool edge(const Tile& tile, int k, int dx, int dy) const
  {
    const int at = Tile::at(k);
    const int step = dx + Tile::Width * dy;
    const std::uint32_t i = tile.instance[at];
    if (tile.instance[at - step] != i || tile.instance[at + step] != i)
    {
      return true;
    }
    // One surface bends little between pixels; a step is of more than a few pixels' size.
    return i != NoInstance &&
      std::abs(tile.depth[at - step] - 2.0 * tile.depth[at] + tile.depth[at + step]) >
      3.0 * worldPixel(this->Of, tile.depth[at]);
  }

  void trace(const Tile& tile, Samples& samples) const
  {
    std::fill(samples.instance, samples.instance + 64, NoInstance);
    RayBlock rays;
    HitBlock hits;
    for (const std::uint32_t i : tile.present)
    {
      const SeenInstance& seen = this->Seen[i];
      for (int s = 0; s < 64; ++s)
      {
        seen.local.fill(samples.x[s], samples.y[s], s, rays);
      }
      std::fill(rays.tMin, rays.tMin + 64, 0.0f);
      std::fill(rays.tMax, rays.tMax + 64, seen.local.tMax);
      intersect(this->Instances[i].octree, rays, seen.options, hits);
      for (int s = 0; s < 64; ++s)
      {
        const double t = seen.local.base + hits.t[s];
        if (hits.primitive[s] != NoPrimitive &&
          (samples.instance[s] == NoInstance || t < samples.t[s]))
        {
          samples.instance[s] = i;
          samples.t[s] = t;
        }
      }
    }
  }

  /// The pixel around k that shows what the sample hit: of its instance and nearest to its depth,
  /// k itself where the difference is small. -1 if there is none.
  int shownBy(const Tile& tile, int k, std::uint32_t instance, double t) const
  {
    const int at = Tile::at(k);
    int best = -1;
    double least = 0.0;
    for (int j = -1; j <= 1; ++j)
    {
      for (int i = -1; i <= 1; ++i)
      {
        const int other = at + i + Tile::Width * j;
        if (tile.instance[other] != instance)
        {
          continue;
        }
        const double distance = std::abs(tile.depth[other] - t);
        if (best < 0 || distance < least)
        {
          best = other;
          least = distance;
        }
      }
    }
    const bool near = tile.instance[at] == instance &&
      std::abs(tile.depth[at] - t) <= least + 3.0 * worldPixel(this->Of, t);
    return near ? at : best;
  }

  /// Adds the parts of an edge pixel, unless all of it is one surface's.
  void divide(const Tile& tile, int k, const Samples& samples, int first, Silhouettes& result) const
  {
    const int at = Tile::at(k);
    int shown[MostSamples];
    bool whole = true;
    for (int s = 0; s < this->SampleCount; ++s)
    {
      const std::uint32_t instance = samples.instance[first + s];
      shown[s] =
        instance == NoInstance ? -1 : this->shownBy(tile, k, instance, samples.t[first + s]);
      whole = whole && shown[s] == (tile.instance[at] == NoInstance ? -1 : at);
    }
    if (whole)
    {
      return;
    }
    const int x = tile.x0 + (k & 7);
    const int y = tile.y0 + (k >> 3);
    if (tile.instance[at] != NoInstance)
    {
      result.pixels.push_back(static_cast<std::size_t>(y) * this->Of.width + x);
    }
    for (int s = 0; s < this->SampleCount; ++s)
    {
      const int source = shown[s];
      if (source < 0)
      {
        continue;
      }
      PixelPart part;
      double sum = 0.0;
      int count = 0;
      for (int other = s; other < this->SampleCount; ++other)
      {
        if (shown[other] == source)
        {
          part.samples |= 1u << other;
          sum += this->Of.windowDepth(samples.t[first + other]);
          ++count;
          shown[other] = -1;
        }
      }
      const Instance& instance = this->Instances[tile.instance[source]];
      part.x = static_cast<std::uint16_t>(x);
      part.y = static_cast<std::uint16_t>(y);
      part.depth =
        static_cast<float>(std::clamp(sum / count + instance.depthOffsetUnits, 0.0, 1.0));
      const int sourceX = tile.x0 + source % Tile::Width - 1;
      const int sourceY = tile.y0 + source / Tile::Width - 1;
      const std::size_t pixel = static_cast<std::size_t>(sourceY) * this->Of.width + sourceX;
      std::copy_n(this->Picture.color.data() + 4 * pixel, 4, part.color);
      result.parts.push_back(part);
    }
  }

  const std::vector<Instance>& Instances;
  const View& Of;
  const Frame& Picture;
  const std::vector<glm::vec2>& Positions;
  int SampleCount;
  std::vector<SeenInstance> Seen; // by index into Scene::instances
};
}

void findSilhouettes(const Scene& scene, const View& view, double pixelError, const Frame& frame,
  const std::vector<glm::vec2>& positions, const ParallelFor& parallelFor, Silhouettes& result)
{
  result.clear();
  if (frame.covered.empty() || positions.empty())
  {
    return;
  }
  const Finder finder(scene, view, pixelError, frame, positions);
  // A surface reaches into pixels beside those whose centres show it.
  const int left = std::max(frame.covered.x0 - 1, 0) / 8;
  const int right = (std::min(frame.covered.x1 + 1, view.width) + 7) / 8;
  const int bottom = std::max(frame.covered.y0 - 1, 0) / 8;
  const int top = (std::min(frame.covered.y1 + 1, view.height) + 7) / 8;
  std::vector<Silhouettes> rows(top - bottom);
  parallelFor(0, rows.size(), 1,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t row = begin; row < end; ++row)
      {
        for (int column = left; column < right; ++column)
        {
          finder.find(column, bottom + static_cast<int>(row), rows[row]);
        }
      }
    });
  for (const Silhouettes& row : rows)
  {
    result.parts.insert(result.parts.end(), row.parts.begin(), row.parts.end());
    result.pixels.insert(result.pixels.end(), row.pixels.begin(), row.pixels.end());
  }
  std::stable_sort(result.parts.begin(), result.parts.end(),
    [](const PixelPart& a, const PixelPart& b) { return a.samples < b.samples; });
}
}
