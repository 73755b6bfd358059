// Exact shadows: a ray from a visible point to a light, through every caster; rays of points that
// lie close together go as a beam where a caster's leaves are triangles (svoShadowBeam.h).
#ifndef svoShadowRays_h
#define svoShadowRays_h

#include "svoCasterBox.h"
#include "svoHits.h"
#include "svoLooseOctree.h"
#include "svoScene.h"
#include "svoShadowBeam.h"
#include "svoSurfacePoint.h"
#include "svoTilePatch.h"
#include "svoWorldToOctree.h"

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
class ShadowRays
{
public:
  /// `eye`: of its leaf geometries. `tree`: of the scene's instances (svoInstanceTree.h), borrowed;
  /// null: each ray looks at each caster. The answers are the same.
  ShadowRays(const Scene& scene, const Hits& eye, const LooseOctree* tree = nullptr);

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
  bool translucent() const { return !this->Translucent.empty(); }
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
  struct Caster
  {
    const Instance* instance;
    LeafGeometry geometry;
    WorldToOctree toOctree;
    double planeError; // world; how far plane leaves among triangles can be off, 0 without any
    double leafError;  // world; how far any leaf can be off
    bool beams;        // all leaves are triangles
    CasterBox box;
  };
  /// Close together, on the light's side of their surface.
  struct Start;
  static bool blocks(const Caster& caster, const Light& light, const glm::dvec3& position,
    const glm::dvec3& side, double offset);
  /// How opaque the caster is where the light of a point that it blocks() meets it first.
  static float opacityMet(const Caster& caster, const Light& light, const glm::dvec3& position,
    const glm::dvec3& side, double offset);
  /// Changes the order of the starts.
  std::uint64_t shadows(const Light& light, Start* starts, int count, double offset) const;
  std::uint64_t beam(
    const Caster& caster, const Light& light, const Start* starts, int count, double offset) const;
  /// Calls visit(caster) for those that may lie on the way from points of `from`, at most `share`
  /// times `along`, until one of them says true; that is the answer.
  template <class Visit>
  bool anyOnTheWay(
    const PointBox& from, const glm::dvec3& along, double share, const Visit& visit) const;
  template <class Visit>
  bool anyBeforeLight(const Light& light, const PointBox& from, const Visit& visit) const;

  std::vector<Caster> Casters, Translucent;
  const LooseOctree* Tree;
  std::vector<std::uint32_t> Casting; // by index of the instance: index into Casters, or None
  static constexpr std::uint32_t None = ~0u;
};
}

#endif
