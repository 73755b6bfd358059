// Times the scenes.
#include "measure.h"

#include "vtkSVORenderPass.h"

#include <vtkCameraPass.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkRenderPassCollection.h>
#include <vtkSequencePass.h>
#include <vtkShadowMapBakerPass.h>
#include <vtkShadowMapPass.h>

#include <algorithm>
#include <chrono>
#include <ctime>

namespace paper
{
namespace
{
constexpr int warmUpFrames = 2;
constexpr int coverageFrames = 8;

double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

Timing summary(const std::vector<Sample>& samples)
{
  Timing timing;
  timing.frames = static_cast<int>(samples.size());
  if (samples.empty())
  {
    return timing;
  }
  std::vector<double> wall;
  std::vector<double> processor;
  for (const Sample& sample : samples)
  {
    wall.push_back(sample.milliseconds);
    processor.push_back(sample.processorMilliseconds);
  }
  timing.medianMilliseconds = median(wall);
  timing.slowestMilliseconds = *std::max_element(wall.begin(), wall.end());
  timing.processorMilliseconds = median(processor);
  return timing;
}

std::map<std::string, double> passStatistics(vtkRenderer* renderer)
{
  const auto* pass = vtkSVORenderPass::SafeDownCast(renderer->GetPass());
  if (!pass)
  {
    return {};
  }
  return { { "trace_ms", 1000 * pass->GetTraceTime() },
    { "shadow_ms", 1000 * pass->GetShadowTime() }, { "present_ms", 1000 * pass->GetPresentTime() },
    { "primary_rays", static_cast<double>(pass->GetNumberOfPrimaryRays()) },
    { "shadow_rays", static_cast<double>(pass->GetNumberOfShadowRays()) },
    { "retraced_layers", static_cast<double>(pass->GetNumberOfRetracedLayers()) } };
}

double coveredShare(vtkRenderWindow* window)
{
  const int* size = window->GetSize();
  vtkNew<vtkFloatArray> depth;
  window->GetZbufferData(0, 0, size[0] - 1, size[1] - 1, depth);
  const float* begin = depth->GetPointer(0);
  const float* end = begin + depth->GetNumberOfValues();
  const auto covered = std::count_if(begin, end, [](float z) { return z < 1.0f; });
  return static_cast<double>(covered) / depth->GetNumberOfValues();
}
}

const std::vector<Method>& methods()
{
  static const std::vector<Method> all{
    { Technique::Octrees, "svo_point_coherent_pixel_error_1",
      "by default: frame coherence, pixel error 1", LightKind::Point, true, 1 },
    { Technique::Octrees, "svo_point_retraced_full_depth",
      "all retraced, full depth (the paper's way)", LightKind::Point, false, 0 },
    { Technique::Octrees, "svo_point_coherent_full_depth", "frame coherence, full depth",
      LightKind::Point, true, 0 },
    { Technique::Octrees, "svo_point_retraced_pixel_error_1", "all retraced, pixel error 1",
      LightKind::Point, false, 1 },
    { Technique::Octrees, "svo_spot_coherent_pixel_error_1",
      "by default: frame coherence, pixel error 1", LightKind::Spot, true, 1 },
    { Technique::Octrees, "svo_spot_retraced_full_depth", "all retraced, full depth",
      LightKind::Spot, false, 0 },
    { Technique::ShadowMaps, "vtk_shadow_map_spot", "with vtkShadowMapPass", LightKind::Spot },
    { Technique::Rasterizer, "vtk_no_shadows", "without shadows, point light", LightKind::Point },
    { Technique::Empty, "vtk_empty_frame", "an empty frame", LightKind::Point },
  };
  return all;
}

int defaultShadowMapResolution()
{
  vtkNew<vtkSVORenderPass> pass;
  return pass->GetShadowBufferResolution();
}

void removePass(vtkRenderer* renderer)
{
  if (vtkRenderPass* pass = renderer->GetPass())
  {
    pass->ReleaseGraphicsResources(renderer->GetRenderWindow());
    renderer->SetPass(nullptr);
  }
}

vtkSmartPointer<vtkRenderPass> shadowMaps(int resolution)
{
  vtkNew<vtkShadowMapPass> shadows;
  shadows->GetShadowMapBakerPass()->SetResolution(resolution);
  vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(shadows->GetShadowMapBakerPass());
  passes->AddItem(shadows);
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(passes);
  auto camera = vtkSmartPointer<vtkCameraPass>::New();
  camera->SetDelegatePass(sequence);
  return camera;
}

void useMethod(const Method& method, vtkRenderer* renderer, int shadowMapResolution)
{
  removePass(renderer);
  if (method.technique == Technique::Octrees)
  {
    vtkNew<vtkSVORenderPass> pass;
    pass->SetFrameCoherence(method.frameCoherence);
    pass->SetPixelError(method.pixelError);
    pass->SetShadowBufferResolution(shadowMapResolution);
    renderer->SetPass(pass);
  }
  else if (method.technique == Technique::ShadowMaps)
  {
    renderer->SetPass(shadowMaps(shadowMapResolution));
  }
}

Sample draw(vtkRenderWindow* window)
{
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t processorStart = std::clock();
  window->Render();
  window->WaitForCompletion();
  const std::chrono::duration<double, std::milli> elapsed =
    std::chrono::steady_clock::now() - start;
  return { elapsed.count(), 1000.0 * (std::clock() - processorStart) / CLOCKS_PER_SEC };
}

double Timing::framesPerSecond() const
{
  return this->medianMilliseconds > 0 ? 1000.0 / this->medianMilliseconds : 0;
}

Timing timeFrames(
  vtkRenderWindow* window, Scene& scene, int framesPerView, const std::function<void()>& afterFrame)
{
  std::vector<Sample> samples;
  for (const Viewpoint& view : scene.experiment().views)
  {
    scene.setView(view);
    for (int i = -warmUpFrames; i < framesPerView; ++i)
    {
      scene.setFrame((i + warmUpFrames) * Scene::period() / (framesPerView + warmUpFrames));
      const Sample sample = draw(window);
      if (i >= 0)
      {
        samples.push_back(sample);
        afterFrame();
      }
    }
  }
  Timing timing = summary(samples);
  timing.statistics = passStatistics(scene.renderer());
  return timing;
}

Timing timeEmptyFrames(vtkRenderWindow* window, int frames)
{
  std::vector<Sample> samples;
  for (int i = -warmUpFrames; i < frames; ++i)
  {
    const Sample sample = draw(window);
    if (i >= 0)
    {
      samples.push_back(sample);
    }
  }
  return summary(samples);
}

std::vector<double> objectCoverage(vtkRenderWindow* window, Scene& scene)
{
  removePass(scene.renderer());
  scene.setGroundVisible(false);
  scene.setAVisible(false);
  for (std::size_t pose = 0; pose < posesOfB; ++pose)
  {
    scene.setPose(pose);
    window->Render();
  }
  scene.setAVisible(true);
  std::vector<double> coverage;
  for (const Viewpoint& view : scene.experiment().views)
  {
    scene.setView(view);
    double sum = 0;
    for (int i = 0; i < coverageFrames; ++i)
    {
      scene.setFrame(i * Scene::period() / coverageFrames);
      window->Render();
      sum += coveredShare(window);
    }
    coverage.push_back(sum / coverageFrames);
  }
  scene.setGroundVisible(true);
  return coverage;
}
}
