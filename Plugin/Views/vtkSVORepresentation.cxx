#include "vtkSVORepresentation.h"

#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkObjectFactory.h"
#include "vtkPPolyDataToSVO.h"
#include "vtkPVDataDeliveryManager.h"
#include "vtkPVLODActor.h"
#include "vtkPVRenderView.h"
#include "vtkSVORenderPass.h"
#include "vtkSVOViewPass.h"

#include <algorithm>

// The mapper of ParaView's surfaces. With VTK 9.3 it took over the name of another one.
#if __has_include("vtkCompositePolyDataMapperDelegator.h")
#include "vtkCompositePolyDataMapper.h"
using CompositeMapper = vtkCompositePolyDataMapper;
#else
#include "vtkCompositePolyDataMapper2.h"
using CompositeMapper = vtkCompositePolyDataMapper2;
#endif

vtkStandardNewMacro(vtkSVORepresentation);

vtkSVORepresentation::vtkSVORepresentation()
{
  this->ToOctree->SetKeepOctrees(true);
  this->ToOctree->SetAdaptLevel(true);
  this->ToOctree->AddObserver(
    vtkCommand::ProgressEvent, this, &vtkSVORepresentation::ForwardProgress);
  this->SuppressLOD = true;
  this->SetupDefaults();
  vtkSVORenderPass::SetUseSVO(true, this->Actor);
}

vtkSVORepresentation::~vtkSVORepresentation() = default;

void vtkSVORepresentation::SetupDefaults()
{
  this->Superclass::SetupDefaults();
  this->ToOctree->SetInputConnection(this->GeometryFilter->GetOutputPort());
  this->MultiBlockMaker->SetInputConnection(this->ToOctree->GetOutputPort());
}

void vtkSVORepresentation::ForwardProgress()
{
  // After the superclass's first filter, which has the range from 0 to 0.8, and beside its second.
  this->UpdateProgress(0.8 + 0.05 * this->ToOctree->GetProgress());
}

int vtkSVORepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (this->UpdatedInteractively)
  {
    this->ForgetPieces();
  }
  this->UpdatedInteractively = this->GetInteractive();
  return this->Superclass::RequestData(request, inputVector, outputVector);
}

int vtkSVORepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo)
{
  // A view that draws levels of detail delivers nothing else: the whole surface is one.
  vtkDataObject* shown = nullptr;
  if (request == vtkPVView::REQUEST_RENDER())
  {
    shown = inInfo->Has(vtkPVRenderView::USE_LOD()) ? vtkPVView::GetDeliveredPieceLOD(inInfo, this)
                                                    : nullptr;
    this->BlockAttrChanged = this->BlockAttrChanged || shown != this->ShownAsDetail;
    this->ShownAsDetail = shown;
  }
  if (request == vtkPVView::REQUEST_UPDATE())
  {
    if (!this->vtkPVDataRepresentation::ProcessViewRequest(request, inInfo, outInfo))
    {
      return 0;
    }
    // Where ParaView draws, and whether levels of detail, follows from the size of the data. It
    // must not change only because an octree is left out. (The superclass's own call comes too
    // late.)
    if (vtkDataObject* surface = this->MultiBlockMaker->GetOutputDataObject(0))
    {
      const unsigned long size = surface->GetActualMemorySize();
      this->Size = this->UpdatedInteractively ? std::max(this->Size, size) : size;
      vtkPVView::SetPiece(inInfo, this, surface, this->Size);
    }
  }
  const vtkMTimeType populated = this->BlockAttributeTime;
  if (!this->Superclass::ProcessViewRequest(request, inInfo, outInfo))
  {
    return 0;
  }
  if (request == vtkPVView::REQUEST_UPDATE_LOD())
  {
    vtkPVView::SetPieceLOD(inInfo, this, vtkPVView::GetPiece(inInfo, this), this->Size);
  }
  if (shown)
  {
    this->Mapper->SetInputDataObject(shown);
    auto* mapper = CompositeMapper::SafeDownCast(this->Mapper);
    if (mapper && (this->BlockAttributeTime > populated || this->BlockAttrChanged))
    {
      // Not yet so if only the levels of detail were delivered.
      this->PopulateBlockAttributes(mapper->GetCompositeDataDisplayAttributes(), shown);
      this->BlockAttrChanged = false;
    }
  }
  return 1;
}

void vtkSVORepresentation::SetInteractive(bool interactive)
{
  this->ToOctree->SetBuildOctrees(!interactive);
}

bool vtkSVORepresentation::GetInteractive()
{
  return !this->ToOctree->GetBuildOctrees();
}

void vtkSVORepresentation::CompleteUpdate()
{
  this->UpdatedInteractively = false;
  this->MarkModified();
  this->ForgetPieces();
}

/// What ParaView keeps of time steps, also while an animation plays and MarkModified() leaves it.
void vtkSVORepresentation::ForgetPieces()
{
  if (auto* view = vtkPVView::SafeDownCast(this->GetView()))
  {
    view->GetDeliveryManager()->ClearCache(this);
  }
}

bool vtkSVORepresentation::AddToView(vtkView* view)
{
  if (!this->Superclass::AddToView(view))
  {
    return false;
  }
  this->UpdateUse(view);
  return true;
}

bool vtkSVORepresentation::RemoveFromView(vtkView* view)
{
  this->UpdateUse(nullptr);
  return this->Superclass::RemoveFromView(view);
}

void vtkSVORepresentation::SetVisibility(bool visible)
{
  this->Superclass::SetVisibility(visible);
  this->UpdateUse(this->GetView());
}

/// Every surface in a view has this representation among its own, mostly unseen. Only one that is
/// shown has a use for the view's pass.
void vtkSVORepresentation::UpdateUse(vtkView* view)
{
  vtkView* wanted = this->GetVisibility() ? view : nullptr;
  if (this->Used == wanted)
  {
    return;
  }
  if (this->Used)
  {
    vtkSVOViewPass::RemoveUser(this->Used);
  }
  this->Used = wanted;
  if (wanted)
  {
    vtkSVOViewPass::AddUser(wanted);
  }
}

void vtkSVORepresentation::SetMaximumLevel(int level)
{
  if (this->ToOctree->GetMaximumLevel() != level)
  {
    this->ToOctree->SetMaximumLevel(level);
    this->MarkModified();
  }
}

int vtkSVORepresentation::GetMaximumLevel()
{
  return this->ToOctree->GetMaximumLevel();
}

void vtkSVORepresentation::SetLeafGeometry(int geometry)
{
  if (this->ToOctree->GetLeafGeometry() != geometry)
  {
    this->ToOctree->SetLeafGeometry(geometry);
    this->MarkModified();
  }
}

int vtkSVORepresentation::GetLeafGeometry()
{
  return this->ToOctree->GetLeafGeometry();
}

void vtkSVORepresentation::SetCacheMemoryLimit(vtkIdType kibibytes)
{
  this->ToOctree->SetCacheMemoryLimit(static_cast<unsigned long>(kibibytes));
}

vtkIdType vtkSVORepresentation::GetCacheMemoryLimit()
{
  return static_cast<vtkIdType>(this->ToOctree->GetCacheMemoryLimit());
}

void vtkSVORepresentation::SetCastShadows(bool cast)
{
  // Without an answer surfaces cast as opaque as they are, with one of true like opaque ones.
  this->Actor->GetPropertyKeys()->Remove(vtkSVORenderPass::CAST_SHADOW());
  if (!cast)
  {
    vtkSVORenderPass::SetCastShadow(false, this->Actor);
  }
}

bool vtkSVORepresentation::GetCastShadows()
{
  return !this->Actor->GetPropertyKeys()->Has(vtkSVORenderPass::CAST_SHADOW());
}

void vtkSVORepresentation::SetReceiveShadows(bool receive)
{
  vtkSVORenderPass::SetReceiveShadow(receive, this->Actor);
}

bool vtkSVORepresentation::GetReceiveShadows()
{
  return vtkSVORenderPass::GetReceiveShadow(this->Actor);
}

void vtkSVORepresentation::SetPixelError(double error)
{
  vtkSVORenderPass::SetPropPixelError(error, this->Actor);
}

double vtkSVORepresentation::GetPixelError()
{
  return vtkSVORenderPass::GetPropPixelError(this->Actor);
}

vtkIdType vtkSVORepresentation::GetNumberOfBuilds()
{
  return this->ToOctree->GetNumberOfBuilds();
}

vtkIdType vtkSVORepresentation::GetCacheMemorySize()
{
  return static_cast<vtkIdType>(this->ToOctree->GetCacheMemorySize());
}

void vtkSVORepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Interactive: " << this->GetInteractive() << '\n'
     << indent << "UpdatedInteractively: " << this->UpdatedInteractively << '\n'
     << indent << "CastShadows: " << this->GetCastShadows() << '\n'
     << indent << "ReceiveShadows: " << this->GetReceiveShadows() << '\n'
     << indent << "PixelError: " << this->GetPixelError() << '\n'
     << indent << "ToOctree:\n";
  this->ToOctree->PrintSelf(os, indent.GetNextIndent());
}
