/**
 * @class vtkPolyDataToSVO
 * @brief converts polydata into a sparse voxel octree
 */
#ifndef vtkPolyDataToSVO_h
#define vtkPolyDataToSVO_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkSVOCoreModule.h"

class VTKSVOCORE_EXPORT vtkPolyDataToSVO : public vtkPolyDataAlgorithm
{
public:
  static vtkPolyDataToSVO* New();
  vtkTypeMacro(vtkPolyDataToSVO, vtkPolyDataAlgorithm);

protected:
  vtkPolyDataToSVO();
  ~vtkPolyDataToSVO() override;

private:
  vtkPolyDataToSVO(const vtkPolyDataToSVO&) = delete;
  void operator=(const vtkPolyDataToSVO&) = delete;
};

#endif
