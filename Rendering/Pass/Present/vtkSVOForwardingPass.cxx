#include "vtkSVOForwardingPass.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkSVOForwardingPass);
