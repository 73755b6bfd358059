// The contour of a mesh as a light sees it: the edges between what faces the light and what does
// not, at which its shadow volume begins. (Crow, Shadow Algorithms for Computer Graphics, SIGGRAPH
// 1977; for meshes that are not closed: Kim, Kim, Kim, Shadow Volumes for General Meshes, 2008.)
#ifndef svoLightContour_h
#define svoLightContour_h

#include "svoMeshEdges.h"
#include "svoSurface.h"
#include "vtkSVOOpenGLModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec4.hpp>

namespace svo
{
/// Every triangle counts as one that faces the light, turned round if it does not, but for those of
/// solid parts that face away from a light outside: these are left out. Each stands for the
/// infinite prism behind it. Of all prisms together only the sides remain on whose both sides there
/// are not equally many.
class VTKSVOOPENGL_EXPORT LightContour
{
public:
  using Edge = MeshEdges::Edge; // so that the prisms lie to the left, seen from the light

  /// Of the same mesh as before, wherever the light was then. `light`, octree coordinates: where it
  /// is, and 1; or the way towards it, and 0. Triangles are asked one by one, or with `bundles` by
  /// their normals where these tell; those that have turned change what their edges count, and
  /// edges and senses are read off anew if there are any. True if it is another contour than
  /// before.
  bool update(
    const Surface& surface, const MeshEdges& mesh, const glm::dvec4& light, bool bundles = true);

  /// Each as often as it bounds prisms.
  const std::vector<Edge>& edges() const { return this->Edges; }
  /// By face, 16 a word, from the lowest bits on: 1 as it is wound, 2 turned round, 0 left out.
  std::vector<std::uint32_t> senses() const;

  /// Of the last update: triangles that were asked one by one, and those that have turned.
  std::size_t asked() const { return this->Asked; }
  std::size_t turned() const { return this->Turned; }

  /// Forgets what makes the next update() quick; the contour stays.
  void forget();
  std::size_t bytes() const;

private:
  void turn(const MeshEdges& mesh, std::uint32_t face, int sense);
  void collect(const MeshEdges& mesh);

  std::vector<std::int8_t> Senses;  // by face: 1 as it is wound, -1 turned round, 0 left out
  std::vector<std::int8_t> Whole;   // by bundle: the sense that all of it has; else Mixed
  std::vector<std::int32_t> Counts; // by edge: prisms along it less prisms against it
  std::vector<Edge> Edges;
  bool Outside = true; // the light, of the mesh
  std::size_t Asked = 0, Turned = 0;
};
}

#endif
