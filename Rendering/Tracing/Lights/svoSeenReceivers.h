// What the eye may see of surfaces that are rasterised, and where a light's map has it.
#ifndef svoSeenReceivers_h
#define svoSeenReceivers_h

#include "svoBox.h"
#include "svoConvexParts.h"
#include "svoView.h"

#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
class SeenReceivers
{
public:
  /// `receivers`: boxes around them, world. A box is taken for a tenth of its diagonal wider on all
  /// sides, since smooth surfaces are looked up beside their facets (svoTerminator.h).
  SeenReceivers(const std::vector<Box>& receivers, const View& eye);

  /// Rectangles of texels of a light's map in which all is that their points look up.
  std::vector<PixelRect> in(const View& map) const;

private:
  struct Part
  {
    ConvexBody box;
    std::vector<glm::dvec3> points; // whose convex hull the eye's view and the box have in common
  };
  std::vector<Part> Parts;
  ConvexBody Eye;
};
}

#endif
