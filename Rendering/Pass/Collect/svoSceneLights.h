// A renderer's lights as lights of the tracer.
#ifndef svoSceneLights_h
#define svoSceneLights_h

#include "svoLight.h"

#include <functional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

class vtkLight;
class vtkRenderer;

namespace svo
{
/// What is to be said of a renderer's lights.
struct LightNotes
{
  std::string text;           // a line for each: its kind, and whether it casts
  bool headlightOnly = false; // no light can cast because all of them are headlights
  bool aimless = false; // one has no direction, or no place that is finite, and lights nothing
};

/// What a host calls lights.
struct LightWords
{
  using Of = std::function<std::string(vtkLight*)>;
  Of headlight = [](vtkLight*) { return "headlight"; }; // the kind of a headlight
  Of name = [](vtkLight*) { return std::string(); };    // empty: its number
};

/// The lights of a renderer that are switched on, in its order, which is the order that VTK's
/// shaders number them in, in a world that `world` makes of VTK's. To be called when the renderer
/// has placed its headlights and camera lights.
std::vector<Light> lightsOf(
  vtkRenderer* renderer, const glm::dmat4& world, const LightWords& words, LightNotes& notes);

/// True if a light that is on moves with the camera, so that nothing seen from it outlives a frame.
bool hasCameraLight(vtkRenderer* renderer);
/// ... one that casts and has a size.
bool hasSoftLight(vtkRenderer* renderer);

/// Whether a light casts while it is switched on. A camera light without a key of its own
/// (svoPropKeys.h) is compared with the others of the renderer whose lights were collected last.
bool castsShadow(vtkLight* light);
}

#endif
