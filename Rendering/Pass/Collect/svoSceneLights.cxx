#include "svoSceneLights.h"

#include "svoAffineMatrix.h"
#include "svoPropKeys.h"

#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkNew.h"
#include "vtkRenderer.h"
#include "vtkWeakReference.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
/// Degrees; it shines from all over the hemisphere, nearly.
constexpr double WidestDisc = 170.0;

/// VTK's renderer transforms a light's direction as it does normals.
void transform(const glm::dmat4& world, Light& light)
{
  if (world == glm::dmat4(1.0) || kindOf(world) != MatrixKind::Affine)
  {
    return;
  }
  light.position = glm::dvec3(world * glm::dvec4(light.position, 1.0));
  const glm::dvec3 direction = light.direction * stableInverse(glm::dmat3(world));
  const double length = glm::length(direction);
  light.direction = length > 0.0 ? direction / length : glm::dvec3(0.0);
}

Light lightOf(vtkLight* source)
{
  Light light;
  const double* position = source->GetTransformedPosition();
  light.position = { position[0], position[1], position[2] };
  const double* focalPoint = source->GetTransformedFocalPoint();
  const glm::dvec3 axis = glm::dvec3(focalPoint[0], focalPoint[1], focalPoint[2]) - light.position;
  const double length = glm::length(axis);
  light.direction = length > 0.0 ? axis / length : glm::dvec3(0.0);
  // In the words of VTK's shaders, to whom angles are floats.
  if (source->GetPositional())
  {
    light.kind =
      static_cast<float>(source->GetConeAngle()) < 90.0f ? Light::Kind::Spot : Light::Kind::Point;
  }
  light.headlight = source->LightTypeIsHeadlight() && !source->GetPositional();
  light.coneAngle = source->GetConeAngle();
  light.exponent = source->GetExponent();
  const double* attenuation = source->GetAttenuationValues();
  light.attenuation = { attenuation[0], attenuation[1], attenuation[2] };
  const double* diffuse = source->GetDiffuseColor();
  light.color =
    glm::vec3(diffuse[0], diffuse[1], diffuse[2]) * static_cast<float>(source->GetIntensity());
  light.size = lightSizeOf(source);
  light.size = light.atInfinity() ? std::min(light.size, WidestDisc) : light.size;
  light.id = reinterpret_cast<std::uintptr_t>(source);
  return light;
}

/// False of a light that lights nothing: directional or a spot without a direction, or without a
/// place.
bool aims(const Light& light)
{
  const auto finite = [](const glm::dvec3& v)
  { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); };
  return finite(light.position) && finite(light.direction) &&
    (light.kind == Light::Kind::Point || light.direction != glm::dvec3(0.0));
}

double brightness(const Light& light)
{
  return light.color.r + light.color.g + light.color.b;
}

/// What somebody said about a light; `otherwise` if nobody did.
bool answerOf(vtkLight* light, bool otherwise)
{
  vtkInformation* keys = light->GetInformation();
  vtkInformationIntegerKey* key = castShadowKey();
  return keys && keys->Has(key) ? keys->Get(key) != 0 : otherwise;
}

bool isAnswered(vtkLight* light)
{
  return answerOf(light, true) == answerOf(light, false);
}

/// Left on camera lights: the renderer among whose lights they are.
vtkInformationObjectBaseKey* placeKey()
{
  static auto* const key = vtkInformationObjectBaseKey::MakeKey("LIGHT_PLACE", "vtkSVO");
  return key;
}

/// Null if it is not known, or gone.
vtkRenderer* placeOf(vtkLight* light)
{
  vtkInformation* keys = light->GetInformation();
  auto* place = keys ? vtkWeakReference::SafeDownCast(keys->Get(placeKey())) : nullptr;
  return place ? vtkRenderer::SafeDownCast(place->Get()) : nullptr;
}

/// Calls visit(light) for those of a renderer that are switched on.
template <class Visit>
void eachLight(vtkRenderer* renderer, const Visit& visit)
{
  vtkCollectionSimpleIterator iterator;
  vtkLightCollection* lights = renderer->GetLights();
  lights->InitTraversal(iterator);
  while (vtkLight* light = lights->GetNextLight(iterator))
  {
    if (light->GetSwitch())
    {
      visit(light);
    }
  }
}

/// Of a renderer's camera lights that nobody gave an answer for the one that casts.
vtkLight* keyLightOf(vtkRenderer* renderer)
{
  vtkLight* key = nullptr;
  eachLight(renderer,
    [&](vtkLight* light)
    {
      if (light->LightTypeIsCameraLight() && !isAnswered(light) && aims(lightOf(light)) &&
        (!key || brightness(lightOf(light)) > brightness(lightOf(key))))
      {
        key = light;
      }
    });
  return key;
}
}

std::vector<Light> lightsOf(
  vtkRenderer* renderer, const glm::dmat4& world, const LightWords& words, LightNotes& notes)
{
  std::vector<Light> lights;
  notes = LightNotes();
  const vtkLight* const key = keyLightOf(renderer);
  bool headlightOnly = true;
  eachLight(renderer,
    [&](vtkLight* source)
    {
      Light light = lightOf(source);
      transform(world, light);
      const bool aiming = aims(light);
      notes.aimless = notes.aimless || !aiming;
      light.castShadow =
        aiming && answerOf(source, source->LightTypeIsSceneLight() || source == key);
      headlightOnly = headlightOnly && source->LightTypeIsHeadlight() && !isAnswered(source);
      if (source->LightTypeIsCameraLight() && placeOf(source) != renderer)
      {
        vtkInformation* keys = keysOf(source);
        if (!keys->Has(placeKey()))
        {
          keys->Set(placeKey(), vtkNew<vtkWeakReference>());
        }
        vtkWeakReference::SafeDownCast(keys->Get(placeKey()))->Set(renderer);
      }
      lights.push_back(light);
      const std::string kind = light.headlight ? words.headlight(source)
        : light.kind == Light::Kind::Point     ? "point"
        : light.kind == Light::Kind::Spot      ? "spot"
                                               : "directional";
      const std::string name = words.name(source);
      notes.text += (name.empty() ? std::to_string(lights.size()) + ". " : name + ", ") + kind +
        (light.castShadow ? ": casts shadows\n"
            : aiming      ? ": casts none\n"
                          : ": has no direction, casts none\n");
    });
  notes.headlightOnly = headlightOnly && !lights.empty();
  return lights;
}

bool hasCameraLight(vtkRenderer* renderer)
{
  bool any = false;
  eachLight(renderer, [&](vtkLight* light) { any = any || light->LightTypeIsCameraLight(); });
  return any;
}

bool hasSoftLight(vtkRenderer* renderer)
{
  bool any = false;
  eachLight(
    renderer, [&](vtkLight* light) { any = any || (lightOf(light).soft() && castsShadow(light)); });
  return any;
}

bool castsShadow(vtkLight* light)
{
  if (!aims(lightOf(light)))
  {
    return false;
  }
  if (light->LightTypeIsCameraLight() && !isAnswered(light))
  {
    vtkRenderer* renderer = placeOf(light);
    return !renderer || !renderer->GetLights()->IsItemPresent(light) ||
      keyLightOf(renderer) == light;
  }
  return answerOf(light, light->LightTypeIsSceneLight());
}
}
