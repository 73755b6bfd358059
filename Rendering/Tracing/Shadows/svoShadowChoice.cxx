#include "svoShadowChoice.h"

#include "svoLeafTraits.h"
#include "svoLocalView.h"
#include "svoTexelPlace.h"
#include "svoVisibleInstances.h"
#include "svoWorldSize.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
/// Of so many tiles with hits one is looked at.
constexpr std::size_t SampledTiles = 16;
constexpr double TilePoints = 64.0;
/// Of the light tiles that are traced for the four texels around a point, on average.
constexpr double MostTexels = 64.0 * (9.0 / 8.0) * (9.0 / 8.0);
/// Triangles that a beam meets one after the other. With more it is divided, and its parts share
/// them; from the most on, rays go alone, each past nearly all of them.
constexpr double FewInBeam = 64.0, MostInBeam = 1024.0;

/// A caster in a map of the light.
struct CasterInMap
{
  PixelRect rect;
  double area;         // of it, texels
  double triangles;    // all that the caster has
  bool walked;         // they are smaller than texels
  bool kept;           // a buffer has its layer
  double looked = 0.0; // texels in it that are looked up
};

struct Map
{
  const View* view;
  glm::dmat4 worldToClip;
  std::vector<CasterInMap> casters;
};

bool casts(const Instance& instance)
{
  return instance.castShadow && instance.body->octree && !instance.body->octree.empty();
}

Map makeMap(const Scene& scene, const View& view, const std::vector<std::uint8_t>& casters,
  const std::vector<std::uint8_t>& kept)
{
  Map map{ &view, view.viewToClip * view.worldToView, {} };
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
  {
    const Instance& instance = scene.instances[i];
    if (casters[i] && casts(instance))
    {
      const LocalView local = makeLocalView(instance.body->octree, instance.localToWorld, view);
      if (!local.rect.empty())
      {
        const PixelRect& r = local.rect;
        map.casters.push_back({ r, static_cast<double>(r.x1 - r.x0) * (r.y1 - r.y0),
          static_cast<double>(instance.body->octree.header().triangleCount),
          !worthTiles(instance, local, view, false), kept[i] != 0 });
      }
    }
  }
  return map;
}

bool contains(const PixelRect& rect, double x, double y)
{
  return x >= rect.x0 && x < rect.x1 && y >= rect.y0 && y < rect.y1;
}

/// Adds what the points of `tiles` tiles look up that are like the one around `position`, where
/// pixels are `pixel` wide in the world.
void lookUp(
  std::vector<Map>& maps, const glm::dvec3& position, double pixel, double tiles, ShadowWork& work)
{
  for (Map& map : maps)
  {
    const TexelPlace at = texelPlace(*map.view, map.worldToClip, position);
    if (at.inside > 0.0)
    {
      const double texel = TexelEdge(*map.view)(at.t);
      const double across = texel > 0.0 ? pixel / texel : 0.0;
      // In a tile of points. Where texels are small each point has light tiles of its own.
      const double texels = TilePoints * std::min(across * across, MostTexels);
      for (CasterInMap& caster : map.casters)
      {
        if (contains(caster.rect, at.x, at.y))
        {
          caster.looked += tiles * texels;
          work.beamPoints += tiles * TilePoints;
          const double triangles =
            std::min({ caster.triangles, caster.triangles * texels / caster.area, MostInBeam });
          work.beamTriangles += tiles * std::min(triangles, FewInBeam);
          work.moreTriangles += tiles * std::max(triangles - FewInBeam, 0.0);
        }
      }
      return;
    }
  }
}
}

ShadowWork shadowWork(const Scene& scene, const View& view, const LayeredView& eye,
  const LightMaps& lightMaps, const std::vector<std::uint8_t>& kept)
{
  assert(kept.size() >= scene.instances.size());
  ShadowWork work;
  std::vector<Map> maps;
  for (const View& map : lightMaps.views)
  {
    maps.push_back(makeMap(scene, map, lightMaps.casters, kept));
  }
  const DepthBuffer& depth = eye.depthBuffer();
  std::size_t hits = 0;
  for (std::size_t tile = 0; tile < depth.tiles(); ++tile)
  {
    if (!depth.hit[tile] || hits++ % SampledTiles != 0)
    {
      continue;
    }
    const std::uint32_t* instances = depth.instance.data() + 64 * tile;
    const auto* first = std::find_if(
      instances, instances + 64, [](std::uint32_t instance) { return instance != NoInstance; });
    const int i = instances[27] != NoInstance ? 27 : static_cast<int>(first - instances); // middle
    if (i < 64 && scene.instances[instances[i]].receiveShadow)
    {
      const int tileX = static_cast<int>(tile) % depth.tilesX;
      const int tileY = static_cast<int>(tile) / depth.tilesX;
      const double x = 8 * tileX + (i & 7) + 0.5, y = 8 * tileY + (i >> 3) + 0.5;
      const double t = eye.base(instances[i]) + depth.t[64 * tile + i];
      work.points += TilePoints * SampledTiles;
      lookUp(maps, view.rayOrigin(x, y) + t * view.rayDirection(x, y), worldPixel(view, t),
        SampledTiles, work);
    }
  }
  for (const Map& map : maps)
  {
    const bool allKept = std::all_of(map.casters.begin(), map.casters.end(),
      [](const CasterInMap& caster) { return caster.kept; });
    (allKept ? work.keptTexels : work.freshTexels) +=
      static_cast<double>(map.view->width) * map.view->height;
    for (const CasterInMap& caster : map.casters)
    {
      const double texels = caster.kept ? 0.0 : std::min(caster.looked, caster.area);
      (caster.walked ? work.walkedTexels : work.tracedTexels) += texels;
      work.seenTriangles += caster.walked ? 0.0 : caster.triangles * texels / caster.area;
    }
  }
  return work;
}

// Fitted to the processor time of 222 frames with AVX-512: one and ten objects of 10 000 to 3 000
// 000 triangles, and the paper's scenes, everything retraced, under a point light and under
// ParaView's light kit, 640x360 and 1920x1080, maps of 2048 texels (BenchmarkFrames --experiments
// shadowChoice). Walked texels, of which these frames have few, are taken for what walks take
// elsewhere. Since then all of it got quicker, by much the same: both sums are too large, but of
// frames that they were and were not fitted to they choose the cheaper technique nine times in ten,
// and no fit anew chooses better on the latter (Documentation/Measurements.md, Automatic shadows).
double ShadowWork::bufferTime() const
{
  return 1e-3 *
    (6.8 * this->points + 3.9 * this->freshTexels + 0.8 * this->keptTexels +
      1.4 * this->tracedTexels + 40.0 * this->walkedTexels + 89.0 * this->seenTriangles);
}

double ShadowWork::rayTime() const
{
  return 1e-3 *
    (14.0 * this->points + 63.0 * this->beamPoints + 350.0 * this->beamTriangles +
      36.0 * this->moreTriangles);
}

namespace
{
/// True if rays meet the very triangles of everything that casts.
bool raysAreExact(const Scene& scene, const LayeredView& eye)
{
  return std::all_of(scene.instances.begin(), scene.instances.end(),
    [&](const Instance& instance)
    {
      if (!casts(instance))
      {
        // Without an octree yet, or only one for lights.
        return !instance.castShadow || !instance.body->casterOctree;
      }
      const auto index = static_cast<std::uint32_t>(&instance - scene.instances.data());
      const LeafTraits traits = traitsOf(eye.leafGeometry(index));
      return traits.exact() && instance.body->octree.surface() &&
        instance.body->octree.longestList() <= traits.longestExact;
    });
}
}

bool mayTakeRays(const Scene& scene, const FrameSettings& settings, const LayeredView& eye)
{
  // Buffers are there anyway for rasterised receivers. Filters smooth what rays cannot, and who
  // sets a bias has buffers in mind.
  return !settings.handsOutMaps() && !settings.filterShadows && settings.automaticBias &&
    settings.bias == 0.0 && raysAreExact(scene, eye);
}
}
