// A ball on a ground, whose shadow is looked at by tests of maps.
#ifndef svoBallOnGround_h
#define svoBallOnGround_h

#include "svoTracerScenes.h"

namespace svotest
{
inline const svo::View Eye = lookAt({ 1, -6, 4 }, 160, 120);

/// A matte ball on a ground.
inline svo::Scene ballOnGround(svo::LeafGeometry leafGeometry, int level = 8)
{
  svo::Scene scene;
  scene.instances = { instanceOf(makeOctree(square(3.0), level), 1, glm::dmat4(1.0), leafGeometry),
    instanceOf(makeOctree(sphere(40, 64), level), 2, movedTo(0.0, 0.0, 1.5), leafGeometry) };
  return scene;
}

inline svo::FrameSettings settingsOf(svo::ShadowTechnique technique)
{
  svo::FrameSettings settings;
  settings.shadowTechnique = technique;
  settings.shadowResolution = 512;
  return settings;
}
}

#endif
