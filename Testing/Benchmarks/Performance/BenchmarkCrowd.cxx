// What frames with many objects cost: vtkSVORenderPass with shadows beside VTK's rasteriser without
// any and, where asked for, vtkShadowMapPass. The methods take turns, frame by frame, in windows of
// their own. Medians over the frames of processor time and wall time, ms, and of ours the phases.
// Objects of both have to cover the same pixels.
//
//   BenchmarkCrowd [--scene field|plain|small|inside|layers|glyphs] [--objects n,n] [--motion
//   none|orbit|all]
//     [--frames n] [--size 1920x1080] [--maps 1] [--culling 1] [--complexity n] [--triangles n]
//     [--json file] [--pictures prefix]
//
// --culling: beside it the same without the culling of what others hide, and without any, and how
// many objects each step left out, of those that it could have: all that no pixel shows.
//
// field   objects of `triangles` (20 000), four meshes, strewn over a square ground as wide as the
//         view, whatever their number; the eye stands in front of it, a little higher than they
//         are, so that most are hidden or tiny
// plain   the same seen from high above, so that few are
// small   objects of 480 triangles in a grid on a ground
// inside  the same from among them: most lie outside of the view
// layers  100 objects of 20 000 triangles in `complexity` layers behind each other, each of which
//         fills the view but for a tenth
// glyphs  copies of a sphere of 1000 triangles by one vtkGlyph3DMapper, in a grid on a ground;
//         beside it the window with nothing in it
//
// none: nothing moves; orbit: the camera does; all: every object turns and bobs (of copies: the
// points that they are at bob).
#include "performancePass.h"
#include "performanceWindow.h"
#include "svoResults.h"
#include "vtkSVORenderPass.h"

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCamera.h>
#include <vtkFloatArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkHardwareSelector.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>
#include <vtkSuperquadricSource.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace
{
struct Options
{
  std::string scene = "field", motion = "all";
  std::vector<int> objects{ 1000 };
  int frames = 9, size[2] = { 1920, 1080 };
  bool maps = false, culling = false;
  int complexity = 8, triangles = 20000;
};

/// No object looks like it.
constexpr int Background[3] = { 51, 77, 102 };

enum class Look
{
  Empty, // nothing is there to be drawn
  Raster,
  ShadowMaps,
  Traced,
  NotOccluded, // traced, without culling of what others hide
  NotCulled    // without any
};

/// Of about so many triangles and a radius of 1.
vtkSmartPointer<vtkPolyData> meshOf(int kind, int triangles)
{
  const int around = static_cast<int>(std::lround(std::sqrt(triangles)));
  const int along = around / 2 + 2;
  if (kind == 0)
  {
    vtkNew<vtkSphereSource> sphere;
    sphere->SetRadius(1.0);
    sphere->SetThetaResolution(around);
    sphere->SetPhiResolution(along);
    sphere->Update();
    return sphere->GetOutput();
  }
  vtkNew<vtkSuperquadricSource> shape;
  shape->SetToroidal(kind == 3);
  shape->SetThickness(0.5);
  shape->SetSize(1.0);
  shape->SetPhiRoundness(kind == 1 ? 0.4 : 1.5);
  shape->SetThetaRoundness(kind == 2 ? 0.4 : 1.0);
  shape->SetThetaResolution(around);
  shape->SetPhiResolution(along);
  shape->Update();
  return shape->GetOutput();
}

class Method
{
public:
  Method(const std::string& name, Look look, const Options& options, int objects)
    : Name(name)
    , Asked(options)
  {
    this->Window->SetOffScreenRendering(true);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(options.size[0], options.size[1]);
    this->Window->AddRenderer(this->Renderer);
    this->Renderer->SetBackground(
      Background[0] / 255.0, Background[1] / 255.0, Background[2] / 255.0);
    const double half = look == Look::Empty ? this->Half : this->addObjects(objects);
    if (options.scene != "layers" && look != Look::Empty)
    {
      this->addGround(half);
    }
    vtkNew<vtkLight> sun;
    sun->SetPosition(-0.6 * half, -0.9 * half, 1.8 * half);
    sun->SetFocalPoint(0.0, 0.0, 0.0);
    this->Renderer->AddLight(sun);
    this->setLook(look);
    this->aim(0);
  }
  ~Method() { this->Window->Finalize(); }

  /// Frame k.
  void draw(int k)
  {
    if (this->Asked.motion == "orbit")
    {
      this->aim(k);
    }
    else if (this->Asked.motion == "all")
    {
      this->move();
    }
    const performance::Moment start = performance::Moment::now();
    this->Window->Render();
    this->Window->GetPixelData(0, 0, 0, 0, 0, this->Pixel); // waits for it
    const performance::Moment end = performance::Moment::now();
    this->Times["processorMs"].push_back(end.processor - start.processor);
    this->Times["wallMs"].push_back(end.wall - start.wall);
    if (this->Phases)
    {
      for (const auto& phase : this->Phases(start, end))
      {
        this->Times[phase.first].push_back(phase.second);
      }
    }
  }
  /// Of the warming up.
  void forget() { this->Times.clear(); }
  svobench::Row row(int objects) const
  {
    svobench::Row row;
    row["experiment"] = "crowd";
    row["scene"] = this->Asked.scene;
    row["motion"] = this->Asked.motion;
    row["objects"] = objects;
    row["triangles"] = this->Asked.triangles;
    row["complexity"] = this->Asked.scene == "layers" ? this->Asked.complexity : 0;
    row["method"] = this->Name;
    for (const auto& time : this->Times)
    {
      row[time.first] = performance::median(time.second);
    }
    if (this->Pass)
    {
      row["primaryRays"] = static_cast<Json::Int64>(this->Pass->GetNumberOfPrimaryRays());
      row["shadowRays"] = static_cast<Json::Int64>(this->Pass->GetNumberOfShadowRays());
      const auto culled = [&](int step)
      { return static_cast<Json::Int64>(this->Pass->GetNumberOfCulledInstances(step)); };
      row["outside"] = culled(vtkSVORenderPass::CULLED_BY_VIEW);
      row["hidden"] = culled(vtkSVORenderPass::CULLED_BY_OCCLUSION);
      row["casters"] = culled(vtkSVORenderPass::CULLED_CASTERS);
    }
    return row;
  }
  void write(const std::string& path) { performance::writePicture(this->Window, path); }
  /// Pixels that objects cover.
  std::vector<bool> covered()
  {
    const int width = this->Asked.size[0], height = this->Asked.size[1];
    vtkNew<vtkUnsignedCharArray> pixels;
    this->Window->GetPixelData(0, 0, width - 1, height - 1, 0, pixels);
    std::vector<bool> covered;
    for (vtkIdType i = 0; i < pixels->GetNumberOfTuples(); ++i)
    {
      bool differs = false;
      for (int k = 0; k < 3; ++k)
      {
        differs = differs || pixels->GetTypedComponent(i, k) != Background[k];
      }
      covered.push_back(differs);
    }
    return covered;
  }
  /// Of all actors, how many no pixel shows, by exact identities.
  std::size_t unseen()
  {
    vtkNew<vtkHardwareSelector> selector;
    selector->SetRenderer(this->Renderer);
    selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_POINTS);
    const int width = this->Asked.size[0], height = this->Asked.size[1];
    selector->SetArea(0, 0, static_cast<unsigned>(width - 1), static_cast<unsigned>(height - 1));
    std::set<vtkProp*> seen;
    if (selector->CaptureBuffers())
    {
      for (int y = 0; y < height; ++y)
      {
        for (int x = 0; x < width; ++x)
        {
          const unsigned pixel[2] = { static_cast<unsigned>(x), static_cast<unsigned>(y) };
          const auto found = selector->GetPixelInformation(pixel, 0);
          if (found.Valid)
          {
            seen.insert(found.Prop);
          }
        }
      }
      selector->ClearBuffers();
    }
    return static_cast<std::size_t>(this->Renderer->GetActors()->GetNumberOfItems()) - seen.size();
  }
  int tracedActors() const { return this->Pass ? this->Pass->GetNumberOfTracedActors() : 0; }
  const std::string Name;

private:
  vtkActor* add(vtkPolyDataMapper* mapper, std::mt19937& random)
  {
    std::uniform_real_distribution<double> share(0.3, 1.0);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(share(random), share(random), share(random));
    this->Renderer->AddActor(actor);
    this->Actors.push_back(actor);
    return actor;
  }
  /// Returns half of the edge of the square that they stand on.
  double addObjects(int objects)
  {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<vtkSmartPointer<vtkPolyDataMapper>> mappers;
    const bool small = this->Asked.scene == "small" || this->Asked.scene == "inside";
    for (int kind = 0; kind < (small ? 1 : 4); ++kind)
    {
      auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
      mapper->SetInputData(meshOf(kind, small ? 480 : this->Asked.triangles));
      mapper->ScalarVisibilityOff();
      mappers.push_back(mapper);
    }
    const auto mapper = [&](int i) { return mappers[i % mappers.size()].Get(); };
    if (this->Asked.scene == "layers")
    {
      for (int layer = 0; layer < this->Asked.complexity; ++layer)
      {
        for (int i = 0; i < 100; ++i)
        {
          vtkActor* actor = this->add(mapper(i + layer), random);
          actor->SetScale(unit(random) < 0.1 ? 0.01 : 0.95);
          actor->SetPosition(2.0 * (i % 10) - 9.0, 3.0 * layer, 2.0 * (i / 10) - 9.0);
        }
      }
      return 10.0;
    }
    const int side = static_cast<int>(std::ceil(std::sqrt(objects)));
    if (this->Asked.scene == "glyphs")
    {
      this->addCopies(objects, side);
      return 1.5 * side;
    }
    for (int i = 0; i < objects; ++i)
    {
      vtkActor* actor = this->add(mapper(i), random);
      const double jitter = small ? 0.0 : 0.8;
      actor->SetPosition(3.0 * (i % side - 0.5 * (side - 1)) + jitter * (unit(random) - 0.5),
        3.0 * (i / side - 0.5 * (side - 1)) + jitter * (unit(random) - 0.5), 1.2);
      actor->RotateWXYZ(360.0 * unit(random), unit(random), unit(random), 1.0);
    }
    return 1.5 * side;
  }
  void addCopies(int objects, int side)
  {
    vtkNew<vtkPoints> points;
    vtkNew<vtkFloatArray> values;
    for (int i = 0; i < objects; ++i)
    {
      points->InsertNextPoint(
        3.0 * (i % side - 0.5 * (side - 1)), 3.0 * (i / side - 0.5 * (side - 1)), 1.2);
      values->InsertNextValue(static_cast<float>(i % 97) / 96.0f);
    }
    this->Places->SetPoints(points);
    this->Places->GetPointData()->SetScalars(values);
    vtkNew<vtkGlyph3DMapper> mapper;
    mapper->SetInputData(this->Places);
    mapper->SetSourceData(meshOf(0, 1000));
    mapper->ScalingOff();
    mapper->OrientOff();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->Renderer->AddActor(actor);
  }
  void addGround(double half)
  {
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(-half - 2.0, -half - 2.0, 0.0);
    plane->SetPoint1(half + 2.0, -half - 2.0, 0.0);
    plane->SetPoint2(-half - 2.0, half + 2.0, 0.0);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(plane->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    this->Renderer->AddActor(actor);
    this->Half = half;
  }
  void aim(int k)
  {
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    if (this->Asked.scene == "layers")
    {
      camera->SetPosition(0.3 * k, -30.0, 0.0);
      camera->SetFocalPoint(0.0, 0.0, 0.0);
      camera->SetViewUp(0.0, 0.0, 1.0);
      camera->SetViewAngle(30.0);
    }
    else if (this->Asked.scene == "inside")
    {
      const double turn = 0.02 * k + 0.3;
      camera->SetPosition(1.5, 1.5, 4.0);
      camera->SetFocalPoint(1.5 + 20.0 * std::sin(turn), 1.5 + 20.0 * std::cos(turn), 2.0);
      camera->SetViewUp(0.0, 0.0, 1.0);
      camera->SetViewAngle(40.0);
    }
    else if (this->Asked.scene == "field")
    {
      const double turn = 0.005 * k;
      camera->SetPosition(3.0 * std::sin(turn), -this->Half - 8.0, 4.0);
      camera->SetFocalPoint(0.0, 0.0, 0.0);
      camera->SetViewUp(0.0, 0.0, 1.0);
      camera->SetViewAngle(40.0);
    }
    else
    {
      const double turn = 0.02 * k - 0.3, far = 1.9 * this->Half;
      camera->SetPosition(far * std::sin(turn), -far * std::cos(turn), 0.75 * this->Half);
      camera->SetFocalPoint(0.0, -0.1 * this->Half, 0.0);
      camera->SetViewUp(0.0, 0.0, 1.0);
      camera->SetViewAngle(40.0);
    }
    this->Renderer->ResetCameraClippingRange();
  }
  void move()
  {
    for (std::size_t i = 0; i < this->Actors.size(); ++i)
    {
      this->Actors[i]->RotateZ(1.0);
      this->Actors[i]->AddPosition(0.0, 0.0, (this->Moves + i) % 8 < 4 ? 0.02 : -0.02);
    }
    if (vtkPoints* points = this->Places->GetPoints())
    {
      for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
      {
        double x[3];
        points->GetPoint(i, x);
        x[2] += (this->Moves + i) % 8 < 4 ? 0.02 : -0.02;
        points->SetPoint(i, x);
      }
      points->Modified();
      this->Places->Modified();
    }
    ++this->Moves;
  }
  void setLook(Look look)
  {
    if (look == Look::ShadowMaps)
    {
      performance::useShadowMaps(this->Renderer);
    }
    else if (look != Look::Raster && look != Look::Empty)
    {
      this->Pass = performance::makePass(this->Phases, false);
      this->Pass->SetOcclusionCulling(look == Look::Traced);
      this->Pass->SetViewCulling(look != Look::NotCulled);
      this->Renderer->SetPass(this->Pass);
    }
  }

  const Options& Asked;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkUnsignedCharArray> Pixel;
  vtkSmartPointer<vtkSVORenderPass> Pass;
  performance::PhasesOfFrame Phases;
  std::vector<vtkSmartPointer<vtkActor>> Actors;
  vtkNew<vtkPolyData> Places; // of copies
  std::size_t Moves = 0;
  double Half = 10.0;
  std::map<std::string, std::vector<double>> Times;
};

/// The share of the pixels that only one of the two covers.
double differing(const std::vector<bool>& a, const std::vector<bool>& b)
{
  std::size_t pixels = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    pixels += a[i] != b[i];
  }
  return static_cast<double>(pixels) / static_cast<double>(a.size());
}

/// False if not everything is traced, or not where it is.
bool measure(
  const Options& options, int objects, const std::string& pictures, svobench::Results& results)
{
  std::vector<std::unique_ptr<Method>> methods;
  methods.push_back(std::make_unique<Method>("raster", Look::Raster, options, objects));
  methods.push_back(std::make_unique<Method>("traced, shadows", Look::Traced, options, objects));
  if (options.maps)
  {
    methods.push_back(
      std::make_unique<Method>("vtkShadowMapPass", Look::ShadowMaps, options, objects));
  }
  if (options.scene == "glyphs")
  {
    methods.push_back(std::make_unique<Method>("empty", Look::Empty, options, objects));
  }
  if (options.culling)
  {
    methods.push_back(
      std::make_unique<Method>("traced, what is hidden too", Look::NotOccluded, options, objects));
    methods.push_back(
      std::make_unique<Method>("traced, nothing culled", Look::NotCulled, options, objects));
  }
  constexpr int Warm = 2; // octrees are built, and layers of still objects kept
  for (int k = -Warm; k < options.frames; ++k)
  {
    for (const auto& method : methods)
    {
      method->draw(k + Warm);
      if (k < 0)
      {
        method->forget();
      }
    }
  }
  const int expected = options.scene == "layers" ? 100 * options.complexity
    : options.scene == "glyphs"                  ? 2
                                                 : objects + 1;
  for (const auto& method : methods)
  {
    results.add(method->row(objects));
    if (!pictures.empty())
    {
      method->write(pictures + options.scene + std::to_string(objects) + "-" +
        method->Name.substr(0, 6) + ".png");
    }
  }
  const double wrong = differing(methods[0]->covered(), methods[1]->covered());
  std::printf("%.5f of the pixels are covered by one of the two only\n", wrong);
  if (options.culling && options.scene != "glyphs")
  {
    std::printf("%zu of the objects are not seen\n", methods[0]->unseen());
  }
  constexpr double Outlines = 0.002;
  return methods[1]->tracedActors() == expected && wrong <= Outlines;
}
}

int main(int argc, char** argv)
{
  Options options;
  std::string json, pictures;
  for (int i = 1; i + 1 < argc; i += 2)
  {
    const std::string name = argv[i], argument = argv[i + 1];
    const int number = std::max(std::atoi(argument.c_str()), 1);
    if (name == "--scene")
    {
      options.scene = argument;
    }
    else if (name == "--objects")
    {
      options.objects.clear();
      std::istringstream list(argument);
      for (std::string one; std::getline(list, one, ',');)
      {
        options.objects.push_back(std::max(std::atoi(one.c_str()), 1));
      }
    }
    else if (name == "--motion")
    {
      options.motion = argument;
    }
    else if (name == "--frames")
    {
      options.frames = number;
    }
    else if (name == "--complexity")
    {
      options.complexity = number;
    }
    else if (name == "--triangles")
    {
      options.triangles = number;
    }
    else if (name == "--maps")
    {
      options.maps = argument == "1";
    }
    else if (name == "--culling")
    {
      options.culling = argument == "1";
    }
    else if (name == "--size")
    {
      std::sscanf(argument.c_str(), "%dx%d", &options.size[0], &options.size[1]);
    }
    else if (name == "--json")
    {
      json = argument;
    }
    else if (name == "--pictures")
    {
      pictures = argument;
    }
    else
    {
      std::fprintf(stderr, "BenchmarkCrowd: what is %s?\n", name.c_str());
      return 1;
    }
  }
  svobench::Results results({ "scene", "motion", "objects", "complexity", "method", "processorMs",
    "wallMs", "collectMs", "eyeMs", "markMs", "lightsMs", "shadeMs", "presentMs", "primaryRays",
    "shadowRays", "outside", "hidden", "casters" });
  bool good = true;
  for (const int n : options.objects)
  {
    good = measure(options, n, pictures, results) && good;
  }
  if (!json.empty() && !results.writeJson(json))
  {
    std::fprintf(stderr, "BenchmarkCrowd: cannot write %s\n", json.c_str());
    return 1;
  }
  if (!good)
  {
    std::fprintf(stderr, "BenchmarkCrowd: not everything was traced where it is\n");
  }
  return good ? 0 : 1;
}
