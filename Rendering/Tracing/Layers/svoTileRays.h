// The rays of a tile through one instance.
#ifndef svoTileRays_h
#define svoTileRays_h

#include "svoHitOrder.h"
#include "svoIntersectTile.h"
#include "svoTracedInstances.h"

#include <vector>

namespace svo
{
/// Where the rays of a tile may meet an instance.
struct TilePart
{
  const TracedInstance* entry = nullptr;
  float tNear = 0.0f, tFar = 0.0f;
  TilePyramid pyramid;
  std::vector<TileNode> nodes; // empty: rays are walked one by one
};

/// Finds where they may; false if nowhere.
bool findPart(const TracedInstances& instances, int tileX, int tileY, TilePart& part);

/// All rays of the tile that may meet the instance there.
void fillPart(const TilePart& part, const TilePoints& at, RayBlock& block);

/// Ends rays where hits would be behind what is merged; false if none is left.
bool cutRays(const TracedInstances& instances, const HitOrder& order, const TilePart& part,
  const MergedTile& merged, RayBlock& block);

/// Through points x, y of the image; tMin and tMax are set, and those with tMin > tMax are none.
void traceRays(const TracedInstances& instances, const TilePart& part, const double* x,
  const double* y, RayBlock& block, HitBlock& found);
}

#endif
