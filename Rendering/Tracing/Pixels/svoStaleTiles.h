// Which tiles have to be shaded anew: by their hits and looks, and by their lights.
#ifndef svoStaleTiles_h
#define svoStaleTiles_h

#include "svoCasterBox.h"
#include "svoFrameInputs.h"
#include "svoHits.h"
#include "svoParallel.h"
#include "svoScene.h"
#include "svoShadedTiles.h"
#include "svoShadows.h"

#include <cstdint>
#include <vector>

namespace svo
{
/// Begins a frame of tiles: stale are those whose hits, or the looks of them, are not what they
/// were. `instances`: those that have changed. `all`: nothing is kept.
void findStaleTiles(
  const Hits& eye, const std::vector<std::uint32_t>& instances, bool all, ShadedTiles& tiles);

/// Stale are also those whose lights may have changed. `hits`: tiles that show anything.
/// `casters`: by index into Scene::instances, of the last frame; becomes this frame's.
void findDarkenedTiles(const Scene& scene, const FrameChanges& changes, const Shadows& shadows,
  const std::vector<std::uint32_t>& hits, std::vector<CasterBox>& casters,
  const ParallelFor& parallelFor, ShadedTiles& tiles);
}

#endif
