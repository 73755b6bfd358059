#include "svoShadowBuffer.h"

#include "svoLeafError.h"
#include "svoLocalView.h"
#include "svoMapTest.h"
#include "svoSelectLevel.h"
#include "svoWorldSize.h"

#include <algorithm>

namespace svo
{
void ShadowBuffer::prepare(const Scene& scene, const LightMaps& maps, std::size_t first,
  const FrameSettings& settings, LayerBudget& budget, std::uint8_t group,
  const ParallelFor& parallelFor)
{
  const std::vector<View>& views = maps.views;
  const std::uint8_t* casters = maps.casters.data() + first; // this scene's
  const bool sameBias =
    this->Maps.automaticBias == settings.automaticBias && this->Maps.bias == settings.bias;
  this->SameMaps = sameBias &&
    std::equal(this->Faces.begin(), this->Faces.end(), views.begin(), views.end(),
      [](const auto& face, const View& view) { return sameRays(face->map.view, view); });
  this->setBias(settings);
  this->arrangeFaces(views, budget);
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
    Face& face = *this->Faces[i];
    const bool sawCasters = face.map.seesCasters;
    static_cast<MapGeometry&>(face.map) = MapGeometry(views[i]);
    const TileGrid before = face.grid;
    face.grid = TileGrid(views[i]);
    if (face.map.shared.merged() || !settings.handsOutMaps() || !sameGrid(before, face.grid))
    {
      face.copied.reset();
    }
    face.map.shared.clear();
    face.layers.setCulling(this->Cull);
    face.map.seesCasters = face.layers.prepare(
      scene, face.map.view,
      [&](const Instance& instance)
      { return casters[&instance - scene.instances.data()] == group; },
      [&](const Instance& instance, const LocalView& local)
      { return selectLevel(instance, local, face.map.view, settings.pixelError); },
      settings.frameCoherence, budget, parallelFor);
    this->SameMaps = this->SameMaps && sawCasters == face.map.seesCasters;
    if (sawCasters != face.map.seesCasters)
    {
      face.copied.reset();
    }
    const std::vector<double> voxels = std::move(face.map.casterVoxel);
    const std::vector<double> errors = std::move(face.map.casterError);
    face.map.casterVoxel.assign(outlines, 0.0);
    face.map.casterError.assign(outlines, 0.0);
    if (!face.map.seesCasters && !settings.wholeShadowBuffers)
    {
      face.forget(); // of most groups' maps, where a light has six
      continue;
    }
    this->SameMaps = this->SameMaps && voxels.size() == outlines;
    const ViewedInstances& seen = face.layers.hits().instances;
    for (std::uint32_t k = 0; k < scene.instances.size(); ++k)
    {
      const Instance& instance = scene.instances[k];
      double &voxel = face.map.casterVoxel[k], &error = face.map.casterError[k];
      if (const int level = seen.level(k); casters[k] == group && level > 0)
      {
        voxel = worldVoxel(instance, level);
        error = worldMapError(instance, seen.leafGeometry(k), level);
      }
      // Tiles that show a caster that has moved have changed: what else is new of it is no matter.
      this->SameMaps = this->SameMaps &&
        (places[k] != this->CasterPlace[k] || (voxels[k] == voxel && errors[k] == error));
    }
    face.map.findLargest();
    if (face.wanted.size() != face.grid.size())
    {
      face.wanted = std::vector<std::atomic<std::uint8_t>>(face.grid.size());
    }
    for (auto& tile : face.wanted)
    {
      tile.store(0, std::memory_order_relaxed);
    }
    face.received.clear();
  }
  this->noteOpacities(scene, casters, group);
}

/// So many faces as there are views: each is the one that had its view's image, if there is one, as
/// what was traced of it is still true then.
void ShadowBuffer::arrangeFaces(const std::vector<View>& views, LayerBudget& budget)
{
  std::vector<std::unique_ptr<Face>> before = std::move(this->Faces);
  const bool moved = !before.empty();
  this->Faces.clear();
  for (const View& view : views)
  {
    const auto same = std::find_if(before.begin(), before.end(),
      [&](const auto& face) { return face && sameImage(face->map.view, view); });
    this->Faces.push_back(same != before.end() ? std::move(*same) : nullptr);
  }
  auto other = before.begin(); // faces that are free
  for (auto& face : this->Faces)
  {
    other = std::find_if(other, before.end(), [](const auto& left) { return left != nullptr; });
    if (!face)
    {
      face = other != before.end() ? std::move(*other) : std::make_unique<Face>(moved);
    }
  }
  this->Maps.maps.clear();
  for (const auto& face : this->Faces)
  {
    this->Maps.maps.push_back(&face->map);
  }
  for (const auto& gone : before)
  {
    budget.used -= gone ? gone->layers.layerMemory() : 0;
  }
}

template <class Body>
void ShadowBuffer::tilesAround(const MapPlace& place, std::uint16_t light, Body&& body) const
{
  const TileGrid& grid = this->Faces[place.index]->grid;
  const PixelRect& crop = place.map->view.crop;
  const int x0 = std::max(static_cast<int>(place.x - this->Around), crop.x0) >> 3;
  const int y0 = std::max(static_cast<int>(place.y - this->Around), crop.y0) >> 3;
  const int x1 = std::min(static_cast<int>(place.x + this->Around), crop.x1 - 1) >> 3;
  const int y1 = std::min(static_cast<int>(place.y + this->Around), crop.y1 - 1) >> 3;
  for (int y = y0; y <= y1; ++y)
  {
    for (int x = x0; x <= x1; ++x)
    {
      body(LightTile{ light, static_cast<std::uint16_t>(place.index),
        static_cast<std::uint32_t>(grid.index(x, y)) });
    }
  }
}

bool ShadowBuffer::isTraced(const MapPlace& place) const
{
  bool traced = true;
  this->tilesAround(place, 0, [&](const LightTile& name) { traced = traced && this->wants(name); });
  return traced;
}

bool ShadowBuffer::knows(const glm::dvec3& position) const
{
  MapPlace place;
  return !this->Maps.lookUp(position, place) || isTraced(place);
}

ShadowBuffer::MapAnswer ShadowBuffer::ask(
  const SurfacePoint& point, double error, const double* extent) const
{
  MapPlace place;
  if (!this->Maps.lookUp(point.position, place))
  {
    return { true, 0.0f, 0.0 };
  }
  MapAnswer said{ isTraced(place), 0.0f, place.map->edge(place.t) };
  if (said.known)
  {
    const MapTest test(this->Maps);
    said.darkness = extent         ? test.darkness(point, error, *extent)
      : test.shadows(point, error) ? 1.0f
                                   : 0.0f;
  }
  return said;
}

void ShadowBuffer::note(const glm::dvec3& position, std::uint16_t light, RaisedTiles& noted) const
{
  MapPlace place;
  if (this->Maps.lookUp(position, place))
  {
    this->tilesAround(place, light,
      [&](const LightTile& name) {
        noted.push_back({ name, this->wants(name) });
      });
  }
}

bool ShadowBuffer::Face::want(const MapPlaces& places, float around, std::uint16_t light,
  std::uint16_t index, LightTiles& noted)
{
  const MapTiles box = tilesOf(places, this->map.view, around);
  if (!box.atMost(8))
  {
    return false;
  }
  const std::uint64_t tiles =
    box.atMost(2) ? ~std::uint64_t(0) : svo::tilesAround(places, this->map.view, around, box);
  for (int y = box.y0; y <= box.y1; ++y)
  {
    for (int x = box.x0; x <= box.x1; ++x)
    {
      if (tiles >> (8 * (y - box.y0) + x - box.x0) & 1)
      {
        // Written part by part where it stays: a whole that was just put together from parts
        // could be copied only when they have reached the cache.
        LightTile& note = noted.emplace_back();
        note.light = light;
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

void ShadowBuffer::mark(const TilePatch& patch, std::uint16_t light, LightTiles& noted)
{
  std::uint64_t left = patch.mask, single = 0;
  for (std::size_t f = 0; f < this->Faces.size() && left != 0; ++f)
  {
    const std::unique_ptr<Face>& face = this->Faces[f];
    MapPlaces places;
    placeInMap(face->map, patch, left, places);
    single |= left & ~(places.inside | places.outside);
    if (places.inside != 0 && face->map.seesCasters &&
      !face->want(places, this->Around, light, static_cast<std::uint16_t>(f), noted))
    {
      single |= places.inside;
    }
    left &= places.outside;
  }
  const auto note = [&](const LightTile& name)
  {
    noted.push_back(name);
    this->mark(name);
  };
  eachBit(single,
    [&](int i)
    {
      MapPlace place;
      if (this->Maps.lookUp(patch.position(i), place))
      {
        this->tilesAround(place, light, note);
      }
    });
}

void ShadowBuffer::mark(const SeenReceivers& receivers)
{
  for (auto& face : this->Faces)
  {
    face->received.assign(face->wanted.size(), 0);
    for (const PixelRect& rect :
      face->map.seesCasters ? receivers.in(face->map.view) : std::vector<PixelRect>())
    {
      face->grid.eachStretch(rect,
        [&](std::size_t first, std::size_t last)
        {
          for (std::size_t tile = first; tile < last; ++tile)
          {
            face->wanted[tile].store(1, std::memory_order_relaxed);
            face->received[tile] = 1;
          }
        });
    }
  }
}

void ShadowBuffer::markAll()
{
  for (auto& face : this->Faces)
  {
    for (auto& tile : face->wanted)
    {
      tile.store(1, std::memory_order_relaxed);
    }
  }
}

void ShadowBuffer::trace(const ParallelFor& parallelFor)
{
  for (auto& face : this->Faces)
  {
    if (face->wanted.empty())
    {
      continue; // it sees nothing
    }
    std::vector<std::uint8_t> wanted(face->wanted.size());
    std::transform(face->wanted.begin(), face->wanted.end(), wanted.begin(),
      [](const auto& tile) { return tile.load(std::memory_order_relaxed); });
    face->layers.trace(parallelFor, wanted.data());
    face->map.occluders.find(face->layers.hits(), parallelFor);
    if (this->MappedColors.empty())
    {
      face->map.opacities.forget();
    }
    else
    {
      face->map.opacities.find(
        *this->Traced, face->map.view, face->layers.hits(), this->OtherOpacities, parallelFor);
    }
    if (face->layers.hits().tiles.anyStale() || this->OtherOpacities)
    {
      face->copied.reset();
    }
  }
  this->Traced = nullptr;
}

void ShadowBuffer::merge(Processes& processes, std::size_t first)
{
  if (this->Translucent)
  {
    const std::vector<float> opacities = std::move(this->Maps.casterOpacity);
    gatherRecords(processes, opacities, this->Maps.casterOpacity);
    this->MappedColors.clear();
    this->Maps.findSameOpacity(/*mapped=*/false);
  }
  for (auto& face : this->Faces)
  {
    const std::vector<double> voxels = std::move(face->map.casterVoxel);
    const std::vector<double> errors = std::move(face->map.casterError);
    gatherRecords(processes, voxels, face->map.casterVoxel);
    gatherRecords(processes, errors, face->map.casterError);
    face->map.findLargest();
    face->map.shared.merge(processes, face->map.view, face->layers.hits(), first);
    face->map.occluders.forget();
    face->map.opacities.forget();
    face->map.seesCasters = face->map.shared.bytes() > 0;
    face->copied.reset();
  }
}

void ShadowBuffer::Face::forget()
{
  std::vector<std::atomic<std::uint8_t>>().swap(this->wanted);
  this->layers.forget();
  this->map.occluders.forget();
  this->map.opacities.forget();
}

std::size_t ShadowBuffer::Face::memory() const
{
  constexpr std::size_t OfTexel = sizeof(float) + sizeof(std::uint32_t) + sizeof(Primitive);
  // Of a tile of the map, here and in LayeredView: marks, states and what lies in it.
  constexpr std::size_t OfTile = 24;
  std::size_t bytes = this->map.shared.bytes() + OfTile * this->wanted.size();
  for (const std::uint8_t hit : this->layers.hits().depth.hit)
  {
    bytes += hit ? 64 * (OfTexel + (this->map.opacities.known() ? sizeof(float) : 0)) : 0;
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
  for (const auto& face : this->Faces)
  {
    sum += face->memory();
  }
  return sum;
}

void ShadowBuffer::addStatistics(FrameStatistics& statistics) const
{
  for (const auto& face : this->Faces)
  {
    statistics.shadowRays += face->layers.rays();
    statistics.retracedLayers += face->layers.retracedLayers();
    statistics.sparedCasters += face->layers.spared().unasked + face->layers.spared().hidden;
  }
}

std::size_t ShadowBuffer::layerMemory() const
{
  std::size_t sum = 0;
  for (const auto& face : this->Faces)
  {
    sum += face->layers.layerMemory();
  }
  return sum;
}
}
