// What a shadow buffer of translucent casters takes of the light.
#include "svoMapTest.h"
#include "svoShadowBuffer.h"
#include "svoShadowFilter.h"

#include <algorithm>
#include <tuple>

namespace svo
{
namespace
{
bool sameColors(const Attributes& a, const Attributes& b)
{
  const auto names = [](const Attributes& c)
  {
    return std::tie(c.colors, c.colorAssociation, c.colorCoordinates, c.colorTexture,
      c.colorTextureSize, c.version);
  };
  return names(a) == names(b);
}
}

void TracedMaps::findSameOpacity(bool mapped)
{
  this->sameOpacity = 0.0f;
  bool same = !mapped;
  for (const float opacity : this->casterOpacity)
  {
    same = same && (opacity == 0.0f || this->sameOpacity == 0.0f || opacity == this->sameOpacity);
    this->sameOpacity = std::max(this->sameOpacity, opacity);
  }
  this->sameOpacity = same ? this->sameOpacity : -1.0f;
}

/// Of the group's casters; of opaque ones there is nothing to note.
void ShadowBuffer::noteOpacities(
  const Scene& scene, const std::uint8_t* casters, std::uint8_t group)
{
  this->Translucent = group != OpaqueCasters;
  const std::vector<float> opacities = std::move(this->Tested.casterOpacity);
  const std::vector<Attributes> colors = std::move(this->MappedColors);
  this->Tested.casterOpacity.clear();
  this->MappedColors.clear();
  this->Traced = &scene;
  if (!this->Translucent)
  {
    return;
  }
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
  {
    const Instance& instance = scene.instances[i];
    const bool ours = casters[i] == group;
    this->Tested.casterOpacity.push_back(ours ? instance.opacity : 0.0f);
    if (ours && instance.mappedOpacity)
    {
      this->MappedColors.push_back(instance.body->attributes);
    }
  }
  this->Tested.casterOpacity.resize(scene.instances.size() + scene.receivers.size(), 0.0f);
  this->Tested.findSameOpacity(!this->MappedColors.empty());
  this->OtherOpacities = opacities != this->Tested.casterOpacity ||
    !std::equal(colors.begin(), colors.end(), this->MappedColors.begin(), this->MappedColors.end(),
      sameColors);
  this->SameMaps = this->SameMaps && !this->OtherOpacities;
}

float MapTest::opacity(const TracedMap& map, const glm::ivec2& texel) const
{
  std::uint32_t caster;
  double t;
  const std::size_t at = map.hits.depth.at(texel.x, texel.y);
  return !map.occluder(at, caster, t) ? 0.0f
    : map.opacities.known()           ? map.opacities.at(at)
                                      : this->Maps.casterOpacity[caster];
}

float MapTest::opacity(const MapPlace& place, double width) const
{
  const PixelRect& crop = place.map->view.crop;
  TexelWindow x(place.x, width, crop.x0, crop.x1);
  TexelWindow y(place.y, width, crop.y0, crop.y1);
  x.weigh();
  y.weigh();
  double sum = 0.0, all = 0.0;
  for (int j = 0; j < y.count; ++j)
  {
    for (int i = 0; i < x.count; ++i)
    {
      const glm::ivec2 texel(x.first + i, y.first + j);
      std::uint32_t caster;
      double t;
      if (place.map->occluder(texel, caster, t))
      {
        const double weight = x.weight[i] * y.weight[j];
        sum += weight * this->opacity(*place.map, texel);
        all += weight;
      }
    }
  }
  return all > 0.0 ? static_cast<float>(sum / all) : 0.0f;
}

void MapTest::taken(const TilePatch& patch, double error, const double* extents,
  std::uint64_t asked, float* taken) const
{
  std::uint64_t some = 0;
  if (extents)
  {
    this->darkness(patch, error, extents, asked, taken);
    eachBit(asked, [&](int i) { some |= std::uint64_t(taken[i] > 0.0f) << i; });
  }
  else
  {
    some = this->shadows(patch, error, asked);
    std::fill_n(taken, TilePatch::Most, 0.0f);
  }
  if (this->Maps.sameOpacity >= 0.0f)
  {
    eachBit(some, [&](int i) { taken[i] = this->Maps.sameOpacity * (extents ? taken[i] : 1.0f); });
    return;
  }
  eachBit(some,
    [&](int i)
    {
      MapPlace place;
      const SurfacePoint point = patch.point(i);
      if (!this->Maps.lookUp(point.position, place))
      {
        return; // nothing is taken at the border of what is seen
      }
      if (!extents)
      {
        taken[i] = this->opacity(*place.map, place.nearest());
        return;
      }
      const double width = boxWidth(place, extents[i]);
      taken[i] = taken[i] < 1.0f ? this->filtered(place, width, point, error, true)
                                 : this->opacity(place, width);
    });
}
}
