// What a frame of the pass took, and what it did; Rendering/Settings.cmake says which of it users
// may ask for.
#ifndef svoPassStatistics_h
#define svoPassStatistics_h

#include "svoFrame.h"
#include "svoSampleDistance.h"

#include <cstddef>

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
  int imageReduction = 1;    // pixels of the window that one of the frame becomes
  /// Largest voxel of the octrees that are shown while they are deepened; pixels of the frame.
  double coarseOctreeError = 0.0;
  std::size_t receiverMemory = 0; // bytes that OpenGL holds of shadow buffers
};
}

#endif
