// How far a frame may be off for what there was to trace.
#ifndef svoFrameErrors_h
#define svoFrameErrors_h

#include "svoFrame.h"
#include "svoHits.h"
#include "svoScene.h"
#include "svoView.h"

namespace svo
{
/// Raises FrameStatistics::coarsestVoxel and, where there are shadows, largestGap.
void findErrors(
  const Scene& scene, const View& view, const Hits& eye, bool shadows, FrameStatistics& statistics);
}

#endif
