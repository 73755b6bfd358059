#include "svoShadowBuffer.h"

#include "svoLeafError.h"
#include "svoSelectLevel.h"
#include "svoShadowTest.h"
#include "svoTexelPlace.h"
#include "svoWorldSize.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace svo
{
void ShadowBuffer::prepare(const Scene& scene, const LightMaps& maps, std::size_t first,
  const FrameSettings& settings, LayerBudget& budget)
{
  const std::vector<View>& views = maps.views;
  const std::uint8_t* casters = maps.casters.data() + first; // this scene's
  this->setBias(settings);
  if (this->Faces.size() != views.size())
  {
    budget.used -= this->layerMemory();
    this->Faces.clear();
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      this->Faces.push_back(std::make_unique<Face>());
    }
  }
  this->CasterVoxel.assign(scene.instances.size() + scene.receivers.size(), 0.0);
  this->CasterError.assign(this->CasterVoxel.size(), 0.0);
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    Face& face = *this->Faces[i];
    face.view = views[i];
    if (face.shared.merged() || !settings.wholeShadowBuffers)
    {
      face.copied.reset();
    }
    face.shared.clear();
    face.worldToClip = face.view.viewToClip * face.view.worldToView;
    face.edge = TexelEdge(face.view);
    face.seesCasters = face.layers.prepare(
      scene, face.view,
      [&](const Instance& instance) { return casters[&instance - scene.instances.data()] != 0; },
      [&](const Instance& instance, const LocalView& local)
      { return selectLevel(instance, local, face.view, settings.pixelError); },
      settings.frameCoherence, budget);
    for (std::size_t k = 0; k < scene.instances.size(); ++k)
    {
      const Instance& instance = scene.instances[k];
      const int level = face.layers.level(static_cast<std::uint32_t>(k));
      const LeafGeometry geometry = face.layers.leafGeometry(static_cast<std::uint32_t>(k));
      if (casters[k] && level > 0)
      {
        this->CasterVoxel[k] = std::max(this->CasterVoxel[k], worldVoxel(instance, level));
        this->CasterError[k] =
          std::max(this->CasterError[k], worldMapError(instance, geometry, level));
      }
    }
    const std::size_t tilesAcross = (face.view.width + 7) / 8;
    const std::size_t tiles = tilesAcross * ((face.view.height + 7) / 8);
    if (face.wanted.size() != tiles)
    {
      face.wanted = std::vector<std::atomic<std::uint8_t>>(tiles);
    }
    for (auto& tile : face.wanted)
    {
      tile.store(0, std::memory_order_relaxed);
    }
  }
}

glm::ivec2 ShadowBuffer::Place::neighbour(int i) const
{
  const glm::ivec2 texel = this->nearest();
  const int dx = this->x - texel.x < 0.5 ? -1 : 1;
  const int dy = this->y - texel.y < 0.5 ? -1 : 1;
  return texel + glm::ivec2(i & 1 ? dx : 0, i & 2 ? dy : 0);
}

bool ShadowBuffer::lookUp(const glm::dvec3& position, Place& place) const
{
  for (const auto& candidate : this->Faces)
  {
    const TexelPlace at = texelPlace(candidate->view, candidate->worldToClip, position);
    if (at.inside > 0.0)
    {
      place = { candidate.get(), at.x, at.y, at.t };
      return candidate->seesCasters;
    }
  }
  return false;
}

template <class Body>
void ShadowBuffer::tilesAround(const Place& place, Body&& body)
{
  const View& view = place.face->view;
  const int tilesAcross = (view.width + 7) / 8;
  const int x0 = std::max(static_cast<int>(place.x - 0.5), 0) >> 3;
  const int y0 = std::max(static_cast<int>(place.y - 0.5), 0) >> 3;
  const int x1 = std::min(static_cast<int>(place.x + 0.5), view.width - 1) >> 3;
  const int y1 = std::min(static_cast<int>(place.y + 0.5), view.height - 1) >> 3;
  for (int y = y0; y <= y1; ++y)
  {
    for (int x = x0; x <= x1; ++x)
    {
      body(static_cast<std::size_t>(y) * tilesAcross + x);
    }
  }
}

void ShadowBuffer::markPlace(Face& face, const Place& place, std::size_t& last)
{
  tilesAround(place,
    [&](std::size_t tile)
    {
      if (tile != last && !face.wanted[tile].load(std::memory_order_relaxed))
      {
        face.wanted[tile].store(1, std::memory_order_relaxed);
      }
      last = tile;
    });
}

bool ShadowBuffer::knows(const glm::dvec3& position) const
{
  bool known = true;
  Place place;
  if (this->lookUp(position, place))
  {
    tilesAround(place,
      [&](std::size_t tile)
      { known = known && place.face->wanted[tile].load(std::memory_order_relaxed); });
  }
  return known;
}

void ShadowBuffer::mark(const TilePoints& points)
{
  std::size_t last = ~std::size_t(0);
  if (this->Faces.size() == 1)
  {
    Face& face = *this->Faces.front();
    if (!face.seesCasters)
    {
      return;
    }
    TexelPlaces places;
    lookUpTexels(face.view, face.worldToClip, points, 0, points.count, places);
    for (int i = 0; i < points.count; ++i)
    {
      if (places.inside[i] > 0.0)
      {
        markPlace(face, { &face, places.x[i], places.y[i], places.t[i] }, last);
      }
    }
    return;
  }
  const Face* lastFace = nullptr;
  for (int i = 0; i < points.count; ++i)
  {
    Place place;
    if (this->lookUp(points.position(i), place))
    {
      last = place.face == lastFace ? last : ~std::size_t(0);
      lastFace = place.face;
      markPlace(const_cast<Face&>(*place.face), place, last);
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
    std::vector<std::uint8_t> wanted(face->wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i)
    {
      wanted[i] = face->wanted[i].load(std::memory_order_relaxed);
    }
    face->layers.trace(parallelFor, wanted.data());
    if (face->layers.changed())
    {
      face->copied.reset();
    }
  }
}

void ShadowBuffer::merge(Processes& processes, std::size_t first)
{
  struct Caster
  {
    double voxel, error;
  };
  std::vector<Caster> own;
  for (std::size_t i = 0; i < this->CasterVoxel.size(); ++i)
  {
    own.push_back({ this->CasterVoxel[i], this->CasterError[i] });
  }
  std::vector<Caster> all;
  gatherRecords(processes, own, all);
  this->CasterVoxel.clear();
  this->CasterError.clear();
  for (const Caster& caster : all)
  {
    this->CasterVoxel.push_back(caster.voxel);
    this->CasterError.push_back(caster.error);
  }
  for (auto& face : this->Faces)
  {
    face->shared.merge(processes, face->view, face->layers, first);
    face->seesCasters = face->shared.bytes() > 0;
    face->copied.reset();
  }
}

bool ShadowBuffer::shadows(const SurfacePoint& point, double error) const
{
  Place place;
  return this->lookUp(point.position, place) && this->shadows(place, point, error);
}

bool ShadowBuffer::shadows(const Place& place, const SurfacePoint& point, double error) const
{
  const Answer answer = this->ask(place, place.nearest(), point, error);
  if (answer != Answer::DarkNearby)
  {
    return answer == Answer::Dark;
  }
  return this->agreed(place, point, error);
}

void ShadowBuffer::shadows(const TilePoints& points, int first, int last, double error,
  const std::uint8_t* asked, std::uint8_t* dark) const
{
  const int count = last - first;
  if (this->Faces.size() != 1 || !this->AutomaticBias)
  {
    for (int i = 0; i < count; ++i)
    {
      dark[i] = asked[i] && this->shadows(points.point(first + i), error);
    }
    return;
  }
  std::fill_n(dark, count, std::uint8_t(0));
  const Face& face = *this->Faces.front();
  if (!face.seesCasters)
  {
    return;
  }
  TexelPlaces places;
  lookUpTexels(face.view, face.worldToClip, points, first, last, places);
  TexelTests tests;
  const DepthBuffer& depth = face.layers.depthBuffer();
  const double infinity = std::numeric_limits<double>::infinity();
  bool any = false;
  for (int i = 0; i < count + TilePoints::Step; ++i)
  {
    tests.x[i] = tests.y[i] = tests.bias[i] = tests.error[i] = 0.0;
    tests.occluder[i] = infinity;
    if (i >= count || !asked[i] || !(places.inside[i] > 0.0))
    {
      continue;
    }
    const int x = static_cast<int>(places.x[i]), y = static_cast<int>(places.y[i]);
    std::uint32_t caster;
    if (!face.occluder(depth.at(x, y), caster, tests.occluder[i]))
    {
      continue;
    }
    any = true;
    tests.x[i] = x + 0.5;
    tests.y[i] = y + 0.5;
    tests.bias[i] = this->Bias * this->CasterVoxel[caster];
    tests.error[i] = std::max(this->CasterError[caster], error);
  }
  if (!any)
  {
    return;
  }
  testTexels(face.view, face.edge, points, first, last, places, tests);
  for (int i = 0; i < count; ++i)
  {
    dark[i] = tests.dark[i] > 0.0;
    if (tests.dark[i] == 1.0)
    {
      const Place place{ &face, places.x[i], places.y[i], places.t[i] };
      dark[i] = this->agreed(place, points.point(first + i), error);
    }
  }
}

bool ShadowBuffer::agreed(const Place& place, const SurfacePoint& point, double error) const
{
  int dark = 0;
  for (int i = 1; i < 4; ++i)
  {
    dark += this->ask(place, place.neighbour(i), point, error) != Answer::Lit;
  }
  return dark >= TexelsToAgree;
}

ShadowBuffer::Answer ShadowBuffer::ask(const Place& place, const glm::ivec2& texel,
  const SurfacePoint& point, double error, double span) const
{
  const Face* face = place.face;
  const double t = place.t;
  if (texel.x < 0 || texel.y < 0 || texel.x >= face->view.width || texel.y >= face->view.height)
  {
    return Answer::Lit;
  }
  std::uint32_t caster;
  double occluder;
  if (!face->occluder(face->layers.depthBuffer().at(texel.x, texel.y), caster, occluder))
  {
    return Answer::Lit;
  }
  const double bias = this->Bias * this->CasterVoxel[caster];
  if (!this->AutomaticBias)
  {
    return occluder + bias < t ? Answer::Dark : Answer::Lit;
  }
  if (!mayShadow(t, span * face->edge(t), occluder, bias))
  {
    return Answer::Lit;
  }
  const double answer = shadowTest(face->view, face->edge,
    { point.position, glm::dvec3(point.facet), glm::dvec3(point.normal), t, texel.x + 0.5,
      texel.y + 0.5, span, occluder, bias, std::max(this->CasterError[caster], error) });
  return static_cast<Answer>(static_cast<int>(answer));
}

double ShadowBuffer::texelEdge(const glm::dvec3& position) const
{
  Place place;
  return this->lookUp(position, place) ? place.face->edge(place.t) : 0.0;
}

std::shared_ptr<const std::vector<float>> ShadowBuffer::Face::copyDepth(double base) const
{
  auto copy = std::make_shared<std::vector<float>>(
    static_cast<std::size_t>(this->view.width) * this->view.height,
    std::numeric_limits<float>::infinity());
  const DepthBuffer& depth = this->layers.depthBuffer();
  for (int y = 0; this->seesCasters && y < this->view.height; ++y)
  {
    float* row = copy->data() + static_cast<std::size_t>(y) * this->view.width;
    for (int x = 0; x < this->view.width; ++x)
    {
      std::uint32_t caster;
      double t;
      if (this->occluder(depth.at(x, y), caster, t))
      {
        row[x] = static_cast<float>(t - base);
      }
    }
  }
  return copy;
}

void ShadowBuffer::copyMaps(int light, std::vector<ShadowMap>& maps)
{
  for (const auto& face : this->Faces)
  {
    ShadowMap map;
    map.light = light;
    map.view = face->view;
    map.base = std::max(face->view.tNear, 0.0);
    if (!face->copied)
    {
      face->copied = face->copyDepth(map.base);
    }
    map.depth = face->copied;
    for (double error : this->CasterError)
    {
      map.worldBias = std::max(map.worldBias, error);
    }
    for (double voxel : this->CasterVoxel)
    {
      map.casterVoxel = std::max(map.casterVoxel, voxel);
    }
    maps.push_back(std::move(map));
  }
}

void ShadowBuffer::release()
{
  this->Faces.clear();
}

std::uint64_t ShadowBuffer::rays() const
{
  std::uint64_t sum = 0;
  for (const auto& face : this->Faces)
  {
    sum += face->layers.rays();
  }
  return sum;
}

std::uint64_t ShadowBuffer::retracedLayers() const
{
  std::uint64_t sum = 0;
  for (const auto& face : this->Faces)
  {
    sum += face->layers.retracedLayers();
  }
  return sum;
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
