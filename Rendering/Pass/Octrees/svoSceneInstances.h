// The instances of a frame's surfaces, kept from frame to frame and written again where they
// change.
#ifndef svoSceneInstances_h
#define svoSceneInstances_h

#include "svoSceneOctrees.h"

#include <cstdint>
#include <vector>

namespace svo
{
/// What a frame makes of a surface that does not come from its prop.
enum class Stage
{
  Planned, // it has no octree but one that it brings; asked how deep one has to be
  Shown    // as it is traced
};

/// One that no instance and no scene of this process has had; less than 2^48.
std::uint64_t newVersion();

/// Brings `instances`, which are those of the last call, in line with all surfaces of the props, in
/// order. PropSurfaces::fresh says whose are written whole, SceneSurface::written what the others
/// were. Those that are shown have their versions. True if one of these has changed since it was
/// shown last.
bool writeInstances(
  std::vector<PropSurfaces>& props, Stage stage, std::vector<Instance>& instances);
}

#endif
