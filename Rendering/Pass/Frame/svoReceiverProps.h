// What VTK draws of a scene's receivers, drawn once more so that they say where they lie.
#ifndef svoReceiverProps_h
#define svoReceiverProps_h

#include "vtkType.h"

#include <utility>
#include <vector>

class vtkProp;
class vtkRenderState;
class vtkViewport;

namespace svo
{
struct CollectedScene;

class ReceiverProps
{
public:
  /// Takes those of a frame's props, for its length. They have keys. True if they are the last
  /// frame's, unchanged.
  bool take(const vtkRenderState& drawn, const CollectedScene& collected);

  /// What is opaque of them, or what is `translucent`: as if it were opaque, the nearest counts.
  void draw(vtkViewport* viewport, bool translucent) const;

private:
  std::vector<std::pair<vtkProp*, vtkMTimeType>> Props;
};
}

#endif
