// Shadows: techniques, resolutions, bias rules, levels and leaf geometries under each kind of
// light, with VTK's shadow maps on the same axes.
#include "accuracyExperiments.h"
#include "accuracyImages.h"
#include "accuracyWindow.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace accuracy
{
namespace
{
struct BiasRule
{
  const char* name;
  bool automatic;
  double voxels;
};
constexpr BiasRule BiasRules[] = { { "automatic", true, 0.0 }, { "none", false, 0.0 },
  { "1 voxel", false, 1.0 }, { "2 voxels", false, 2.0 }, { "4 voxels", false, 4.0 } };

svo::FrameSettings settingsOf(svo::ShadowTechnique technique, int resolution, const BiasRule& bias)
{
  svo::FrameSettings settings;
  settings.shadowTechnique = technique;
  settings.shadowResolution = resolution;
  settings.automaticBias = bias.automatic;
  settings.bias = bias.voxels;
  return settings;
}

/// One light's part of the experiment.
class ShadowRun
{
public:
  ShadowRun(const Sweep& sweep, const Stage& stage, const std::string& light, OctreeShelf& shelf,
    Results& results)
    : Of(sweep)
    , On(stage)
    , LightName(light)
    , Shelf(shelf)
    , Out(results)
    , View(stage.camera.view())
    , Exact(stage)
    , Truth(exactPicture(Exact, stage, View, true))
    , TrueLight(lightOf(Truth))
  {
  }

  void tracer()
  {
    constexpr auto Buffer = svo::ShadowTechnique::Buffer;
    const auto automatic = svo::LeafGeometry::Automatic;
    this->prepare(10, automatic, "automatic");
    this->measure(svo::ShadowTechnique::Rays, 0, BiasRules[0]);
    for (const int resolution : this->Of.resolutions)
    {
      for (const BiasRule& bias : BiasRules)
      {
        if (bias.automatic || resolution == 2048)
        {
          this->measure(Buffer, resolution, bias);
        }
      }
    }
    for (const auto& [leaves, name] : LeafGeometries)
    {
      if (leaves != automatic)
      {
        this->prepare(10, leaves, name);
        this->measure(svo::ShadowTechnique::Rays, 0, BiasRules[0]);
        this->measure(Buffer, 2048, BiasRules[0]);
      }
    }
    for (const int level : this->Of.shadowLevels)
    {
      if (level != 10)
      {
        this->prepare(level, automatic, "automatic");
        this->measure(svo::ShadowTechnique::Rays, 0, BiasRules[0]);
        this->measure(Buffer, 2048, BiasRules[0]);
      }
    }
  }

  void rasterizer()
  {
    Window window(this->On);
    Row row = this->newRow("vtkRasterizer");
    window.useRasterizer();
    const Picture plain = window.draw(this->Of.repeat, row);
    const double voxel = std::exp2(-10.0);
    measureDepth(plain, this->Truth, this->View, voxel, row);
    measureSilhouette(plain, this->Truth, this->Exact, this->View, row);
    this->Out.add(row);
    if (this->On.lights[0].kind != svo::Light::Kind::Point)
    {
      for (const int resolution : this->Of.resolutions)
      {
        row = this->newRow("vtkShadowMapPass");
        row["resolution"] = resolution;
        window.useShadowMapPass(resolution);
        const Picture shadowed = window.draw(this->Of.repeat, row);
        this->judge(lightOf(shadowed, plain), shadowed, row, "vtkShadowMapPass", resolution);
      }
    }
    row = this->newRow("vtkSVORenderPass");
    row["level"] = 10;
    row["resolution"] = 2048;
    window.useOctrees(10);
    const Picture shadowed = window.draw(this->Of.repeat, row);
    this->judge(lightOf(shadowed, plain), shadowed, row, "vtkSVORenderPass", 0);
  }

private:
  Row newRow(const char* method) const
  {
    Row row;
    row["experiment"] = "shadows";
    row["mesh"] = this->On.name;
    row["light"] = this->LightName;
    row["method"] = method;
    return row;
  }

  void prepare(int level, svo::LeafGeometry leaves, const char* name)
  {
    this->Level = level;
    this->Leaves = name;
    this->Now = sceneOf(this->On, this->Shelf, level, leaves);
    Row row;
    this->Plain = traced(
      this->Now, this->View, settingsOf(svo::ShadowTechnique::None, 0, BiasRules[0]), 1, row);
  }

  void measure(svo::ShadowTechnique technique, int resolution, const BiasRule& bias)
  {
    const bool rays = technique == svo::ShadowTechnique::Rays;
    Row row = this->newRow("svo");
    row["level"] = this->Level;
    row["leaves"] = this->Leaves;
    row["technique"] = rays ? "rays" : "buffer";
    if (!rays)
    {
      row["resolution"] = resolution;
      row["bias"] = bias.name;
    }
    const Picture shadowed =
      traced(this->Now, this->View, settingsOf(technique, resolution, bias), this->Of.repeat, row);
    const std::vector<Light> shown = lightOf(shadowed, this->Plain);
    if (rays)
    {
      this->RaysOnOctree = shown;
    }
    else
    {
      measureShadow(shown, this->RaysOnOctree, this->Truth, shadowed, this->View.width, "map", row);
    }
    const bool picture = this->Level == 10 && resolution == 2048 &&
      this->Leaves == std::string("automatic") && (bias.automatic || bias.voxels == 0.0);
    this->judge(shown, shadowed, row, std::string("svo-") + bias.name, picture ? resolution : 0);
  }

  /// Against the mesh; with a picture of what is wrong where `imageOf` is 2048.
  void judge(const std::vector<Light>& shown, const Picture& picture, Row& row,
    const std::string& image, int imageOf)
  {
    measureShadow(shown, this->TrueLight, this->Truth, picture, this->View.width, "mesh", row);
    this->Out.add(row);
    if (!this->Of.images.empty() && imageOf == 2048)
    {
      writeShadowDifference(shown, this->TrueLight, this->Truth, this->View.width,
        this->Of.images + "/shadow-" + this->On.name + "-" + this->LightName + "-" + image +
          ".png");
    }
  }

  const Sweep& Of;
  const Stage& On;
  std::string LightName;
  OctreeShelf& Shelf;
  Results& Out;
  svo::View View;
  Reference Exact;
  std::vector<TruePixel> Truth;
  std::vector<Light> TrueLight;

  int Level = 10;
  std::string Leaves;
  svo::Scene Now;
  Picture Plain;
  std::vector<Light> RaysOnOctree;
};
}

std::vector<std::pair<std::string, svo::Light>> lightsAround()
{
  using Kind = svo::Light::Kind;
  const glm::dvec3 centre(0.0, 0.0, 0.3);
  const auto light = [&](Kind kind, const glm::dvec3& position)
  {
    svo::Light l;
    l.kind = kind;
    l.position = position;
    l.direction = glm::normalize(centre - position);
    l.exponent = 0.0;
    l.id = 1;
    if (kind == Kind::Spot)
    {
      l.coneAngle = 26.0; // the object and its shadow
    }
    return l;
  };
  const glm::dvec3 far(1.3, -1.6, 2.2);
  return { { "directional", light(Kind::Directional, far) }, { "spot", light(Kind::Spot, far) },
    { "point", light(Kind::Point, far) },
    { "near point", light(Kind::Point, { 0.35, -0.45, 0.95 }) } };
}

Stage groundStage(const std::shared_ptr<const Shape>& shape, int size)
{
  Stage stage;
  stage.name = shape->mesh.name;
  stage.objects = { { shape, glm::dmat4(1.0) },
    { std::make_shared<Shape>(ground(1.5)), glm::dmat4(1.0) } };
  stage.camera.width = stage.camera.height = size;
  stage.camera.eye = { 0.8, -2.0, 1.3 };
  fillWindow(stage, stage.objects[0]);
  stage.camera.eye += 0.25 * (stage.camera.eye - stage.camera.focus);
  fitClippingPlanes(stage);
  return stage;
}

void measureShadows(const Sweep& sweep, Results& results)
{
  for (const auto& shape : sweep.shapes)
  {
    Stage stage = groundStage(shape, sweep.size);
    OctreeShelf shelf;
    for (const auto& [name, light] : lightsAround())
    {
      stage.lights = { light };
      ShadowRun run(sweep, stage, name, shelf, results);
      run.tracer();
      run.rasterizer();
    }
  }
}
}
