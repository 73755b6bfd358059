// Few facets with smooth normals, where light grazes them: they should show no shadow of their own,
// and a wall right above them should keep the light out.
#include "accuracyExperiments.h"

#include <glm/gtc/matrix_transform.hpp>

namespace accuracy
{
namespace
{
/// The unit normals of ellipsoid(), three floats a point.
std::vector<float> ellipsoidNormals(const Mesh& mesh)
{
  std::vector<float> normals;
  for (const glm::dvec3& x : mesh.points)
  {
    const glm::dvec3 n =
      glm::normalize((x - glm::dvec3(0.0, 0.0, 0.3)) / glm::dvec3(0.25, 0.16, 0.09));
    for (int i = 0; i < 3; ++i)
    {
      normals.push_back(static_cast<float>(n[i]));
    }
  }
  return normals;
}

/// Ways to find shadows.
struct Variant
{
  svo::LeafGeometry leaves;
  const char* name;
  bool rays;
  bool filter;
};
std::vector<Variant> ways()
{
  std::vector<Variant> ways;
  for (const auto& [leaves, name] : LeafGeometries)
  {
    ways.push_back({ leaves, name, false, false });
    ways.push_back({ leaves, name, true, false });
  }
  ways.push_back({ svo::LeafGeometry::Automatic, "automatic", false, true });
  return ways;
}
}

void measureTerminator(const Sweep& sweep, Results& results)
{
  for (const unsigned facets : { 8u, 24u })
  {
    const auto shape = std::make_shared<Shape>(ellipsoid(facets, facets));
    const std::vector<float> normals = ellipsoidNormals(shape->mesh);
    const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), 0.4, glm::dvec3(0.6, 0.3, 1.0));
    Stage stage;
    stage.name = "ellipsoid of " + std::to_string(facets);
    // The wall: the same facets, larger by a fiftieth, around the body's middle.
    const glm::dvec3 middle(0.0, 0.0, 0.3);
    stage.objects = { { shape, turned },
      { shape,
        turned * glm::translate(glm::dmat4(1.0), middle) *
          glm::scale(glm::dmat4(1.0), glm::dvec3(1.02)) *
          glm::translate(glm::dmat4(1.0), -middle) } };
    stage.camera.width = stage.camera.height = sweep.size;
    stage.camera.eye = { 0.8, -2.0, 1.3 };
    fillWindow(stage, stage.objects[1]);
    fitClippingPlanes(stage);
    const svo::View view = stage.camera.view();
    OctreeShelf shelf;
    for (const auto& [lightName, light] : lightsAround())
    {
      stage.lights = { light };
      for (const Variant& way : ways())
      {
        svo::Scene scene = sceneOf(stage, shelf, 10, way.leaves);
        for (svo::Instance& instance : scene.instances)
        {
          instance.material.flat = false;
          instance.body.own().attributes.normals = normals.data();
          instance.body.own().attributes.normalAssociation = svo::Association::Point;
        }
        scene.instances[1].visible = false;
        svo::FrameSettings settings;
        settings.shadowTechnique =
          way.rays ? svo::ShadowTechnique::Rays : svo::ShadowTechnique::Buffer;
        settings.filterShadows = way.filter;
        settings.pixelError = 0.0;
        svo::FrameSettings none = settings;
        none.shadowTechnique = svo::ShadowTechnique::None;
        Row unused;
        const Picture plain = traced(scene, view, none, 1, unused);
        const Picture walled = traced(scene, view, settings, 1, unused);
        scene.instances[1].castShadow = false;
        const Picture alone = traced(scene, view, settings, 1, unused);
        std::size_t lit = 0, toothed = 0, leaks = 0;
        for (std::size_t i = 0; i < plain.grey.size(); ++i)
        {
          lit += plain.grey[i] > 0.0;
          toothed += alone.grey[i] < plain.grey[i];
          leaks += walled.grey[i] > 0.0;
        }
        Row row;
        row["experiment"] = "terminator";
        row["mesh"] = stage.name;
        row["light"] = lightName;
        row["level"] = 10;
        row["leaves"] = way.name;
        row["technique"] = way.rays ? "rays" : "buffer";
        row["filterShadows"] = way.filter;
        row["litPixels"] = static_cast<Json::UInt64>(lit);
        row["toothed"] = static_cast<Json::UInt64>(toothed);
        row["throughWall"] = static_cast<double>(leaks) / static_cast<double>(lit);
        results.add(row);
      }
    }
  }
}
}
