// Renders the paper's experiments: pictures, the frames of a movie, and a table of figures.
#include "arguments.h"
#include "measure.h"
#include "meshes.h"
#include "objects.h"
#include "pictures.h"
#include "progress.h"
#include "report.h"
#include "scenes.h"

#include "svoIntersect.h"

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkVersion.h>

#include <vtksys/SystemInformation.hxx>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>
#include <thread>

namespace
{
using namespace paper;

/// B runs in front of the other objects.
constexpr int pictureFrame = 14;

/// The line "OpenGL renderer string:  ..." of what the window says about itself.
std::string openGLRenderer(vtkRenderWindow* window)
{
  std::istringstream capabilities(window->ReportCapabilities());
  const std::string key = "OpenGL renderer string:";
  for (std::string line; std::getline(capabilities, line);)
  {
    if (line.compare(0, key.size(), key) == 0)
    {
      return line.substr(line.find_first_not_of(' ', key.size()));
    }
  }
  return "unknown";
}

const Method& defaultMethod()
{
  const auto found = std::find_if(methods().begin(), methods().end(),
    [](const Method& m) { return m.name == "svo_point_coherent_pixel_error_1"; });
  return *found;
}

SceneFigures describe(const Scene& scene)
{
  SceneFigures figures;
  figures.name = scene.experiment().name;
  figures.objects = scene.experiment().objects;
  figures.trianglesShown = scene.trianglesShown();
  figures.trianglesInMemory = scene.trianglesInMemory();
  figures.buildSeconds = scene.buildSeconds();
  figures.octreeMebibytes = scene.octreeMebibytes();
  figures.voxels = scene.voxels();
  figures.paperFramesPerSecond = scene.experiment().paperFramesPerSecond;
  for (const Viewpoint& view : scene.experiment().views)
  {
    figures.viewpoints.push_back(view.name);
  }
  return figures;
}

class Demo
{
public:
  Demo(const Arguments& arguments, vtkRenderWindow* window)
    : Options(arguments)
    , Window(window)
    , ShadowMapResolution(defaultShadowMapResolution())
  {
  }

  /// Everything about one scene; false with a message if a file cannot be written.
  bool run(const Experiment& experiment, const Objects& objects, int movieFrames, Figures& figures)
  {
    Scene scene(experiment, objects);
    this->Window->AddRenderer(scene.renderer());
    SceneFigures sceneFigures = describe(scene);
    {
      const Progress progress(experiment.name + ": pixels on objects", 0);
      sceneFigures.coverage = objectCoverage(this->Window, scene);
    }
    bool good = this->drawPictures(scene);
    if (good && this->Options.framesPerView > 0)
    {
      this->time(scene, sceneFigures);
    }
    figures.scenes.push_back(sceneFigures);
    good = good && this->drawMovie(scene, movieFrames);
    removePass(scene.renderer());
    this->Window->RemoveRenderer(scene.renderer());
    if (!good)
    {
      std::cerr << "PaperScenes: cannot write pictures into \"" << this->Options.output << "\".\n";
    }
    return good;
  }

private:
  void time(Scene& scene, SceneFigures& figures)
  {
    const int total = this->Options.framesPerView * static_cast<int>(figures.viewpoints.size());
    for (const Method& method : methods())
    {
      if (method.technique == Technique::Empty)
      {
        continue;
      }
      Progress progress(scene.experiment().name + ": timing " + method.name, total);
      scene.setLight(method.light);
      useMethod(method, scene.renderer(), this->ShadowMapResolution);
      const Timing timing =
        timeFrames(this->Window, scene, this->Options.framesPerView, [&] { progress.advance(); });
      figures.timings[method.name] = timing;
      progress.finish(std::to_string(std::lround(timing.medianMilliseconds)) + " ms, " +
        std::to_string(std::lround(timing.processorMilliseconds)) + " ms of processor time");
    }
    scene.setLight(LightKind::Point);

    vtkNew<vtkRenderer> nothing;
    this->Window->RemoveRenderer(scene.renderer());
    this->Window->AddRenderer(nothing);
    figures.timings[methods().back().name] = timeEmptyFrames(this->Window, total);
    this->Window->RemoveRenderer(nothing);
    this->Window->AddRenderer(scene.renderer());
  }

  /// Ours first, and says where they are.
  bool drawPictures(Scene& scene)
  {
    const Experiment& experiment = scene.experiment();
    Progress progress(experiment.name + ": pictures", 0);
    const auto draw = [&](const Method& method, const std::string& suffix)
    {
      useMethod(method, scene.renderer(), this->ShadowMapResolution);
      scene.setLight(method.light);
      for (const Viewpoint& view : experiment.shownViews())
      {
        scene.setView(view);
        scene.setFrame(pictureFrame);
        const std::string path =
          this->Options.output + "/" + experiment.name + "-" + view.name + suffix + ".png";
        if (!writePicture(this->Window, path))
        {
          return false;
        }
      }
      return true;
    };
    const auto shadowMaps = std::find_if(methods().begin(), methods().end(),
      [](const Method& m) { return m.technique == Technique::ShadowMaps; });
    if (!draw(defaultMethod(), ""))
    {
      return false;
    }
    progress.finish(this->Options.output + "/" + experiment.name + "-*.png");
    return draw(*shadowMaps, "-vtkShadowMapPass");
  }

  bool drawMovie(Scene& scene, int frames)
  {
    if (frames == 0)
    {
      return true;
    }
    Progress progress(scene.experiment().name + ": movie frames", frames);
    useMethod(defaultMethod(), scene.renderer(), this->ShadowMapResolution);
    scene.setLight(LightKind::Point);
    scene.setCaption(scene.experiment().name + ":  " + scene.experiment().objects +
      ",  shadows by vtkSVORenderPass");
    const bool good = writeMovieFrames(this->Window, scene, this->Options.output + "/frames",
      this->NextMovieFrame, frames, [&] { progress.advance(); });
    this->NextMovieFrame += frames;
    return good;
  }

  const Arguments& Options;
  vtkRenderWindow* Window;
  int ShadowMapResolution;
  int NextMovieFrame = 0;
};

bool prepare(const Arguments& arguments, Objects& objects, Figures& figures)
{
  Meshes meshes;
  std::string error;
  {
    const Progress progress("reading meshes", 0);
    if (arguments.standIn)
    {
      meshes = standInMeshes();
    }
    else if (!readMeshes(arguments.fileOfA, arguments.fileOfB, meshes, error))
    {
      std::cerr << "PaperScenes: " << error << "\n";
      return false;
    }
  }
  figures.sourceOfA = meshes.sourceOfA;
  figures.sourceOfB = meshes.sourceOfB;
  figures.trianglesOfA = meshes.a->GetNumberOfPolys();
  figures.trianglesOfB = meshes.b.front()->GetNumberOfPolys();

  Progress progress("building octrees", static_cast<int>(meshes.b.size()));
  if (!buildOctrees(
        meshes, arguments.level, [&](double) { progress.advance(); }, objects, error))
  {
    std::cerr << "PaperScenes: " << error << "\n";
    return false;
  }
  return true;
}

std::vector<const Experiment*> chosenExperiments(const Arguments& arguments)
{
  std::vector<const Experiment*> chosen;
  for (const Experiment& experiment : experiments())
  {
    const auto& names = arguments.scenes;
    if (names.empty() || std::find(names.begin(), names.end(), experiment.name) != names.end())
    {
      chosen.push_back(&experiment);
    }
  }
  return chosen;
}
}

int main(int argc, char* argv[])
{
  Arguments arguments;
  const Parsed parsed = parseArguments(argc, argv, arguments);
  if (parsed != Parsed::Run)
  {
    return parsed == Parsed::HelpShown ? 0 : 2;
  }
  Figures figures;
  Objects objects;
  if (!prepare(arguments, objects, figures))
  {
    return 1;
  }
  if (!vtksys::SystemTools::MakeDirectory(arguments.output + "/frames"))
  {
    std::cerr << "PaperScenes: cannot make the folder \"" << arguments.output << "\".\n";
    return 1;
  }

  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(true);
  window->SetMultiSamples(0);
  window->SetSize(arguments.size);
  window->Render();
  figures.openGL = openGLRenderer(window);
  figures.vtkVersion = vtkVersion::GetVTKVersion();
  figures.processors = std::thread::hardware_concurrency();
  vtksys::SystemInformation system;
  system.RunCPUCheck();
  figures.processor = system.GetModelName();
  figures.instructionSet = svo::instructionSet();
  std::copy_n(arguments.size, 2, figures.size);
  figures.level = arguments.level;
  figures.shadowMapResolution = defaultShadowMapResolution();

  Demo demo(arguments, window);
  const std::vector<const Experiment*> chosen = chosenExperiments(arguments);
  bool good = true;
  for (const Experiment* experiment : chosen)
  {
    figures.framesPerMedian = arguments.framesPerView * static_cast<int>(experiment->views.size());
    good = good &&
      demo.run(
        *experiment, objects, movieShare(*experiment, chosen, arguments.movieFrames), figures);
  }
  window->Finalize();
  if (!good)
  {
    return 1;
  }
  std::cout << "\n" << table(figures);
  const std::string json = arguments.output + "/figures.json";
  if (!writeJson(figures, json))
  {
    std::cerr << "PaperScenes: cannot write \"" << json << "\".\n";
    return 1;
  }
  return 0;
}
