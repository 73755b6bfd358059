#include "svoSceneLights.h"

#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkRenderer.h"
#include "vtkSVORenderPass.h"

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
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
  light.id = reinterpret_cast<std::uintptr_t>(source);
  return light;
}

double brightness(const Light& light)
{
  return light.color.r + light.color.g + light.color.b;
}
}

std::vector<Light> lightsOf(vtkRenderer* renderer, bool& headlightOnly)
{
  std::vector<Light> lights;
  std::vector<std::size_t> undecided; // camera lights that nobody gave an answer for
  headlightOnly = true;
  vtkCollectionSimpleIterator iterator;
  vtkLightCollection* collection = renderer->GetLights();
  collection->InitTraversal(iterator);
  while (vtkLight* source = collection->GetNextLight(iterator))
  {
    if (!source->GetSwitch())
    {
      continue;
    }
    Light light = lightOf(source);
    light.castShadow = vtkSVORenderPass::GetCastShadow(source);
    vtkInformation* keys = source->GetInformation();
    const bool answered = keys && keys->Has(vtkSVORenderPass::CAST_SHADOW());
    headlightOnly = headlightOnly && source->LightTypeIsHeadlight() && !answered;
    if (source->LightTypeIsCameraLight() && !answered)
    {
      undecided.push_back(lights.size());
    }
    lights.push_back(light);
  }

  std::size_t key = 0;
  for (std::size_t i = 1; i < undecided.size(); ++i)
  {
    if (brightness(lights[undecided[i]]) > brightness(lights[undecided[key]]))
    {
      key = i;
    }
  }
  for (std::size_t i = 0; i < undecided.size(); ++i)
  {
    lights[undecided[i]].castShadow = i == key;
  }
  headlightOnly = headlightOnly && !lights.empty();
  return lights;
}
}
