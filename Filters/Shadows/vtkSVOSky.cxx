#include "vtkSVOSky.h"

#include "svoSkyDirections.h"
#include "vtkSVOShadowFilter.h"

#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

vtkStandardNewMacro(vtkSVOSky);

//------------------------------------------------------------------------------
const char* vtkSVOSky::GetTypeAsString()
{
  return this->Type == OVERCAST ? "Overcast" : "Uniform";
}

//------------------------------------------------------------------------------
int vtkSVOSky::AddLights(vtkSVOShadowFilter* filter)
{
  const glm::dvec3 given(this->Up[0], this->Up[1], this->Up[2]);
  const double length = glm::length(given);
  if (!(length > 0.0) || !std::isfinite(length))
  {
    vtkErrorMacro("There is no sky: its up is zero, or not finite.");
    return 0;
  }
  if (!filter)
  {
    vtkErrorMacro("There is no filter to add lights to.");
    return 0;
  }
  const glm::dvec3 up = given / length;
  const glm::dvec3 other = std::abs(up.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(other, up));
  const glm::dvec3 v = glm::cross(up, u);
  const std::vector<glm::dvec3> directions = svo::skyDirections(this->NumberOfDirections);
  const auto brightness = [this](double sine)
  { return this->Type == OVERCAST ? svo::overcastSky(sine) : 1.0; };
  double whole = 0.0, wholeCosine = 0.0; // of a level place
  for (const glm::dvec3& d : directions)
  {
    whole += brightness(d.z);
    wholeCosine += brightness(d.z) * d.z;
  }
  for (const glm::dvec3& d : directions)
  {
    const glm::dvec3 to = d.x * u + d.y * v + d.z * up;
    vtkNew<vtkLight> light;
    light->SetPosition(to.x, to.y, to.z);
    filter->SetWeights(
      filter->AddLight(light), brightness(d.z) / whole, brightness(d.z) / wholeCosine);
  }
  return static_cast<int>(directions.size());
}

//------------------------------------------------------------------------------
void vtkSVOSky::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Type: " << this->GetTypeAsString() << "\n";
  os << indent << "NumberOfDirections: " << this->NumberOfDirections << "\n";
  os << indent << "Up: (" << this->Up[0] << ", " << this->Up[1] << ", " << this->Up[2] << ")\n";
}
