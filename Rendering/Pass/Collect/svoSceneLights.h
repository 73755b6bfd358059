// A renderer's lights as lights of the tracer.
#ifndef svoSceneLights_h
#define svoSceneLights_h

#include "svoScene.h"

#include <vector>

#include <glm/mat4x4.hpp>

class vtkLight;
class vtkRenderer;

namespace svo
{
/// The lights that are switched on, in the renderer's order, which is the order that VTK's shaders
/// number them in, in a world that `world` makes of VTK's. To be called when the renderer has
/// placed its headlights and camera lights. `headlightOnly` says that no light can cast because all
/// of them are headlights.
std::vector<Light> lightsOf(vtkRenderer* renderer, const glm::dmat4& world, bool& headlightOnly);

/// Whether a light casts while it is switched on. A camera light without a key of its own
/// (svoPropKeys.h) is compared with the others of the renderer whose lights were collected last.
bool castsShadow(vtkLight* light);
}

#endif
