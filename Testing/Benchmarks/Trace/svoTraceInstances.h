// Rays of the eye through a crowd: the eye's part of a frame of the tracer, nothing shaded, beside
// Embree's instances.
#ifndef svoTraceInstances_h
#define svoTraceInstances_h

#include "svoBenchmarkMesh.h"
#include "svoOctree.h"
#include "svoTraceReport.h"

namespace svobench
{
/// `count` of the mesh in a square. Adds rows, and checks that both see the same.
void traceInstances(const Mesh& mesh, const svo::Octree& octree, int count, int width, int height,
  int repeat, TraceReport& report);
}

#endif
