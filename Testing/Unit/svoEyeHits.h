// What the eye sees of a scene, for tests of what is asked from there.
#ifndef svoEyeHits_h
#define svoEyeHits_h

#include "svoLayeredView.h"
#include "svoScene.h"

namespace svotest
{
/// Every instance at its full depth; nothing is traced yet.
inline void prepareEye(svo::LayeredView& eye, const svo::Scene& scene, const svo::View& view)
{
  svo::LayerBudget budget{ 1 << 30, 0 };
  eye.prepare(
    scene, view, [](const svo::Instance&) { return true; },
    [](const svo::Instance& instance, const svo::LocalView&)
    { return instance.body->octree.level(); },
    false, budget);
}
}

#endif
