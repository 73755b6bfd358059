/**
 * @class vtkSVOExposureFilter
 * @brief a vtkSVOShadowFilter whose lights are numbers: a sun path, a sky, or a list
 *
 * For programs that have no vtkLight at hand, as ParaView. The lights are made anew in each
 * execution; those that AddLight() gave are replaced.
 *
 * @sa vtkSVOShadowFilter vtkSVOSunPath vtkSVOSky
 */
#ifndef vtkSVOExposureFilter_h
#define vtkSVOExposureFilter_h

#include "vtkSVOShadowFilter.h"

#include <array>  // for places
#include <vector> // for places

class VTKSVOSHADOWS_EXPORT vtkSVOExposureFilter : public vtkSVOShadowFilter
{
public:
  static vtkSVOExposureFilter* New();
  vtkTypeMacro(vtkSVOExposureFilter, vtkSVOShadowFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Where light comes from.
   */
  enum LightSourceType
  {
    SUN_PATH = 0,
    SKY = 1,
    DIRECTIONS = 2,
    POSITIONS = 3
  };

  //@{
  /**
   * The sun in the course of a day (default; Exposure is in hours), a sky (Exposure is 1 under a
   * free sky), the directions of AddDirection(), or the positions of AddPosition(), each of
   * weight 1.
   */
  vtkSetClampMacro(LightSource, int, SUN_PATH, POSITIONS);
  vtkGetMacro(LightSource, int);
  void SetLightSourceToSunPath() { this->SetLightSource(SUN_PATH); }
  void SetLightSourceToSky() { this->SetLightSource(SKY); }
  void SetLightSourceToDirections() { this->SetLightSource(DIRECTIONS); }
  void SetLightSourceToPositions() { this->SetLightSource(POSITIONS); }
  const char* GetLightSourceAsString();
  //@}

  //@{
  /**
   * Year, month and day of the sun path; default 2024, 6, 21. See vtkSVOSunPath for this and what
   * follows.
   */
  vtkSetVector3Macro(Date, int);
  vtkGetVector3Macro(Date, int);
  //@}

  //@{
  /**
   * Place of the sun path in degrees: latitude -90 to 90, longitude -180 to 180, north and east
   * positive; other longitudes are taken round the earth. Default 0, 0.
   */
  void SetLatitude(double value);
  vtkGetMacro(Latitude, double);
  void SetLongitude(double value);
  vtkGetMacro(Longitude, double);
  //@}

  //@{
  /**
   * Hours that local clocks are ahead of UTC: -14 to 14, default 0.
   */
  void SetTimeZone(double value);
  vtkGetMacro(TimeZone, double);
  //@}

  //@{
  /**
   * The part of the day, local hours 0 to 24, and how far apart the sun's places are, in minutes,
   * 0.1 to 1440. Default 0, 24 and 30.
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
   * Days from the date on, 1 to 36525, default 1; and the width in degrees of the bins in which
   * suns become one light, 0 (none; default) to 30.
   */
  vtkSetClampMacro(NumberOfDays, int, 1, 36525);
  vtkGetMacro(NumberOfDays, int);
  void SetBinWidth(double value);
  vtkGetMacro(BinWidth, double);
  //@}

  //@{
  /**
   * North (of the sun path) and up (of the sun path and the sky) in the model's coordinates.
   * Default (0, 1, 0) and (0, 0, 1).
   */
  vtkSetVector3Macro(North, double);
  vtkGetVector3Macro(North, double);
  vtkSetVector3Macro(Up, double);
  vtkGetVector3Macro(Up, double);
  //@}

  /**
   * How bright the sky is; as in vtkSVOSky.
   */
  enum SkyType
  {
    UNIFORM = 0,
    OVERCAST = 1
  };

  //@{
  /**
   * Uniform (default), or the CIE's overcast sky.
   */
  vtkSetClampMacro(SkyType, int, UNIFORM, OVERCAST);
  vtkGetMacro(SkyType, int);
  void SetSkyTypeToUniform() { this->SetSkyType(UNIFORM); }
  void SetSkyTypeToOvercast() { this->SetSkyType(OVERCAST); }
  //@}

  //@{
  /**
   * Directions of the sky: 1 to 100000, default 256.
   */
  vtkSetClampMacro(NumberOfSkyDirections, int, 1, 100000);
  vtkGetMacro(NumberOfSkyDirections, int);
  //@}

  //@{
  /**
   * Directions, of any length, to lights that are infinitely far away, and positions of lights, or
   * of sensors that are to be seen. An index that does not exist gives (0, 0, 0).
   */
  void AddDirection(double x, double y, double z);
  void RemoveAllDirections();
  int GetNumberOfDirections() { return static_cast<int>(this->Directions.size()); }
  void GetDirection(int index, double direction[3]);
  void AddPosition(double x, double y, double z);
  void RemoveAllPositions();
  int GetNumberOfPositions() { return static_cast<int>(this->Positions.size()); }
  void GetPosition(int index, double position[3]);
  //@}

protected:
  vtkSVOExposureFilter() = default;
  ~vtkSVOExposureFilter() override = default;

  void PrepareLights() override;

private:
  int LightSource = SUN_PATH;
  int Date[3] = { 2024, 6, 21 };
  double Latitude = 0.0;
  double Longitude = 0.0;
  double TimeZone = 0.0;
  double StartHour = 0.0;
  double EndHour = 24.0;
  double Step = 30.0;
  int NumberOfDays = 1;
  double BinWidth = 0.0;
  double North[3] = { 0.0, 1.0, 0.0 };
  double Up[3] = { 0.0, 0.0, 1.0 };
  int SkyType = UNIFORM;
  int NumberOfSkyDirections = 256;
  std::vector<std::array<double, 3>> Directions, Positions;
};

#endif
