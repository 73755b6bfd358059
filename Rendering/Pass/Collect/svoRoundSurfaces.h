// Splats, impostors, tubes and spheres as casters. VTK goes on drawing them.
#ifndef svoRoundSurfaces_h
#define svoRoundSurfaces_h

#include "svoCollectedActor.h"
#include "svoUnitShapes.h"

#include <vector>

namespace svo
{
/// Adds what an actor's mapper draws that draws nothing else.
void collectRoundShapes(const CollectedActor& actor, UnitShapes& units);

/// Adds the tubes and spheres of a part whose scalars have been mapped to `attributes`. True if it
/// draws any.
bool collectTubes(const CollectedActor& actor, const SurfacePart& part,
  const Attributes& attributes, UnitShapes& units);

/// Puts the shapes of collected props in their places: of props that are fresh or have moved, and
/// unless `sameEye` those with a width in pixels.
void placeRoundShapes(std::vector<PropSurfaces>& props, const View& eye, bool sameEye);
}

#endif
