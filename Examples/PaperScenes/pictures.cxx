// Writes pictures and movie frames.
#include "pictures.h"

#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cstdio>

namespace paper
{
namespace
{
constexpr double orbitDegrees = 16;
}

bool writePicture(vtkRenderWindow* window, const std::string& path)
{
  window->Render();
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(window);
  grab->SetInputBufferTypeToRGB();
  grab->ReadFrontBufferOff();
  grab->ShouldRerenderOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(grab->GetOutputPort());
  writer->SetFileName(path.c_str());
  writer->SetCompressionLevel(3);
  writer->Write();
  return writer->GetErrorCode() == 0;
}

int movieShare(const Experiment& experiment, const std::vector<const Experiment*>& all, int frames)
{
  const int shares = static_cast<int>(all.size()) + 1;
  return &experiment == all.back() ? frames - (shares - 2) * (frames / shares) : frames / shares;
}

bool writeMovieFrames(vtkRenderWindow* window, Scene& scene, const std::string& folder, int first,
  int frames, const std::function<void()>& afterFrame)
{
  const std::vector<Viewpoint>& views = scene.experiment().shownViews();
  for (int i = 0; i < frames; ++i)
  {
    const auto count = static_cast<int>(views.size());
    const int shot = std::min(count - 1, i * count / frames);
    const int shotBegin = (shot * frames + count - 1) / count;
    const double within = static_cast<double>(i - shotBegin) * count / frames;
    scene.setView(views[shot], orbitDegrees * (within - 0.5));
    scene.setFrame(i);
    char name[32];
    std::snprintf(name, sizeof(name), "/frame-%05d.png", first + i);
    if (!writePicture(window, folder + name))
    {
      return false;
    }
    afterFrame();
  }
  return true;
}
}
