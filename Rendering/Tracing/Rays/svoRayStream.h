// Rays that are asked together, side by side in float: which of them come to a box. Boxes are
// thrown out before any ray is turned into a caster's own coordinates. Wald et al., "Applying Ray
// Streams", and Tsakok, "Faster Incoherent Rays: Multi-BVH Ray Stream Tracing", 2009.
#ifndef svoRayStream_h
#define svoRayStream_h

#include "svoOcclusion.h"
#include "vtkSVOTracingModule.h"

#include <algorithm>
#include <cassert>
#include <cstdint>

#include <glm/vec3.hpp>

namespace svo
{
/// Relative to a point near their starts.
struct StreamRays
{
  static constexpr int Most = OcclusionRays::Most;
  int count = 0;
  alignas(64) float start[3][Most];
  alignas(64) float inverse[3][Most]; // of directions
  alignas(64) float length[Most];     // below 0: meets nothing any more
};

class VTKSVOTRACING_EXPORT RayStream
{
public:
  static constexpr int Most = StreamRays::Most;
  /// Of rays, one bit each.
  struct Mask
  {
    std::uint64_t word[Most / 64];
    bool none() const
    {
      return std::all_of(
        this->word, this->word + Most / 64, [](std::uint64_t w) { return w == 0; });
    }
  };

  /// `near`: of their starts, world.
  explicit RayStream(const glm::dvec3& near)
    : Near(near)
  {
  }

  /// `start`: world; `direction`: unit. Meets nothing unless `length`, which may be infinite, is
  /// larger than 0.
  void add(const glm::dvec3& start, const glm::vec3& direction, float length);

  /// The ray meets nothing more.
  void end(int ray)
  {
    assert(this->Rays.length[ray] > 0.0f);
    this->Rays.length[ray] = Ended;
    --this->Left;
  }
  bool empty() const { return this->Left == 0; }

  /// False if no ray comes to the box; `extent`: half its edges. What floats do not tell apart
  /// counts as reached.
  bool reach(const glm::dvec3& centre, const glm::dvec3& extent) const;
  /// Which do.
  Mask reaching(const glm::dvec3& centre, const glm::dvec3& extent) const;

private:
  static constexpr float Ended = -1.0f;
  static constexpr int MostLanes = 16;
  struct Box
  {
    float low[3], high[3];
  };
  Box boxOf(const glm::dvec3& centre, const glm::dvec3& extent) const;

  const glm::dvec3 Near;
  int Left = 0;
  float Reach = 0.0f; // of starts, from Near
  StreamRays Rays;
};
}

#endif
