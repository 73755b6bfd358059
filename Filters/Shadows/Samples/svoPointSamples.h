// A mesh's points, with their normals.
#ifndef svoPointSamples_h
#define svoPointSamples_h

#include "svoBuild.h"
#include "svoSamples.h"

#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>

namespace svo
{
class PointSamples : public Samples
{
public:
  /// `normals`: one a point, in the mesh's coordinates, of any length; where it is empty they are
  /// the mean of the triangles around a point, weighted by area, and 0 where there are none. The
  /// mesh outlives this object. Points that are not finite are in no piece.
  PointSamples(
    const TriangleMesh& mesh, std::vector<glm::dvec3> normals, const glm::dmat4& toWorld);

  std::size_t placeCount() const override { return this->Order.size(); }
  std::size_t pieces() const override
  {
    return (this->Order.size() + PieceSamples - 1) / PieceSamples;
  }
  void piece(std::size_t index, std::vector<std::uint32_t>& places,
    std::vector<Sample>& samples) const override;

private:
  TriangleMesh Mesh;
  std::vector<glm::dvec3> Normals; // the mesh's coordinates
  glm::dmat4 ToWorld;
  glm::dmat3 NormalToWorld;
  std::vector<std::uint32_t> Order;
};
}

#endif
