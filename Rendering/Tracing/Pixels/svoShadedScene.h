// What is sampled and shaded, for the length of a frame.
#ifndef svoShadedScene_h
#define svoShadedScene_h

#include "svoFrameTiles.h"
#include "svoReceiverSampler.h"
#include "svoTileSampler.h"

namespace svo
{
struct ShadedScene : SampledFrame
{
  const TileSampler& sampler; // of the eye
  const FrameTiles& tiles;    // of the frame that is written
};
}

#endif
