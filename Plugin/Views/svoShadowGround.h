// A ground below what a view shows, of which the shadows alone are seen.
#ifndef svoShadowGround_h
#define svoShadowGround_h

#include "vtkNew.h"

class vtkActor;
class vtkBoundingBox;
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

  /// Before each frame: puts it below `data` (world coordinates) along an axis, 0, 1 or 2, twice as
  /// far to all sides as the diagonal is long: room for shadows from 20 degrees above the horizon.
  /// Widens the camera's clipping range to show it. An empty box, or axis -1: there is none.
  void place(vtkRenderer* renderer, const vtkBoundingBox& data, int axis);

  /// Takes it out of the renderer.
  void remove(vtkRenderer* renderer);

private:
  vtkNew<vtkActor> Actor;
};
}

#endif
