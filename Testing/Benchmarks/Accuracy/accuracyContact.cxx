// Where a bias shows: acne on a convex body, and how far from its foot a shadow begins.
#include "accuracyExperiments.h"

#include "svoWorldSize.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace accuracy
{
namespace
{
svo::FrameSettings shadowBuffer(bool filter)
{
  svo::FrameSettings settings;
  settings.shadowTechnique = svo::ShadowTechnique::Buffer;
  settings.pixelError = 0.0;
  settings.filterShadows = filter;
  return settings;
}

/// A pixel counts as dark if less than `share` of the light is left.
std::vector<Light> shownLight(
  const svo::Scene& scene, const svo::View& view, const svo::FrameSettings& settings, double share)
{
  Row unused;
  svo::FrameSettings none = settings;
  none.shadowTechnique = svo::ShadowTechnique::None;
  const Picture plain = traced(scene, view, none, 1, unused);
  const Picture shadowed = traced(scene, view, settings, 1, unused);
  std::vector<Light> light = lightOf(shadowed, plain);
  for (std::size_t i = 0; i < light.size(); ++i)
  {
    if (light[i] != Light::Unlit)
    {
      light[i] = shadowed.grey[i] < share * plain.grey[i] ? Light::Dark : Light::Lit;
    }
  }
  return light;
}

/// The leaf geometries, and the default once more with filtered shadows.
struct Variant
{
  svo::LeafGeometry leaves;
  const char* name;
  bool filter;
};
std::vector<Variant> ways()
{
  std::vector<Variant> ways;
  for (const auto& [leaves, name] : LeafGeometries)
  {
    ways.push_back({ leaves, name, false });
  }
  ways.push_back({ svo::LeafGeometry::Automatic, "automatic", true });
  return ways;
}

/// A convex body alone: whatever is dark where n.l > 0.1 shadows itself.
void measureAcne(const Sweep& sweep, Results& results)
{
  Stage stage;
  stage.name = "ellipsoid";
  stage.objects = { { std::make_shared<Shape>(ellipsoid(60, 90)),
    glm::rotate(glm::dmat4(1.0), 0.4, glm::dvec3(0.6, 0.3, 1.0)) } };
  stage.camera.width = stage.camera.height = sweep.size;
  stage.camera.eye = { 0.8, -2.0, 1.3 };
  fillWindow(stage, stage.objects[0]);
  fitClippingPlanes(stage);
  const svo::View view = stage.camera.view();
  OctreeShelf shelf;
  for (const auto& [lightName, light] : lightsAround())
  {
    stage.lights = { light };
    const Reference reference(stage);
    const std::vector<TruePixel> truth = exactPicture(reference, stage, view, true);
    for (const int level : { 8, 10 })
    {
      for (const Variant& way : ways())
      {
        // Of a filtered shadow the faintest counts.
        const std::vector<Light> shown = shownLight(sceneOf(stage, shelf, level, way.leaves), view,
          shadowBuffer(way.filter), way.filter ? 1.0 : 0.5);
        std::size_t dark = 0, lit = 0;
        for (std::size_t i = 0; i < truth.size(); ++i)
        {
          lit += truth[i].lit > 0.1f;
          dark += truth[i].lit > 0.1f && shown[i] == Light::Dark;
        }
        Row row;
        row["experiment"] = "acne";
        row["mesh"] = stage.name;
        row["light"] = lightName;
        row["level"] = level;
        row["leaves"] = way.name;
        row["filterShadows"] = way.filter;
        row["litPixels"] = static_cast<Json::UInt64>(lit);
        row["selfShadowed"] = static_cast<Json::UInt64>(dark);
        results.add(row);
      }
    }
  }
}

constexpr double HalfWall = 5e-5; // a tenth of a voxel thick

/// Distance of a point of the ground from the wall's foot.
double besideWall(const glm::dmat4& toWall, const glm::dvec3& point)
{
  const glm::dvec3 p(toWall * glm::dvec4(point, 1.0));
  return std::hypot(std::max(std::abs(p.x) - 0.5, 0.0), std::max(std::abs(p.y) - HalfWall, 0.0));
}

/// A thin wall on a ground, lit from behind, and seen from so near that a voxel has many pixels.
/// (Of anything thicker than a few voxels the light sees a side that is far from the foot.)
void measureFoot(const Sweep& sweep, Results& results)
{
  const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), 0.35, glm::dvec3(0.0, 0.0, 1.0));
  Stage stage;
  stage.name = "wall";
  stage.objects = {
    { std::make_shared<Shape>(box({ -0.5, -HalfWall, 0.0 }, { 0.5, HalfWall, 0.4 })), turned },
    { std::make_shared<Shape>(ground(1.5)), glm::dmat4(1.0) }
  };
  stage.camera.width = stage.camera.height = sweep.size;
  stage.camera.focus = glm::dvec3(turned * glm::dvec4(0.0, -HalfWall, 0.0, 1.0));
  stage.camera.eye = stage.camera.focus + glm::dvec3(turned * glm::dvec4(0.02, -0.1, 0.12, 0.0));
  stage.camera.near = 0.05;
  stage.camera.far = 1.0;
  const svo::View view = stage.camera.view();
  OctreeShelf shelf;
  for (auto [lightName, light] : lightsAround())
  {
    light.position.y = std::abs(light.position.y); // behind the wall
    light.direction.y = -std::abs(light.direction.y);
    stage.lights = { light };
    const Reference reference(stage);
    const std::vector<TruePixel> truth = exactPicture(reference, stage, view, true);
    for (const Variant& way : ways())
    {
      const svo::Scene scene = sceneOf(stage, shelf, 10, way.leaves);
      const double voxel = svo::worldVoxel(scene.instances[0]);
      // Of filtered light a twentieth does.
      const std::vector<Light> shown =
        shownLight(scene, view, shadowBuffer(way.filter), way.filter ? 0.05 : 0.5);
      double gap = 0.0;
      std::size_t dark = 0;
      for (std::size_t i = 0; i < truth.size(); ++i)
      {
        if (truth[i].hit.object == 1 && truth[i].dark && shown[i] != Light::Unlit)
        {
          ++dark;
          gap = shown[i] == Light::Lit
            ? std::max(gap, besideWall(glm::inverse(turned), truth[i].hit.point) / voxel)
            : gap;
        }
      }
      Row row;
      row["experiment"] = "contact";
      row["mesh"] = stage.name;
      row["light"] = lightName;
      row["level"] = 10;
      row["leaves"] = way.name;
      row["filterShadows"] = way.filter;
      row["darkPixels"] = static_cast<Json::UInt64>(dark);
      row["gapVoxels"] = gap;
      results.add(row);
    }
  }
}
}

void measureContact(const Sweep& sweep, Results& results)
{
  measureAcne(sweep, results);
  measureFoot(sweep, results);
}
}
