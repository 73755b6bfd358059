// What vtkSVOShadowFilter holds.
#ifndef vtkSVOShadowFilterInternals_h
#define vtkSVOShadowFilterInternals_h

#include "svoCasterOctrees.h"
#include "svoShadowShares.h"
#include "vtkSVOShadowFilter.h"

#include "vtkLight.h"
#include "vtkMatrix4x4.h"
#include "vtkSmartPointer.h"

#include <map>
#include <string>
#include <vector>

class vtkSVOShadowFilter::vtkInternals
{
public:
  explicit vtkInternals(vtkSVOShadowFilter* owner)
    : Octrees(owner)
  {
  }
  struct Weighted
  {
    vtkSmartPointer<vtkLight> light;
    double weight = 1.0, withCosine = 1.0;
    std::string name;

    double weightOf(bool cosine) const { return cosine ? this->withCosine : this->weight; }
  };
  std::vector<Weighted> Lights;
  std::map<int, vtkSmartPointer<vtkMatrix4x4>> Matrices; // of casters
  svo::CasterOctrees Octrees;

  /// The lights as rays have them; `wrong`: of each problem the numbers of the lights that have it.
  std::vector<svo::WeightedLight> lights(
    bool cosine, std::map<std::string, std::string>& wrong) const;
};

#endif
