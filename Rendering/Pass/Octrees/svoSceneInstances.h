// The instances of a frame's surfaces, kept from frame to frame and written again where they
// change.
#ifndef svoSceneInstances_h
#define svoSceneInstances_h

#include "svoSceneOctrees.h"

#include <vector>

namespace svo
{
/// What a frame makes of a surface that does not come from its prop.
enum class Stage
{
  Planned, // it has no octree but one that it brings; asked how deep one has to be
  Shown    // as it is traced
};

class SceneInstances
{
public:
  /// Brings `instances`, which are those of the last call, in line with all surfaces of the props,
  /// in order. PropSurfaces::fresh says whose are written whole, SceneSurface::written what the
  /// others were.
  static void write(
    std::vector<PropSurfaces>& props, Stage stage, std::vector<Instance>& instances);
};
}

#endif
