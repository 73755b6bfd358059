// Viewport and background of a pass that has no vtkCameraPass above it, as vtkRenderStepsPass sets
// them up.
#ifndef svoOwnCamera_h
#define svoOwnCamera_h

#include "vtkOpenGLState.h"

#include <optional>

class vtkRenderPass;
class vtkRenderState;

namespace svo
{
/// The camera of a frame of a pass. Its destructor gives OpenGL's viewport back to the passes
/// around it.
class OwnCamera
{
public:
  OwnCamera(const vtkRenderState* state, vtkRenderPass* pass);

  /// Sets the camera up, unless a vtkCameraPass above the pass has. May be called again, after
  /// other frames have been drawn.
  void setUp() const;

private:
  struct Saved
  {
    explicit Saved(vtkOpenGLState* state);
    vtkOpenGLState::ScopedglViewport viewport;
    vtkOpenGLState::ScopedglScissor scissor;
    vtkOpenGLState::ScopedglEnableDisable scissorTest;
  };

  const vtkRenderState* State;
  bool Needed;
  std::optional<Saved> Before;
};
}

#endif
