// The shadow test of the points of a patch against one map of a shadow buffer: single points' rules
// (svoTexelPlace.h, svoShadowTest.h) in single precision, counted from the patch's origin. Each
// answer says how far off it may be; where that decides, it is left to the test of one point, in
// double. So a patch gets the answers of its points, all of them, and asks for few.
#ifndef svoTileShadows_h
#define svoTileShadows_h

#include "svoLight.h"
#include "svoMapTexels.h"
#include "svoTexelPlace.h"
#include "svoTilePatch.h"

#include <cstdint>

namespace svo
{
/// What texels say to points, and what they do not. By pixel.
struct TexelTests
{
  alignas(64) float occluder[TilePatch::Most]; // linear depth, less t0
  alignas(64) float bias[TilePatch::Most];     // world, along the light
  alignas(64) float error[TilePatch::Most];    // world, along the normal
  /// Points that are dark; dark by an occluder nearby; and those whose answer is not certain.
  std::uint64_t dark, nearby, unsure;
};

/// Sets all occluders, of one caster: `base` plus each of the depths, in double.
void setOccluders(double base, const TexelOccluders& occluders, TexelTests& tests);

/// Tests points of `lanes`, which are inside of the map and each in a texel that something lies at.
void testTexels(const MapGeometry& map, const TilePatch& patch, std::uint64_t lanes,
  const MapPlaces& places, TexelTests& tests);

/// Which of the points in `asked` may turnsAway() from the light, by `grazing`, or DoubtfulSine
/// where they are `dark`. All that do are among them.
std::uint64_t mayTurnAway(const Light& light, double grazing, const TilePatch& patch,
  std::uint64_t asked, std::uint64_t dark);
}

#endif
