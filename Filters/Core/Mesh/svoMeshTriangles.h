// A vtkPolyData cut into triangles, the way VTK's OpenGL mapper draws it.
#ifndef svoMeshTriangles_h
#define svoMeshTriangles_h

#include "svoBuild.h"
#include "vtkSVOCoreModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

class vtkPolyData;

namespace svo
{
/// As many triangles as a mesh has, or more: a polygon or strip of n points makes n - 2.
VTKSVOCORE_EXPORT std::size_t triangleBound(vtkPolyData* mesh);

/// Triangles of the polygons, then of the strips. A polygon is a fan around its first point, as in
/// vtkOpenGLIndexBufferObject, unless it is flat, convex and has thousands of points; a strip's
/// triangles alternate, so that all have the strip's winding. Triangles with two ids alike are left
/// out. Vertices and lines have no triangles, but count in the cell ids. Does not change the mesh.
class VTKSVOCORE_EXPORT MeshTriangles
{
public:
  /// The mesh must stay alive and unchanged as long as this object: double points are not copied.
  explicit MeshTriangles(vtkPolyData* mesh);

  /// False if the mesh has more points, triangles or cells than 32 bits can number.
  bool addressable() const { return this->Addressable; }
  /// Polygons and strips that name a point which does not exist; they are left out.
  std::size_t brokenCells() const { return this->Broken; }
  /// For svo::build; valid as long as this object.
  TriangleMesh view() const;
  /// vtkPolyData's cell id of every triangle.
  const std::vector<std::uint32_t>& cells() const { return this->Cells; }
  std::vector<std::uint32_t>& cells() { return this->Cells; }

private:
  std::vector<glm::dvec3> Copy;
  const glm::dvec3* Points = nullptr;
  std::size_t PointCount = 0;
  std::vector<glm::uvec3> Triangles;
  std::vector<std::uint32_t> Cells;
  std::size_t Broken = 0;
  bool Addressable = true;
};
}

#endif
