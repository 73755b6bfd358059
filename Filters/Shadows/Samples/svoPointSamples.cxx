#include "svoPointSamples.h"

#include "svoSampleOrder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/mat3x3.hpp>

namespace svo
{
namespace
{
bool isFinite(const glm::dvec3& v)
{
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Of the triangles around each point; crosses are twice the areas.
std::vector<glm::dvec3> meanNormals(const TriangleMesh& mesh)
{
  std::vector<glm::dvec3> normals(mesh.pointCount, glm::dvec3(0.0));
  for (std::size_t t = 0; t < mesh.triangleCount; ++t)
  {
    const glm::uvec3 ids = mesh.triangles[t];
    const glm::dvec3& a = mesh.points[ids.x];
    const glm::dvec3 cross = glm::cross(mesh.points[ids.y] - a, mesh.points[ids.z] - a);
    for (int i = 0; i < 3 && isFinite(cross); ++i)
    {
      normals[ids[i]] += cross;
    }
  }
  return normals;
}
}

PointSamples::PointSamples(
  const TriangleMesh& mesh, std::vector<glm::dvec3> normals, const glm::dmat4& toWorld)
  : Mesh(mesh)
  , Normals(normals.empty() ? meanNormals(mesh) : std::move(normals))
  , ToWorld(toWorld)
{
  // Of all matrices that take normals along, the one whose normals keep to the outside when it
  // mirrors.
  this->NormalToWorld = glm::inverseTranspose(glm::dmat3(toWorld));
  std::vector<std::uint32_t> ids;
  std::vector<glm::dvec3> points;
  for (std::size_t i = 0; i < mesh.pointCount; ++i)
  {
    const glm::dvec3 x(toWorld * glm::dvec4(mesh.points[i], 1.0));
    if (isFinite(x))
    {
      ids.push_back(static_cast<std::uint32_t>(i));
      points.push_back(x);
    }
  }
  this->Order = mortonOrder(points);
  for (std::uint32_t& i : this->Order)
  {
    i = ids[i];
  }
}

void PointSamples::piece(
  std::size_t index, std::vector<std::uint32_t>& places, std::vector<Sample>& samples) const
{
  places.clear();
  samples.clear();
  const std::size_t end = std::min((index + 1) * PieceSamples, this->Order.size());
  for (std::size_t i = index * PieceSamples; i < end; ++i)
  {
    const std::uint32_t id = this->Order[i];
    const glm::dvec3 normal = this->NormalToWorld * this->Normals[id];
    const double length = glm::length(normal);
    samples.push_back({ glm::dvec3(this->ToWorld * glm::dvec4(this->Mesh.points[id], 1.0)),
      length > 0.0 && std::isfinite(length) ? normal / length : glm::dvec3(0.0), id,
      static_cast<std::uint32_t>(places.size()), 1.0 });
    places.push_back(id);
  }
}
}
