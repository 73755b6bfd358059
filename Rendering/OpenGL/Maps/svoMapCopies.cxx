#include "svoMapCopies.h"

#include "svoLeafError.h"
#include "svoLocalView.h"
#include "svoTranslucentGroups.h"

#include <algorithm>
#include <cstdint>

#include <glm/mat4x4.hpp>

namespace svo
{
namespace
{
MapCopy::Shape shapeOf(const Instance& instance)
{
  return instance.body->octree.hasPlanes()           ? MapCopy::Planes
    : instance.body->ball && !instance.mappedOpacity ? MapCopy::Ball
                                                     : MapCopy::Triangles;
}

/// Of a caster in a map.
MapCopy::Record recordOf(
  const Instance& instance, const CasterInMemory& caster, const ShadowMap& map)
{
  const View& view = map.view;
  const Octree& octree = instance.body->octree;
  const MapCopy::Shape shape = shapeOf(instance);
  const bool ball = shape == MapCopy::Ball;
  const glm::dmat4 toView =
    view.worldToView * (ball ? instance.localToWorld : cubeToWorld(octree, instance.localToWorld));
  const glm::dmat4 toClip = view.viewToClip * toView;
  MapCopy::Record record{ {}, {}, caster.octree, caster.low, caster.high };
  for (int column = 0; column < 4; ++column)
  {
    const double base = column == 3 ? map.base : 0.0;
    record.rows[0][column] = static_cast<float>(toClip[column][0]);
    record.rows[1][column] = static_cast<float>(toClip[column][1]);
    record.rows[2][column] = static_cast<float>(-toView[column][2] - base);
    record.rows[3][column] = static_cast<float>(toClip[column][3]);
  }
  if (shape != MapCopy::Triangles)
  {
    const WorldToOctree& to = caster.toOctree;
    const auto ofBall = [&](const glm::dvec3& x) { return to.inverse * x; };
    record.source = view.parallel
      ? glm::vec4(ball ? ofBall(view.axis) : to.vector(view.axis), 0.0f)
      : glm::vec4(ball ? ofBall(view.eye - to.translation) : to.point(view.eye) - 1.5, 1.0f);
  }
  return record;
}

/// The error that a test against the map allows for.
double errorOf(const Instance& instance)
{
  const Octree& octree = instance.body->octree;
  const bool cubes = instance.body->leafGeometry == LeafGeometry::Voxel;
  return worldMapError(instance,
    !octree.hasPlanes() ? LeafGeometry::Triangle
      : cubes           ? LeafGeometry::Voxel
                        : LeafGeometry::Plane,
    octree.level());
}
}

std::vector<MapCopy> copiesIn(const Scene& scene, const std::vector<CasterInMemory>& casters,
  const std::vector<LightMaps>& lights, std::vector<ShadowMap>& maps)
{
  std::vector<MapCopy> copies;
  int layers = 0;
  for (std::size_t m = 0; m < maps.size(); ++m)
  {
    ShadowMap& map = maps[m];
    const std::vector<std::uint8_t>& groups = lights[map.light].casters;
    const std::size_t before = copies.size();
    for (const CasterInMemory& caster : casters)
    {
      const Instance& instance = scene.instances[caster.instance];
      const Octree& octree = instance.body->octree;
      if (groups[caster.instance] != OpaqueCasters + map.group)
      {
        continue;
      }
      map.worldBias = std::max(map.worldBias, errorOf(instance));
      map.casterVoxel = std::max(map.casterVoxel, worldVoxel(instance));
      const PixelRect rect = seeOctree(octree, instance.localToWorld, map.view).rect;
      if (!rect.empty())
      {
        copies.push_back({ static_cast<int>(m), shapeOf(instance), octree.id(), caster.instance,
          instance.version, rect, &octree, recordOf(instance, caster, map) });
      }
    }
    map.layer = copies.size() > before ? layers++ : -1;
  }
  std::sort(copies.begin(), copies.end());
  return copies;
}

std::vector<PixelRect> changedParts(
  const std::vector<MapCopy>& before, const std::vector<MapCopy>& now, std::size_t maps)
{
  std::vector<PixelRect> parts(maps);
  const auto add = [&parts](const MapCopy& copy)
  { parts[copy.map] = around(parts[copy.map], copy.rect); };
  auto a = before.begin();
  auto b = now.begin();
  while (a != before.end() || b != now.end())
  {
    const bool gone = b == now.end() || (a != before.end() && *a < *b);
    const bool added = a == before.end() || (b != now.end() && *b < *a);
    if (gone)
    {
      add(*a++);
    }
    else if (added)
    {
      add(*b++);
    }
    else
    {
      if (a->version != b->version || b->version == 0)
      {
        add(*a);
        add(*b);
      }
      ++a;
      ++b;
    }
  }
  return parts;
}
}
