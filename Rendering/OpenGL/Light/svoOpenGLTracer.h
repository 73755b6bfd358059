// The tracer of windows that VTK draws on a GPU: VTK rasterises, octrees in the GPU's memory answer
// for the light.
#ifndef svoOpenGLTracer_h
#define svoOpenGLTracer_h

#include "svoTracer.h"
#include "vtkSVOOpenGLModule.h"

#include <memory>

namespace svo
{
/// A tracer that does what `other` does, but for frames whose settings ask for light code
/// (FrameNeeds::lightCode): code has one ray a fragment and light meet the triangles of all
/// octrees, exactly, and others trace the octrees of planes that are seen. No other instance is to
/// be seen. Where it cannot, the frame gets `other`'s shadow maps, and LightCode::complaint says
/// why.
VTKSVOOPENGL_EXPORT std::unique_ptr<Tracer> makeOpenGLTracer(std::unique_ptr<Tracer> other);
}

#endif
