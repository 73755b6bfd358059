// Balls and rods as copies of one unit shape, in their places.
#ifndef svoPlacedShapes_h
#define svoPlacedShapes_h

#include "svoGlyphCopies.h"
#include "svoRoundShapes.h"
#include "svoView.h"

#include <memory>

#include <glm/mat4x4.hpp>

namespace svo
{
/// Where copies of the unit ball, or of the unit rod (UnitShapes), are these shapes: `copies` get
/// their places in what `localToWorld` leads to. `eye` is asked for what is Pixels wide only; with
/// a size of 0 it is not known, and radii are taken for lengths. A rod has the mean width of its
/// ends; where one end is more than a quarter farther from the eye than the other, it is more than
/// one copy, each with the mean of its own: no more than an eighth off.
void placeShapes(
  const RoundShapes& shapes, const glm::dmat4& localToWorld, const View& eye, GlyphSet& copies);

/// RoundShapes whose copies are placed in the world, anew when their actor moves, and those with a
/// width in pixels when the eye does.
struct PlacedShapes
{
  std::shared_ptr<const RoundShapes> shapes;
  glm::dmat4 localToWorld{ 1.0 }; // the actor's
  std::shared_ptr<GlyphSet> copies;
};
}

#endif
