#include "vtkSVOToPolyData.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkSVOToPolyData);

vtkSVOToPolyData::vtkSVOToPolyData() = default;
vtkSVOToPolyData::~vtkSVOToPolyData() = default;
