#include "svoReceiverSampler.h"

#include "svoHemisphereSums.h"
#include "svoSampleRays.h"
#include "svoTerminator.h"
#include "svoTilePatch.h"
#include "svoWorldSize.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace svo
{
namespace
{
/// What floats resolve of a place that a rasteriser has interpolated, by its size.
constexpr double PlaceError = 1e-6;

/// The unit vector of two numbers of ReceiverPlaces::planes.
glm::vec3 unfold(const std::uint16_t* numbers)
{
  const glm::vec2 at = glm::vec2(numbers[0], numbers[1]) * (2.0f / 65535.0f) - 1.0f;
  const float z = 1.0f - std::abs(at.x) - std::abs(at.y);
  const float fold = std::max(-z, 0.0f);
  return glm::normalize(
    glm::vec3(at.x + (at.x < 0.0f ? fold : -fold), at.y + (at.y < 0.0f ? fold : -fold), z));
}

/// Points of a tile, by pixel.
struct TilePoints
{
  glm::dvec3 position[TilePatch::Most]; // world
  glm::vec3 facet[TilePatch::Most], normal[TilePatch::Most];
  float lift[TilePatch::Most];
  double farthest; // from the eye
};

struct Scratch
{
  TilePoints points;
  double base; // of depths
  TileHitList list, raised;
  TilePatch patch;
  SampleSums sums[3];
  float missed[TilePatch::Most];
  std::uint64_t rays;
};

/// Samples tiles of places. They are of no instance that is known.
class TileOfPlaces
{
public:
  TileOfPlaces(const SampledFrame& frame, const ReceiverPlaces& places,
    const std::vector<std::uint8_t>& hidden, LightImages& images)
    : Frame(frame)
    , Places(places)
    , Hidden(hidden)
    , Images(images)
    , ToWorld(glm::inverse(frame.view.worldToView))
    , Turn(glm::transpose(glm::dmat3(frame.view.worldToView)))
    , ToPixel(frame.view.viewToClip * frame.view.worldToView)
  {
  }

  void sample(int tileX, int tileY, Scratch& scratch) const;

private:
  void take(int tileX, int tileY, Scratch& scratch) const;
  void put(TileHitList& list, int i, const glm::dvec3& position, double base) const;
  template <class F>
  void eachPatch(const TileHitList& list, bool smooth, Scratch& scratch, F&& f) const;
  void sampleLight(std::size_t light, Scratch& scratch) const;
  ShadowQuery query(Scratch& scratch, std::uint64_t asked) const
  {
    return { scratch.patch, { 0.0, PlaceError * scratch.points.farthest }, nullptr, asked,
      scratch.rays, scratch.sums };
  }

  const SampledFrame& Frame;
  const ReceiverPlaces& Places;
  const std::vector<std::uint8_t>& Hidden; // by pixel
  LightImages& Images;
  const glm::dmat4 ToWorld;
  const glm::dmat3 Turn; // to the world
  const glm::dmat4 ToPixel;
};

/// Point number i of a list of depths less `base`.
void TileOfPlaces::put(TileHitList& list, int i, const glm::dvec3& position, double base) const
{
  const View& view = this->Frame.view;
  const glm::dvec4 clip = this->ToPixel * glm::dvec4(position, 1.0);
  const glm::dvec2 at =
    (0.5 + 0.5 * glm::dvec2(clip) / clip.w) * glm::dvec2(view.width, view.height);
  const double t = glm::dot(position - view.eye, view.axis);
  list.put(i, at.x, at.y, static_cast<float>(t - base), SampleBatch::AnyInstance, NoPrimitive);
}

/// The points of a tile.
void TileOfPlaces::take(int tileX, int tileY, Scratch& scratch) const
{
  TilePoints& points = scratch.points;
  scratch.list.start(8 * tileX, 8 * tileY);
  points.farthest = scratch.base = 0.0;
  const int columns = std::min(8, this->Places.width - 8 * tileX);
  const int rows = std::min(8, this->Places.height - 8 * tileY);
  for (int k = 0; k < columns * rows; ++k)
  {
    const int x = k % columns, y = k / columns, i = 8 * y + x;
    const std::size_t pixel = static_cast<std::size_t>(8 * tileY + y) * this->Places.width +
      static_cast<std::size_t>(8 * tileX + x);
    const float* place = &this->Places.places[4 * pixel];
    const std::uint16_t* planes = &this->Places.planes[4 * pixel];
    if (place[3] <= ReceiverPlaces::Nowhere || this->Hidden[pixel])
    {
      continue;
    }
    const glm::dvec3 inView(place[0], place[1], place[2]);
    if (!std::isfinite(glm::dot(inView, inView)) || !std::isfinite(place[3]))
    {
      continue; // of a facet without an area
    }
    points.position[i] = glm::dvec3(this->ToWorld * glm::dvec4(inView, 1.0));
    points.facet[i] = glm::vec3(this->Turn * glm::dvec3(unfold(planes)));
    points.normal[i] = glm::vec3(this->Turn * glm::dvec3(unfold(planes + 2)));
    points.lift[i] = std::max(place[3], 0.0f);
    points.farthest = std::max(points.farthest, glm::length(inView));
    scratch.base = scratch.list.hits.mask == 0 ? -inView.z : scratch.base;
    this->put(scratch.list, i, points.position[i], scratch.base);
  }
}

/// Calls f(mask) for the patches of a list, `smooth`: of points on the smooth surface.
template <class F>
void TileOfPlaces::eachPatch(const TileHitList& list, bool smooth, Scratch& scratch, F&& f) const
{
  TilePatch& patch = scratch.patch;
  const TilePoints& points = scratch.points;
  svo::eachPatch(
    this->Frame.view, list.hits, [](std::uint32_t) { return true; },
    [&](std::uint32_t) { return scratch.base; }, patch,
    [&](const TilePatch&)
    {
      eachBit(patch.mask,
        [&](int i)
        {
          patch.facet.set(i, smooth ? points.normal[i] : points.facet[i]);
          patch.normal.set(i, points.normal[i]);
        });
      f(patch.mask);
    });
}

/// What a light with a size leaves. At the terminator the smooth surface is asked, as traced points
/// ask (svoTerminator.h).
void TileOfPlaces::sampleLight(std::size_t number, Scratch& scratch) const
{
  const Light& light = this->Frame.scene.lights[number];
  const TilePoints& points = scratch.points;
  std::uint64_t lit = 0, raised = 0;
  scratch.raised.start(scratch.list.hits.x0, scratch.list.hits.y0);
  eachBit(scratch.list.hits.mask,
    [&](int i)
    {
      const glm::dvec3 towards =
        light.atInfinity() ? -light.direction : light.position - points.position[i];
      const glm::dvec3 normal(points.normal[i]);
      if (!(glm::dot(normal, towards) > 0.0))
      {
        return; // it is not lit anyway
      }
      const bool doubtful =
        glm::dot(glm::dvec3(points.facet[i]), towards) <= DoubtfulSine * glm::length(towards);
      const glm::dvec3 over = points.position[i] + double(points.lift[i]) * normal;
      const View& view = this->Frame.view;
      const auto depth = [&](const glm::dvec3& at) { return glm::dot(at - view.eye, view.axis); };
      // (Not behind the eye, where it had no pixel.)
      if (doubtful && points.lift[i] > 0.0f &&
        (view.parallel || depth(over) > 0.5 * depth(points.position[i])))
      {
        raised |= std::uint64_t(1) << i;
        this->put(scratch.raised, i, over, scratch.base);
      }
      else
      {
        lit |= std::uint64_t(1) << i;
      }
    });
  const auto test = [&](std::uint64_t asked)
  {
    this->Frame.shadows.of(number).test(this->query(scratch, asked), scratch.missed);
    this->Images.put(this->Images.sampled().ofLights[number], scratch.patch, asked, *scratch.sums);
  };
  this->eachPatch(scratch.list, false, scratch, [&](std::uint64_t mask) { test(mask & lit); });
  this->eachPatch(scratch.raised, true, scratch, [&](std::uint64_t mask) { test(mask & raised); });
}

void TileOfPlaces::sample(int tileX, int tileY, Scratch& scratch) const
{
  const SampledPlanes& planes = this->Images.sampled();
  this->take(tileX, tileY, scratch);
  scratch.sums->first = this->Images.firstSample();
  if (this->Images.firstSample() == 0)
  {
    this->Images.startTile(tileX, tileY);
  }
  this->eachPatch(scratch.list, false, scratch,
    [&](std::uint64_t mask)
    {
      this->Images.put(scratch.patch);
      sampleAround(
        this->query(scratch, mask), this->Frame.shadows, this->Frame.settings, this->Images);
    });
  for (std::size_t l = 0; l < planes.ofLights.size(); ++l)
  {
    if (planes.ofLights[l] != SampledPlanes::None)
    {
      this->sampleLight(l, scratch);
    }
  }
}

/// Of each pixel of places, whether the eye has traced something before it, and before all beside
/// it: parts of a pixel take the light of their neighbours. (Between slices nothing lies.)
std::vector<std::uint8_t> hiddenPlaces(const SampledFrame& frame, const ReceiverPlaces& places)
{
  const int width = places.width, height = places.height;
  const DepthBuffer& eye = frame.eye.depth;
  assert(
    8 * eye.grid.tilesX >= width && 8 * eye.grid.tilesY >= std::min(frame.view.height, height));
  std::vector<std::uint8_t> before(static_cast<std::size_t>(width) * height), hidden(before);
  for (int y = 0; y < height; ++y)
  {
    const int seenY = y % places.sliceRows;
    for (int x = 0; x < width && seenY < frame.view.height; ++x)
    {
      const std::size_t tile = static_cast<std::size_t>(seenY / 8) * eye.grid.tilesX + x / 8;
      const std::size_t at = 64 * tile + 8 * (seenY & 7) + (x & 7);
      const std::size_t pixel = static_cast<std::size_t>(y) * width + x;
      if (eye.hit[tile] && eye.instance[at] != NoInstance)
      {
        constexpr double Beside = 4.0; // pixels' widths
        const double t = eye.t[at] + frame.eye.base(eye.instance[at]);
        const double behind = -double(places.places[4 * pixel + 2]) - t;
        before[pixel] = behind > Beside * widerWorldPixel(frame.view, t);
      }
    }
  }
  for (int y = 1; y + 1 < height; ++y)
  {
    for (int x = 1; x + 1 < width; ++x)
    {
      bool all = true;
      for (int k = 0; k < 9 && all; ++k)
      {
        all = before[static_cast<std::size_t>(y + k / 3 - 1) * width + (x + k % 3 - 1)] != 0;
      }
      hidden[static_cast<std::size_t>(y) * width + x] = all;
    }
  }
  return hidden;
}
}

void ReceiverSampler::begin(const SampledPlanes& sampled, bool other, bool more)
{
  const bool same = sampled.count == this->Shares.sampled.count;
  if (other || more || !same)
  {
    this->More = more && same && this->Shares.current;
    this->Shares.current = false;
  }
  this->Shares.sampled = sampled;
}

std::uint64_t ReceiverSampler::sample(const SampledFrame& frame, const ReceiverPlaces& places,
  bool same, const ParallelFor& parallelFor)
{
  const int tilesX = (places.width + 7) / 8, tilesY = (places.height + 7) / 8;
  this->Images.begin(
    this->Shares.sampled, tilesX, tilesY, nullptr, frame.settings.lightSamples, this->More && same);
  const std::vector<std::uint8_t> hidden = hiddenPlaces(frame, places);
  const TileOfPlaces tile(frame, places, hidden, this->Images);
  std::atomic<std::uint64_t> rays{ 0 };
  std::vector<std::uint8_t> filled(static_cast<std::size_t>(tilesX) * tilesY);
  parallelFor(0, static_cast<std::size_t>(tilesX) * tilesY, 1,
    [&](std::size_t first, std::size_t last)
    {
      Scratch scratch;
      scratch.rays = 0;
      for (std::size_t i = first; i < last; ++i)
      {
        tile.sample(static_cast<int>(i) % tilesX, static_cast<int>(i) / tilesX, scratch);
        filled[i] = scratch.list.hits.mask != 0;
      }
      rays.fetch_add(scratch.rays, std::memory_order_relaxed);
    });
  // What has become empty is to be known as such.
  const bool known = this->Filled.size() == filled.size();
  this->Images.findMeans(parallelFor, frame.settings.filterLightSamples,
    [&](int x, int y)
    {
      const std::size_t i = static_cast<std::size_t>(y) * tilesX + x;
      return filled[i] != 0 || !known || this->Filled[i] != 0;
    });
  this->Filled = std::move(filled);
  const std::vector<std::uint16_t> coarser = std::move(this->Shares.numbers);
  this->write(places, parallelFor);
  std::vector<int> planes(static_cast<std::size_t>(this->Shares.sampled.count));
  std::iota(planes.begin(), planes.end(), 0);
  this->Shares.error =
    this->More && same ? differenceOf(coarser, this->Shares.numbers, planes, places) : -1.0;
  this->Shares.current = true;
  this->More = false;
  return rays;
}

/// The means as numbers.
void ReceiverSampler::write(const ReceiverPlaces& places, const ParallelFor& parallelFor)
{
  const std::size_t pixels = static_cast<std::size_t>(places.width) * places.height;
  this->Shares.numbers.assign(4 * pixels * this->Shares.layers(), 0);
  // Means of lights and of occlusion are what is missing; of a sky what is seen.
  const SampledPlanes& planes = this->Shares.sampled;
  const int missing = planes.ofSky == SampledPlanes::None ? planes.count : planes.ofSky;
  parallelFor(0, static_cast<std::size_t>(places.height), 16,
    [&](std::size_t first, std::size_t last)
    {
      for (int plane = 0; plane < planes.count; ++plane)
      {
        std::uint16_t* numbers = &this->Shares.numbers[4 * pixels * (plane / 4) + plane % 4];
        for (std::size_t at = first * places.width; at < last * places.width; ++at)
        {
          const float mean = this->Images.mean(
            plane, static_cast<int>(at % places.width), static_cast<int>(at / places.width));
          const float share = plane < missing ? 1.0f - mean : mean;
          numbers[4 * at] =
            static_cast<std::uint16_t>(glm::clamp(share, 0.0f, 1.0f) * 65535.0f + 0.5f);
        }
      }
    });
}
}
