// Rays from a light to points that lie close together, through one octree: the exact shadow test of
// a tile's points.
//
// The rays fill a narrow beam. As those of a tile of pixels do (svoIntersectTile.h) they go through
// the octree together, from the light to the points, and meet the few triangles that are in the
// beam side by side, in float. Where a ray meets its nearest triangle is then computed in double,
// with the numbers that a ray alone has (svoShadowRays.h): so what lies right behind a point, its
// own surface first of all, is told from what lies right before it.
//
// The answers are those of rays alone but for rays that pass an edge by less than what floats
// resolve in the octree's cube (BeamRounding), and points that an occluder touches as closely.
#ifndef svoShadowBeam_h
#define svoShadowBeam_h

#include "svoLight.h"
#include "svoOctree.h"
#include "svoRay.h"
#include "svoWorldToOctree.h"
#include "vtkSVOTracingModule.h"

#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

namespace svo
{
/// How far a beam's rays can be off, of the edge of the octree's root cube: three roundings of
/// coordinates below 4 and of directions that are followed for at most 4.
constexpr double BeamRounding = 1e-6;

/// Of at most 64 points, in an octree's coordinates.
struct BeamPoints
{
  static constexpr int Most = 64;
  int count = 0;
  glm::dvec3 at[Most];
};

enum class BeamAnswer : std::uint8_t
{
  Lit,
  Dark,     // a triangle is between the point and the light
  Undecided // the light lies on a triangle: a ray alone knows what is behind
};

/// Answers all points. False, and nothing is answered, where the beam is too wide to see at most
/// `mostNodes` nodes: ask for fewer points. `nearest`: where not null, the triangles that make
/// points dark, those nearest to the light.
VTKSVOTRACING_EXPORT bool traceBeam(const Octree& octree, const WorldToOctree& toOctree,
  const Light& light, const BeamPoints& points, BeamAnswer* answers, Primitive* nearest = nullptr,
  std::size_t mostNodes = 256);
}

#endif
