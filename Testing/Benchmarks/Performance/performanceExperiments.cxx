#include "performanceExperiments.h"

#include "svoBenchmarkMesh.h"

#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkLightKit.h>
#include <vtkLinearSubdivisionFilter.h>
#include <vtkPoints.h>
#include <vtkTriangleMeshPointNormals.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include <glm/trigonometric.hpp>

namespace performance
{
namespace
{
using paper::LightKind;
using paper::Technique;

const paper::Experiment& paperScene(const std::string& name)
{
  for (const paper::Experiment& experiment : paper::experiments())
  {
    if (experiment.name == name)
    {
      return experiment;
    }
  }
  throw std::runtime_error("there is no scene " + name);
}

const Method Point{ "svo, point light", Technique::Octrees, LightKind::Point, {}, "" };
const Method Spot{ "svo", Technique::Octrees, LightKind::Spot, {}, "" };
const Method ShadowMaps{ "vtkShadowMapPass", Technique::ShadowMaps, LightKind::Spot, {}, "" };
const Method Rasterizer{ "vtk, no shadows", Technique::Rasterizer, LightKind::Spot, {}, "" };
const Method Empty{ "vtk, empty frame", Technique::Empty, LightKind::Spot, {}, "" };

std::vector<Method> peers(const Sweep& sweep, const std::vector<Method>& ours)
{
  std::vector<Method> methods = ours;
  if (!sweep.oursOnly)
  {
    methods.insert(methods.end(), { ShadowMaps, Rasterizer });
  }
  return methods;
}

/// A's of size 1 in a square, seen from above one of its corners' sides.
paper::Experiment crowd(int count)
{
  const int edge = static_cast<int>(std::ceil(std::sqrt(count)));
  constexpr double spacing = 0.8; // the ground is 28 wide
  const double half = 0.5 * spacing * edge;
  paper::Experiment experiment{}; // and no B
  experiment.name = "crowd";
  for (int i = 0; i < count; ++i)
  {
    experiment.a.push_back(
      { spacing * (i % edge + 0.5) - half, spacing * (i / edge + 0.5) - half, 37.0 * i, 1.0 });
  }
  experiment.views = { { "above", { 0.6 * half, -1.6 * half - 2.0, 0.9 * half + 0.9 },
    { 0.0, 0.0, 0.35 }, 32.0 } };
  experiment.light[0] = -half;
  experiment.light[1] = -1.5 * half - 1.0;
  experiment.light[2] = 2.0 * half + 2.0;
  return experiment;
}

/// As high as A, on the ground, with hollows and ridges that shade each other.
vtkSmartPointer<vtkPolyData> ball(int triangles)
{
  const svobench::Mesh mesh =
    svobench::bumpySphere(static_cast<unsigned>(std::lround(std::sqrt(triangles / 4.0))));
  vtkNew<vtkPoints> points;
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.points.size()));
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    const glm::dvec3 p = 0.45 * mesh.points[i] + glm::dvec3(0.0, 0.0, 0.5);
    points->SetPoint(static_cast<vtkIdType>(i), p.x, p.y, p.z);
  }
  vtkNew<vtkCellArray> polygons;
  polygons->AllocateEstimate(static_cast<vtkIdType>(mesh.triangles.size()), 3);
  for (const glm::uvec3& t : mesh.triangles)
  {
    const vtkIdType ids[3] = { t.x, t.y, t.z };
    polygons->InsertNextCell(3, ids);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(polygons);
  vtkNew<vtkTriangleMeshPointNormals> normals;
  normals->SetInputData(data);
  normals->Update();
  return normals->GetOutput();
}

/// 1 to `count` lights around the scene, the first where it is.
void addLights(paper::Scene& scene, int count)
{
  for (int i = 1; i < count; ++i)
  {
    auto* first = vtkLight::SafeDownCast(scene.renderer()->GetLights()->GetItemAsObject(0));
    const double* at = first->GetPosition();
    const double angle = glm::radians(360.0 * i / count);
    vtkNew<vtkLight> light;
    light->DeepCopy(first);
    light->SetPosition(std::cos(angle) * at[0] - std::sin(angle) * at[1],
      std::sin(angle) * at[0] + std::cos(angle) * at[1], at[2]);
    scene.renderer()->AddLight(light);
  }
}
}

Experiments::Experiments(const Sweep& sweep, svobench::Results& results)
  : Settings(sweep)
  , Out(results)
{
  this->Window->SetOffScreenRendering(true);
  this->Window->SetMultiSamples(0);
}

Experiments::~Experiments()
{
  this->Window->Finalize();
}

const std::vector<std::pair<std::string, Experiments::Experiment>>& Experiments::all()
{
  static const std::vector<std::pair<std::string, Experiment>> experiments{
    { "scenes", &Experiments::scenes }, { "instructionSets", &Experiments::instructionSets },
    { "refined", &Experiments::refined }, { "shadows", &Experiments::shadows },
    { "lights", &Experiments::lights }, { "lightKit", &Experiments::lightKit },
    { "sizes", &Experiments::sizes }, { "levels", &Experiments::levels },
    { "objects", &Experiments::objects }, { "triangles", &Experiments::triangles },
    { "threads", &Experiments::threads }, { "cores", &Experiments::cores },
    { "openGL", &Experiments::openGL }
  };
  return experiments;
}

std::vector<std::string> Experiments::names()
{
  std::vector<std::string> result;
  for (const auto& experiment : all())
  {
    result.push_back(experiment.first);
  }
  return result;
}

bool Experiments::run(const std::string& name)
{
  const auto found = std::find_if(
    all().begin(), all().end(), [&](const auto& experiment) { return experiment.first == name; });
  if (found == all().end())
  {
    std::cerr << "there is no experiment " << name << "\n";
    return false;
  }
  this->Window->SetSize(this->Settings.size.first, this->Settings.size.second);
  const bool good = (this->*found->second)();
  std::cerr << name << (good ? " is done\n" : " FAILED\n");
  return good;
}

bool Experiments::contest(const Contest& contest)
{
  return performance::run(this->Window, contest, this->Settings.effort, this->Out);
}

const paper::Objects& Experiments::paperObjects()
{
  std::string error;
  if (this->PaperObjects.a.poses.empty() &&
    !paper::buildOctrees(
      this->Settings.meshes, 10, [](double) {}, this->PaperObjects, error))
  {
    throw std::runtime_error(error);
  }
  return this->PaperObjects;
}

paper::Objects Experiments::objectsWith(vtkPolyData* a, int level) const
{
  paper::Meshes meshes;
  meshes.a = a;
  paper::Objects result;
  std::string error;
  if (!paper::buildOctrees(
        meshes, level, [](double) {}, result, error))
  {
    throw std::runtime_error(error);
  }
  return result;
}

bool Experiments::scenes()
{
  bool good = true;
  for (const std::string& name : this->Settings.scenes)
  {
    const paper::Experiment& scene = paperScene(name);
    Contest contest{ &scene, &this->paperObjects(), peers(this->Settings, { Point, Spot }),
      { Situation::Retraced, Situation::All, Situation::One, Situation::Camera,
        Situation::Nothing },
      {}, {} };
    contest.row["experiment"] = "scenes";
    contest.methods.push_back(Empty);
    if (scene.a.size() + (scene.b.size > 0 ? 1 : 0) == 1)
    {
      contest.situations.erase(contest.situations.begin() + 2); // one is all
    }
    good = this->contest(contest) && good;
  }
  return good;
}

bool Experiments::instructionSets()
{
  Contest contest{ &paperScene("paper4"), &this->paperObjects(), {}, { Situation::Retraced }, {},
    {} };
  contest.row["experiment"] = "instructionSets";
  for (const char* name : { "AVX-512", "AVX2", "SSE4", "scalar" })
  {
    contest.methods.push_back(Point);
    contest.methods.back().instructionSet = name;
  }
  return this->contest(contest);
}

bool Experiments::refined()
{
  paper::Experiment scene = paperScene("paper4");
  scene.views.resize(1); // VTK takes seconds for ten million triangles
  bool good = true;
  for (const int subdivisions : { 0, this->Settings.subdivisions })
  {
    vtkNew<vtkLinearSubdivisionFilter> filter; // the same surface, so the same pixels
    filter->SetInputData(this->Settings.meshes.a);
    filter->SetNumberOfSubdivisions(subdivisions);
    filter->Update();
    vtkPolyData* mesh = subdivisions == 0 ? this->Settings.meshes.a.Get() : filter->GetOutput();
    paper::Objects objects = this->objectsWith(mesh, 10);
    objects.b = this->paperObjects().b;
    Contest contest{ &scene, &objects, peers(this->Settings, { Point, Spot }),
      { Situation::Camera, Situation::Retraced }, {}, {} };
    contest.row["experiment"] = "refined";
    contest.row["triangles"] = Json::Int64(mesh->GetNumberOfPolys());
    if (!this->Settings.oursOnly)
    {
      contest.methods.push_back(Point);
      contest.methods.back().name = "svo, point light, shadow rays";
      contest.methods.back().settings = [](vtkSVORenderPass* pass)
      { pass->SetShadowTechniqueToShadowRays(); };
    }
    good = this->contest(contest) && good;
  }
  return good;
}

bool Experiments::shadows()
{
  Contest contest{ &paperScene("paper4"), &this->paperObjects(), {}, { Situation::Retraced }, {},
    {} };
  contest.row["experiment"] = "shadows";
  for (const int resolution : { 0, 512, 1024, 2048, 4096, -1 })
  {
    contest.methods.push_back(Point);
    Method& method = contest.methods.back();
    method.name = resolution == 0 ? "none" : resolution < 0 ? "rays" : std::to_string(resolution);
    method.settings = [resolution](vtkSVORenderPass* pass)
    {
      if (resolution > 0)
      {
        pass->SetShadowBufferResolution(resolution);
      }
      else if (resolution == 0)
      {
        pass->SetShadowTechniqueToNone();
      }
      else
      {
        pass->SetShadowTechniqueToShadowRays();
      }
    };
  }
  return this->contest(contest);
}

bool Experiments::lights()
{
  bool good = true;
  for (int count = 1; count <= this->Settings.lights; ++count)
  {
    Contest contest{ &paperScene("paper4"), &this->paperObjects(), peers(this->Settings, { Spot }),
      { Situation::Retraced }, {}, [count](paper::Scene& scene) { addLights(scene, count); } };
    contest.row["experiment"] = "lights";
    contest.row["lights"] = count;
    good = this->contest(contest) && good;
  }
  return good;
}

bool Experiments::lightKit()
{
  Contest contest{ &paperScene("paper4"), &this->paperObjects(), peers(this->Settings, { Spot }),
    { Situation::Camera, Situation::All, Situation::Nothing }, {},
    [](paper::Scene& scene)
    {
      scene.renderer()->RemoveAllLights();
      vtkNew<vtkLightKit> kit;
      kit->AddLightsToRenderer(scene.renderer());
    } };
  contest.row["experiment"] = "lightKit";
  return this->contest(contest);
}

bool Experiments::sizes()
{
  bool good = true;
  for (const auto& size : this->Settings.sizes)
  {
    this->Window->SetSize(size.first, size.second);
    Contest contest{ &paperScene("paper4"), &this->paperObjects(), peers(this->Settings, { Spot }),
      { Situation::Retraced }, {}, {} };
    contest.row["experiment"] = "sizes";
    contest.methods.push_back(Empty);
    good = this->contest(contest) && good;
  }
  return good;
}

bool Experiments::levels()
{
  // A without an octree: each pass builds the one that it needs.
  paper::Objects objects = this->objectsWith(this->Settings.meshes.a, 6);
  objects.a.poses.front()->SetInputDataObject(this->Settings.meshes.a);
  bool good = true;
  for (const int level : this->Settings.levels)
  {
    Contest contest{ &paperScene("paper1a"), &objects, {}, { Situation::Retraced }, {}, {} };
    contest.row["experiment"] = "levels";
    contest.row["level"] = level;
    const char* names[] = { "voxel", "plane", "triangle", "automatic" };
    for (int leaves = 0; leaves < 4; ++leaves)
    {
      contest.methods.push_back(Point);
      contest.methods.back().name = names[leaves];
      contest.methods.back().settings = [leaves, level](vtkSVORenderPass* pass)
      {
        pass->SetMaximumLevel(level);
        pass->SetLeafGeometry(leaves);
        pass->SetPixelError(0.0); // down to the last level
      };
    }
    good = this->contest(contest) && good;
  }
  return good;
}

bool Experiments::objects()
{
  const paper::Objects shapes = this->objectsWith(this->Settings.meshes.a, 10);
  bool good = true;
  for (const int count : this->Settings.objects)
  {
    const paper::Experiment scene = crowd(count);
    Contest contest{ &scene, &shapes, peers(this->Settings, { Spot }),
      { Situation::Camera, Situation::All }, {}, {} };
    contest.row["experiment"] = "objects";
    contest.row["objects"] = count;
    contest.row["triangles"] = Json::Int64(count * shapes.a.trianglesShown);
    good = this->contest(contest) && good;
  }
  return good;
}

bool Experiments::triangles()
{
  bool good = true;
  for (const int count : this->Settings.triangles)
  {
    const paper::Objects shapes = this->objectsWith(ball(count), 10);
    const paper::Experiment scene = crowd(1);
    Contest contest{ &scene, &shapes, peers(this->Settings, { Spot }),
      { Situation::Camera, Situation::All }, {}, {} };
    contest.row["experiment"] = "triangles";
    contest.row["triangles"] = Json::Int64(shapes.a.trianglesShown);
    contest.row["buildSeconds"] = shapes.a.buildSeconds;
    good = this->contest(contest) && good;
  }
  return good;
}

bool Experiments::openGL()
{
  this->Window->Render();
  std::istringstream lines(this->Window->ReportCapabilities());
  for (std::string line; std::getline(lines, line);)
  {
    if (line.find("OpenGL") == 0)
    {
      std::cerr << line << "\n";
    }
  }
  const auto onOpenGL = [](vtkSVORenderPass* pass)
  {
    pass->SetBackendToOpenGL();
    pass->SetShadowTechniqueToShadowRays();
  };
  const std::vector<Method> ours{ Spot,
    { "svo, shadow rays", Technique::Octrees, LightKind::Spot,
      [](vtkSVORenderPass* pass) { pass->SetShadowTechniqueToShadowRays(); }, "" },
    { "svo, OpenGL, maps", Technique::Octrees, LightKind::Spot,
      [](vtkSVORenderPass* pass) { pass->SetBackendToOpenGL(); }, "", false, false },
    { "svo, OpenGL, rays", Technique::Octrees, LightKind::Spot, onOpenGL, "", false, false } };
  const auto race = [&](const paper::Experiment& scene, const paper::Objects& shapes)
  {
    Contest contest{ &scene, &shapes, peers(this->Settings, ours),
      { Situation::Camera, Situation::All }, {}, {} };
    contest.methods.push_back(Empty);
    contest.row["experiment"] = "openGL";
    contest.row["triangles"] = Json::Int64(shapes.a.trianglesShown);
    return this->contest(contest);
  };
  bool good = race(paperScene("paper4"), this->paperObjects());
  for (const int count : this->Settings.ballsOfTen)
  {
    good = race(crowd(10), this->objectsWith(ball(count), 10)) && good;
  }
  return good;
}

bool Experiments::threads()
{
  Contest contest{ &paperScene("paper4"), &this->paperObjects(), peers(this->Settings, { Point }),
    { Situation::Retraced, Situation::One }, {}, {} };
  const char* threads = std::getenv("VTK_SMP_MAX_THREADS");
  contest.row["experiment"] = "threads";
  contest.row["threads"] =
    threads ? std::atoi(threads) : static_cast<int>(std::thread::hardware_concurrency());
  return this->contest(contest);
}

bool Experiments::cores()
{
  Contest contest{ &paperScene("paper4"), &this->paperObjects(), { Point },
    { Situation::Retraced, Situation::One, Situation::Camera }, {}, {} };
  contest.methods.front().simulatesCores = true;
  contest.row["experiment"] = "cores";
  return this->contest(contest);
}
}
