// What is sampled and shaded, for the length of a frame.
#ifndef svoShadedScene_h
#define svoShadedScene_h

#include "svoFrame.h"
#include "svoFrameTiles.h"
#include "svoHits.h"
#include "svoScene.h"
#include "svoShadows.h"
#include "svoTileSampler.h"
#include "svoView.h"

namespace svo
{
struct ShadedScene
{
  const Scene& scene;
  const View& view;
  const FrameSettings& settings;
  const Hits& eye;
  const TileSampler& sampler; // of the eye
  const FrameTiles& tiles;    // of the frame that is written
  const Shadows& dark;
};
}

#endif
