#include "svoSilhouetteFinder.h"

#include "svoDepthSlope.h"
#include "svoFrameEdges.h"
#include "svoHits.h"
#include "svoPixelShader.h"
#include "svoShownDepth.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>

namespace svo
{
namespace
{
constexpr int MostSamples = 32;

/// Samples of one pixel that see the same triangle.
struct Facet
{
  std::uint32_t instance;
  Primitive primitive;
  std::uint32_t samples = 0; // bit i: sample i
  int count = 0;
  double x = 0.0, y = 0.0, t = 0.0; // mean of its samples; in between their sum
  std::uint8_t color[4]{};
};

/// An edge pixel, and which of the tile's facets are its own.
struct EdgePixel
{
  int x, y;
  std::size_t firstFacet, lastFacet;
  int hits; // samples
  const TileSamples* samples;
  int lane; // of its first sample
};

/// What a thread needs, from tile to tile.
struct TileScratch
{
  std::vector<EdgePixel> pixels;
  std::vector<TileSamples> samples;
  std::vector<Facet> facets;
  std::vector<std::size_t> alone, beside; // indices of facets that are to be shaded
  std::vector<glm::ivec2> places;         // of `beside`: pixels whose samples of light it takes
  TileHitList hits;
  PixelShader::Scratch shading;
};

class Finder
{
public:
  Finder(const ShadedScene& shaded, const PixelShader& shader, const LightImages& sampled,
    const Frame& frame, const std::vector<glm::vec2>& positions)
    : Lit(shaded)
    , Beside(this->Lit)
    , Shader(shader)
    , EyeView(shaded.view)
    , Picture(frame)
    , Positions(positions)
    , SampleCount(std::min(static_cast<int>(positions.size()), MostSamples))
    , Edges(frame, shaded.eye.depth, shaded.view)
  {
    this->Beside.images = sampled.sampled().any() ? &sampled : nullptr;
  }

  /// Adds what is to be changed in an 8x8 tile.
  void find(int tileX, int tileY, TileScratch& scratch, Silhouettes& result) const
  {
    this->findPixels(tileX, tileY, scratch);
    if (scratch.pixels.empty())
    {
      return;
    }
    this->trace(tileX, tileY, scratch);
    this->findFacets(scratch);
    this->color(tileX, tileY, scratch);
    for (const EdgePixel& pixel : scratch.pixels)
    {
      this->divide(pixel, scratch, result);
    }
  }

private:
  std::size_t at(int x, int y) const
  {
    return static_cast<std::size_t>(y) * this->EyeView.width + x;
  }
  void findPixels(int tileX, int tileY, TileScratch& scratch) const
  {
    scratch.pixels.clear();
    const FrameEdges::Tile edges(this->Edges, tileX, tileY);
    for (int y = 8 * tileY; y < std::min(8 * tileY + 8, this->EyeView.height); ++y)
    {
      for (int x = 8 * tileX; x < std::min(8 * tileX + 8, this->EyeView.width); ++x)
      {
        if (isEdge(edges, x, y))
        {
          scratch.pixels.push_back({ x, y, 0, 0, 0, nullptr, 0 });
        }
      }
    }
  }

  void trace(int tileX, int tileY, TileScratch& scratch) const
  {
    const auto pixelsPerBlock = static_cast<std::size_t>(64 / this->SampleCount);
    scratch.samples.resize((scratch.pixels.size() - 1) / pixelsPerBlock + 1);
    for (TileSamples& samples : scratch.samples) // lanes that nobody needs
    {
      std::fill(samples.x, samples.x + 64, 8.0 * tileX + 0.5);
      std::fill(samples.y, samples.y + 64, 8.0 * tileY + 0.5);
    }
    for (std::size_t k = 0; k < scratch.pixels.size(); ++k)
    {
      EdgePixel& pixel = scratch.pixels[k];
      TileSamples& samples = scratch.samples[k / pixelsPerBlock];
      pixel.samples = &samples;
      pixel.lane = static_cast<int>(k % pixelsPerBlock) * this->SampleCount;
      for (int s = 0; s < this->SampleCount; ++s)
      {
        samples.x[pixel.lane + s] = pixel.x + double(this->Positions[s].x);
        samples.y[pixel.lane + s] = pixel.y + double(this->Positions[s].y);
      }
    }
    this->Lit.shaded.sampler.sample(tileX, tileY, scratch.samples.data(), scratch.samples.size());
  }

  /// From linear depth to what is affine on a plane, and back: so means stay on the triangle.
  double flat(double t) const { return this->EyeView.parallel ? t : 1.0 / t; }

  void findFacets(TileScratch& scratch) const
  {
    scratch.facets.clear();
    for (EdgePixel& pixel : scratch.pixels)
    {
      pixel.firstFacet = scratch.facets.size();
      const TileSamples& samples = *pixel.samples;
      for (int s = 0; s < this->SampleCount; ++s)
      {
        const int lane = pixel.lane + s;
        if (samples.instance[lane] == NoInstance)
        {
          continue;
        }
        const auto found =
          std::find_if(scratch.facets.begin() + pixel.firstFacet, scratch.facets.end(),
            [&](const Facet& facet) {
              return facet.instance == samples.instance[lane] &&
                facet.primitive == samples.primitive[lane];
            });
        const std::size_t at = found - scratch.facets.begin();
        if (at == scratch.facets.size())
        {
          scratch.facets.push_back({ samples.instance[lane], samples.primitive[lane] });
        }
        Facet& facet = scratch.facets[at];
        facet.samples |= 1u << s;
        ++facet.count;
        ++pixel.hits;
        facet.x += samples.x[lane];
        facet.y += samples.y[lane];
        facet.t += this->flat(samples.t[lane]);
      }
      pixel.lastFacet = scratch.facets.size();
    }
    for (Facet& facet : scratch.facets)
    {
      facet.x /= facet.count;
      facet.y /= facet.count;
      facet.t = this->flat(facet.t / facet.count);
    }
  }

  /// Colours all facets: those that the pixel's centre sees as the frame has it, others at the
  /// middle of their samples, with what their planes have at the pixel's centre. What samples of
  /// light found beside, on the same thing, they take: few of their own would be grain.
  void color(int tileX, int tileY, TileScratch& scratch) const
  {
    scratch.alone.clear();
    scratch.beside.clear();
    scratch.places.clear();
    for (const EdgePixel& pixel : scratch.pixels)
    {
      for (std::size_t f = pixel.firstFacet; f < pixel.lastFacet; ++f)
      {
        Facet& facet = scratch.facets[f];
        std::size_t shownBy = this->at(pixel.x, pixel.y);
        if (!this->shows(pixel, facet))
        {
          const bool known = this->Lit.shaded.shadows.knows(this->position(facet));
          const bool nearby =
            (this->Beside.images || !known) && this->nearby(pixel, facet, shownBy);
          if (!nearby)
          {
            scratch.alone.push_back(f);
            continue;
          }
          if (known)
          {
            const auto at = static_cast<int>(shownBy);
            scratch.beside.push_back(f);
            scratch.places.emplace_back(at % this->EyeView.width, at / this->EyeView.width);
            continue;
          }
        }
        std::copy_n(this->Picture.color.data() + 4 * shownBy, 4, facet.color);
      }
    }
    this->shade(tileX, tileY, this->Lit, scratch.alone, nullptr, scratch);
    this->shade(tileX, tileY, this->Beside, scratch.beside, scratch.places.data(), scratch);
  }

  /// Some of the facets. `pixels`: PixelShader::Scratch::pixels of each.
  void shade(int tileX, int tileY, const PixelShader::Lit& lit,
    const std::vector<std::size_t>& facets, const glm::ivec2* pixels, TileScratch& scratch) const
  {
    TileHitList& list = scratch.hits;
    for (std::size_t first = 0; first < facets.size(); first += TileHits::Most)
    {
      const std::size_t count = std::min<std::size_t>(facets.size() - first, TileHits::Most);
      scratch.shading.pixels = pixels ? pixels + first : nullptr;
      list.start(8 * tileX, 8 * tileY);
      for (std::size_t i = 0; i < count; ++i)
      {
        const Facet& facet = scratch.facets[facets[first + i]];
        const double base = this->Lit.shaded.eye.base(facet.instance);
        list.put(static_cast<int>(i), facet.x, facet.y, static_cast<float>(facet.t - base),
          facet.instance, facet.primitive);
        // Where OpenGL interpolates, whichever samples a triangle covers.
        list.lookAt(static_cast<int>(i), std::floor(facet.x) + 0.5, std::floor(facet.y) + 0.5);
      }
      this->Shader.shadePatches(lit, list.hits, scratch.shading,
        [&]
        {
          eachBit(scratch.shading.patch.mask,
            [&](int i)
            {
              Facet& facet = scratch.facets[facets[first + i]];
              std::memcpy(facet.color, scratch.shading.colors.rgba + i, 4);
            });
        });
    }
  }

  const DepthBuffer& seen() const { return this->Lit.shaded.eye.depth; }

  bool shows(const EdgePixel& pixel, const Facet& facet) const
  {
    return this->seen().instanceAt(pixel.x, pixel.y) == facet.instance &&
      this->seen().primitiveAt(pixel.x, pixel.y) == facet.primitive;
  }

  glm::dvec3 position(const Facet& facet) const
  {
    return this->EyeView.rayOrigin(facet.x, facet.y) +
      facet.t * this->EyeView.rayDirection(facet.x, facet.y);
  }

  float windowDepth(std::uint32_t instance, double t, double slopes) const
  {
    const double offset = shownOffset(this->Lit.shaded.scene.instances[instance], this->EyeView);
    return static_cast<float>(std::clamp(this->EyeView.windowDepth(t) + offset + slopes, 0.0, 1.0));
  }
  float windowDepth(const Facet& f) const
  {
    const Instance& instance = this->Lit.shaded.scene.instances[f.instance];
    const double factor = instance.depthOffset.factor;
    const double slopes = factor == 0.0 ? 0.0
                                        : factor *
        steepness(instance.body->octree, { instance.body->octree, instance.localToWorld },
          this->EyeView, f.x, f.y, f.t, f.primitive);
    return this->windowDepth(f.instance, f.t, slopes);
  }

  /// The pixel in or around this one that shows the facet's instance nearest to its depth.
  bool nearby(const EdgePixel& pixel, const Facet& facet, std::size_t& best) const
  {
    const float depth = this->windowDepth(facet);
    float least = std::numeric_limits<float>::infinity();
    for (int y = pixel.y - 1; y <= pixel.y + 1; ++y)
    {
      for (int x = pixel.x - 1; x <= pixel.x + 1; ++x)
      {
        if (this->Edges.instance(x, y) == facet.instance)
        {
          const float distance = std::abs(this->Picture.depth[this->at(x, y)] - depth);
          best = distance < least ? this->at(x, y) : best;
          least = std::min(distance, least);
        }
      }
    }
    return least < std::numeric_limits<float>::infinity();
  }

  /// Adds an edge pixel's parts, or, where one surface fills it evenly, its colour.
  void divide(const EdgePixel& pixel, TileScratch& scratch, Silhouettes& result) const
  {
    const std::vector<Facet>& facets = scratch.facets;
    const bool hit = this->seen().instanceAt(pixel.x, pixel.y) != NoInstance;
    const std::size_t count = pixel.lastFacet - pixel.firstFacet;
    const bool whole = pixel.hits == this->SampleCount;
    if (count == 0 ? !hit : count == 1 && whole && this->shows(pixel, facets[pixel.firstFacet]))
    {
      return;
    }
    Silhouettes::Pixel replaced;
    replaced.index = this->at(pixel.x, pixel.y);
    if (!(whole && hit && this->isEven(pixel, facets) && this->isFlat(pixel)))
    {
      for (std::size_t f = pixel.firstFacet; f < pixel.lastFacet; ++f)
      {
        this->addSamples(pixel, facets[f], result.parts);
      }
    }
    else
    {
      this->mix(pixel, facets, replaced.color);
    }
    if (hit)
    {
      result.pixels.push_back(replaced);
    }
  }

  /// True if what is seen in the pixel is the surface that its centre shows, in about one colour.
  bool isEven(const EdgePixel& pixel, const std::vector<Facet>& facets) const
  {
    // Windows show the mean of the samples' 2.2th powers, who reads a back buffer gets the mean
    // itself: of such colours either is about the same.
    constexpr int Alike = 16;
    const Facet& first = facets[pixel.firstFacet];
    const float depth = this->Picture.depth[this->at(pixel.x, pixel.y)];
    const float width = this->Edges.width(depth);
    if (this->seen().instanceAt(pixel.x, pixel.y) != first.instance)
    {
      return false;
    }
    int least[3] = { 255, 255, 255 }, most[3] = { 0, 0, 0 };
    for (std::size_t f = pixel.firstFacet; f < pixel.lastFacet; ++f)
    {
      const Facet& facet = facets[f];
      if (facet.instance != first.instance ||
        std::abs(this->windowDepth(facet) - depth) > 3.0f * width)
      {
        return false;
      }
      for (int c = 0; c < 3; ++c)
      {
        least[c] = std::min<int>(least[c], facet.color[c]);
        most[c] = std::max<int>(most[c], facet.color[c]);
        if (most[c] - least[c] > Alike)
        {
          return false;
        }
      }
    }
    return true;
  }

  /// The mean colour of a pixel's samples.
  void mix(const EdgePixel& pixel, const std::vector<Facet>& facets, std::uint8_t (&color)[4]) const
  {
    for (int c = 0; c < 3; ++c)
    {
      int sum = this->SampleCount / 2;
      for (std::size_t f = pixel.firstFacet; f < pixel.lastFacet; ++f)
      {
        sum += facets[f].count * facets[f].color[c];
      }
      color[c] = static_cast<std::uint8_t>(sum / this->SampleCount);
    }
    color[3] = 255;
  }

  /// Window depth of sample number s, which is not level, as it is shown.
  float sampleDepth(const EdgePixel& pixel, int s) const
  {
    return this->windowDepth(
      pixel.samples->instance[pixel.lane + s], pixel.samples->t[pixel.lane + s], 0.0);
  }

  /// True if VTK's mapper gives all of a fragment the depth of the pixel's centre.
  bool isLevel(std::uint32_t instance) const
  {
    return !this->Lit.shaded.scene.instances[instance].depthOffset.none();
  }

  /// True if the pixel shows a facet on whose plane all of its samples lie.
  bool isFlat(const EdgePixel& pixel) const
  {
    if (this->Picture.slopes.empty() || this->isLevel(pixel.samples->instance[pixel.lane]))
    {
      return true; // one depth is what it has
    }
    constexpr float Most = 1e-6f;
    const std::size_t own = this->at(pixel.x, pixel.y);
    const float* slope = this->Picture.slopes.data() + 2 * own;
    bool flat = true;
    for (int s = 0; s < this->SampleCount; ++s)
    {
      const glm::vec2 from = this->Positions[s] - 0.5f;
      const float plane = this->Picture.depth[own] + slope[0] * from.x + slope[1] * from.y;
      flat = flat && std::abs(this->sampleDepth(pixel, s) - plane) <= Most;
    }
    return flat;
  }

  /// A facet's samples: one by one, each at its own depth, unless they are level.
  void addSamples(const EdgePixel& pixel, const Facet& facet, std::vector<PixelPart>& parts) const
  {
    PixelPart part;
    part.x = static_cast<std::uint16_t>(pixel.x);
    part.y = static_cast<std::uint16_t>(pixel.y);
    std::copy_n(facet.color, 3, part.color);
    part.color[3] = 255;
    if (this->isLevel(facet.instance))
    {
      part.samples = facet.samples;
      part.depth = this->windowDepth(facet);
      parts.push_back(part);
      return;
    }
    for (int s = 0; s < this->SampleCount; ++s)
    {
      if (facet.samples >> s & 1)
      {
        part.samples = 1u << s;
        part.depth = this->sampleDepth(pixel, s);
        parts.push_back(part);
      }
    }
  }

  PixelShader::Lit Lit;
  PixelShader::Lit Beside; // by what samples found beside, if there are any
  const PixelShader& Shader;
  const View& EyeView;
  const Frame& Picture;
  const std::vector<glm::vec2>& Positions;
  int SampleCount;
  FrameEdges Edges;
};
}

void findSilhouettes(const ShadedScene& shaded, const PixelShader& shader,
  const LightImages& sampled, const Frame& frame, const std::vector<glm::vec2>& positions,
  const ParallelFor& parallelFor, Silhouettes& result)
{
  result.clear();
  if (frame.covered.empty() || positions.empty())
  {
    return;
  }
  const Finder finder(shaded, shader, sampled, frame, positions);
  const View& view = shaded.view;
  // A surface reaches into pixels beside those whose centres show it.
  const int left = std::max(frame.covered.x0 - 1, 0) / 8;
  const int right = (std::min(frame.covered.x1 + 1, view.width) + 7) / 8;
  const int bottom = std::max(frame.covered.y0 - 1, 0) / 8;
  const int top = (std::min(frame.covered.y1 + 1, view.height) + 7) / 8;
  std::vector<Silhouettes> rows(top - bottom);
  parallelFor(0, rows.size(), 1,
    [&](std::size_t begin, std::size_t end)
    {
      const auto scratch = std::make_unique<TileScratch>();
      for (std::size_t row = begin; row < end; ++row)
      {
        for (int column = left; column < right; ++column)
        {
          finder.find(column, bottom + static_cast<int>(row), *scratch, rows[row]);
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
