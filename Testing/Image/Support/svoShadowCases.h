// Random shadow maps and random points, and what the processor says of them.
#ifndef svoShadowCases_h
#define svoShadowCases_h

#include "svoFrame.h"
#include "svoShadowBuffer.h"
#include "svoView.h"

#include <vector>

#include <glm/vec3.hpp>

namespace svotest
{
/// A point in the eye's view coordinates, as fragments have it.
struct ShadowCase
{
  glm::vec3 position;
  glm::vec3 facet;  // unit
  glm::vec3 normal; // unit
  float extent;     // how wide a piece of the surface it stands for, world
};

class ShadowCases
{
public:
  static constexpr int Across = 128; // cases along each edge of a picture of all

  /// `parallel`: the light's rays; otherwise they come from a place. `nested`: a second, finer map
  /// is in front of the first.
  ShadowCases(bool parallel, bool nested, const svo::FrameSettings& settings, unsigned int seed);

  /// The points are within these much of where they are said to be: what single precision may do to
  /// them, world units, and to directions, radians.
  static constexpr double Rounding = 1e-5, Tilt = 2e-6;

  /// The share of light that a point misses: the least and the most that points and planes have
  /// within rounding.
  struct Range
  {
    double least, most;
  };
  Range darkness(const ShadowCase& point) const;

  /// The facet turns its back on rays of texels around the point: receivers have another rule
  /// there.
  bool turnsAway(const ShadowCase& point) const;

  std::vector<ShadowCase> points;
  std::vector<svo::ShadowMap> maps;
  svo::View eye;
  svo::FrameSettings settings;

private:
  svo::ShadowBuffer buffer;
};
}

#endif
