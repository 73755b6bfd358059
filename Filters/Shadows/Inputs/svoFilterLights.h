// A filter's lights, and what rays know of them.
#ifndef svoFilterLights_h
#define svoFilterLights_h

#include "svoShadowShares.h"

#include "vtkLight.h"
#include "vtkSmartPointer.h"

#include <map>
#include <string>
#include <vector>

namespace svo
{
struct FilterLight
{
  vtkSmartPointer<vtkLight> light;
  double weight = 1.0, withCosine = 1.0; // the latter where incidence counts by its cosine
  std::string name;
};

/// The lights as rays have them; `wrong`: of each problem the numbers of the lights that have it.
std::vector<WeightedLight> weightedLights(
  const std::vector<FilterLight>& lights, bool cosine, std::map<std::string, std::string>& wrong);
}

#endif
