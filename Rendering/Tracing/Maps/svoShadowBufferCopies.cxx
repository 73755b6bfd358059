// A shadow buffer's maps, tile by tile, for rasterised receivers.
#include "svoShadowBuffer.h"

#include <algorithm>
#include <limits>
#include <memory>

namespace svo
{
std::shared_ptr<const ShadowTexels> ShadowBuffer::Map::copy(
  double base, const std::vector<float>* ofCasters) const
{
  constexpr std::size_t InTile = ShadowTexels::InTile;
  auto copy = std::make_shared<ShadowTexels>();
  copy->tilesX = this->grid.tilesX;
  copy->tiles.reserve(static_cast<std::size_t>(this->grid.tilesX) * this->grid.tilesY);
  copy->stride = ofCasters ? 2 * InTile : InTile;
  std::vector<std::size_t> places; // of tiles that something lies in, row by row
  for (int y = this->grid.y0; y < this->grid.y0 + this->grid.tilesY; ++y)
  {
    for (int x = this->grid.x0; x < this->grid.x0 + this->grid.tilesX; ++x)
    {
      const std::size_t place = this->grid.index(x, y);
      const bool any =
        this->traced.seesCasters && this->isReceived(place) && this->traced.holds(place);
      copy->tiles.push_back(
        any ? static_cast<std::uint32_t>(places.size()) : ShadowTexels::Nothing);
      if (any)
      {
        places.push_back(place);
      }
    }
  }
  copy->numbers.reserve(copy->stride * places.size());
  for (const std::size_t place : places)
  {
    float numbers[2 * InTile];
    for (std::size_t i = 0; i < InTile; ++i)
    {
      const std::size_t at = InTile * place + i;
      std::uint32_t caster;
      double t;
      const bool any = this->traced.occluder(at, caster, t);
      numbers[i] = any ? static_cast<float>(t - base) : std::numeric_limits<float>::infinity();
      if (ofCasters)
      {
        numbers[InTile + i] = !any         ? 0.0f
          : this->traced.opacities.known() ? this->traced.opacities.at(at)
                                           : (*ofCasters)[caster];
      }
    }
    copy->numbers.insert(copy->numbers.end(), numbers, numbers + copy->stride);
  }
  return copy;
}

bool ShadowBuffer::Map::copySuffices() const
{
  return this->copied &&
    (this->copiedOf.empty() ||
      (!this->received.empty() &&
        std::equal(this->received.begin(), this->received.end(), this->copiedOf.begin(),
          this->copiedOf.end(), [](std::uint8_t now, std::uint8_t then) { return now <= then; })));
}

void ShadowBuffer::copyMaps(int light, std::vector<ShadowMap>& maps, int group)
{
  for (const auto& map : this->Maps)
  {
    ShadowMap copy;
    copy.light = light;
    copy.group = group;
    copy.view = cropped(map->traced.view);
    copy.base = std::max(map->traced.view.tNear, 0.0);
    if (!map->copySuffices())
    {
      map->copiedOf = map->received;
      map->copiedFrom = map->hits.version;
      map->copied = map->copy(copy.base, this->Translucent ? &this->Tested.casterOpacity : nullptr);
    }
    copy.texels = map->copied;
    copy.worldBias = map->traced.largestError;
    copy.casterVoxel = map->traced.largestVoxel;
    maps.push_back(std::move(copy));
  }
}
}
