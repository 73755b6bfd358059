// How far from a light lies what the eye may see of receivers, in tiles of the light's views: which
// casters are in front of some of it.
#ifndef svoSeenDepths_h
#define svoSeenDepths_h

#include "svoConvexParts.h"
#include "svoLight.h"
#include "svoOutline.h"
#include "svoView.h"
#include "vtkSVOOpenGLModule.h"

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
class VTKSVOOPENGL_EXPORT SeenDepths
{
public:
  /// `casters`: one byte an outline. Bodies are taken for a little larger than they are.
  SeenDepths(const std::vector<Outline>& outlines, const std::vector<std::uint8_t>& casters,
    const Light& light, const View& eye);

  /// True if something that the eye may see can lie in a caster's shadow.
  bool behind(const Outline& caster) const;

  /// How far along a light at infinity, in the world, lies what the eye may see of any receiver;
  /// minus infinity: it sees none.
  double last() const { return this->Last; }

private:
  static constexpr int Tiles = 64; // along an edge of a view
  /// One of a light's views.
  struct LightView
  {
    View view;
    CommonPart piece; // with its rays
    /// Linear depths, row by row; minus infinity where nothing is seen.
    std::vector<double> depths;
  };
  struct Footprint;
  static Footprint footprintOf(const LightView& seen, const std::vector<glm::dvec3>& points);

  std::vector<LightView> Views; // empty: nobody knows
  double Last;
};
}

#endif
