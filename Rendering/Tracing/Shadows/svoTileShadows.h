// The shadow test of the visible points of a tile against one map of a shadow buffer:
// svoTexelPlace.h and svoShadowTest.h, point by point, in vectors.
#ifndef svoTileShadows_h
#define svoTileShadows_h

#include "svoScene.h"
#include "svoTexelPlace.h"
#include "svoTilePoints.h"
#include "svoView.h"

#include <cstdint>

#include <glm/mat4x4.hpp>

namespace svo
{
/// The TexelPlace of each point, by index of the point minus `first`.
struct TexelPlaces
{
  alignas(64) double x[TilePoints::Room], y[TilePoints::Room];
  alignas(64) double t[TilePoints::Room], inside[TilePoints::Room];
};

/// What a texel says to a point, and what it does not.
struct TexelTests
{
  alignas(64) double x[TilePoints::Room], y[TilePoints::Room]; // the texel's centre
  alignas(64) double occluder[TilePoints::Room];               // infinity: none
  alignas(64) double bias[TilePoints::Room];                   // world, along the light
  alignas(64) double error[TilePoints::Room];                  // world, along the normal
  alignas(64) double dark[TilePoints::Room]; // answer: 0 lit, 1 dark by an occluder nearby, 2 dark
};

void lookUpTexels(const View& light, const glm::dmat4& worldToClip, const TilePoints& points,
  int first, int last, TexelPlaces& places);

/// Which of the points first..last - 1 are `asked` about and may turnsAway() from the light, by
/// `grazing`, or DoubtfulSine where they are `dark`; by index minus `first`. All that do are among
/// them. False if there are none.
bool mayTurnAway(const Light& light, double grazing, const TilePoints& points, int first, int last,
  const std::uint8_t* asked, const std::uint8_t* dark, std::uint8_t* turned);

void testTexels(const View& light, const TexelEdge& edge, const TilePoints& points, int first,
  int last, const TexelPlaces& places, TexelTests& tests);
}

#endif
