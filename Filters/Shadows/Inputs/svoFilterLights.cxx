#include "svoFilterLights.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace svo
{
namespace
{
/// A light as the rays have it. Off, with a reason in `problem`, where it has no place in the
/// world: it "moves with a camera ...". A light that is switched off has no problem.
WeightedLight shadowLight(vtkLight* source, double weight, std::string& problem)
{
  WeightedLight result;
  Light& light = result.light;
  result.weight = weight;
  double from[3], to[3];
  source->GetTransformedPosition(from);
  source->GetTransformedFocalPoint(to);
  light.position = { from[0], from[1], from[2] };
  const glm::dvec3 axis = glm::dvec3(to[0], to[1], to[2]) - light.position;
  const double length = glm::length(axis);
  light.direction = length > 0.0 ? axis / length : glm::dvec3(0.0);
  light.coneAngle = source->GetConeAngle();
  if (source->GetPositional())
  {
    // VTK draws all cones from 90 degrees on as none.
    light.kind = light.coneAngle < 90.0 ? Light::Kind::Spot : Light::Kind::Point;
  }
  result.cone = light.hasCone() ? std::cos(glm::radians(light.coneAngle)) : -2.0;
  result.on = source->GetSwitch() != 0;
  if (!result.on)
  {
    return result;
  }
  const bool aimed = length > 0.0 && std::isfinite(length);
  const bool placed = std::isfinite(from[0]) && std::isfinite(from[1]) && std::isfinite(from[2]);
  if (!source->LightTypeIsSceneLight())
  {
    problem = "moves with a camera, and there is none here";
  }
  else if (!placed || (!aimed && light.kind != Light::Kind::Point))
  {
    problem = "has no direction: its position and focal point are the same, or not finite";
  }
  else if (!std::isfinite(weight))
  {
    problem = "has a weight that is not finite";
  }
  result.on = problem.empty();
  return result;
}
}

std::vector<WeightedLight> weightedLights(
  const std::vector<FilterLight>& lights, bool cosine, std::map<std::string, std::string>& wrong)
{
  std::vector<WeightedLight> result;
  for (const FilterLight& light : lights)
  {
    std::string problem;
    result.push_back(shadowLight(light.light, cosine ? light.withCosine : light.weight, problem));
    if (!problem.empty())
    {
      std::string& who = wrong[problem];
      who += (who.empty() ? "" : ", ") + std::to_string(result.size() - 1);
    }
  }
  return result;
}
}
