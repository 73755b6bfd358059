/**
 * @class vtkSVOSunPath
 * @brief where the sun stands in the course of days, as lights for vtkSVOShadowFilter
 *
 * The sun's apparent place after J. Meeus, "Astronomical Algorithms" (1998), chapters 7, 12 and 25,
 * which is that of NOAA's solar calculator: within 0.01 degrees from 1900 to 2100, refraction
 * apart.
 *
 * Directions are in the coordinates of a model whose north and up can be set: x is east, y north
 * and z up by default.
 *
 * @sa vtkSVOShadowFilter vtkSVOSky
 */
#ifndef vtkSVOSunPath_h
#define vtkSVOSunPath_h

#include "vtkObject.h"
#include "vtkSVOShadowsModule.h" // for the export macro

class vtkSVOShadowFilter;

class VTKSVOSHADOWS_EXPORT vtkSVOSunPath : public vtkObject
{
public:
  static vtkSVOSunPath* New();
  vtkTypeMacro(vtkSVOSunPath, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  //@{
  /**
   * The day, in the Gregorian calendar and in the time of TimeZone; default 21 June 2024. A day
   * that does not exist is an error when it is used.
   */
  void SetDate(int year, int month, int day);
  vtkSetMacro(Year, int);
  vtkGetMacro(Year, int);
  vtkSetMacro(Month, int);
  vtkGetMacro(Month, int);
  vtkSetMacro(Day, int);
  vtkGetMacro(Day, int);
  //@}

  //@{
  /**
   * The place in degrees: latitude -90 to 90, north positive; longitude -180 to 180, east
   * positive; others are taken round the earth. Default 0, 0.
   */
  void SetLatitude(double value);
  vtkGetMacro(Latitude, double);
  void SetLongitude(double value);
  vtkGetMacro(Longitude, double);
  //@}

  //@{
  /**
   * Hours that local clocks are ahead of UTC, summer time included: -14 to 14, default 0.
   */
  void SetTimeZone(double value);
  vtkGetMacro(TimeZone, double);
  //@}

  //@{
  /**
   * North and up in the model's coordinates, of any length; what of north is not level is left out.
   * Default (0, 1, 0) and (0, 0, 1).
   */
  vtkSetVector3Macro(North, double);
  vtkGetVector3Macro(North, double);
  vtkSetVector3Macro(Up, double);
  vtkGetVector3Macro(Up, double);
  //@}

  //@{
  /**
   * Whether the air lifts the sun, as it is seen: by half a degree at the horizon, by 0.03 degrees
   * at 30 degrees (NOAA's approximation, for 1010 hPa and 10 degrees Celsius). Default on.
   */
  vtkSetMacro(Refraction, bool);
  vtkGetMacro(Refraction, bool);
  vtkBooleanMacro(Refraction, bool);
  //@}

  //@{
  /**
   * The part of the day that AddLights() is for, local hours 0 to 24, and how far apart its lights
   * are, in minutes: 0.1 to 1440. Default 0, 24 and 30.
   */
  void SetStartHour(double value);
  vtkGetMacro(StartHour, double);
  void SetEndHour(double value);
  vtkGetMacro(EndHour, double);
  void SetStep(double value);
  vtkGetMacro(Step, double);
  //@}

  //@{
  /**
   * How many days AddLights() is for, from the date on; 1 to 36525, default 1. 366 are the year
   * 2024. TimeZone is that of all of them; the hours of sun of whole days do not depend on it.
   */
  vtkSetClampMacro(NumberOfDays, int, 1, 36525);
  vtkGetMacro(NumberOfDays, int);
  //@}

  //@{
  /**
   * Suns whose directions lie in one bin of this width, in degrees of arc, become one light with
   * the sum of their weights, from their mean direction: a year in far fewer lights. A sun is
   * moved by 0.7 widths at most; ShadowsAsData.md has what that changes. 0 to 30; default 0: every
   * sun is a light.
   */
  void SetBinWidth(double value);
  vtkGetMacro(BinWidth, double);
  //@}

  /**
   * The unit direction to the sun at a local hour, in the model's coordinates. False if the sun's
   * centre is below the horizon, and, with (0, 0, 0), if the date does not exist or north and up
   * are no axes (an error).
   */
  bool GetDirection(double hour, double direction[3]);

  //@{
  /**
   * The sun's elevation above the horizon, and its azimuth from north to east, 0 to 360; degrees. 0
   * after an error.
   */
  double GetElevation(double hour);
  double GetAzimuth(double hour);
  //@}

  /**
   * Adds directional lights: one for each step in the middle of which the sun is up, with the
   * step's hours as its weight, so that "Exposure" is in hours of sun. Their names are the times in
   * the middle of the steps, or, of several suns in a bin, azimuth and elevation. Returns how many,
   * which is 0 in a polar night, and, after an error, without a filter and where EndHour is not
   * after StartHour.
   */
  int AddLights(vtkSVOShadowFilter* filter);

protected:
  vtkSVOSunPath() = default;
  ~vtkSVOSunPath() override = default;

private:
  int Year = 2024;
  int Month = 6;
  int Day = 21;
  double Latitude = 0.0;
  double Longitude = 0.0;
  double TimeZone = 0.0;
  double North[3] = { 0.0, 1.0, 0.0 };
  double Up[3] = { 0.0, 0.0, 1.0 };
  bool Refraction = true;
  double StartHour = 0.0;
  double EndHour = 24.0;
  double Step = 30.0;
  int NumberOfDays = 1;
  double BinWidth = 0.0;
};

#endif
