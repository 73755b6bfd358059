// The intersection of convex bodies: boxes, and pieces of views.
#ifndef svoConvexParts_h
#define svoConvexParts_h

#include "svoView.h"

#include <array>
#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
/// Eight corners, as of a cube: corner i lies at the upper end of x if i & 1, of y if i & 2, of z
/// if i & 4. Faces are flat; a body may be flat as well.
using ConvexBody = std::array<glm::dvec3, 8>;

/// The piece of a view between two linear depths.
ConvexBody pieceOf(const View& view, double nearest, double farthest);

/// Adds points whose convex hull is the intersection of all bodies; none if it is empty.
void addCommonPart(const std::vector<ConvexBody>& bodies, std::vector<glm::dvec3>& points);
}

#endif
