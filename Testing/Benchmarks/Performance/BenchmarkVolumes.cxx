// Shadow volumes beside the other techniques: a bumpy ball over a ground, which all turns in the
// light of one to ten lights, or stands still while the camera moves. The methods take turns, frame
// by frame. Processor time of a frame, ms, and how many pixels are lit that should not be, or dark,
// beside exact rays of the CPU, of those that show the scene.
//
//   BenchmarkVolumes [--triangles 510,2040,8010,100000] [--lights 1,3] [--frames 12]
//     [--size 960x540] [--json file] [--pictures prefix]
//
// Then contours, by the ways of "Crow", all edges between what faces the light and what does not
// (A); "Heidmann", the outline of all polygons that face it, united in the light's view (B); and
// the outline of the loops of A, united there (C); without and with what is known of the last
// frame.
//
// The exit code is 1 if volumes are off by more than a pixel in two thousand, or the outlines of B
// and C enclose other areas.
#include "performanceWindow.h"
#include "svoBenchmarkMesh.h"
#include "svoLightContour.h"
#include "svoMeshEdges.h"
#include "svoResults.h"
#include "vtkSVORenderPass.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <boost/polygon/polygon.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace
{
using Picture = std::vector<unsigned char>; // RGB
namespace bp = boost::polygon;

struct Options
{
  std::vector<int> triangles{ 510, 2040, 8010, 100000 }, lights{ 1, 3 };
  int frames = 12, size[2] = { 960, 540 };
  std::string pictures;
};

double processorMs()
{
  return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

svobench::Mesh ballOf(int triangles)
{
  return svobench::bumpySphere(static_cast<unsigned>(std::lround(std::sqrt(0.25 * triangles))));
}

/// What stands or turns over the ground, drawn in one way.
class Scene
{
public:
  Scene(const std::string& name, const svobench::Mesh& mesh, int lights, const Options& options)
    : Name(name)
  {
    this->Window->SetOffScreenRendering(true);
    this->Window->SetMultiSamples(0);
    this->Window->SetSize(options.size[0], options.size[1]);
    this->Window->AddRenderer(this->Renderer);
    vtkNew<vtkPlaneSource> plane;
    plane->SetOrigin(-4.0, -4.0, 0.0);
    plane->SetPoint1(4.0, -4.0, 0.0);
    plane->SetPoint2(-4.0, 4.0, 0.0);
    vtkNew<vtkPolyDataMapper> planeMapper;
    planeMapper->SetInputConnection(plane->GetOutputPort());
    vtkNew<vtkActor> ground;
    ground->SetMapper(planeMapper);
    this->Renderer->AddActor(ground);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(svobench::polyData(mesh));
    this->Ball->SetMapper(mapper);
    this->Ball->SetPosition(0.0, 0.0, 1.6);
    this->Ball->GetProperty()->SetColor(0.9, 0.5, 0.3);
    this->Renderer->AddActor(this->Ball);
    for (int i = 0; i < lights; ++i)
    {
      vtkNew<vtkLight> light;
      light->SetLightTypeToSceneLight();
      light->SetPositional(true);
      light->SetConeAngle(40.0); // vtkShadowMapPass has no others
      light->SetExponent(0.0);
      light->SetPosition(3.0 * std::cos(0.9 + 2.4 * i), 3.0 * std::sin(0.9 + 2.4 * i), 6.0);
      light->SetFocalPoint(0.0, 0.0, 0.5);
      light->SetIntensity(1.0 / lights);
      this->Renderer->AddLight(light);
    }
    if (name == "vtkShadowMapPass")
    {
      performance::useShadowMaps(this->Renderer);
    }
    else if (name != "no shadows")
    {
      this->Renderer->SetPass(this->Pass);
      const bool onCPU = name.find("CPU") != std::string::npos;
      this->Pass->SetBackend(
        onCPU ? vtkSVORenderPass::BACKEND_CPU : vtkSVORenderPass::BACKEND_OPENGL);
      this->Pass->SetShadowTechnique(name.rfind("volumes", 0) == 0
          ? vtkSVORenderPass::SHADOW_VOLUMES
          : name.rfind("rays", 0) == 0 ? vtkSVORenderPass::SHADOW_RAYS
                                       : vtkSVORenderPass::SHADOW_BUFFER);
    }
  }
  ~Scene() { this->Window->Finalize(); }
  Scene(const Scene&) = delete;
  void operator=(const Scene&) = delete;

  const std::string& name() const { return this->Name; }
  vtkSVORenderPass* pass() { return this->Pass; }

  void draw(int frame, bool moves)
  {
    const double turn = moves ? 0.4 : 0.4 + 0.01 * frame;
    vtkCamera* camera = this->Renderer->GetActiveCamera();
    camera->SetPosition(7.0 * std::cos(turn), -7.0 * std::sin(turn), 5.0);
    camera->SetFocalPoint(0.0, 0.0, 0.8);
    camera->SetViewUp(0.0, 0.0, 1.0);
    this->Renderer->ResetCameraClippingRange();
    if (moves)
    {
      this->Ball->SetOrientation(3.0 * frame, 2.0 * frame, 0.0);
    }
    const double before = processorMs();
    this->Window->Render();
    this->Window->WaitForCompletion();
    this->Times.push_back(processorMs() - before);
  }
  double median(int frames) const
  {
    return performance::median({ this->Times.end() - frames, this->Times.end() });
  }
  Picture picture() const
  {
    vtkNew<vtkUnsignedCharArray> pixels;
    const int* size = this->Window->GetSize();
    this->Window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, 0, pixels);
    return { pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues() };
  }
  void write(const std::string& path) { performance::writePicture(this->Window, path); }

private:
  std::string Name;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkSVORenderPass> Pass;
  vtkNew<vtkActor> Ball;
  std::vector<double> Times;
};

/// Share of the pixels, of those that are not black in either, in which the two differ as light and
/// shadow of one light do.
double wrong(const Picture& exact, const Picture& other, int lights)
{
  const int visible = std::max(40 / lights, 6);
  std::size_t shown = 0, count = 0;
  for (std::size_t i = 0; i < exact.size(); i += 3)
  {
    int most = 0;
    bool black = true;
    for (std::size_t c = i; c < i + 3; ++c)
    {
      most = std::max(most, std::abs(exact[c] - other[c]));
      black = black && exact[c] == 0 && other[c] == 0;
    }
    shown += !black;
    count += most > visible;
  }
  return static_cast<double>(count) / static_cast<double>(std::max<std::size_t>(shown, 1));
}

bool compareFrames(const Options& options, svobench::Results& results)
{
  bool good = true;
  for (const int lights : options.lights)
  {
    for (const int triangles : options.triangles)
    {
      const svobench::Mesh mesh = ballOf(triangles);
      std::vector<std::unique_ptr<Scene>> scenes;
      for (const char* name :
        { "rays, CPU", "volumes", "rays", "maps", "maps, CPU", "vtkShadowMapPass", "no shadows" })
      {
        scenes.push_back(std::make_unique<Scene>(name, mesh, lights, options));
      }
      for (const bool moves : { true, false })
      {
        std::vector<double> off(scenes.size());
        for (int frame = -2; frame < options.frames; ++frame)
        {
          Picture exact;
          for (std::size_t i = 0; i < scenes.size(); ++i)
          {
            scenes[i]->draw(frame, moves);
            const Picture picture = scenes[i]->picture();
            exact = i == 0 ? picture : exact;
            off[i] += frame < 0 ? 0.0 : wrong(exact, picture, lights) / options.frames;
          }
        }
        for (std::size_t i = 0; i < scenes.size(); ++i)
        {
          Scene& scene = *scenes[i];
          svobench::Row row;
          row["experiment"] = moves ? "all turns" : "the camera moves";
          row["triangles"] = static_cast<int>(mesh.triangles.size());
          row["lights"] = lights;
          row["method"] = scene.name();
          row["frameMs"] = scene.median(options.frames);
          if (scene.name() != "vtkShadowMapPass") // whose light is another one
          {
            row["wrongPercent"] = 100.0 * off[i];
          }
          row["contourEdges"] = static_cast<Json::Int64>(scene.pass()->GetNumberOfContourEdges());
          results.add(row);
          const bool counted = scene.pass()->GetNumberOfShadowVolumes() > 0;
          good = good && (scene.name() != "volumes" || (counted && off[i] < 1.0 / 2000));
          if (!options.pictures.empty() && moves)
          {
            scene.write(options.pictures + scene.name() + "-" + std::to_string(triangles) + "-" +
              std::to_string(lights) + ".png");
          }
        }
      }
    }
  }
  return good;
}

/// In the light's view, in whole numbers.
class Outline
{
public:
  using Point = bp::point_data<int>;

  explicit Outline(const glm::dvec4& light)
    : Light(light)
  {
    // The way from the light to the middle of the cube, and two across.
    this->Variant = glm::normalize(light.w * (glm::dvec3(1.5) * light.w - glm::dvec3(light)) -
      (1.0 - light.w) * glm::dvec3(light));
    const glm::dvec3 other =
      std::abs(this->Variant.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    this->Across = glm::normalize(glm::cross(this->Variant, other));
    this->Up = glm::cross(this->Across, this->Variant);
  }
  Point place(const glm::vec3& point) const
  {
    const glm::dvec3 from = glm::dvec3(point) - this->Light.w * glm::dvec3(this->Light);
    const double depth = this->Light.w > 0.0
      ? glm::dot(from, this->Variant) / glm::distance(glm::dvec3(1.5), glm::dvec3(this->Light))
      : 1.0;
    constexpr double Steps = 1e8;
    const auto step = [&](const glm::dvec3& axis)
    { return static_cast<int>(std::lround(Steps * glm::dot(from, axis) / depth)); };
    return { step(this->Across), step(this->Up) };
  }
  void add(const glm::vec3& from, const glm::vec3& to)
  {
    const Point a = this->place(from), b = this->place(to);
    if (a != b)
    {
      const int upright = a.x() == b.x() ? -1 : 1; // Boost counts these the other way round
      this->Edges.insert(a < b ? std::make_pair(std::make_pair(a, b), upright)
                               : std::make_pair(std::make_pair(b, a), -upright));
    }
  }
  /// Edges of what all that was added encloses.
  std::size_t unite(double& area)
  {
    std::vector<bp::polygon_with_holes_data<int>> parts;
    this->Edges.get(parts);
    std::size_t count = 0;
    area = 0.0;
    for (const auto& part : parts)
    {
      area += bp::area(part);
      count += part.size();
      for (auto hole = part.begin_holes(); hole != part.end_holes(); ++hole)
      {
        count += hole->size();
      }
    }
    return count;
  }

private:
  glm::dvec4 Light;
  glm::dvec3 Variant, Across, Up;
  bp::polygon_set_data<int> Edges;
};

bool compareContours(const Options& options, svobench::Results& results)
{
  bool good = true;
  for (const int triangles : options.triangles)
  {
    const svobench::Mesh mesh = ballOf(triangles);
    svo::Surface surface;
    surface.triangles = mesh.triangles;
    for (const glm::dvec3& point : mesh.points)
    {
      surface.points.emplace_back(1.5 + 0.3 * point);
    }
    const double start = processorMs();
    const svo::MeshEdges edges(surface);
    const double preparedMs = processorMs() - start;
    svo::LightContour kept;
    struct Variant
    {
      const char* name;
      std::vector<double> times = {};
      double edges = 0.0;
    } ways[] = { { "A" }, { "A, kept" }, { "A, kept, by normals" }, { "B" }, { "C" },
      { "C, kept" } };
    svo::LightContour bundled;
    for (int frame = 0; frame < options.frames; ++frame)
    {
      const double turn = glm::radians(3.0 * frame);
      const glm::dvec4 light(1.5 + 1.2 * std::cos(turn), 1.5 + 1.2 * std::sin(turn), 2.9, 1.0);
      const auto corner = [&](std::uint32_t i)
      { return surface.points[surface.triangles[i / 3][i % 3]]; };
      const auto time = [](Variant& way, const auto& work)
      {
        const double before = processorMs();
        way.edges = static_cast<double>(work());
        way.times.push_back(processorMs() - before);
      };
      svo::LightContour fresh;
      double area[3] = {};
      const auto loops = [&](const svo::LightContour& contour, double& enclosed)
      {
        Outline outline(light);
        for (const svo::LightContour::Edge& edge : contour.edges())
        {
          outline.add(corner(edge.from), corner(edge.to));
        }
        return outline.unite(enclosed);
      };
      time(ways[0],
        [&]
        {
          fresh.update(surface, edges, light, false);
          return fresh.edges().size();
        });
      time(ways[1],
        [&]
        {
          kept.update(surface, edges, light, false);
          return kept.edges().size();
        });
      time(ways[2],
        [&]
        {
          bundled.update(surface, edges, light, true);
          return bundled.edges().size();
        });
      time(ways[3],
        [&]
        {
          Outline outline(light);
          for (const glm::uvec3& t : surface.triangles)
          {
            const glm::dvec3 a(surface.points[t[0]]), b(surface.points[t[1]]),
              c(surface.points[t[2]]);
            if (glm::dot(glm::cross(b - a, c - a), glm::dvec3(light) - a) > 0.0)
            {
              for (int k = 0; k < 3; ++k)
              {
                outline.add(surface.points[t[k]], surface.points[t[(k + 1) % 3]]);
              }
            }
          }
          return outline.unite(area[0]);
        });
      time(ways[4],
        [&]
        {
          svo::LightContour again;
          again.update(surface, edges, light, false);
          return loops(again, area[1]);
        });
      const double unitedMs = ways[4].times.back() - ways[0].times.back();
      ways[5].times.push_back(ways[1].times.back() + unitedMs);
      ways[5].edges = ways[4].edges;
      good = good && std::abs(area[0] - area[1]) <= 1e-4 * area[0] && area[0] > 0.0;
    }
    for (Variant& way : ways)
    {
      svobench::Row row;
      row["experiment"] = "contour";
      row["triangles"] = static_cast<int>(mesh.triangles.size());
      row["method"] = way.name;
      row["contourMs"] = performance::median({ way.times.begin() + 1, way.times.end() });
      row["contourEdges"] = way.edges;
      row["preparedMs"] = preparedMs;
      results.add(row);
    }
  }
  return good;
}

std::vector<int> numbers(const std::string& text)
{
  std::vector<int> numbers;
  std::istringstream stream(text);
  for (std::string number; std::getline(stream, number, ',');)
  {
    numbers.push_back(std::max(std::atoi(number.c_str()), 1));
  }
  return numbers;
}
}

int main(int argc, char** argv)
{
  Options options;
  std::string json;
  for (int i = 1; i + 1 < argc; i += 2)
  {
    const std::string name = argv[i], value = argv[i + 1];
    if (name == "--triangles")
    {
      options.triangles = numbers(value);
    }
    else if (name == "--lights")
    {
      options.lights = numbers(value);
    }
    else if (name == "--frames")
    {
      options.frames = std::max(std::atoi(value.c_str()), 2);
    }
    else if (name == "--size")
    {
      std::sscanf(value.c_str(), "%dx%d", &options.size[0], &options.size[1]);
    }
    else if (name == "--json")
    {
      json = value;
    }
    else if (name == "--pictures")
    {
      options.pictures = value;
    }
    else
    {
      std::fprintf(stderr, "BenchmarkVolumes: what is %s?\n", name.c_str());
      return 2;
    }
  }
  svobench::Results results({ "triangles", "lights", "method", "frameMs", "wrongPercent",
    "contourEdges", "contourMs", "preparedMs" });
  const bool frames = compareFrames(options, results);
  const bool contours = compareContours(options, results);
  if (!frames)
  {
    std::fprintf(stderr, "BenchmarkVolumes: volumes are not what rays are\n");
  }
  if (!contours)
  {
    std::fprintf(stderr, "BenchmarkVolumes: outlines enclose other areas\n");
  }
  if (!json.empty() && !results.writeJson(json))
  {
    std::fprintf(stderr, "BenchmarkVolumes: cannot write %s\n", json.c_str());
    return 1;
  }
  return frames && contours ? 0 : 1;
}
