#include "svoVDBTransform.h"

#include "svoOctree.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>

namespace svo
{
bool indexToWorld(const openvdb::math::Transform& transform, glm::dmat4& matrix)
{
  if (!transform.isLinear())
  {
    return false;
  }
  // OpenVDB's vectors are rows, GLM's columns: in memory both matrices are the same.
  matrix = glm::make_mat4(transform.baseMap()->getAffineMap()->getMat4().asPointer());
  return true;
}

bool onlyMovesAndScales(const glm::dmat4& matrix)
{
  const double scale = matrix[0][0];
  return scale > 0.0 && glm::dmat3(matrix) == glm::dmat3(scale);
}

bool keepsAngles(const glm::dmat4& matrix)
{
  constexpr double Tolerance = 1e-6;
  const glm::dmat3 linear(matrix);
  const double length = glm::length(linear[0]);
  bool keeps = length > 0.0 && std::isfinite(length);
  for (int i = 0; i < 3; ++i)
  {
    const glm::dvec3 a = linear[i] / length, b = linear[(i + 1) % 3] / length;
    keeps =
      keeps && std::abs(glm::dot(a, b)) < Tolerance && std::abs(glm::dot(a, a) - 1.0) < Tolerance;
  }
  return keeps;
}

openvdb::math::Transform::Ptr transformOf(const Octree& octree)
{
  using openvdb::math::Transform;
  const Header& h = octree.header();
  const glm::dvec3 first = glm::dvec3(h.origin[0], h.origin[1], h.origin[2]) + 0.5 * h.voxelSize;
  if (!octree.hasTransform())
  {
    Transform::Ptr transform = Transform::createLinearTransform(h.voxelSize);
    transform->postTranslate({ first.x, first.y, first.z });
    return transform;
  }
  glm::dmat4 own(h.voxelSize);
  own[3] = glm::dvec4(first, 1.0);
  const glm::dmat4 matrix = octree.transform() * own;
  return Transform::createLinearTransform(openvdb::math::Mat4d(glm::value_ptr(matrix)));
}
}
