#include "vtkPolyDataToSVO.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkPolyDataToSVO);

vtkPolyDataToSVO::vtkPolyDataToSVO() = default;
vtkPolyDataToSVO::~vtkPolyDataToSVO() = default;
