// Numbers that users set, without wrong ones being taken in silence.
#ifndef svoNumberSetting_h
#define svoNumberSetting_h

#include "vtkObject.h"

#include <algorithm>
#include <cmath>

namespace svo
{
/// As vtkSetClampMacro does; what is not finite changes nothing. One warning where it is not the
/// given value that is set.
inline void setNumber(
  vtkObject* owner, const char* name, double value, double least, double most, double& setting)
{
  if (!std::isfinite(value))
  {
    vtkWarningWithObjectMacro(
      owner, << name << " stays " << setting << ": the value given is not a finite number.");
    return;
  }
  const double inside = std::min(std::max(value, least), most);
  if (inside != value)
  {
    vtkWarningWithObjectMacro(owner, << name << " is set to " << inside << ", as " << value
                                     << " is not between " << least << " and " << most << ".");
  }
  if (setting != inside)
  {
    setting = inside;
    owner->Modified();
  }
}

/// The same of a longitude in degrees, which goes round.
inline void setLongitude(vtkObject* owner, double value, double& setting)
{
  const double wrapped = std::remainder(value, 360.0);
  setNumber(
    owner, "Longitude", wrapped == -180.0 && value > 0.0 ? 180.0 : wrapped, -180.0, 180.0, setting);
}
}

#define svoSetNumberMacro(Class, Name, Least, Most)                                                \
  void Class::Set##Name(double value)                                                              \
  {                                                                                                \
    svo::setNumber(this, #Name, value, Least, Most, this->Name);                                   \
  }

/// The numbers that place the sun and choose its hours, of a class that has them.
#define svoSetSunMacro(Class)                                                                      \
  void Class::SetLongitude(double value)                                                           \
  {                                                                                                \
    svo::setLongitude(this, value, this->Longitude);                                               \
  }                                                                                                \
  svoSetNumberMacro(Class, Latitude, -90.0, 90.0);                                                 \
  svoSetNumberMacro(Class, TimeZone, -14.0, 14.0);                                                 \
  svoSetNumberMacro(Class, StartHour, 0.0, 24.0);                                                  \
  svoSetNumberMacro(Class, EndHour, 0.0, 24.0);                                                    \
  svoSetNumberMacro(Class, Step, 0.1, 1440.0);                                                     \
  svoSetNumberMacro(Class, BinWidth, 0.0, 30.0)

#endif
