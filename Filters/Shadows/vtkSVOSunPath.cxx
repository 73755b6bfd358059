#include "vtkSVOSunPath.h"

#include "svoNumberSetting.h"
#include "svoSunBins.h"
#include "svoSunPosition.h"
#include "vtkSVOShadowFilter.h"

#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>

vtkStandardNewMacro(vtkSVOSunPath);

namespace
{
/// East, north and up in the model's coordinates; false, after an error, if these are no axes or
/// there is no such day.
bool axesOf(vtkSVOSunPath* path, glm::dvec3 (&axes)[3])
{
  const int year = path->GetYear(), month = path->GetMonth(), day = path->GetDay();
  if (!svo::isDate(year, month, day))
  {
    vtkErrorWithObjectMacro(
      path, "There is no such day: " << year << "-" << month << "-" << day << ".");
    return false;
  }
  const glm::dvec3 n = glm::make_vec3(path->GetNorth()), u = glm::make_vec3(path->GetUp());
  const glm::dvec3 east = glm::cross(n, u);
  const double sine = glm::length(east);
  if (!(sine > 1e-9 * glm::length(n) * glm::length(u)) || !std::isfinite(sine))
  {
    vtkErrorWithObjectMacro(
      path, "North and up are no axes: they are parallel, zero, or not finite.");
    return false;
  }
  axes[0] = east / sine;
  axes[2] = glm::normalize(u);
  axes[1] = glm::cross(axes[2], axes[0]);
  return true;
}

/// The sun at a local hour: east, north, up.
glm::dvec3 localDirection(vtkSVOSunPath* path, double hour)
{
  const glm::dvec3 sun = svo::sunDirection(
    svo::julianDay(path->GetYear(), path->GetMonth(), path->GetDay(), hour - path->GetTimeZone()),
    path->GetLatitude(), path->GetLongitude());
  return path->GetRefraction() ? svo::refracted(sun) : sun;
}
}

//------------------------------------------------------------------------------
void vtkSVOSunPath::SetDate(int year, int month, int day)
{
  this->SetYear(year);
  this->SetMonth(month);
  this->SetDay(day);
}

//------------------------------------------------------------------------------
svoSetSunMacro(vtkSVOSunPath);

//------------------------------------------------------------------------------
bool vtkSVOSunPath::GetDirection(double hour, double direction[3])
{
  direction[0] = direction[1] = direction[2] = 0.0;
  glm::dvec3 axes[3];
  if (!axesOf(this, axes))
  {
    return false;
  }
  const glm::dvec3 local = localDirection(this, hour);
  for (int i = 0; i < 3; ++i)
  {
    direction[i] = local.x * axes[0][i] + local.y * axes[1][i] + local.z * axes[2][i];
  }
  return local.z > 0.0;
}

//------------------------------------------------------------------------------
double vtkSVOSunPath::GetElevation(double hour)
{
  glm::dvec3 axes[3];
  return axesOf(this, axes) ? svo::elevationOf(localDirection(this, hour)) : 0.0;
}

//------------------------------------------------------------------------------
double vtkSVOSunPath::GetAzimuth(double hour)
{
  glm::dvec3 axes[3];
  return axesOf(this, axes) ? svo::azimuthOf(localDirection(this, hour)) : 0.0;
}

//------------------------------------------------------------------------------
int vtkSVOSunPath::AddLights(vtkSVOShadowFilter* filter)
{
  if (!filter)
  {
    vtkErrorMacro("There is no filter to add lights to.");
    return 0;
  }
  glm::dvec3 axes[3];
  if (!axesOf(this, axes))
  {
    return 0;
  }
  if (!(this->StartHour < this->EndHour))
  {
    vtkErrorMacro("There are no suns: hours from " << this->StartHour << " to " << this->EndHour
                                                   << " are none.");
    return 0;
  }
  svo::SunBins bins(this->BinWidth);
  const double step = this->Step / 60.0;
  const int steps =
    std::max(1, static_cast<int>(std::ceil((this->EndHour - this->StartHour) / step - 1e-9)));
  svo::Date date{ this->Year, this->Month, this->Day };
  for (int day = 0; day < this->NumberOfDays; ++day, date = svo::nextDay(date))
  {
    for (int i = 0; i < steps; ++i)
    {
      const double begin = this->StartHour + i * step;
      const double end = std::min(begin + step, this->EndHour);
      const double hour = 0.5 * (begin + end);
      const glm::dvec3 local = localDirection(this, 24.0 * day + hour);
      if (local.z > 0.0)
      {
        bins.add(local, end - begin, date, hour);
      }
    }
  }
  for (const svo::SunBins::Bin& bin : bins.all())
  {
    const glm::dvec3 to = bin.sum.x * axes[0] + bin.sum.y * axes[1] + bin.sum.z * axes[2];
    vtkNew<vtkLight> light;
    light->SetPosition(to.x, to.y, to.z);
    const int index = filter->AddLight(light);
    filter->SetWeight(index, bin.weight);
    filter->SetLightName(index, bin.name().c_str());
  }
  return static_cast<int>(bins.all().size());
}

//------------------------------------------------------------------------------
void vtkSVOSunPath::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Year: " << this->Year << "\n";
  os << indent << "Month: " << this->Month << "\n";
  os << indent << "Day: " << this->Day << "\n";
  os << indent << "Latitude: " << this->Latitude << "\n";
  os << indent << "Longitude: " << this->Longitude << "\n";
  os << indent << "TimeZone: " << this->TimeZone << "\n";
  os << indent << "North: (" << this->North[0] << ", " << this->North[1] << ", " << this->North[2]
     << ")\n";
  os << indent << "Up: (" << this->Up[0] << ", " << this->Up[1] << ", " << this->Up[2] << ")\n";
  os << indent << "Refraction: " << (this->Refraction ? "On\n" : "Off\n");
  os << indent << "StartHour: " << this->StartHour << "\n";
  os << indent << "EndHour: " << this->EndHour << "\n";
  os << indent << "Step: " << this->Step << "\n";
  os << indent << "NumberOfDays: " << this->NumberOfDays << "\n";
  os << indent << "BinWidth: " << this->BinWidth << "\n";
}
