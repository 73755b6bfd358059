// A renderer that a pass is attached to, but not set on.
#ifndef svoAttachedRenderer_h
#define svoAttachedRenderer_h

#include "vtkSVOPresenter.h"

#include "vtkCommand.h"
#include "vtkCuller.h"
#include "vtkRenderer.h"
#include "vtkSmartPointer.h"
#include "vtkWeakPointer.h"

#include <functional>

class vtkProp;

namespace svo
{
/// Has the pass hear of the renderer's frames and its end, puts the presenter first in its list of
/// props, and takes what is traced from what it draws. The props stay visible and in the list,
/// where bounds, pickers and selectors find them.
class AttachedRenderer
{
public:
  AttachedRenderer(vtkRenderer* renderer, vtkCommand* events, vtkSVOPresenter* presenter,
    std::function<bool(vtkProp*)> traces);
  ~AttachedRenderer();
  AttachedRenderer(const AttachedRenderer&) = delete;
  AttachedRenderer& operator=(const AttachedRenderer&) = delete;

  /// Null if it is gone, and another one may be in its place.
  vtkRenderer* renderer() const { return this->Renderer; }

  /// Before each frame: some hosts remove all cullers.
  void addCuller();

  /// The renderer is being deleted.
  void forget() { this->Renderer = nullptr; }

  bool leaving = false; // detached in the midst of a frame: as soon as that ends

private:
  vtkWeakPointer<vtkRenderer> Renderer;
  vtkSmartPointer<vtkCommand> Events;
  vtkSmartPointer<vtkSVOPresenter> Presenter;
  vtkSmartPointer<vtkCuller> Culler;
};
}

#endif
