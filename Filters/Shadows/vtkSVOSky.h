/**
 * @class vtkSVOSky
 * @brief a sky as lights for vtkSVOShadowFilter: sky view factors, overcast days
 *
 * Directions to equal parts of the hemisphere, each with a weight, so that "Exposure" of a level
 * place without anything around it is 1. With CosineWeighted of the filter that is the sky view
 * factor of a uniform sky, or the daylight of an overcast one; without, the share of the sky that
 * is seen.
 *
 * @sa vtkSVOShadowFilter vtkSVOSunPath
 */
#ifndef vtkSVOSky_h
#define vtkSVOSky_h

#include "vtkObject.h"
#include "vtkSVOShadowsModule.h" // for the export macro

class vtkSVOShadowFilter;

class VTKSVOSHADOWS_EXPORT vtkSVOSky : public vtkObject
{
public:
  static vtkSVOSky* New();
  vtkTypeMacro(vtkSVOSky, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * How bright the sky is.
   */
  enum SkyType
  {
    UNIFORM = 0,
    OVERCAST = 1
  };

  //@{
  /**
   * Uniform (default): the same everywhere. Overcast: the CIE's standard overcast sky, whose
   * horizon is a third as bright as its zenith.
   */
  vtkSetClampMacro(Type, int, UNIFORM, OVERCAST);
  vtkGetMacro(Type, int);
  void SetTypeToUniform() { this->SetType(UNIFORM); }
  void SetTypeToOvercast() { this->SetType(OVERCAST); }
  const char* GetTypeAsString();
  //@}

  //@{
  /**
   * How many directions there are: 1 to 100000, default 256.
   */
  vtkSetClampMacro(NumberOfDirections, int, 1, 100000);
  vtkGetMacro(NumberOfDirections, int);
  //@}

  //@{
  /**
   * Up in the model's coordinates, of any length. Default (0, 0, 1).
   */
  vtkSetVector3Macro(Up, double);
  vtkGetVector3Macro(Up, double);
  //@}

  /**
   * Adds directional lights to the filter, with a weight each for its CosineWeighted and without.
   * Returns how many: 0 after an error, without a filter and for an up that is zero or not finite.
   */
  int AddLights(vtkSVOShadowFilter* filter);

protected:
  vtkSVOSky() = default;
  ~vtkSVOSky() override = default;

private:
  int Type = UNIFORM;
  int NumberOfDirections = 256;
  double Up[3] = { 0.0, 0.0, 1.0 };
};

#endif
