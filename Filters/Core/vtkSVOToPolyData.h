/**
 * @class vtkSVOToPolyData
 * @brief the cells of an octree as a surface
 */
#ifndef vtkSVOToPolyData_h
#define vtkSVOToPolyData_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkSVOCoreModule.h"

class VTKSVOCORE_EXPORT vtkSVOToPolyData : public vtkPolyDataAlgorithm
{
public:
  static vtkSVOToPolyData* New();
  vtkTypeMacro(vtkSVOToPolyData, vtkPolyDataAlgorithm);

protected:
  vtkSVOToPolyData();
  ~vtkSVOToPolyData() override;

private:
  vtkSVOToPolyData(const vtkSVOToPolyData&) = delete;
  void operator=(const vtkSVOToPolyData&) = delete;
};

#endif
