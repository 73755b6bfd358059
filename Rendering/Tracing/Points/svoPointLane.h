// The arithmetic of a visible point on its triangle, for one point. The loops over the points of a
// tile (svoTileLook.cxx) call it, and become vectors; pointOfTriangle() calls it for one point.
#ifndef svoPointLane_h
#define svoPointLane_h

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// The second and the third of three barycentric coordinates, clamped to 0..1, and what all three
/// are to be divided by for their sum to be 1.
struct ClampedWeights
{
  float v, w, sum;
};

inline ClampedWeights clampWeights(float v, float w)
{
  const float v0 = v < 0.0f ? 0.0f : v, w0 = w < 0.0f ? 0.0f : w;
  const float v1 = v0 < 1.0f ? v0 : 1.0f, w1 = w0 < 1.0f ? w0 : 1.0f;
  const float sum = v1 + w1;
  return { v1, w1, sum < 1.0f ? 1.0f : sum };
}

/// Barycentric coordinates of the point of a triangle that is near another point, as ratios of
/// areas, clamped to at least 0 and scaled to sum 1. Of a triangle that is n times as long as wide
/// they are off by n roundings; with dot products of the edges, by Cramer's rule, it were n
/// squared. `p`, `e1`, `e2`: the other point and the second and third corner, from the first one.
inline glm::vec3 nearWeights(const glm::vec3& p, const glm::vec3& e1, const glm::vec3& e2)
{
  const glm::vec3 area = glm::cross(e1, e2);
  const float area2 = glm::dot(area, area);
  const ClampedWeights c =
    clampWeights(area2 > 0.0f ? glm::dot(glm::cross(p, e2), area) / area2 : 0.0f,
      area2 > 0.0f ? glm::dot(glm::cross(e1, p), area) / area2 : 0.0f);
  return { 1.0f - (c.v + c.w) / c.sum, c.v / c.sum, c.w / c.sum };
}

/// The same of a point whose two latter coordinates are affine in its way from an origin: there
/// they are `v` and `w`, and grow by `alongV` and `alongW`.
inline glm::vec3 affineWeights(
  const glm::vec3& way, float v, const glm::vec3& alongV, float w, const glm::vec3& alongW)
{
  const ClampedWeights c = clampWeights(v + glm::dot(alongV, way), w + glm::dot(alongW, way));
  const float scale = 1.0f / c.sum;
  return { 1.0f - (c.v + c.w) * scale, c.v * scale, c.w * scale };
}

/// The same, not clamped: of a point anywhere on the triangle's plane.
inline glm::vec3 planeWeights(
  const glm::vec3& way, float v, const glm::vec3& alongV, float w, const glm::vec3& alongW)
{
  const float b = v + glm::dot(alongV, way), c = w + glm::dot(alongW, way);
  return { 1.0f - (b + c), b, c };
}

/// What the corners of a triangle have, at barycentric coordinates.
template <class Vector>
Vector weighted(const glm::vec3& weight, const Vector (&corners)[3])
{
  return weight.x * corners[0] + weight.y * corners[1] + weight.z * corners[2];
}

/// 1 if the side that a triangle winds to faces the viewer, else -1.
inline float sideLane(const glm::vec3& winding, const glm::vec3& towards)
{
  return glm::dot(winding, towards) > 0.0f ? 1.0f : -1.0f;
}

/// False if floats are too short or too long for unitLane().
inline bool hasUnitLane(const glm::vec3& v)
{
  const float length2 = glm::dot(v, v);
  return (length2 > 1e-30f) & (length2 < 1e30f);
}

inline glm::vec3 unitLane(const glm::vec3& v)
{
  return v / std::sqrt(glm::dot(v, v));
}
}

#endif
