#include "vtkSVOExposureFilter.h"

#include "svoNumberSetting.h"
#include "vtkSVOSky.h"
#include "vtkSVOSunPath.h"

#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <sstream>

vtkStandardNewMacro(vtkSVOExposureFilter);

namespace
{
void copyPlace(const std::vector<std::array<double, 3>>& places, int index, double place[3])
{
  const bool exists = index >= 0 && index < static_cast<int>(places.size());
  for (std::size_t i = 0; i < 3; ++i)
  {
    place[i] = exists ? places[static_cast<std::size_t>(index)][i] : 0.0;
  }
}
}

//------------------------------------------------------------------------------
const char* vtkSVOExposureFilter::GetLightSourceAsString()
{
  const char* const names[] = { "SunPath", "Sky", "Directions", "Positions" };
  return names[this->LightSource];
}

//------------------------------------------------------------------------------
svoSetSunMacro(vtkSVOExposureFilter);

//------------------------------------------------------------------------------
void vtkSVOExposureFilter::AddDirection(double x, double y, double z)
{
  this->Directions.push_back({ x, y, z });
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkSVOExposureFilter::RemoveAllDirections()
{
  this->Directions.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkSVOExposureFilter::GetDirection(int index, double direction[3])
{
  copyPlace(this->Directions, index, direction);
}

//------------------------------------------------------------------------------
void vtkSVOExposureFilter::AddPosition(double x, double y, double z)
{
  this->Positions.push_back({ x, y, z });
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkSVOExposureFilter::RemoveAllPositions()
{
  this->Positions.clear();
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkSVOExposureFilter::GetPosition(int index, double position[3])
{
  copyPlace(this->Positions, index, position);
}

//------------------------------------------------------------------------------
// What this modifies is older than the output that it is for.
void vtkSVOExposureFilter::PrepareLights()
{
  this->RemoveAllLights();
  if (this->LightSource == SUN_PATH)
  {
    vtkNew<vtkSVOSunPath> path;
    path->SetDate(this->Date[0], this->Date[1], this->Date[2]);
    path->SetLatitude(this->Latitude);
    path->SetLongitude(this->Longitude);
    path->SetTimeZone(this->TimeZone);
    path->SetStartHour(this->StartHour);
    path->SetEndHour(this->EndHour);
    path->SetStep(this->Step);
    path->SetNumberOfDays(this->NumberOfDays);
    path->SetBinWidth(this->BinWidth);
    path->SetNorth(this->North);
    path->SetUp(this->Up);
    path->AddLights(this);
    return; // a day without sun is no mistake
  }
  if (this->LightSource == SKY)
  {
    vtkNew<vtkSVOSky> sky;
    sky->SetType(this->SkyType);
    sky->SetNumberOfDirections(this->NumberOfSkyDirections);
    sky->SetUp(this->Up);
    sky->AddLights(this);
    return;
  }
  const bool positional = this->LightSource == POSITIONS;
  for (const auto& place : positional ? this->Positions : this->Directions)
  {
    vtkNew<vtkLight> light;
    light->SetPosition(place[0], place[1], place[2]);
    light->SetPositional(positional);
    light->SetConeAngle(180.0);
    std::ostringstream name;
    name << (positional ? "at (" : "from (") << place[0] << ", " << place[1] << ", " << place[2]
         << ")";
    this->SetLightName(this->AddLight(light), name.str().c_str());
  }
  if (this->GetNumberOfLights() == 0)
  {
    vtkWarningMacro("Nothing arrives, as there are no " << (positional ? "positions" : "directions")
                                                        << " of lights.");
  }
}

//------------------------------------------------------------------------------
void vtkSVOExposureFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LightSource: " << this->GetLightSourceAsString() << "\n";
  os << indent << "Date: " << this->Date[0] << "-" << this->Date[1] << "-" << this->Date[2] << "\n";
  os << indent << "Latitude: " << this->Latitude << "\n";
  os << indent << "Longitude: " << this->Longitude << "\n";
  os << indent << "TimeZone: " << this->TimeZone << "\n";
  os << indent << "StartHour: " << this->StartHour << "\n";
  os << indent << "EndHour: " << this->EndHour << "\n";
  os << indent << "Step: " << this->Step << "\n";
  os << indent << "NumberOfDays: " << this->NumberOfDays << "\n";
  os << indent << "BinWidth: " << this->BinWidth << "\n";
  os << indent << "North: (" << this->North[0] << ", " << this->North[1] << ", " << this->North[2]
     << ")\n";
  os << indent << "Up: (" << this->Up[0] << ", " << this->Up[1] << ", " << this->Up[2] << ")\n";
  os << indent << "SkyType: " << (this->SkyType == OVERCAST ? "Overcast\n" : "Uniform\n");
  os << indent << "NumberOfSkyDirections: " << this->NumberOfSkyDirections << "\n";
  os << indent << "NumberOfDirections: " << this->GetNumberOfDirections() << "\n";
  os << indent << "NumberOfPositions: " << this->GetNumberOfPositions() << "\n";
}
