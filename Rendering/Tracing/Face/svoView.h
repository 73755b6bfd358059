// A view: the rays of an image, for the eye and for lights alike.
#ifndef svoView_h
#define svoView_h

#include "vtkSVOTracingModule.h"

#include <algorithm>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// A rectangle of pixels, upper bounds excluded.
struct PixelRect
{
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool empty() const { return x0 >= x1 || y0 >= y1; }
  double pixels() const { return empty() ? 0.0 : static_cast<double>(x1 - x0) * (y1 - y0); }
  bool overlaps(const PixelRect& o) const
  {
    return x0 < o.x1 && o.x0 < x1 && y0 < o.y1 && o.y0 < y1;
  }
  bool operator==(const PixelRect& o) const
  {
    return x0 == o.x0 && y0 == o.y0 && x1 == o.x1 && y1 == o.y1;
  }
};

/// The smallest one that holds both.
inline PixelRect around(const PixelRect& a, const PixelRect& b)
{
  return a.empty() ? b
    : b.empty()    ? a
                   : PixelRect{ std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1),
                    std::max(a.y1, b.y1) };
}

/// What both hold.
inline PixelRect common(const PixelRect& a, const PixelRect& b)
{
  return { std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1) };
}

/// Every pixel's ray is an affine function of the pixel: at pixel centre (x, y), with x, y counted
/// from the lower left corner of the image in pixels (the first centre is 0.5, 0.5),
///
///   origin(x, y)    = origin    + x originX    + y originY       (world)
///   direction(x, y) = direction + x directionX + y directionY    (world)
///
/// and the ray parameter t is the linear depth: distance from the eye plane along the view axis,
/// in world units. A perspective view has originX = originY = 0, a parallel one directionX =
/// directionY = 0. t is affine-invariant, so the same number in every object's coordinates.
struct VTKSVOTRACING_EXPORT View
{
  glm::dvec3 origin{ 0.0 }, originX{ 0.0 }, originY{ 0.0 };
  glm::dvec3 direction{ 0.0, 0.0, -1.0 }, directionX{ 0.0 }, directionY{ 0.0 };
  double tNear = 0.0;  // rays start here (near plane)
  double tFar = 1e300; // and end here (far plane)
  int width = 0;       // pixels
  int height = 0;      // pixels
  /// The pixels that are looked at: all of them, but for a light whose casters fill a larger image
  /// than is wanted. It begins with a whole tile of 8x8 pixels. What a pixel's ray is does not hang
  /// on it, to the bit.
  PixelRect crop;

  glm::dmat4 worldToView{ 1.0 }; // rigid; view space looks along -z
  glm::dmat4 viewToClip{ 1.0 };  // OpenGL clip space, z in [-w, w]
  bool parallel = false;

  /// Rays come from the eye, or go along the axis, and front faces are wound to the left, as in all
  /// common projections: the side of a facet that rays see is the one that VTK's shaders light.
  bool plain = true;
  bool mirrored = false;       // front faces are wound to the right, so VTK lights their backs
  bool facetsFaceAxis = false; // facets without normals are lit as they face the axis, not the eye
  glm::dvec3 eye{ 0.0 };       // origin of view space, world
  glm::dvec3 axis{ 0, 0, -1.0 }; // view direction, world

  glm::dvec3 rayOrigin(double x, double y) const { return origin + x * originX + y * originY; }
  glm::dvec3 rayDirection(double x, double y) const
  {
    return direction + x * directionX + y * directionY;
  }
  /// It looks at all of its image.
  bool isWhole() const { return this->crop == PixelRect{ 0, 0, this->width, this->height }; }
  /// OpenGL window depth, 0..1, of linear depth t. Depends on t only for every projection whose
  /// last row has no x and y terms (all of VTK's).
  double windowDepth(double t) const
  {
    // View space has z = -t; the last two rows of the projection know nothing of x and y.
    const double z = viewToClip[2][2] * -t + viewToClip[3][2];
    const double w = viewToClip[2][3] * -t + viewToClip[3][3];
    return 0.5 * z / w + 0.5;
  }
  /// The inverse: infinity where no ray is so deep.
  double linearDepth(double windowDepth) const;
};

/// The view of a projection: any matrix whose last row is (0, 0, a, b), so off-axis, explicit and
/// parallel projections included. False if the matrix cannot be inverted or is not finite.
VTKSVOTRACING_EXPORT bool makeView(
  const glm::dmat4& worldToView, const glm::dmat4& viewToClip, int width, int height, View& view);

/// The view whose image is the crop of another's alone; its rays are those but for rounding.
VTKSVOTRACING_EXPORT View cropped(const View& view);

/// True if a pixel of the one has the same ray as that of the other.
VTKSVOTRACING_EXPORT bool sameImage(const View& a, const View& b);
/// True if the two views look at the same pixels of the same image as well.
inline bool sameRays(const View& a, const View& b)
{
  return a.crop == b.crop && sameImage(a, b);
}
}

#endif
