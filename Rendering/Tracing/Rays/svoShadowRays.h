// Exact shadows: a ray from a visible point to a light, through every caster; rays of points that
// lie close together go as a beam where a caster's leaves are triangles (svoShadowBeam.h).
#ifndef svoShadowRays_h
#define svoShadowRays_h

#include "svoLight.h"
#include "svoRayCasters.h"
#include "svoShadowBeam.h"
#include "svoSurfacePoint.h"
#include "svoTilePatch.h"

#include <cstdint>

#include <glm/vec3.hpp>

namespace svo
{
class ShadowRays
{
public:
  /// The casters are borrowed.
  explicit ShadowRays(const RayCasters& casters)
    : Casters(casters)
  {
  }

  /// True if a caster lies between the point and the light. The ray starts off the point's own
  /// surface, along the facet on the light's side, by `offset` (world): the error of its leaf.
  bool shadows(
    const Light& light, const glm::dvec3& position, const glm::vec3& facet, double offset) const;

  /// The same for the points of a patch that are `asked`, one bit a pixel: those that are shadowed.
  std::uint64_t shadows(
    const Light& light, const TilePatch& patch, double offset, std::uint64_t asked) const;

  /// The same for points anywhere, of which those close together are the quicker ones, bit i for
  /// number i; at most Most.
  static constexpr int Most = BeamPoints::Most;
  std::uint64_t shadows(
    const Light& light, const SurfacePoint* const* points, int count, double offset) const;

  /// Those rays, and these points, know nothing of translucent casters. True if there are some.
  bool translucent() const { return !this->Casters.translucent().empty(); }
  /// The share of the light that they take from the points of a patch that are `asked`, by pixel,
  /// 0..1; 0 of others. Of each caster it is what the ray from the light meets first that counts.
  void taken(const Light& light, const TilePatch& patch, double offset, std::uint64_t asked,
    float* taken) const;

  /// The start of that ray, world.
  static glm::dvec3 start(
    const Light& light, const glm::dvec3& position, const glm::vec3& facet, double offset);

  /// True if a caster lies between two points, farther from the first one than `offset` and than
  /// the error of its own leaves (world).
  bool between(const glm::dvec3& from, const glm::dvec3& to, double offset) const;

private:
  const RayCasters& Casters;
};
}

#endif
