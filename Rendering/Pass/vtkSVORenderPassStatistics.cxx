// What of the last frame is more than a figure (those: Rendering/Settings.cmake), and what is kept.
#include "vtkSVORenderPass.h"

#include "svoPassInternals.h"

#include <algorithm>

vtkIdType vtkSVORenderPass::GetNumberOfCulledInstances(int step) const
{
  const svo::FrameStatistics& frame = this->Impl->statistics.tracer;
  switch (step)
  {
    case CULLED_BY_VIEW:
      return static_cast<vtkIdType>(frame.outsideInstances);
    case CULLED_BY_OCCLUSION:
      return static_cast<vtkIdType>(frame.hiddenInstances);
    case CULLED_BY_DETAIL:
      return static_cast<vtkIdType>(frame.smallInstances);
    case CULLED_CASTERS:
      return static_cast<vtkIdType>(frame.sparedCasters);
    default:
      return 0;
  }
}

vtkIdType vtkSVORenderPass::GetNumberOfCulledInstances() const
{
  return this->GetNumberOfCulledInstances(CULLED_BY_VIEW) +
    this->GetNumberOfCulledInstances(CULLED_BY_OCCLUSION) +
    this->GetNumberOfCulledInstances(CULLED_BY_DETAIL);
}

const char* vtkSVORenderPass::GetCastingLights() const
{
  return this->Impl->castingLights.c_str();
}

const svo::PassStatistics& vtkSVORenderPass::LastFrame() const
{
  return this->Impl->statistics;
}

double vtkSVORenderPass::GetImageSampleDistance() const
{
  return this->Impl->statistics.pace.distance * this->Impl->statistics.imageReduction;
}

double vtkSVORenderPass::GetAcceptedPixelError() const
{
  // A pixel of the traced picture is `distance` pixels of the window.
  const double distance = this->GetImageSampleDistance();
  const double ofRays =
    distance > 1.0 ? distance * std::max(this->PixelError, 1.0) : this->PixelError;
  const svo::PassStatistics& frame = this->Impl->statistics;
  const double ofShadows = frame.pace.coarseness > 1.0 ? distance * frame.tracer.widestTexel : 0.0;
  return std::max({ ofRays, ofShadows, frame.coarseOctreeError * frame.imageReduction,
    distance * frame.tracer.largestSmallInstance });
}

int vtkSVORenderPass::GetNumberOfOctreesBuilt() const
{
  return this->Impl->store.built();
}

int vtkSVORenderPass::GetNumberOfOctreesInProgress() const
{
  return this->Impl->store.building();
}

vtkIdType vtkSVORenderPass::GetOctreeMemorySize() const
{
  return static_cast<vtkIdType>(this->Impl->store.bytes() / svo::BytesOfKiB);
}
