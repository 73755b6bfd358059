// What interactive frames lose to keep to their time: a ball above a ground in ParaView's light
// kit, 1920x1080, the camera in orbit, and beside each interactive frame the still picture of the
// same camera. One line for each rate: the median time of a frame (processor time of two cores,
// which the pass goes by as well), the mean difference of a channel, and the share of pixels that
// differ by more than 8 of 255 in some channel.
//
//   BenchmarkInteractive [triangles] [none | buffer | rays | automatic] [Hz ...]
#include "pictureDifference.h"
#include "svoBenchmarkMesh.h"
#include "vtkSVORenderPass.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkLightKit.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPlaneSource.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include <glm/trigonometric.hpp>

namespace
{
constexpr int Width = 1920, Height = 1080;
constexpr int Frames = 12, WarmUp = 4;

/// Two cores' processor time, and the clock.
struct Moment
{
  double processor = static_cast<double>(std::clock()) / CLOCKS_PER_SEC / 2.0;
  std::chrono::steady_clock::time_point clock = std::chrono::steady_clock::now();
};

/// Goes by processor time, so that whatever else the machine is busy with changes nothing.
class SteadyPass : public vtkSVORenderPass
{
public:
  static SteadyPass* New();
  vtkTypeMacro(SteadyPass, vtkSVORenderPass);
  Moment begin; // of the frame

  /// Of the frame so far, processor time by the clock's.
  double share() const
  {
    const Moment now;
    const std::chrono::duration<double> passed = now.clock - this->begin.clock;
    return (now.processor - this->begin.processor) / passed.count();
  }

protected:
  void MeasureFrame(double& seconds, double& fixedSeconds, double& shadowSeconds) const override
  {
    this->Superclass::MeasureFrame(seconds, fixedSeconds, shadowSeconds);
    for (double* time : { &seconds, &fixedSeconds, &shadowSeconds })
    {
      *time *= this->share();
    }
  }
};
vtkStandardNewMacro(SteadyPass);

vtkSmartPointer<vtkPolyData> ball(int triangles)
{
  const svobench::Mesh mesh =
    svobench::bumpySphere(static_cast<unsigned>(std::lround(std::sqrt(triangles / 4.0))));
  vtkNew<vtkPoints> points;
  for (const glm::dvec3& p : mesh.points)
  {
    points->InsertNextPoint(p.x, p.y, p.z);
  }
  vtkNew<vtkCellArray> polygons;
  for (const glm::uvec3& t : mesh.triangles)
  {
    const vtkIdType ids[3] = { t.x, t.y, t.z };
    polygons->InsertNextCell(3, ids);
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(polygons);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(data);
  normals->SplittingOff();
  normals->Update();
  return normals->GetOutput();
}

void show(vtkRenderer* renderer, vtkPolyData* mesh)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
}

/// Seconds of two cores.
double draw(
  vtkRenderWindow* window, SteadyPass* pass, double rate, std::vector<unsigned char>& picture)
{
  window->SetDesiredUpdateRate(rate);
  pass->begin = Moment();
  window->Render();
  const double seconds = Moment().processor - pass->begin.processor;
  vtkNew<vtkUnsignedCharArray> pixels;
  window->GetPixelData(0, 0, Width - 1, Height - 1, 0, pixels);
  picture.assign(
    pixels->GetPointer(0), pixels->GetPointer(0) + 3 * static_cast<std::size_t>(Width) * Height);
  return seconds;
}

double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void run(vtkRenderWindow* window, vtkRenderer* renderer, SteadyPass* pass, double rate)
{
  std::vector<double> seconds, mean, wrong, distance, accepted;
  std::vector<std::vector<unsigned char>> shown;
  const auto turn = [&](int frame)
  {
    const double angle = glm::radians(3.0 * frame);
    renderer->GetActiveCamera()->SetPosition(5.0 * std::sin(angle), -5.0 * std::cos(angle), 2.5);
  };
  for (int frame = 0; frame < WarmUp + Frames; ++frame)
  {
    turn(frame);
    shown.emplace_back();
    seconds.push_back(draw(window, pass, rate, shown.back()));
    distance.push_back(pass->GetImageSampleDistance());
    accepted.push_back(pass->GetAcceptedPixelError());
  }
  for (int frame = WarmUp; frame < WarmUp + Frames; ++frame)
  {
    turn(frame);
    std::vector<unsigned char> still;
    draw(window, pass, 0.001, still);
    const performance::PictureDifference off(still, shown[frame]);
    mean.push_back(off.mean);
    wrong.push_back(100.0 * off.wrong);
  }
  const auto timed = [](const std::vector<double>& all) {
    return median({ all.begin() + WarmUp, all.end() });
  };
  std::printf("%4.0f Hz: %6.1f ms, mean difference %6.3f of 255, "
              "%6.2f %% of pixels differ; rays "
              "%.1f pixels apart, accepted error %.1f\n",
    rate, 1e3 * timed(seconds), median(mean), median(wrong), timed(distance), timed(accepted));
}
}

int main(int argc, char* argv[])
{
  const int triangles = argc > 1 ? std::atoi(argv[1]) : 1000000;
  const std::string technique = argc > 2 ? argv[2] : "buffer";
  vtkNew<vtkRenderer> renderer;
  show(renderer, ball(std::max(triangles, 64)));
  vtkNew<vtkPlaneSource> ground;
  ground->SetOrigin(-4.0, -4.0, -1.2);
  ground->SetPoint1(4.0, -4.0, -1.2);
  ground->SetPoint2(-4.0, 4.0, -1.2);
  ground->Update();
  show(renderer, ground->GetOutput());
  vtkNew<vtkLightKit> kit;
  kit->AddLightsToRenderer(renderer);
  vtkNew<SteadyPass> pass;
  pass->SetShadowTechnique(technique == "none" ? 0
      : technique == "rays"                    ? 2
      : technique == "automatic"               ? 3
                                               : 1);
  pass->SetBuildInBackground(false);
  renderer->SetPass(pass);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(true);
  window->SetMultiSamples(0);
  window->SetSize(Width, Height);
  window->AddRenderer(renderer);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetPosition(0.0, -5.0, 2.5);
  camera->SetFocalPoint(0.0, 0.0, -0.2);
  renderer->ResetCameraClippingRange(-10.0, 10.0, -10.0, 10.0, -10.0, 10.0);
  window->Render();
  std::vector<double> rates;
  for (int i = 3; i < argc; ++i)
  {
    rates.push_back(std::atof(argv[i]));
  }
  for (const double rate : rates.empty() ? std::vector<double>{ 5.0, 10.0, 20.0 } : rates)
  {
    run(window, renderer, pass, rate);
  }
  return 0;
}
