// The nearest triangles of 64 rays that lie close together: an 8x8 tile of pixels or light texels.
//
// The rays of a tile fill a narrow pyramid. Instead of walking each of them through the octree, the
// octree is gone through once for all of them: nodes outside the pyramid are left out, and nodes
// with few triangles (svoShortLists.h) settle the rest, each triangle against all rays side by
// side. The hits are those of LeafGeometry::Triangle, to the last bit: the nearest triangle, of
// equally near ones the one with the smallest id. It pays off while the triangles that a tile sees
// are few; where they are smaller than pixels, walking each ray (svoIntersect.h) does not depend on
// their number.
#ifndef svoIntersectTile_h
#define svoIntersectTile_h

#include "svoOctree.h"
#include "svoRay.h"
#include "vtkSVOOctreeModule.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec4.hpp>

namespace svo
{
/// What holds the rays of a tile, as linear functions f(p) = f.x p.x + f.y p.y + f.z p.z + f.w of
/// octree coordinates p.
struct TilePyramid
{
  glm::dvec4 side[4]; // not negative inside
  glm::dvec4 t;       // the rays' parameter
};

/// A node that a tile's rays may meet: one with a short list, or a brick.
struct TileNode
{
  float tNear; // not above the t of any hit inside
  std::uint32_t node;
  float x, y, z, size; // its cube: lower corner, octree coordinates minus 1, and edge
};

/// The nodes of a group of tiles, found together; each tile then takes its own out of them.
class VTKSVOOCTREE_EXPORT TileGroup
{
public:
  /// Finds the nodes inside the group's pyramid; false if there are more than `most`.
  bool find(
    const Octree& octree, const TilePyramid& pyramid, float tMin, float tMax, std::size_t most);
  /// Those inside the pyramid of one of its tiles, nearest first: what rays of the tile can meet is
  /// among them.
  void select(const TilePyramid& pyramid, std::vector<TileNode>& nodes) const;

private:
  std::vector<TileNode> Nodes; // nearest first
  /// Their cubes: lower corners, octree coordinates minus 1, and edges; room for a vector more.
  std::vector<float> X, Y, Z, Size;
};

/// Finds the nodes inside the pyramid between tMin and tMax, nearest first. False if there are more
/// than `most`: then they are not all there. The octree must have a surface.
VTKSVOOCTREE_EXPORT bool findTileNodes(const Octree& octree, const TilePyramid& pyramid, float tMin,
  float tMax, std::size_t most, std::vector<TileNode>& nodes);

/// The nearest hits of the rays, all inside the pyramid, among the triangles of `nodes`. Results do
/// not depend on the instruction set.
VTKSVOOCTREE_EXPORT void intersectTile(const Octree& octree, const TilePyramid& pyramid,
  const std::vector<TileNode>& nodes, const RayBlock& rays, HitBlock& hits);
}

#endif
