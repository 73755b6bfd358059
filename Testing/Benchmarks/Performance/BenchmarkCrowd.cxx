// What frames with many objects cost: vtkSVORenderPass with shadows beside VTK's rasteriser without
// any and, where asked for, vtkShadowMapPass. The methods take turns, frame by frame, in windows of
// their own. Medians over the frames of processor time and wall time, ms, and of ours the phases.
// Objects of both have to cover the same pixels.
//
//   BenchmarkCrowd [--scene field|plain|small|inside|layers|glyphs] [--objects n,n]
//     [--motion none|orbit|all] [--frames n] [--size 1920x1080] [--maps 1] [--culling 1] [--rays 1]
//     [--complexity n] [--triangles n] [--json file] [--pictures prefix]
//
// --culling: beside it the same without the culling of what others hide, and without any, and how
// many objects each step left out, of those that it could have: all that no pixel shows.
//
// --rays: beside it the same with rays to the light, on the CPU and with OpenGL, and maps with
// OpenGL.
//
// The scenes: performanceCrowd.h.
//
// none: nothing moves; orbit: the camera does; all: every object turns and bobs (of copies: the
// points that they are at bob).
#include "performanceCrowd.h"
#include "performancePass.h"
#include "performanceWindow.h"
#include "svoResults.h"
#include "vtkSVORenderPass.h"

#include <vtkActor.h>
#include <vtkHardwareSelector.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace
{
struct Options
{
  performance::CrowdOptions crowd;
  std::string motion = "all";
  std::vector<int> objects{ 1000 };
  int frames = 9, size[2] = { 1920, 1080 };
  bool maps = false, culling = false, rays = false;
};

/// No object looks like it.
constexpr int Background[3] = { 51, 77, 102 };

enum class Look
{
  Empty, // nothing is there to be drawn
  Raster,
  ShadowMaps,
  Traced,
  Rays,       // traced, with rays to the light
  OpenGLRays, // the same, with the OpenGL backend
  OpenGLMaps,
  NotOccluded, // traced, without culling of what others hide
  NotCulled    // without any
};

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
    if (look != Look::Empty)
    {
      this->Scene.emplace(this->Renderer, options.crowd, objects);
    }
    this->setLook(look);
  }
  ~Method() { this->Window->Finalize(); }

  /// Frame k.
  void draw(int k)
  {
    if (this->Scene && this->Asked.motion == "orbit")
    {
      this->Scene->aim(k);
    }
    else if (this->Scene && this->Asked.motion == "all")
    {
      this->Scene->move();
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
    row["scene"] = this->Asked.crowd.scene;
    row["motion"] = this->Asked.motion;
    row["objects"] = objects;
    row["triangles"] = this->Asked.crowd.triangles;
    row["complexity"] = this->Asked.crowd.scene == "layers" ? this->Asked.crowd.complexity : 0;
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
    return static_cast<std::size_t>(this->actors()) - seen.size();
  }
  int actors() const { return this->Scene ? this->Scene->actors() : 0; }
  /// False of a frame that the CPU has made for OpenGL.
  bool isOpenGLsIfAsked() const
  {
    return !this->Pass || this->Pass->GetBackend() != vtkSVORenderPass::BACKEND_OPENGL ||
      (this->Pass->GetGPUMemory() > 0 && this->Pass->GetNumberOfShadowRays() == 0);
  }
  int tracedActors() const { return this->Pass ? this->Pass->GetNumberOfTracedActors() : 0; }
  const std::string Name;

private:
  void setLook(Look look)
  {
    if (look == Look::ShadowMaps)
    {
      performance::useShadowMaps(this->Renderer);
    }
    else if (look != Look::Raster && look != Look::Empty)
    {
      // The one with phases has the CPU's tracer, whatever its backend is.
      const bool openGL = look == Look::OpenGLRays || look == Look::OpenGLMaps;
      this->Pass = openGL ? vtkSmartPointer<vtkSVORenderPass>::New()
                          : performance::makePass(this->Phases, false);
      this->Pass->SetBackend(
        openGL ? vtkSVORenderPass::BACKEND_OPENGL : vtkSVORenderPass::BACKEND_CPU);
      this->Pass->SetOcclusionCulling(look != Look::NotOccluded && look != Look::NotCulled);
      this->Pass->SetViewCulling(look != Look::NotCulled);
      if (look == Look::Rays || look == Look::OpenGLRays)
      {
        this->Pass->SetShadowTechniqueToShadowRays();
      }
      this->Renderer->SetPass(this->Pass);
    }
  }

  const Options& Asked;
  vtkNew<vtkRenderer> Renderer;
  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkUnsignedCharArray> Pixel;
  vtkSmartPointer<vtkSVORenderPass> Pass;
  performance::PhasesOfFrame Phases;
  std::optional<performance::Crowd> Scene; // none: nothing is there to be drawn
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
  if (options.crowd.scene == "glyphs")
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
  if (options.rays)
  {
    methods.push_back(std::make_unique<Method>("traced, rays", Look::Rays, options, objects));
    methods.push_back(std::make_unique<Method>("OpenGL, rays", Look::OpenGLRays, options, objects));
    methods.push_back(std::make_unique<Method>("OpenGL, maps", Look::OpenGLMaps, options, objects));
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
  const int expected = methods[1]->actors();
  for (const auto& method : methods)
  {
    results.add(method->row(objects));
    if (!pictures.empty())
    {
      method->write(pictures + options.crowd.scene + std::to_string(objects) + "-" +
        method->Name.substr(0, 6) + ".png");
    }
  }
  const double wrong = differing(methods[0]->covered(), methods[1]->covered());
  std::printf("%.5f of the pixels are covered by one of the two only\n", wrong);
  if (options.culling && options.crowd.scene != "glyphs")
  {
    std::printf("%zu of the objects are not seen\n", methods[0]->unseen());
  }
  constexpr double Outlines = 0.002;
  const bool drawn = std::all_of(
    methods.begin(), methods.end(), [](const auto& method) { return method->isOpenGLsIfAsked(); });
  return methods[1]->tracedActors() == expected && wrong <= Outlines && drawn;
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
      options.crowd.scene = argument;
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
      options.crowd.complexity = number;
    }
    else if (name == "--triangles")
    {
      options.crowd.triangles = number;
    }
    else if (name == "--maps")
    {
      options.maps = argument == "1";
    }
    else if (name == "--culling")
    {
      options.culling = argument == "1";
    }
    else if (name == "--rays")
    {
      options.rays = argument == "1";
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
