// What the eye may see of surfaces that are rasterised, and where a light's map has it.
#ifndef svoSeenReceivers_h
#define svoSeenReceivers_h

#include "svoBox.h"
#include "svoConvexParts.h"
#include "svoHits.h"
#include "svoView.h"

#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
class SeenReceivers
{
public:
  /// `receivers`: boxes around them, world. A box is taken for a tenth of its diagonal wider on all
  /// sides, since smooth surfaces are looked up beside their facets (svoTerminator.h). A flat one,
  /// a ground as a rule, has no such, and is taken in parts: what of it the eye sees past what was
  /// traced. `traced`: by the eye.
  SeenReceivers(const std::vector<Box>& receivers, const View& eye, const Hits& traced);

  /// Rectangles of texels of a light's map in which all is that their points look up.
  std::vector<PixelRect> in(const View& map) const;

private:
  struct Part
  {
    ConvexBody box;
    ConvexBody seen;                // a piece of the eye's view
    std::vector<glm::dvec3> points; // whose convex hull both have in common
  };
  /// Of a box that is flat along an axis, what the eye sees of it in a part of its picture.
  void addSeen(
    const ConvexBody& box, int axis, const PixelRect& around, const View& eye, const Hits& traced);

  std::vector<Part> Parts;
};
}

#endif
