// A renderer's camera as a view of the tracer.
#ifndef svoCameraView_h
#define svoCameraView_h

#include "svoView.h"

#include <glm/mat4x4.hpp>

class vtkMatrix4x4;
class vtkRenderState;
class vtkRenderer;

namespace svo
{
/// VTK's matrices act on column vectors and are stored by rows.
glm::dmat4 toGlm(const vtkMatrix4x4* matrix);

/// Size in pixels of what a render state draws: its framebuffer, or this tile of the renderer's
/// viewport.
void sizeOf(const vtkRenderState* state, int& width, int& height);

/// VTK's world to the scene's, so that the view is rigid: actors' matrices are multiplied by it.
/// Identity, unless the camera has a ModelTransformMatrix, or a UserViewTransform that is not
/// rigid.
glm::dmat4 sceneTransform(vtkRenderer* renderer);

/// The rays of the renderer's active camera. They come from the projection matrix, so window
/// centres, shears, stereo eyes, explicit projections and tiles are all in them. False if the size
/// is zero or the matrices cannot be inverted.
bool viewOfCamera(vtkRenderer* renderer, int width, int height, View& view);
}

#endif
