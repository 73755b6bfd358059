// Which edges the triangles of a mesh share: what the contour that a light sees is made of.
#ifndef svoMeshEdges_h
#define svoMeshEdges_h

#include "svoSurface.h"
#include "vtkSVOOpenGLModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace svo
{
/// Of any mesh: closed or open, and with edges that more than two triangles have. Points at the
/// same place are one. Corner 3 t + k is that of Surface::triangles[t][k].
struct VTKSVOOPENGL_EXPORT MeshEdges
{
  explicit MeshEdges(const Surface& surface);

  static constexpr std::uint32_t None = ~0u;

  struct Edge
  {
    std::uint32_t from, to; // corners
  };
  std::vector<Edge> edges;

  struct Face
  {
    /// Twice the index of an edge, and 1 if the triangle goes along it from `to` to `from`; None of
    /// those that join a point with itself.
    std::uint32_t edges[3];
    /// Its part of the mesh is closed, and wound so that its triangles are seen from outside: what
    /// is in the way of a ray from behind is told by the triangles that face the light. By its
    /// volume: of a part that turns itself inside out somewhere, that lobe's own inside is not
    /// told.
    bool solid;
  };
  std::vector<Face> faces;

  /// Faces whose normals lie close together: a cell of a cube of directions. (Zhang and Hoff, Fast
  /// Backface Culling Using Normal Masks, I3D 1997.)
  struct Bundle
  {
    std::uint32_t first, end; // in `bundled`
    glm::dvec3 axis;          // unit
    double angle;             // to the farthest of its normals, radians
  };
  std::vector<Bundle> bundles;
  std::vector<std::uint32_t> bundled; // faces, bundle by bundle; those without a normal come last

  glm::dvec3 centre{ 0.0 }; // of the points, octree coordinates
  double radius = 0.0;      // of a ball around there that holds them

  std::size_t bytes() const
  {
    return this->edges.size() * sizeof(Edge) + this->faces.size() * sizeof(Face) +
      this->bundles.size() * sizeof(Bundle) + this->bundled.size() * sizeof(std::uint32_t);
  }
};
}

#endif
