// How far the shadow volumes of a light reach, and from which side the eye counts them.
#ifndef svoVolumeReach_h
#define svoVolumeReach_h

#include "svoFrame.h"
#include "svoLight.h"
#include "svoMapCopies.h"
#include "svoOutline.h"
#include "svoSeenDepths.h"
#include "svoView.h"
#include "svoVolumeDraws.h"
#include "svoWorldToOctree.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec4.hpp>

namespace svo
{
/// A light's place in an octree's coordinates, and 1; or the way towards it, and 0.
glm::dvec4 placeOf(const Light& light, const WorldToOctree& to);

/// Of the volumes of one light in a frame.
class VolumeReach
{
public:
  static constexpr double Endless = 1e300;

  /// Volumes have to reach to all that the eye may see of what receives, and to the eye: from there
  /// to what is seen nothing is to leave them by their ends. Those of a light with a place are
  /// endless. `outlines`: of a scene, `casters` one byte each; they and the others live as long as
  /// this.
  VolumeReach(const std::vector<Outline>& outlines, const std::vector<std::uint8_t>& casters,
    const Light& light, const View& view, const FrameSettings& settings);

  /// How far along the light, from the eye on, the volume of an instance reaches, world; Endless.
  /// False if it needs none: nothing that is seen lies in its shadow.
  bool find(std::size_t instance, double& end) const;
  /// By the sides behind where the eye may be in the caster's shadow.
  VolumeDraws::Sides way(const CasterInMemory& caster) const;

private:
  const std::vector<Outline>& Outlines;
  const Light& Of;
  const View& Eye;
  double Last; // of all, along the light, world
  std::optional<SeenDepths> Seen;
};
}

#endif
