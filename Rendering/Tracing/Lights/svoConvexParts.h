// The intersection of convex bodies: boxes, and pieces of views.
#ifndef svoConvexParts_h
#define svoConvexParts_h

#include "svoView.h"
#include "vtkSVOTracingModule.h"

#include <array>
#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
/// Eight corners, as of a cube: corner i lies at the upper end of x if i & 1, of y if i & 2, of z
/// if i & 4. Faces are flat; a body may be flat as well.
using ConvexBody = std::array<glm::dvec3, 8>;

/// The piece of a view between two linear depths.
VTKSVOTRACING_EXPORT ConvexBody pieceOf(const View& view, double nearest, double farthest);

/// A face of a body, and the half-space dot(normal, x) >= offset that the body lies in.
struct ConvexFace
{
  std::vector<glm::dvec3> polygon;
  glm::dvec3 normal;
  double offset;
  bool flat; // the whole body lies in its plane
};

/// What some bodies have in common with one body after the other.
class VTKSVOTRACING_EXPORT CommonPart
{
public:
  explicit CommonPart(const std::vector<ConvexBody>& bodies);

  /// Adds points whose convex hull is the intersection of `body` and all of them; none if it is
  /// empty.
  void add(const ConvexBody& body, std::vector<glm::dvec3>& points) const;

private:
  std::vector<std::vector<ConvexFace>> Faces; // of a body
};
}

#endif
