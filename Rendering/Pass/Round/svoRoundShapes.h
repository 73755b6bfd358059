// Balls and rods that VTK draws for points and lines: where they are, and how wide.
#ifndef svoRoundShapes_h
#define svoRoundShapes_h

#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
struct RoundShapes
{
  enum class Shape
  {
    Ball,
    Rod
  };
  /// What a radius is.
  enum class Width
  {
    Local, // a length in the input's coordinates, which the actor's matrix scales
    World, // a length in the world, whatever the actor's matrix is
    Pixels // so many pixels at the shape's place
  };
  Shape shape = Shape::Ball;
  Width width = Width::Local;
  std::vector<glm::dvec3> ends; // of balls the centres, of rods both ends, which differ; finite
  std::vector<double> radii;    // of each; empty: all have `radius`
  double radius = 1.0;          // above 0

  std::size_t count() const { return this->ends.size() / (this->shape == Shape::Rod ? 2 : 1); }
};
}

#endif
