// How far a frame may be off for what there was to trace.
#ifndef svoFrameErrors_h
#define svoFrameErrors_h

#include "svoHits.h"
#include "svoScene.h"
#include "svoView.h"

namespace svo
{
/// FrameStatistics::coarsestVoxel
double coarsestVoxel(const Scene& scene, const View& view, const Hits& eye);

/// FrameStatistics::largestGap
double largestGap(const Scene& scene, const View& view, const Hits& eye);
}

#endif
