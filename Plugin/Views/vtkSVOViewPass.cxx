#include "vtkSVOViewPass.h"

#include "vtkInformation.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVRenderView.h"
#include "vtkRenderer.h"
#include "vtkSVORenderPass.h"

vtkStandardNewMacro(vtkSVOViewPass);
vtkInformationKeyMacro(vtkSVOViewPass, VIEW_PASS, ObjectBase);

vtkSVOViewPass::vtkSVOViewPass()
  : Pass(vtkSVORenderPass::New())
{
}

vtkSVOViewPass::~vtkSVOViewPass()
{
  this->Pass->Delete();
}

vtkSVOViewPass* vtkSVOViewPass::OfRenderer(vtkRenderer* renderer)
{
  if (!renderer->GetInformation())
  {
    vtkNew<vtkInformation> information;
    renderer->SetInformation(information);
  }
  auto* found = SafeDownCast(renderer->GetInformation()->Get(VIEW_PASS()));
  if (!found)
  {
    vtkNew<vtkSVOViewPass> made;
    renderer->GetInformation()->Set(VIEW_PASS(), made);
    found = made;
  }
  return found;
}

vtkSVORenderPass* vtkSVOViewPass::Of(vtkObjectBase* view)
{
  auto* renderView = vtkPVRenderView::SafeDownCast(view);
  return renderView ? OfRenderer(renderView->GetRenderer())->Pass : nullptr;
}

void vtkSVOViewPass::AddUser(vtkView* view)
{
  if (auto* renderView = vtkPVRenderView::SafeDownCast(view))
  {
    vtkSVOViewPass* self = OfRenderer(renderView->GetRenderer());
    if (self->Users++ == 0)
    {
      self->Pass->Attach(renderView->GetRenderer());
    }
  }
}

void vtkSVOViewPass::RemoveUser(vtkView* view)
{
  if (auto* renderView = vtkPVRenderView::SafeDownCast(view))
  {
    vtkSVOViewPass* self = OfRenderer(renderView->GetRenderer());
    if (self->Users > 0 && --self->Users == 0)
    {
      self->Pass->Detach(renderView->GetRenderer());
    }
  }
}

void vtkSVOViewPass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Users: " << this->Users << '\n' << indent << "Pass:\n";
  this->Pass->PrintSelf(os, indent.GetNextIndent());
}
