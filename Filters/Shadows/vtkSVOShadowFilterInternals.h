// What vtkSVOShadowFilter holds.
#ifndef vtkSVOShadowFilterInternals_h
#define vtkSVOShadowFilterInternals_h

#include "svoCasterOctrees.h"
#include "svoFilterLights.h"
#include "vtkSVOShadowFilter.h"

#include "vtkMatrix4x4.h"
#include "vtkSmartPointer.h"

#include <map>
#include <vector>

class vtkSVOShadowFilter::vtkInternals
{
public:
  explicit vtkInternals(vtkSVOShadowFilter* owner)
    : Octrees(owner)
  {
  }
  std::vector<svo::FilterLight> Lights;
  std::map<int, vtkSmartPointer<vtkMatrix4x4>> Matrices; // of casters
  svo::CasterOctrees Octrees;
};

#endif
