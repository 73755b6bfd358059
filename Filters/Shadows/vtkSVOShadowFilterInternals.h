// What vtkSVOShadowFilter holds.
#ifndef vtkSVOShadowFilterInternals_h
#define vtkSVOShadowFilterInternals_h

#include "svoCasterOctrees.h"
#include "svoFilterLights.h"
#include "vtkSVOShadowFilter.h"

#include "vtkMatrix4x4.h"
#include "vtkSmartPointer.h"

#include <cstddef>
#include <map>
#include <vector>

class vtkSVOShadowFilter::vtkInternals
{
public:
  explicit vtkInternals(vtkSVOShadowFilter* owner)
    : Owner(owner)
    , Octrees(owner)
  {
  }
  /// Null, after an error that ends so, if there is no such light.
  svo::FilterLight* Find(int index, const char* what)
  {
    if (!this->Owner->GetLight(index))
    {
      vtkErrorWithObjectMacro(this->Owner, "There is no light " << index << " " << what << ".");
      return nullptr;
    }
    return &this->Lights[static_cast<std::size_t>(index)];
  }

  vtkSVOShadowFilter* Owner;
  std::vector<svo::FilterLight> Lights;
  std::map<int, vtkSmartPointer<vtkMatrix4x4>> Matrices; // of casters
  svo::CasterOctrees Octrees;
};

#endif
