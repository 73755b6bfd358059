// Facets, normals and colours of the points of a patch, all of them at once.
//
// The results are those of pointOfTriangle() (svoSurfacePoint.h) for each point, up to the rounding
// of single precision: both call the functions of svoPointLane.h, there with a position in double,
// here with the way from the patch's origin. Points that vectors cannot do, on nodes or with odd
// normals, are pointOfTriangle()'s, bit for bit.
#ifndef svoTileLook_h
#define svoTileLook_h

#include "svoSurfacePoint.h"
#include "svoTilePatch.h"
#include "svoTileTriangles.h"

namespace svo
{
/// `matrices`: of the patch's instance. `triangles`: for this function alone.
VTKSVOTRACING_EXPORT void lookAtPatch(
  const SurfaceMatrices& matrices, TilePatch& patch, TileTriangles& triangles);
}

#endif
