#include "svoShadowCases.h"

#include "svoMapTest.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace svotest
{
namespace
{
constexpr int Size = 64;       // texels along an edge of a map
constexpr double Middle = 6.0; // linear depth of what casts, world
constexpr double Near = 1.0, Far = 11.0;

class Dice
{
public:
  explicit Dice(unsigned int seed)
    : Engine(seed)
  {
  }
  double between(double low, double high)
  {
    return low + (high - low) * (this->Engine() / 4294967296.0);
  }
  bool chance(double share) { return this->between(0.0, 1.0) < share; }
  /// All orders of magnitude alike.
  double magnitude(double low, double high)
  {
    return std::exp(this->between(std::log(low), std::log(high)));
  }
  glm::dvec3 direction()
  {
    for (;;)
    {
      const glm::dvec3 v(
        this->between(-1.0, 1.0), this->between(-1.0, 1.0), this->between(-1.0, 1.0));
      if (glm::length(v) > 0.1 && glm::length(v) < 1.0)
      {
        return glm::normalize(v);
      }
    }
  }

private:
  std::mt19937 Engine;
};

/// Another process, of one caster, that has seen what random texels hold: tiles of planes, of
/// steps, of creases and of noise, some with holes.
class RandomCaster : public svo::Processes
{
public:
  RandomCaster(const std::vector<svo::View>& views, double voxel, double error, Dice& dice)
    : Views(views)
    , Voxel(voxel)
    , Error(error)
    , Random(dice)
  {
  }
  int count() const override { return 2; }
  int self() const override { return 0; }

  void gather(const std::vector<unsigned char>& own, std::vector<unsigned char>& all,
    std::vector<std::size_t>& begins) override
  {
    const double caster[] = { this->Voxel, this->Error };
    all = own;
    all.resize(own.size() + sizeof(caster));
    std::memcpy(all.data() + own.size(), caster, sizeof(caster));
    begins = { 0, own.size(), all.size() };
  }

  /// Twice a map: which tiles are empty, and the texels.
  void minimum(std::vector<std::uint64_t>& values) override
  {
    if (!this->Tiles)
    {
      std::fill(values.begin(), values.end(), std::uint64_t(0));
      this->Tiles = true;
      return;
    }
    const svo::View& view = this->Views[this->Map++];
    for (std::size_t tile = 0; tile < values.size(); tile += 64)
    {
      this->fill(view, &values[tile]);
    }
    this->Tiles = false;
  }

private:
  void fill(const svo::View& view, std::uint64_t* texels)
  {
    constexpr double Steps = static_cast<double>((std::uint64_t(1) << 39) - 1);
    Dice& dice = this->Random;
    const double edge = svo::TexelEdge(view)(Middle);
    const double noise = dice.chance(0.25) ? dice.magnitude(0.01, 4.0) : 0.0;
    const double step = dice.chance(0.5) ? dice.magnitude(0.1, 60.0) : 0.0;
    const double holes = dice.chance(0.2) ? 0.2 : 0.0;
    const bool crease = dice.chance(0.5);
    const double turn = dice.between(0.0, 6.3), from = dice.between(-2.0, 2.0);
    const double slopeX = dice.between(-2.0, 2.0), slopeY = dice.between(-2.0, 2.0);
    const double bend = dice.between(-3.0, 3.0), level = dice.between(-3.0, 3.0);
    for (int k = 0; k < 64; ++k)
    {
      const double x = k % 8 - 3.5, y = k / 8 - 3.5;
      const double across = std::cos(turn) * x + std::sin(turn) * y - from;
      const double deep = level + slopeX * x + slopeY * y + (across > 0.0 ? step : 0.0) +
        (crease ? bend * std::abs(across) : 0.0) + noise * dice.between(-1.0, 1.0);
      const double share = (Middle + edge * deep - view.tNear) / (view.tFar - view.tNear);
      if (!dice.chance(holes))
      {
        texels[k] = static_cast<std::uint64_t>(std::clamp(share, 0.0, 1.0) * Steps) << 24;
      }
    }
  }

  const std::vector<svo::View>& Views;
  double Voxel, Error;
  Dice& Random;
  bool Tiles = false; // said which are empty
  std::size_t Map = 0;
};

/// A view that looks past the origin; `size` of what it covers there.
svo::View randomView(const glm::dmat4& worldToView, bool parallel, double size, Dice& dice)
{
  const double x = size, y = size * dice.between(0.3, 1.0), s = Near / Middle;
  const double dx = dice.between(-0.2, 0.2), dy = dice.between(-0.2, 0.2);
  const glm::dmat4 projection = parallel
    ? glm::ortho(dx - x, dx + x, dy - y, dy + y, Near, Far)
    : glm::frustum(s * (dx - x), s * (dx + x), s * (dy - y), s * (dy + y), Near, Far);
  svo::View view;
  svo::makeView(worldToView, projection, Size, Size, view);
  view.tNear = Near;
  view.tFar = Far;
  return view;
}

glm::dmat4 lookFromSomewhere(double distance, Dice& dice)
{
  return glm::lookAt(distance * dice.direction(), 0.3 * dice.direction(), dice.direction());
}

/// A unit vector towards where rays come from, or away; the sine of its plane's angle to them is of
/// any magnitude.
glm::dvec3 planeFacing(const glm::dvec3& ray, Dice& dice)
{
  const glm::dvec3 along = glm::normalize(ray);
  const glm::dvec3 aside = glm::normalize(glm::cross(along, dice.direction()));
  const double sine = dice.magnitude(3e-4, 1.0);
  return std::sqrt(1.0 - sine * sine) * aside - sine * along;
}

/// Where a map has a point, texels.
glm::dvec2 placeOf(const svo::View& view, const glm::dvec3& position)
{
  const glm::dvec4 clip = view.viewToClip * view.worldToView * glm::dvec4(position, 1.0);
  return 0.5 * Size * (glm::dvec2(clip) / clip.w + 1.0);
}

ShadowCase randomCase(const svo::ShadowMap& map, const svo::View& eye, Dice& dice)
{
  const double x = dice.between(-0.5, Size + 0.5), y = dice.between(-0.5, Size + 0.5);
  const int column = std::clamp(static_cast<int>(x), 0, Size - 1);
  const int row = std::clamp(static_cast<int>(y), 0, Size - 1);
  const double held = map.texels->depthAt(column, row);
  const double occluder = std::isfinite(held) ? map.base + held : Middle;
  const double edge = svo::TexelEdge(map.view)(occluder);
  const double away = (dice.chance(0.6) ? 1.0 : -1.0) * dice.magnitude(0.02, 90.0);
  const double t = occluder + edge * away;
  const glm::dvec3 ray = map.view.rayDirection(x, y);
  const glm::dvec3 facet = planeFacing(ray, dice);
  const glm::dvec3 normal = dice.chance(0.3) ? facet
    : dice.chance(0.2)                       ? -planeFacing(ray, dice)
                                             : planeFacing(ray, dice);
  const glm::dmat3 turn(eye.worldToView);
  ShadowCase point;
  point.position = eye.worldToView * glm::dvec4(map.view.rayOrigin(x, y) + t * ray, 1.0);
  point.facet = turn * facet;
  point.normal = turn * normal;
  point.extent = dice.chance(0.5) ? 0.0f : static_cast<float>(edge * dice.between(0.0, 6.0));
  return point;
}

svo::SurfacePoint worldPoint(const ShadowCase& point, const svo::View& eye)
{
  const glm::dmat4 toWorld = glm::inverse(eye.worldToView);
  svo::SurfacePoint result{};
  result.position = toWorld * glm::dvec4(point.position, 1.0);
  result.facet = glm::dmat3(toWorld) * glm::dvec3(point.facet);
  result.normal = glm::dmat3(toWorld) * glm::dvec3(point.normal);
  return result;
}
}

ShadowCases::ShadowCases(
  bool parallel, bool nested, const svo::FrameSettings& frameSettings, unsigned int seed)
  : settings(frameSettings)
{
  Dice dice(seed);
  this->settings.wholeShadowBuffers = true;
  svo::LightMaps lightMaps;
  const glm::dmat4 toLight = lookFromSomewhere(Middle, dice);
  if (nested)
  {
    lightMaps.views.push_back(randomView(toLight, parallel, 0.8, dice));
  }
  lightMaps.views.push_back(randomView(toLight, parallel, 2.0, dice));
  const double edge = svo::TexelEdge(lightMaps.views.back())(Middle);
  RandomCaster caster(lightMaps.views, edge, 0.4 * edge, dice);
  svo::LayerBudget budget{ 0, 0 };
  this->buffer.prepare(svo::Scene(), lightMaps, 0, this->settings, budget);
  this->buffer.trace(svo::serialFor); // of this process: nothing
  this->buffer.merge(caster, 0);
  this->buffer.copyMaps(0, this->maps);

  svo::makeView(
    lookFromSomewhere(5.0, dice), glm::perspective(0.7, 1.0, 0.1, 20.0), Across, Across, this->eye);
  for (int i = 0; i < Across * Across; ++i)
  {
    const std::size_t map = dice.chance(0.5) ? 0 : this->maps.size() - 1;
    this->points.push_back(randomCase(this->maps[map], this->eye, dice));
  }
}

ShadowCases::Range ShadowCases::darkness(const ShadowCase& point) const
{
  const svo::SurfacePoint exact = worldPoint(point, this->eye);
  Range range{ 1.0, 0.0 };
  // The corners of a cube around the point, with both planes tilted this way and that.
  for (int i = -1; i < 32; ++i)
  {
    const auto side = [i](int bit) { return i < 0 ? 0.0 : i >> bit & 1 ? 1.0 : -1.0; };
    svo::SurfacePoint p = exact;
    p.position += Rounding * glm::dvec3(side(0), side(1), side(2));
    const glm::dvec3 ray = this->maps.back().view.rayDirection(0.5 * Size, 0.5 * Size);
    const glm::dvec3 tilt = Tilt * glm::normalize(ray);
    p.facet = glm::dvec3(exact.facet) + side(3) * tilt;
    p.normal = glm::dvec3(exact.normal) + side(4) * tilt;
    const double dark = this->settings.filterShadows
      ? static_cast<double>(svo::MapTest(this->buffer.maps()).darkness(p, 0.0, point.extent))
      : static_cast<double>(svo::MapTest(this->buffer.maps()).shadows(p, 0.0));
    range.least = std::min(range.least, dark);
    range.most = std::max(range.most, dark);
  }
  return range;
}

bool ShadowCases::turnsAway(const ShadowCase& point) const
{
  const svo::SurfacePoint p = worldPoint(point, this->eye);
  for (const svo::ShadowMap& map : this->maps)
  {
    const glm::dvec2 place = placeOf(map.view, p.position);
    // From the point to the centres of texels that are asked, in texels.
    const double edge = svo::TexelEdge(map.view)(Middle);
    const double window = 2.0 + (this->settings.filterShadows ? 0.5 * point.extent / edge : 0.0);
    for (int corner = 0; corner < 4; ++corner)
    {
      const glm::dvec3 ray = map.view.rayDirection(
        place.x + (corner & 1 ? window : -window), place.y + (corner & 2 ? window : -window));
      if (glm::dot(glm::dvec3(p.facet), ray) > -2.0 * Tilt * glm::length(ray))
      {
        return true;
      }
    }
  }
  return false;
}
}
