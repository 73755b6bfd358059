#include "svoNeededLevels.h"

#include "svoLeafGeometry.h"
#include "svoLightDetail.h"
#include "svoLocalView.h"
#include "svoWorldSize.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace svo
{
namespace
{
/// Voxels are built this much smaller than they may appear: an octree's cube is a little wider than
/// the mesh's box, and lights are fitted anew to octrees once they are there.
constexpr double HeadRoom = 7.0 / 8.0;

/// Beyond this, world units, nothing can be said of what is seen.
constexpr double LargestEdge = 1e140;

/// The level that is built where `level` would do. Where triangles are exact, no deeper than it
/// takes to tell them apart.
int builtLevel(int level, const Instance& instance, bool exact)
{
  const int coarsest = coarsestLevel(instance.body->box, instance.body->triangles);
  const int deepest = exact && instance.body->detailLevel > 0
    ? std::min(instance.body->deepestLevel, std::max(instance.body->detailLevel, coarsest))
    : instance.body->deepestLevel;
  return std::min(std::max(level, coarsest), deepest);
}

/// Largest octree level that the rays of a view stop at; 0 if the view does not see the instance.
int levelFor(const Instance& instance, const View& view, double pixelError)
{
  assert(instance.body->box.known());
  const glm::dvec3 size = instance.body->box.high - instance.body->box.low;
  const double edge = std::max({ size.x, size.y, size.z }) * (1.0 + 1.0 / 64.0);
  const double scale = worldScale(instance.localToWorld);
  if (!(scale * edge < LargestEdge))
  {
    return instance.body->deepestLevel;
  }
  const glm::dvec3 low = 0.5 * (instance.body->box.low + instance.body->box.high) - 0.5 * edge;
  const SeenCube seen = seeCube(low, edge, instance.localToWorld, view);
  if (seen.rect.empty())
  {
    return 0;
  }
  const double allowed = HeadRoom * pixelError * worldPixel(view, seen.nearest);
  if (!(allowed > 0.0))
  {
    return instance.body->deepestLevel;
  }
  int level = 1;
  while (level < instance.body->deepestLevel && std::ldexp(scale * edge, -level) > allowed)
  {
    ++level;
  }
  return level;
}
}

int coarsestLevel(const Box& box, std::size_t triangles)
{
  constexpr double Coarsest = 4.0; // smaller ones take no less time to build
  const glm::dvec3 size = box.high - box.low;
  const double edge = std::max({ size.x, size.y, size.z });
  if (!(edge > 0.0) || !std::isfinite(edge))
  {
    return static_cast<int>(Coarsest);
  }
  // In edges, so that no size is too large or too small.
  const glm::dvec3 sides = size / edge;
  const double area = 2.0 * (sides.x * sides.y + sides.y * sides.z + sides.z * sides.x);
  constexpr double TrianglesOfBrick = 8.0;
  constexpr double trianglesOfVoxel = TrianglesOfBrick / 16.0; // a brick's face has 16
  const double voxels2 = static_cast<double>(triangles) / (trianglesOfVoxel * std::max(area, 1e-6));
  const double level = std::ceil(0.5 * std::log2(std::max(voxels2, 1.0)));
  return static_cast<int>(std::clamp(level, Coarsest, static_cast<double>(MaximumLevel)));
}

std::vector<NeededLevels> neededLevels(
  const Scene& scene, const View& eye, const FrameSettings& settings)
{
  std::vector<NeededLevels> needed(scene.instances.size());
  const auto errorOf = [&](const Instance& instance)
  { return instance.pixelError >= 0.0 ? instance.pixelError : settings.pixelError; };
  const std::vector<Outline> outlines = outlinesOf(scene);
  const bool casting = std::any_of(
    scene.lights.begin(), scene.lights.end(), [](const Light& light) { return light.castShadow; });
  const bool sampled = settings.asksHemispheres() ||
    (settings.shadowTechnique != ShadowTechnique::None &&
      std::any_of(scene.lights.begin(), scene.lights.end(),
        [](const Light& light) { return light.castShadow && light.soft(); }));
  std::vector<LightMaps> lights;
  if (settings.shadowTechnique == ShadowTechnique::Buffer)
  {
    lights = mapsOfLights(outlines, scene.lights, settings, eye);
  }
  for (const LightMaps& maps : lights)
  {
    for (const View& view : maps.views)
    {
      for (std::size_t i = 0; i < needed.size(); ++i)
      {
        const Instance& instance = scene.instances[i];
        assert(i < maps.casters.size());
        if (maps.casters[i] && instance.body->box.known())
        {
          needed[i].lights =
            std::max({ needed[i].lights, 1, levelFor(instance, view, errorOf(instance)) });
        }
      }
    }
  }
  for (std::size_t i = 0; i < needed.size(); ++i)
  {
    const Instance& instance = scene.instances[i];
    const int deepest = instance.body->deepestLevel;
    const bool unknown =
      !instance.body->box.known() || (instance.visible && (eye.width <= 0 || eye.height <= 0));
    const bool rays = casting && instance.castShadow && settings.asksCasters();
    // Who asks for no error at all, or gives a bias in voxels, has the voxels' size in mind.
    const bool exact = !rays && errorOf(instance) > 0.0 && settings.bias == 0.0;
    int& seenByLights = needed[i].lights;
    seenByLights = seenByLights > 0 ? builtLevel(seenByLights, instance, exact) : 0;
    // Samples meet what they begin on: of what VTK draws each triangle.
    const bool met = sampled && instance.castShadow && !instance.visible;
    const int level = unknown || rays || met ? deepest
      : instance.visible                     ? levelFor(instance, eye, errorOf(instance))
                                             : 1;
    needed[i].eye = std::max(builtLevel(level, instance, exact), seenByLights);
  }
  return needed;
}
}
