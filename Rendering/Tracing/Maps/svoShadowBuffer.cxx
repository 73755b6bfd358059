#include "svoShadowBuffer.h"

#include "svoLayeredView.h"
#include "svoLeafError.h"
#include "svoLocalView.h"
#include "svoMapTest.h"
#include "svoSelectLevel.h"
#include "svoWorldSize.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace svo
{
ShadowBuffer::Map::Map(std::unique_ptr<LayeredView> view)
  : layers(std::move(view))
  , hits(this->layers->hits())
{
}

ShadowBuffer::Map::~Map() = default;

void ShadowBuffer::prepare(const Scene& scene, const LightMaps& maps, std::size_t first,
  const FrameSettings& settings, LayerBudget& budget, std::uint8_t group,
  const ParallelFor& parallelFor)
{
  const std::vector<View>& views = maps.views;
  const std::uint8_t* casters = maps.casters.data() + first; // this scene's
  const bool sameBias =
    this->Tested.automaticBias == settings.automaticBias && this->Tested.bias == settings.bias;
  this->SameMaps = sameBias &&
    std::equal(this->Maps.begin(), this->Maps.end(), views.begin(), views.end(),
      [](const auto& map, const View& view) { return sameRays(map->traced.view, view); });
  this->setBias(settings);
  this->arrangeMaps(views, budget);
  const std::vector<glm::dmat4> places = std::move(this->CasterPlace);
  this->CasterPlace.clear();
  this->CasterPlace.reserve(scene.instances.size());
  for (const Instance& instance : scene.instances)
  {
    this->CasterPlace.push_back(instance.localToWorld);
  }
  this->SameMaps = this->SameMaps && places.size() == this->CasterPlace.size();
  const std::size_t outlines = scene.instances.size() + scene.receivers.size();
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    Map& map = *this->Maps[i];
    const bool sawCasters = map.traced.seesCasters;
    static_cast<MapGeometry&>(map.traced) = MapGeometry(views[i]);
    const TileGrid before = map.grid;
    map.grid = TileGrid(views[i]);
    if (map.traced.shared.merged() || !settings.handsOutMaps() || !sameGrid(before, map.grid))
    {
      map.copied.reset();
    }
    map.traced.shared.clear();
    map.layers->setCulling(this->Cull);
    map.traced.seesCasters = map.layers->prepare(
      scene, map.traced.view,
      [&](const Instance& instance)
      { return casters[&instance - scene.instances.data()] == group; },
      [&](const Instance& instance, const LocalView& local)
      { return selectLevel(instance, local, map.traced.view, settings.pixelError); },
      settings.frameCoherence, budget, parallelFor);
    this->SameMaps = this->SameMaps && sawCasters == map.traced.seesCasters;
    if (sawCasters != map.traced.seesCasters)
    {
      map.copied.reset();
    }
    const std::vector<double> voxels = std::move(map.traced.casterVoxel);
    const std::vector<double> errors = std::move(map.traced.casterError);
    map.traced.casterVoxel.assign(outlines, 0.0);
    map.traced.casterError.assign(outlines, 0.0);
    if (!map.traced.seesCasters && !settings.wholeShadowBuffers)
    {
      map.forget(); // of most groups' maps, where a light has six
      continue;
    }
    this->SameMaps = this->SameMaps && voxels.size() == outlines;
    const ViewedInstances& seen = map.hits.instances;
    for (std::uint32_t k = 0; k < scene.instances.size(); ++k)
    {
      const Instance& instance = scene.instances[k];
      double &voxel = map.traced.casterVoxel[k], &error = map.traced.casterError[k];
      if (const int level = seen.level(k); casters[k] == group && level > 0)
      {
        voxel = worldVoxel(instance, level);
        error = worldMapError(instance, seen.leafGeometry(k), level);
      }
      // Tiles that show a caster that has moved have changed: what else is new of it is no matter.
      this->SameMaps = this->SameMaps &&
        (places[k] != this->CasterPlace[k] || (voxels[k] == voxel && errors[k] == error));
    }
    map.traced.findLargest();
    if (map.wanted.size() != map.grid.size())
    {
      map.wanted = std::vector<std::atomic<std::uint8_t>>(map.grid.size());
    }
    for (auto& tile : map.wanted)
    {
      tile.store(0, std::memory_order_relaxed);
    }
    map.received.clear();
  }
  this->noteOpacities(scene, casters, group);
}

/// So many maps as there are views: each is the one that had its view's image, if there is one, as
/// what was traced of it is still true then.
void ShadowBuffer::arrangeMaps(const std::vector<View>& views, LayerBudget& budget)
{
  assert(views.size() <= 256); // LightTile::map
  std::vector<std::unique_ptr<Map>> before = std::move(this->Maps);
  const bool moved = !before.empty();
  this->Maps.clear();
  for (const View& view : views)
  {
    const auto same = std::find_if(before.begin(), before.end(),
      [&](const auto& map) { return map && sameImage(map->traced.view, view); });
    this->Maps.push_back(same != before.end() ? std::move(*same) : nullptr);
  }
  auto other = before.begin(); // maps that are free
  for (auto& map : this->Maps)
  {
    other = std::find_if(other, before.end(), [](const auto& left) { return left != nullptr; });
    if (!map)
    {
      map = other != before.end()
        ? std::move(*other)
        : std::make_unique<Map>(std::make_unique<LayeredView>(/*exact=*/false, moved));
    }
  }
  this->Tested.maps.clear();
  for (const auto& map : this->Maps)
  {
    this->Tested.maps.push_back(&map->traced);
  }
  for (const auto& gone : before)
  {
    budget.used -= gone ? gone->layers->layerMemory() : 0;
  }
}

template <class Function>
void ShadowBuffer::tilesAround(const MapPlace& place, BufferName name, Function&& function) const
{
  const TileGrid& grid = this->Maps[place.index]->grid;
  const PixelRect& crop = place.map->view.crop;
  const int x0 = std::max(static_cast<int>(place.x - this->Around), crop.x0) >> 3;
  const int y0 = std::max(static_cast<int>(place.y - this->Around), crop.y0) >> 3;
  const int x1 = std::min(static_cast<int>(place.x + this->Around), crop.x1 - 1) >> 3;
  const int y1 = std::min(static_cast<int>(place.y + this->Around), crop.y1 - 1) >> 3;
  for (int y = y0; y <= y1; ++y)
  {
    for (int x = x0; x <= x1; ++x)
    {
      function(LightTile{ name.light, name.group, static_cast<std::uint8_t>(place.index),
        static_cast<std::uint32_t>(grid.index(x, y)) });
    }
  }
}

bool ShadowBuffer::isTraced(const MapPlace& place) const
{
  bool traced = true;
  this->tilesAround(
    place, {}, [&](const LightTile& tile) { traced = traced && this->wants(tile); });
  return traced;
}

bool ShadowBuffer::knows(const glm::dvec3& position) const
{
  MapPlace place;
  return !this->Tested.lookUp(position, place) || isTraced(place);
}

ShadowBuffer::MapAnswer ShadowBuffer::ask(
  const SurfacePoint& point, double error, const double* extent) const
{
  MapPlace place;
  if (!this->Tested.lookUp(point.position, place))
  {
    return { true, 0.0f, 0.0 };
  }
  MapAnswer said{ isTraced(place), 0.0f, place.map->edge(place.t) };
  if (said.known)
  {
    const MapTest test(this->Tested);
    said.darkness = extent         ? test.darkness(point, error, *extent)
      : test.shadows(point, error) ? 1.0f
                                   : 0.0f;
  }
  return said;
}

void ShadowBuffer::note(const glm::dvec3& position, BufferName name, RaisedTiles& noted) const
{
  MapPlace place;
  if (this->Tested.lookUp(position, place))
  {
    this->tilesAround(place, name,
      [&](const LightTile& tile) {
        noted.push_back({ tile, this->wants(tile) });
      });
  }
}

bool ShadowBuffer::Map::want(
  const MapPlaces& places, float around, BufferName name, std::uint8_t index, LightTiles& noted)
{
  const MapTiles box = tilesOf(places, this->traced.view, around);
  if (!box.atMost(8))
  {
    return false;
  }
  const std::uint64_t tiles =
    box.atMost(2) ? ~std::uint64_t(0) : svo::tilesAround(places, this->traced.view, around, box);
  for (int y = box.y0; y <= box.y1; ++y)
  {
    for (int x = box.x0; x <= box.x1; ++x)
    {
      if (tiles >> (8 * (y - box.y0) + x - box.x0) & 1)
      {
        // Written part by part where it stays: a whole that was just put together from parts
        // could be copied only when they have reached the cache.
        LightTile& note = noted.emplace_back();
        note.light = name.light;
        note.group = name.group;
        note.map = index;
        note.tile = static_cast<std::uint32_t>(this->grid.index(x, y));
        std::atomic<std::uint8_t>& tile = this->wanted[note.tile];
        if (!tile.load(std::memory_order_relaxed))
        {
          tile.store(1, std::memory_order_relaxed);
        }
      }
    }
  }
  return true;
}

void ShadowBuffer::mark(const TilePatch& patch, BufferName name, LightTiles& noted)
{
  std::uint64_t left = patch.mask, single = 0;
  for (std::size_t f = 0; f < this->Maps.size() && left != 0; ++f)
  {
    const std::unique_ptr<Map>& map = this->Maps[f];
    MapPlaces places;
    placeInMap(map->traced, patch, left, places);
    single |= left & ~(places.inside | places.outside);
    if (places.inside != 0 && map->traced.seesCasters &&
      !map->want(places, this->Around, name, static_cast<std::uint8_t>(f), noted))
    {
      single |= places.inside;
    }
    left &= places.outside;
  }
  const auto note = [&](const LightTile& tile)
  {
    noted.push_back(tile);
    this->mark(tile);
  };
  eachBit(single,
    [&](int i)
    {
      MapPlace place;
      if (this->Tested.lookUp(patch.position(i), place))
      {
        this->tilesAround(place, name, note);
      }
    });
}

void ShadowBuffer::mark(const SeenReceivers& receivers)
{
  for (auto& map : this->Maps)
  {
    map->received.assign(map->wanted.size(), 0);
    for (const PixelRect& rect :
      map->traced.seesCasters ? receivers.in(map->traced.view) : std::vector<PixelRect>())
    {
      map->grid.eachStretch(rect,
        [&](std::size_t first, std::size_t last)
        {
          for (std::size_t tile = first; tile < last; ++tile)
          {
            map->wanted[tile].store(1, std::memory_order_relaxed);
            map->received[tile] = 1;
          }
        });
    }
  }
}

void ShadowBuffer::markAll()
{
  for (auto& map : this->Maps)
  {
    for (auto& tile : map->wanted)
    {
      tile.store(1, std::memory_order_relaxed);
    }
  }
}

void ShadowBuffer::trace(const ParallelFor& parallelFor)
{
  for (auto& map : this->Maps)
  {
    if (map->wanted.empty())
    {
      continue; // it sees nothing
    }
    std::vector<std::uint8_t> wanted(map->wanted.size());
    std::transform(map->wanted.begin(), map->wanted.end(), wanted.begin(),
      [](const auto& tile) { return tile.load(std::memory_order_relaxed); });
    map->layers->trace(parallelFor, wanted.data());
    map->traced.occluders.find(map->hits, parallelFor);
    if (this->MappedColors.empty())
    {
      map->traced.opacities.forget();
    }
    else
    {
      map->traced.opacities.find(
        *this->Traced, map->traced.view, map->hits, this->OtherOpacities, parallelFor);
    }
    if (map->hits.version > map->copiedFrom || this->OtherOpacities)
    {
      map->copied.reset();
    }
  }
  this->Traced = nullptr;
}

void ShadowBuffer::merge(Processes& processes, std::size_t first)
{
  if (this->Translucent)
  {
    const std::vector<float> opacities = std::move(this->Tested.casterOpacity);
    gatherRecords(processes, opacities, this->Tested.casterOpacity);
    this->MappedColors.clear();
    this->Tested.findSameOpacity(/*mapped=*/false);
  }
  for (auto& map : this->Maps)
  {
    const std::vector<double> voxels = std::move(map->traced.casterVoxel);
    const std::vector<double> errors = std::move(map->traced.casterError);
    gatherRecords(processes, voxels, map->traced.casterVoxel);
    gatherRecords(processes, errors, map->traced.casterError);
    map->traced.findLargest();
    map->traced.shared.merge(processes, map->traced.view, map->hits, first);
    map->traced.occluders.forget();
    map->traced.opacities.forget();
    map->traced.seesCasters = map->traced.shared.bytes() > 0;
    map->copied.reset();
  }
}

void ShadowBuffer::Map::forget()
{
  std::vector<std::atomic<std::uint8_t>>().swap(this->wanted);
  this->layers->forget();
  this->traced.occluders.forget();
  this->traced.opacities.forget();
}

std::size_t ShadowBuffer::Map::memory() const
{
  constexpr std::size_t OfTexel = sizeof(float) + sizeof(std::uint32_t) + sizeof(Primitive);
  // Of a tile of the map, here and in LayeredView: marks, states and what lies in it.
  constexpr std::size_t OfTile = 32;
  std::size_t bytes = this->traced.shared.bytes() + OfTile * this->wanted.size();
  for (const std::uint8_t hit : this->hits.depth.hit)
  {
    bytes += hit ? 64 * (OfTexel + (this->traced.opacities.known() ? sizeof(float) : 0)) : 0;
  }
  if (this->copied)
  {
    bytes += this->copied->tiles.size() * sizeof(std::uint32_t) +
      this->copied->numbers.size() * sizeof(float);
  }
  return bytes;
}

std::size_t ShadowBuffer::memory() const
{
  std::size_t sum = 0;
  for (const auto& map : this->Maps)
  {
    sum += map->memory();
  }
  return sum;
}

void ShadowBuffer::addStatistics(FrameStatistics& statistics) const
{
  for (const auto& map : this->Maps)
  {
    statistics.shadowRays += map->layers->rays();
    statistics.retracedLayers += map->layers->retracedLayers();
    statistics.sparedCasters += map->layers->spared().unasked + map->layers->spared().hidden;
  }
}

std::size_t ShadowBuffer::layerMemory() const
{
  std::size_t sum = 0;
  for (const auto& map : this->Maps)
  {
    sum += map->layers->layerMemory();
  }
  return sum;
}
}
