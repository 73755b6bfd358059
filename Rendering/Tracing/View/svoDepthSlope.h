// How a plane's window depth changes from pixel to pixel.
#ifndef svoDepthSlope_h
#define svoDepthSlope_h

#include "svoOctree.h"
#include "svoPlane.h"
#include "svoRay.h"
#include "svoSurface.h"
#include "svoView.h"
#include "svoWorldToOctree.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// By how much the window depth of a plane grows from pixel to pixel, to the right and upwards: all
/// over the plane the same. The ray of the image's point (x, y) meets it at linear depth t;
/// `normal` is the plane's, of any length, world. 0 of planes that are seen edge on.
inline glm::dvec2 depthSlope(
  const View& view, double x, double y, double t, const glm::dvec3& normal)
{
  const double along = glm::dot(normal, view.rayDirection(x, y));
  const glm::dvec2 deeper(-(glm::dot(normal, view.originX) + t * glm::dot(normal, view.directionX)),
    -(glm::dot(normal, view.originY) + t * glm::dot(normal, view.directionY)));
  // The derivative of View::windowDepth().
  const glm::dmat4& m = view.viewToClip;
  const double z = m[3][2] - m[2][2] * t;
  const double w = m[3][3] - m[2][3] * t;
  const glm::dvec2 slope = 0.5 * (m[2][3] * z - m[2][2] * w) / (w * w) / along * deeper;
  const bool valid = std::abs(slope.x) + std::abs(slope.y) < 1.0;
  return { valid ? slope.x : 0.0, valid ? slope.y : 0.0 };
}

/// How steep the facet of a hit is: the length of depthSlope(), a multiple of which offsets of
/// coincident topology add. A node's is that of its mean plane.
inline double steepness(const Octree& octree, const WorldToOctree& toOctree, const View& view,
  double x, double y, double t, Primitive primitive)
{
  glm::dvec3 normal(0.0);
  if (primitive & NodePrimitive)
  {
    normal = decodePlane(octree.nodes()[primitive & ~NodePrimitive].plane).normal;
  }
  else if (octree.hasPlanes())
  {
    normal = decodePlane(octree.lists()[primitive]).normal;
  }
  else if (const Surface* surface = octree.surface())
  {
    normal = TrianglePlane(*surface, primitive).normal;
  }
  return glm::length(depthSlope(view, x, y, t, toOctree.gradient(normal)));
}
}

#endif
