// What a frame of the pass took, and what it did; Rendering/Settings.cmake says which of it users
// may ask for.
#ifndef svoPassStatistics_h
#define svoPassStatistics_h

#include "svoFrame.h"
#include "svoSampleDistance.h"

#include "vtkProp.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace svo
{
struct PassStatistics
{
  FrameStatistics tracer;
  double collectTime = 0.0; // s
  double presentTime = 0.0; // s
  int tracedActors = 0;
  int rasterizedActors = 0;
  int instances = 0;
  int octreesBuilt = 0;      // or taken over from a background build
  FramePace pace;            // in pixels of the frame
  bool pacedShadows = false; // shadow maps take as long as they have texels
  bool openGL = false;       // VTK draws all that is seen
  int imageReduction = 1;    // pixels of the window that one of the frame becomes
  /// Largest voxel of the octrees that are shown while they are deepened; pixels of the frame.
  double coarseOctreeError = 0.0;
  std::size_t receiverMemory = 0; // bytes that OpenGL holds of shadow buffers
  std::string castingLights;      // a line for each light that is on
  std::vector<std::pair<vtkWeakPointer<vtkProp>, std::string>> reasons; // CollectedScene

  /// Empty if there is none.
  std::string reasonOf(vtkProp* prop) const
  {
    const auto found = std::find_if(this->reasons.begin(), this->reasons.end(),
      [prop](const auto& reason) { return prop && reason.first == prop; });
    return found != this->reasons.end() ? found->second : std::string();
  }

  /// vtkSVORenderPass::MeasureFrame()
  void measure(double& seconds, double& fixedSeconds, double& shadowSeconds) const
  {
    // What was waited for to be built will not be built again.
    fixedSeconds = this->octreesBuilt > 0 ? 0.0 : this->collectTime;
    const double maps =
      this->tracer.askedCasters() ? this->tracer.lights.wall : this->tracer.shadowTime;
    shadowSeconds = this->pacedShadows ? maps : 0.0;
    seconds = fixedSeconds + this->tracer.traceTime + this->tracer.shadowTime + this->presentTime;
  }

  /// Pixels of the window from ray to ray.
  double sampleDistance() const { return this->pace.distance * this->imageReduction; }

  /// vtkSVOPassSettings::GetAcceptedPixelError()
  double acceptedError(double pixelError) const
  {
    const double distance = this->sampleDistance();
    return std::max({ distance > 1.0 ? distance * std::max(pixelError, 1.0) : pixelError,
      this->pace.coarseness > 1.0 ? distance * this->tracer.widestTexel : 0.0,
      this->coarseOctreeError * this->imageReduction,
      distance * this->tracer.largestSmallInstance });
  }
};
}

#endif
