// The paper's scenes: what a frame costs and how wrong it is, for each way of drawing it.
#include "accuracyExperiments.h"
#include "accuracyWindow.h"

#include "scenes.h"

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>

#include <map>
#include <stdexcept>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

namespace accuracy
{
namespace
{
glm::dvec3 vectorOf(const double* v)
{
  return { v[0], v[1], v[2] };
}

/// Objects, camera and light of a scene as they stand. Shapes are kept by mesh.
Stage stageOf(paper::Scene& scene, std::map<vtkDataSet*, std::shared_ptr<const Shape>>& shapes)
{
  Stage stage;
  stage.name = scene.experiment().name;
  vtkActorCollection* actors = scene.renderer()->GetActors();
  actors->InitTraversal();
  while (vtkActor* actor = actors->GetNextActor())
  {
    vtkDataSet* data = actor->GetMapper()->GetInput();
    std::shared_ptr<const Shape>& shape = shapes[data];
    if (!shape)
    {
      shape = std::make_shared<Shape>(fromPolyData(vtkPolyData::SafeDownCast(data), stage.name));
    }
    stage.objects.push_back(
      { shape, glm::transpose(glm::make_mat4(actor->GetMatrix()->GetData())) });
  }
  stage.subject = 1; // the ground comes first
  vtkCamera* camera = scene.renderer()->GetActiveCamera();
  stage.camera.eye = vectorOf(camera->GetPosition());
  stage.camera.focus = vectorOf(camera->GetFocalPoint());
  stage.camera.angle = camera->GetViewAngle();
  return stage;
}

svo::Light lightOf(paper::Scene& scene, paper::LightKind kind)
{
  scene.setLight(kind);
  vtkLight* source = vtkLight::SafeDownCast(scene.renderer()->GetLights()->GetItemAsObject(0));
  svo::Light light;
  light.kind = kind == paper::LightKind::Point ? svo::Light::Kind::Point : svo::Light::Kind::Spot;
  light.position = vectorOf(source->GetPosition());
  light.direction = glm::normalize(vectorOf(source->GetFocalPoint()) - light.position);
  light.coneAngle = source->GetConeAngle();
  light.exponent = 0.0;
  light.id = 1;
  return light;
}

struct Setting
{
  const char* name;
  int level;
  svo::LeafGeometry leaves;
  svo::ShadowTechnique technique;
  int resolution;
  double pixelError;
};

std::vector<Setting> settings()
{
  using Leaf = svo::LeafGeometry;
  using Technique = svo::ShadowTechnique;
  return { { "defaults", 10, Leaf::Automatic, Technique::Buffer, 2048, 1.0 },
    { "level 8", 8, Leaf::Automatic, Technique::Buffer, 2048, 1.0 },
    { "level 9", 9, Leaf::Automatic, Technique::Buffer, 2048, 1.0 },
    { "level 11", 11, Leaf::Automatic, Technique::Buffer, 2048, 1.0 },
    { "voxel leaves", 10, Leaf::Voxel, Technique::Buffer, 2048, 1.0 },
    { "triangle leaves", 10, Leaf::Triangle, Technique::Buffer, 2048, 1.0 },
    { "full depth", 10, Leaf::Automatic, Technique::Buffer, 2048, 0.0 },
    { "pixel error 2", 10, Leaf::Automatic, Technique::Buffer, 2048, 2.0 },
    { "pixel error 4", 10, Leaf::Automatic, Technique::Buffer, 2048, 4.0 },
    { "512 texels", 10, Leaf::Automatic, Technique::Buffer, 512, 1.0 },
    { "1024 texels", 10, Leaf::Automatic, Technique::Buffer, 1024, 1.0 },
    { "4096 texels", 10, Leaf::Automatic, Technique::Buffer, 4096, 1.0 },
    { "shadow rays", 10, Leaf::Automatic, Technique::Rays, 0, 1.0 },
    { "voxel leaves, level 8, 512 texels", 8, Leaf::Voxel, Technique::Buffer, 512, 1.0 },
    { "triangle leaves, full depth, rays", 10, Leaf::Triangle, Technique::Rays, 0, 0.0 } };
}

/// One scene in each way.
class PaperRun
{
public:
  PaperRun(const Sweep& sweep, const Stage& stage, Results& results)
    : Of(sweep)
    , On(stage)
    , Out(results)
    , View(stage.camera.view())
    , Exact(stage)
    , Truth(exactPicture(Exact, stage, View, true))
    , TrueLight(lightOf(Truth))
  {
  }

  void tracer(OctreeShelf& shelf, const Setting& setting)
  {
    const svo::Scene scene = sceneOf(this->On, shelf, setting.level, setting.leaves);
    svo::FrameSettings frame;
    frame.shadowTechnique = svo::ShadowTechnique::None;
    frame.pixelError = setting.pixelError;
    Row row = this->newRow(setting.name);
    const Picture plain = traced(scene, this->View, frame, 1, row);
    frame.shadowTechnique = setting.technique;
    frame.shadowResolution = setting.resolution;
    const Picture shadowed = traced(scene, this->View, frame, this->Of.repeat, row);
    row["level"] = setting.level;
    double build = 0.0, memory = 0.0;
    std::map<const Shape*, int> seen;
    for (const Object& object : this->On.objects)
    {
      if (!seen[object.shape.get()]++)
      {
        const OctreeShelf::Entry& entry = shelf.get(*object.shape, setting.level);
        build += 1e3 * entry.buildSeconds;
        memory += static_cast<double>(entry.octree.bytes()) / 1024.0;
      }
    }
    row["buildMs"] = build;
    row["octreeKiB"] = memory;
    this->judge(shadowed, plain, row);
  }

  void passes(bool spot)
  {
    Window window(this->On);
    Row row = this->newRow("vtkRasterizer");
    window.useRasterizer();
    const Picture plain = window.draw(this->Of.repeat, row);
    this->judge(plain, plain, row);
    if (spot)
    {
      for (const int resolution : { 1024, 2048, 4096 })
      {
        row = this->newRow("vtkShadowMapPass");
        row["resolution"] = resolution;
        window.useShadowMapPass(resolution);
        this->judge(window.draw(this->Of.repeat, row), plain, row);
      }
    }
    row = this->newRow("vtkSVORenderPass");
    window.useOctrees(10);
    this->judge(window.draw(this->Of.repeat, row), plain, row);
  }

private:
  Row newRow(const char* method) const
  {
    Row row;
    row["experiment"] = "paper";
    row["mesh"] = this->On.name;
    row["light"] = this->On.lights[0].kind == svo::Light::Kind::Spot ? "spot" : "point";
    row["method"] = method;
    return row;
  }

  void judge(const Picture& shadowed, const Picture& plain, Row& row)
  {
    double scale = 0.0;
    const Object& subject = this->On.objects[this->On.subject];
    for (int i = 0; i < 3; ++i)
    {
      scale = std::max(scale, glm::length(glm::dvec3(subject.toWorld[i])));
    }
    // In thousandths of an object's size: nearly a voxel of level 10.
    measureDepth(shadowed, this->Truth, this->View, 1e-3 * scale, row);
    measureSilhouette(shadowed, this->Truth, this->Exact, this->View, row);
    measureShadow(lightOf(shadowed, plain), this->TrueLight, this->Truth, shadowed,
      this->View.width, "mesh", row);
    this->Out.add(row);
  }

  const Sweep& Of;
  const Stage& On;
  Results& Out;
  svo::View View;
  Reference Exact;
  std::vector<TruePixel> Truth;
  std::vector<Light> TrueLight;
};
}

void measurePaperScenes(const Sweep& sweep, Results& results)
{
  paper::Meshes meshes;
  std::string error;
  if (sweep.fileOfB.empty())
  {
    meshes = paper::standInMeshes();
  }
  else if (!paper::readMeshes(sweep.fileOfA, sweep.fileOfB, meshes, error))
  {
    throw std::runtime_error(error);
  }
  meshes.b.resize(1);
  paper::Objects objects;
  if (!paper::buildOctrees(
        meshes, 1, [](double) {}, objects, error))
  {
    throw std::runtime_error(error);
  }
  std::map<vtkDataSet*, std::shared_ptr<const Shape>> shapes;
  OctreeShelf shelf;
  for (const paper::Experiment& experiment : paper::experiments())
  {
    if (sweep.brief && experiment.name != "paper2")
    {
      continue;
    }
    paper::Scene scene(experiment, objects);
    Stage stage = stageOf(scene, shapes);
    stage.camera.width = sweep.size * 16 / 9 / 8 * 8;
    stage.camera.height = sweep.size;
    stage.camera.near = 0.3;
    stage.camera.far = 25.0;
    for (const auto kind : { paper::LightKind::Point, paper::LightKind::Spot })
    {
      stage.lights = { lightOf(scene, kind) };
      PaperRun run(sweep, stage, results);
      for (const Setting& setting : settings())
      {
        if (!sweep.brief || setting.level == 10)
        {
          run.tracer(shelf, setting);
        }
      }
      run.passes(kind == paper::LightKind::Spot);
    }
  }
}
}
