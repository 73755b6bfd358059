// Whether a context is worth drawing in: by what its renderer is called, and by how fast rays are
// in it.
#ifndef svoBackendChoice_h
#define svoBackendChoice_h

#include "svoParallel.h"
#include "vtkSVOOpenGLModule.h"

#include <functional>
#include <string>

class vtkOpenGLRenderWindow;

namespace svo
{
/// True of an OpenGL that runs on the processor, by its GL_RENDERER.
VTKSVOOPENGL_EXPORT bool isSoftwareRenderer(const std::string& name);

/// Pixels a second that show a surface and send a ray to a light each.
struct RayRates
{
  double openGL = 0.0;   // of the mask alone: the rasteriser takes next to nothing beside it
  double cpu = 0.0;      // of a frame while the camera moves
  std::string complaint; // why there is nothing of OpenGL; empty if all is well
};

/// Of small pictures of waves in the light of a low sun. The window's context is current, and as it
/// was afterwards.
VTKSVOOPENGL_EXPORT RayRates measureRays(
  vtkOpenGLRenderWindow* window, const ParallelFor& parallelFor);

struct BackendChoice
{
  bool openGL = false;
  std::string complaint; // why it cannot be OpenGL; empty if it can, or is merely slower
};

/// Software takes the CPU, a GPU OpenGL; with `rays` to lights unless the CPU has them faster as
/// `measure` says, which is asked once in the life of a context. The window's is current.
VTKSVOOPENGL_EXPORT BackendChoice chooseBackend(
  vtkOpenGLRenderWindow* window, bool rays, const std::function<RayRates()>& measure);

/// The same for a renderer of any name.
VTKSVOOPENGL_EXPORT BackendChoice chooseBackend(vtkOpenGLRenderWindow* window,
  const std::string& renderer, bool rays, const std::function<RayRates()>& measure);
}

#endif
