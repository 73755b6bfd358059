// What benchmarks do with VTK's windows, and with times.
#ifndef performanceWindow_h
#define performanceWindow_h

#include <vtkCameraPass.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderPassCollection.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSequencePass.h>
#include <vtkShadowMapBakerPass.h>
#include <vtkShadowMapPass.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <string>
#include <vector>

namespace performance
{
inline double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[values.size() / 2];
}

/// VTK's own shadows, with maps of 2048 x 2048.
inline void useShadowMaps(vtkRenderer* renderer)
{
  vtkNew<vtkShadowMapBakerPass> baker;
  baker->SetResolution(2048);
  vtkNew<vtkShadowMapPass> maps;
  maps->SetShadowMapBakerPass(baker);
  vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(baker);
  passes->AddItem(maps);
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(passes);
  vtkNew<vtkCameraPass> camera;
  camera->SetDelegatePass(sequence);
  renderer->SetPass(camera);
}

inline void writePicture(vtkRenderWindow* window, const std::string& path)
{
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(path.c_str());
  writer->Write();
}
}

#endif
