// Rays of any directions from points that lie close together, through all casters of a scene: what
// of each is blocked.
//
// Each caster's rays go through its octree side by side, in float (svoOcclusion.h), from where they
// come near to it. They begin off the points' own surface, where that is a caster by more than
// floats resolve in its cube. Answers depend neither on which rays are asked together, nor on their
// order.
#ifndef svoSampleRays_h
#define svoSampleRays_h

#include "svoDepthBuffer.h"
#include "svoOcclusion.h"
#include "svoRayCasters.h"
#include "vtkSVOTracingModule.h"

#include <cassert>
#include <cstdint>

#include <glm/vec3.hpp>

namespace svo
{
/// World.
struct SampleBatch
{
  static constexpr int MostPoints = 64;
  static constexpr int MostRays = OcclusionRays::Most;

  static constexpr std::uint32_t AnyInstance = NoInstance - 1;
  std::uint32_t own = NoInstance; // index of the instance that the points lie on; or any may be it
  int points = 0;
  glm::dvec3 position[MostPoints];
  glm::vec3 side[MostPoints]; // unit, of its surface, to where its rays go
  int rays = 0;
  std::uint8_t point[MostRays];
  glm::vec3 direction[MostRays]; // unit
  float length[MostRays];        // may be infinite
  float blocked[MostRays];       // the answer, 0..1

  int addPoint(const glm::dvec3& at, const glm::vec3& towards)
  {
    assert(this->points < MostPoints);
    this->position[this->points] = at;
    this->side[this->points] = towards;
    return this->points++;
  }
  void addRay(int from, const glm::vec3& along, float reach)
  {
    assert(from < this->points && this->rays < MostRays);
    this->point[this->rays] = static_cast<std::uint8_t>(from);
    this->direction[this->rays] = along;
    this->length[this->rays++] = reach;
  }
};

/// Sets what is blocked of each ray: all by an opaque caster, by a translucent one what it takes of
/// light (ShadowRays::taken()). They start `offset` (world), or what a caster's planes are off, off
/// their surface. Where a float does not tell that off another caster's surface nothing is known of
/// what is nearer to it.
VTKSVOTRACING_EXPORT void traceSamples(
  const RayCasters& casters, double offset, SampleBatch& batch);
}

#endif
