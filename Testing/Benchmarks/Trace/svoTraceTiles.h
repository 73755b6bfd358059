// Rays of one mesh as a frame traces them: by a view of one instance, whole tiles at a time.
#ifndef svoTraceTiles_h
#define svoTraceTiles_h

#include "svoLayeredView.h"

#include <vector>

namespace svobench
{
class TracedTiles
{
public:
  TracedTiles(const svo::Octree& octree, const svo::View& view);
  /// All rays of the view, depths placed in double, nothing kept from the last time.
  void trace();
  /// What that met; t is linear depth minus `base`.
  std::vector<svo::HitBlock> hits(double base) const;

private:
  svo::Scene Scene;
  svo::View View;
  svo::LayeredView Layers;
};
}

#endif
