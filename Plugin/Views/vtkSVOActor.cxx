#include "vtkSVOActor.h"

#include "vtkObjectFactory.h"
#include "vtkSVORenderPass.h"

vtkStandardNewMacro(vtkSVOActor);

vtkSVOActor::vtkSVOActor() = default;
vtkSVOActor::~vtkSVOActor() = default;

void vtkSVOActor::SetPass(vtkSVORenderPass* pass)
{
  this->Pass = pass;
}

int vtkSVOActor::RenderOpaqueGeometry(vtkViewport* viewport)
{
  if (this->Pass && this->Pass->IsTraced(this))
  {
    return 0;
  }
  return this->Superclass::RenderOpaqueGeometry(viewport);
}

void vtkSVOActor::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Pass: " << this->Pass.GetPointer() << '\n';
}
