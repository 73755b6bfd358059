// Rays in octree coordinates, one at a time and in blocks of 64, and what they hit.
#ifndef svoRay_h
#define svoRay_h

#include "svoLayout.h"

#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

namespace svo
{
/// One ray, x(t) = origin + t * direction for t in [tMin, tMax]. The direction is not normalised:
/// t is the same number in all coordinates that an affine map leads to.
struct Ray
{
  glm::dvec3 origin;
  glm::dvec3 direction;
  double tMin = 0.0;
  double tMax = 1e300;
};

/// Names what was hit, in 32 bits: a triangle id (below NodePrimitive), or of an octree of planes
/// the index of the plane in its lists, or NodePrimitive | index of the node whose mean plane
/// stands for the surface where a ray stopped above the bricks.
using Primitive = std::uint32_t;
constexpr Primitive NodePrimitive = 0x80000000u;
constexpr Primitive NoPrimitive = 0xffffffffu;

struct Hit
{
  double t = 0.0;
  Primitive primitive = NoPrimitive;
  glm::ivec3 cell{ -1 }; // the cell that was hit, integer coordinates at `level`
  int level = 0;
  explicit operator bool() const { return primitive != NoPrimitive; }
};

/// How rays end.
struct TraceOptions
{
  LeafGeometry leafGeometry = LeafGeometry::Automatic;
  int level = MaximumLevel; // rays stop at cells of this octree level (clamped to the octree's own)
};

/// Rays as a structure of arrays, in octree coordinates ([1,2)^3 is the cube); origins lie within a
/// few units of it.
template <int N>
struct RayArrays
{
  static constexpr int Size = N;
  alignas(64) float originX[Size], originY[Size], originZ[Size];
  alignas(64) float directionX[Size], directionY[Size], directionZ[Size];
  alignas(64) float tMax[Size];

  glm::vec3 origin(int i) const { return { originX[i], originY[i], originZ[i] }; }
  glm::vec3 direction(int i) const { return { directionX[i], directionY[i], directionZ[i] }; }
  /// Sets where ray i begins and where it goes, of floats or doubles.
  template <class Vector>
  void aim(std::size_t i, const Vector& from, const Vector& along)
  {
    originX[i] = static_cast<float>(from.x);
    originY[i] = static_cast<float>(from.y);
    originZ[i] = static_cast<float>(from.z);
    directionX[i] = static_cast<float>(along.x);
    directionY[i] = static_cast<float>(along.y);
    directionZ[i] = static_cast<float>(along.z);
  }
};

/// An 8x8 tile of pixels or of light texels, or any 64 rays. Origins lie within a few units of the
/// cube (the caller re-originates in double), t is relative to an origin of the caller's. A ray
/// with tMin > tMax or with a NaN anywhere is never a hit.
struct RayBlock : RayArrays<64>
{
  alignas(64) float tMin[Size];
};

/// Answer to a RayBlock. t is undefined where the primitive is NoPrimitive.
struct HitBlock
{
  alignas(64) float t[RayBlock::Size];
  alignas(64) Primitive primitive[RayBlock::Size];
};
}

#endif
