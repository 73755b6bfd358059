// A ground below what a view shows, of which the shadows alone are seen.
#ifndef svoShadowGround_h
#define svoShadowGround_h

#include "vtkNew.h"

class vtkActor;
class vtkMultiProcessController;
class vtkRenderer;

namespace svo
{
class ShadowGround
{
public:
  ShadowGround();
  ~ShadowGround();
  ShadowGround(const ShadowGround&) = delete;
  ShadowGround& operator=(const ShadowGround&) = delete;

  /// Before each frame: puts it below the data along an axis, 0, 1 or 2, twice as far to all sides
  /// as the data's diagonal is long: room for shadows from 20 degrees above the horizon. Widens the
  /// camera's clipping range to show it. Axis -1, or no data: there is none.
  /// `processes` hold the data together, and all of them call this; null: this one has all.
  void place(vtkRenderer* renderer, int axis, vtkMultiProcessController* processes);

  /// After each frame: it is not part of what the view shows.
  void endFrame();

  /// Takes it out of the renderer.
  void remove(vtkRenderer* renderer);

private:
  vtkNew<vtkActor> Actor;
};
}

#endif
