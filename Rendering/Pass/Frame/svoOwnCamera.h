// Who sets up viewport and background: the pass itself, wherever vtkRenderStepsPass would.
#ifndef svoOwnCamera_h
#define svoOwnCamera_h

#include "vtkOpenGLState.h"

#include <optional>

class vtkRenderPass;
class vtkRenderState;

namespace svo
{
/// The camera of a frame of a pass, while that lasts. Passes around it find OpenGL's viewport as it
/// was.
class OwnCamera
{
public:
  OwnCamera(const vtkRenderState* state, vtkRenderPass* pass);

  /// Sets it up, unless a vtkCameraPass above the pass has: others may have drawn since.
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
