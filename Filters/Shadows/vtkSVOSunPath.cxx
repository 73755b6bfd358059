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

vtkStandardNewMacro(vtkSVOSunPath);

namespace
{
constexpr double Degree = 3.14159265358979323846 / 180.0;

/// East, north and up in the model's frame; false if there is no such frame.
bool frameOf(const double north[3], const double up[3], glm::dvec3 (&frame)[3])
{
  const glm::dvec3 n(north[0], north[1], north[2]), u(up[0], up[1], up[2]);
  const glm::dvec3 east = glm::cross(n, u);
  const double sine = glm::length(east);
  if (!(sine > 1e-9 * glm::length(n) * glm::length(u)) || !std::isfinite(sine))
  {
    return false;
  }
  frame[0] = east / sine;
  frame[2] = glm::normalize(u);
  frame[1] = glm::cross(frame[2], frame[0]);
  return true;
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
bool vtkSVOSunPath::IsValid()
{
  glm::dvec3 frame[3];
  if (!svo::isDate(this->Year, this->Month, this->Day))
  {
    vtkErrorMacro(
      "There is no such day: " << this->Year << "-" << this->Month << "-" << this->Day << ".");
    return false;
  }
  if (!frameOf(this->North, this->Up, frame))
  {
    vtkErrorMacro("North and up are no frame: they are parallel, zero, or not finite.");
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkSVOSunPath::LocalDirection(double hour, double direction[3]) const
{
  const glm::dvec3 sun =
    svo::sunDirection(svo::julianDay(this->Year, this->Month, this->Day, hour - this->TimeZone),
      this->Latitude, this->Longitude);
  const glm::dvec3 seen = this->Refraction ? svo::refracted(sun) : sun;
  for (int i = 0; i < 3; ++i)
  {
    direction[i] = seen[i];
  }
}

//------------------------------------------------------------------------------
bool vtkSVOSunPath::GetDirection(double hour, double direction[3])
{
  direction[0] = direction[1] = direction[2] = 0.0;
  glm::dvec3 frame[3];
  if (!this->IsValid() || !frameOf(this->North, this->Up, frame))
  {
    return false;
  }
  double local[3];
  this->LocalDirection(hour, local);
  for (int i = 0; i < 3; ++i)
  {
    direction[i] = local[0] * frame[0][i] + local[1] * frame[1][i] + local[2] * frame[2][i];
  }
  return local[2] > 0.0;
}

//------------------------------------------------------------------------------
double vtkSVOSunPath::GetElevation(double hour)
{
  if (!this->IsValid())
  {
    return 0.0;
  }
  double local[3];
  this->LocalDirection(hour, local);
  return std::atan2(local[2], std::hypot(local[0], local[1])) / Degree;
}

//------------------------------------------------------------------------------
double vtkSVOSunPath::GetAzimuth(double hour)
{
  if (!this->IsValid())
  {
    return 0.0;
  }
  double local[3];
  this->LocalDirection(hour, local);
  const double azimuth = std::atan2(local[0], local[1]) / Degree;
  return azimuth < 0.0 ? azimuth + 360.0 : azimuth;
}

//------------------------------------------------------------------------------
int vtkSVOSunPath::AddLights(vtkSVOShadowFilter* filter)
{
  if (!filter)
  {
    vtkErrorMacro("There is no filter to add lights to.");
    return 0;
  }
  if (!this->IsValid())
  {
    return 0;
  }
  if (!(this->StartHour < this->EndHour))
  {
    vtkErrorMacro("There are no suns: hours from " << this->StartHour << " to " << this->EndHour
                                                   << " are none.");
    return 0;
  }
  glm::dvec3 frame[3];
  frameOf(this->North, this->Up, frame);
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
      double local[3];
      this->LocalDirection(24.0 * day + hour, local);
      if (local[2] > 0.0)
      {
        bins.add({ local[0], local[1], local[2] }, end - begin, date, hour);
      }
    }
  }
  for (const svo::SunBins::Bin& bin : bins.all())
  {
    const glm::dvec3 to = bin.sum.x * frame[0] + bin.sum.y * frame[1] + bin.sum.z * frame[2];
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPosition(to.x, to.y, to.z);
    light->SetFocalPoint(0.0, 0.0, 0.0);
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
