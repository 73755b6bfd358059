// A stage as VTK draws it: rasterised, with vtkShadowMapPass, and with vtkSVORenderPass.
#ifndef accuracyWindow_h
#define accuracyWindow_h

#include "accuracyMetrics.h"
#include "accuracyStage.h"

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

namespace accuracy
{
class Window
{
public:
  explicit Window(const Stage& stage);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  vtkRenderer* renderer() { return this->Renderer; }
  /// VTK's own picture, without shadows.
  void useRasterizer();
  /// Directional and spot lights only: others cast nothing in it.
  void useShadowMapPass(int resolution);
  /// vtkSVORenderPass with its defaults, nothing kept from frame to frame.
  void useOctrees(int level);

  /// Draws `repeat` frames after one that warms up. Into the row: frameMs and processorMs of the
  /// fastest; of vtkSVORenderPass also collectMs, traceMs, shadowMs, presentMs, octreeKiB,
  /// layerKiB.
  Picture draw(int repeat, Row& row);

private:
  void removePass();

  vtkNew<vtkRenderWindow> Target;
  vtkNew<vtkRenderer> Renderer;
};
}

#endif
