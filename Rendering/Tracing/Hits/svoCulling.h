// How the instances of a view are culled.
#ifndef svoCulling_h
#define svoCulling_h

#include "svoLooseOctree.h"

namespace svo
{
struct Culling
{
  const LooseOctree* tree = nullptr; // of the scene's instances (svoInstanceTree.h); null: none
  bool occlusion = true;             // those that others hide are left out
  /// Pixels of its rectangle from which on an instance is worth being drawn.
  double leastPixels = 0.0;
};
}

#endif
