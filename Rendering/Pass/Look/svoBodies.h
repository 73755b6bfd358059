// Balls and rods that VTK draws for points and lines: where they are, how wide, and their copies of
// one unit shape.
#ifndef svoBodies_h
#define svoBodies_h

#include "svoGlyphCopies.h"
#include "svoView.h"

#include <cstddef>
#include <memory>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace svo
{
struct Bodies
{
  enum class Shape
  {
    Ball,
    Rod
  };
  /// What a radius is.
  enum class Width
  {
    Local, // a length in the frame of the input, which the actor's matrix scales
    World, // a length in the world, whatever the actor's matrix is
    Pixels // so many pixels at the body's place
  };
  Shape shape = Shape::Ball;
  Width width = Width::Local;
  std::vector<glm::dvec3> ends; // of balls the centres, of rods both ends, which differ; finite
  std::vector<double> radii;    // of each; empty: all have `radius`
  double radius = 1.0;          // above 0

  std::size_t count() const { return this->ends.size() / (this->shape == Shape::Rod ? 2 : 1); }
};

/// Where copies of the unit ball, or of the unit rod (UnitShapes), are these bodies: `copies` get
/// their places in what `localToWorld` leads to. `eye` is asked for what is Pixels wide only; with
/// a size of 0 it is not known, and radii are taken for lengths. A rod has the mean width of its
/// ends; where one end is more than a quarter farther from the eye than the other, it is more than
/// one copy, each with the mean of its own: no more than an eighth off.
void placeBodies(
  const Bodies& bodies, const glm::dmat4& localToWorld, const View& eye, GlyphSet& copies);

/// Bodies whose copies are placed in the world, anew when their actor moves, and those with a width
/// in pixels when the eye does.
struct PlacedBodies
{
  std::shared_ptr<const Bodies> bodies;
  glm::dmat4 localToWorld{ 1.0 }; // the actor's
  std::shared_ptr<GlyphSet> copies;
};
}

#endif
