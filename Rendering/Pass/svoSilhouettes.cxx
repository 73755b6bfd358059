#include "svoSilhouettes.h"

#include "svoDepthBuffer.h"
#include "svoIntersect.h"
#include "svoLocalView.h"
#include "svoSelect.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
  double voxel = 0.0; // edge of a cell where rays stop, world
};

/// The inverse of View::windowDepth.
double linearDepth(const View& view, double window)
{
  const glm::dmat4& p = view.viewToClip;
  const double ndc = 2.0 * window - 1.0;
  return (p[3][2] - ndc * p[3][3]) / (p[2][2] - ndc * p[2][3]);
}

/// What a pixel's width is in window depth. With z = a + b / t and a pixel's width proportional to
/// t it is affine in z, in a parallel view constant.
struct PixelDepth
{
  explicit PixelDepth(const View& view)
  {
    const double first = view.parallel ? 1.0 : view.tNear;
    const double t[2] = { first, 2.0 * first };
    double z[2], width[2];
    for (int i = 0; i < 2; ++i)
    {
      z[i] = view.windowDepth(t[i]);
      // The derivative of the window depth, from a difference that is exact for 1 / t.
      const double step = view.windowDepth(2.0 * t[i]) - z[i];
      width[i] = worldPixel(view, t[i]) * std::abs(step) * (view.parallel ? 1.0 : 2.0) / t[i];
    }
    this->slope = z[1] != z[0] ? static_cast<float>((width[1] - width[0]) / (z[1] - z[0])) : 0.0f;
    this->constant = static_cast<float>(width[0] - this->slope * z[0]);
  }
  float operator()(float window) const { return this->constant + this->slope * window; }

  float constant = 0.0f;
  float slope = 0.0f;
};

/// Rays through points of the image that are near each other, and what they hit.
struct Samples
{
  int count = 0;
  double x[64];
  double y[64];
  int pixelX[64]; // that the point lies in
  int pixelY[64];
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
    , Width(view)
  {
    for (const Instance& instance : scene.instances)
    {
      SeenInstance seen;
      if (instance.visible && instance.octree && !instance.octree.empty())
      {
        seen.local = makeLocalView(instance.octree, instance.localToWorld, view);
        seen.options = { instance.leafGeometry,
          selectLevel(instance, seen.local, view, pixelError) };
        seen.voxel = worldVoxel(instance, seen.options.level);
      }
      this->Seen.push_back(seen);
    }
  }

  /// The pixels of an 8x8 tile that are shared.
  void find(int x0, int y0, Silhouettes& result) const
  {
    Samples samples;
    const int x1 = std::min(x0 + 8, this->Of.width);
    const int y1 = std::min(y0 + 8, this->Of.height);
    for (int y = y0; y < y1; ++y)
    {
      for (int x = x0; x < x1; ++x)
      {
        if (!this->edge(x, y))
        {
          continue;
        }
        for (int s = 0; s < this->SampleCount; ++s)
        {
          const int i = samples.count++;
          samples.x[i] = x + static_cast<double>(this->Positions[s].x);
          samples.y[i] = y + static_cast<double>(this->Positions[s].y);
          samples.pixelX[i] = x;
          samples.pixelY[i] = y;
        }
        if (samples.count + this->SampleCount > 64)
        {
          this->divide(samples, result);
          samples.count = 0;
        }
      }
    }
    if (samples.count > 0)
    {
      this->divide(samples, result);
    }
  }

private:
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * this->Of.width + x; }
  bool inside(int x, int y) const
  {
    return x >= 0 && y >= 0 && x < this->Of.width && y < this->Of.height;
  }
  std::uint32_t instance(int x, int y) const
  {
    return this->inside(x, y) ? this->Picture.instance[this->at(x, y)] : NoInstance;
  }

  bool edge(int x, int y) const
  {
    const std::uint32_t i = this->Picture.instance[this->at(x, y)];
    if (this->instance(x - 1, y) != i || this->instance(x + 1, y) != i ||
      this->instance(x, y - 1) != i || this->instance(x, y + 1) != i)
    {
      return true;
    }
    if (i == NoInstance)
    {
      return false;
    }
    // Window depth is linear on planes. One surface bends little between pixels; a step is of more
    // than a few pixels' size.
    const float* depth = this->Picture.depth.data() + this->at(x, y);
    const int up = this->Of.width;
    const float limit = 3.0f * this->Width(*depth);
    return std::abs(depth[-1] - 2.0f * depth[0] + depth[1]) > limit ||
      std::abs(depth[-up] - 2.0f * depth[0] + depth[up]) > limit;
  }

  /// Calls body(index into the frame) for the pixels in and around one that show an instance.
  template <class Body>
  void around(int x, int y, Body&& body) const
  {
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, this->Of.height - 1); ++j)
    {
      for (int i = std::max(x - 1, 0); i <= std::min(x + 1, this->Of.width - 1); ++i)
      {
        if (this->Picture.instance[this->at(i, j)] != NoInstance)
        {
          body(this->at(i, j));
        }
      }
    }
  }

  /// Every ray through the instances that are seen in and around its pixel.
  void trace(Samples& samples) const
  {
    std::fill(samples.instance, samples.instance + 64, NoInstance);
    std::vector<std::uint32_t> present;
    for (int s = 0; s < samples.count; s += this->SampleCount)
    {
      this->around(samples.pixelX[s], samples.pixelY[s],
        [&](std::size_t pixel)
        {
          const std::uint32_t i = this->Picture.instance[pixel];
          if (std::find(present.begin(), present.end(), i) == present.end())
          {
            present.push_back(i);
          }
        });
    }
    std::sort(present.begin(), present.end());
    for (const std::uint32_t i : present)
    {
      this->trace(i, samples);
    }
  }

  void trace(std::uint32_t i, Samples& samples) const
  {
    const SeenInstance& seen = this->Seen[i];
    RayBlock rays;
    std::fill(rays.tMin, rays.tMin + 64, 1.0f); // never a hit
    std::fill(rays.tMax, rays.tMax + 64, 0.0f);
    for (int first = 0; first < samples.count; first += this->SampleCount)
    {
      // Not far in front of what the centres of the pixels around show there is nothing.
      float nearest = 2.0f;
      this->around(samples.pixelX[first], samples.pixelY[first],
        [&](std::size_t pixel)
        {
          if (this->Picture.instance[pixel] == i)
          {
            nearest = std::min(nearest, this->Picture.depth[pixel]);
          }
        });
      if (nearest > 1.0f)
      {
        continue;
      }
      const double t = linearDepth(this->Of, double(nearest) - this->Instances[i].depthOffsetUnits);
      const double start = t - 16.0 * worldPixel(this->Of, t) - 4.0 * seen.voxel - seen.local.base;
      for (int s = first; s < first + this->SampleCount; ++s)
      {
        rays.tMin[s] = std::max(static_cast<float>(start), 0.0f);
        rays.tMax[s] = seen.local.tMax;
      }
    }
    for (int s = 0; s < 64; ++s)
    {
      const int k = std::min(s, samples.count - 1);
      seen.local.fill(samples.x[k], samples.y[k], s, rays);
    }
    HitBlock hits;
    intersect(this->Instances[i].octree, rays, seen.options, hits);
    for (int s = 0; s < samples.count; ++s)
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

  /// The window depth of what a sample hit.
  float depthOf(const Samples& samples, int s) const
  {
    const Instance& hit = this->Instances[samples.instance[s]];
    const double window = this->Of.windowDepth(samples.t[s]) + hit.depthOffsetUnits;
    return static_cast<float>(std::clamp(window, 0.0, 1.0));
  }

  /// The pixel in or around the sample's that shows what the sample hit: of its instance and
  /// nearest to its depth, the sample's own where the difference is small.
  std::size_t shownBy(const Samples& samples, int s) const
  {
    const float depth = this->depthOf(samples, s);
    std::size_t best = this->at(samples.pixelX[s], samples.pixelY[s]);
    float least = std::numeric_limits<float>::infinity();
    this->around(samples.pixelX[s], samples.pixelY[s],
      [&](std::size_t pixel)
      {
        const float distance = std::abs(this->Picture.depth[pixel] - depth);
        if (this->Picture.instance[pixel] == samples.instance[s] && distance < least)
        {
          best = pixel;
          least = distance;
        }
      });
    const std::size_t own = this->at(samples.pixelX[s], samples.pixelY[s]);
    const bool near = this->Picture.instance[own] == samples.instance[s] &&
      std::abs(this->Picture.depth[own] - depth) <= least + 3.0f * this->Width(depth);
    return near ? own : best;
  }

  void divide(Samples& samples, Silhouettes& result) const
  {
    this->trace(samples);
    for (int first = 0; first < samples.count; first += this->SampleCount)
    {
      this->dividePixel(samples, first, result);
    }
  }

  /// Adds the parts of an edge pixel, unless all of it is one surface's.
  void dividePixel(const Samples& samples, int first, Silhouettes& result) const
  {
    constexpr std::size_t Nothing = ~std::size_t(0);
    const std::size_t own = this->at(samples.pixelX[first], samples.pixelY[first]);
    const bool hit = this->Picture.instance[own] != NoInstance;
    std::size_t shown[MostSamples];
    bool whole = true;
    for (int s = 0; s < this->SampleCount; ++s)
    {
      shown[s] =
        samples.instance[first + s] == NoInstance ? Nothing : this->shownBy(samples, first + s);
      whole = whole && shown[s] == (hit ? own : Nothing);
    }
    if (whole)
    {
      return;
    }
    if (hit)
    {
      result.pixels.push_back(own);
    }
    for (int s = 0; s < this->SampleCount; ++s)
    {
      const std::size_t source = shown[s];
      if (source == Nothing)
      {
        continue;
      }
      PixelPart part;
      part.x = static_cast<std::uint16_t>(samples.pixelX[first]);
      part.y = static_cast<std::uint16_t>(samples.pixelY[first]);
      float sum = 0.0f;
      int count = 0;
      for (int other = s; other < this->SampleCount; ++other)
      {
        if (shown[other] == source)
        {
          part.samples |= 1u << other;
          sum += this->depthOf(samples, first + other);
          ++count;
          shown[other] = Nothing;
        }
      }
      part.depth = sum / static_cast<float>(count);
      std::copy_n(this->Picture.color.data() + 4 * source, 4, part.color);
      result.parts.push_back(part);
    }
  }

  const std::vector<Instance>& Instances;
  const View& Of;
  const Frame& Picture;
  const std::vector<glm::vec2>& Positions;
  int SampleCount;
  PixelDepth Width;
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
          finder.find(8 * column, 8 * (bottom + static_cast<int>(row)), rows[row]);
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
