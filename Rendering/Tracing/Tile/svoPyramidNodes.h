// Which nodes of an octree a tile's rays can meet: the highest with short lists of triangles
// (svoShortLists.h), and bricks.
//
// The rays of a tile fill a narrow pyramid. A node is outside of it if it is beyond one of the four
// sides, each a linear function of octree coordinates; all 64 cells of a node are compared at once.
#ifndef svoPyramidNodes_h
#define svoPyramidNodes_h

#include "svoGroupView.h"
#include "svoOctree.h"
#include "vtkSVOTracingModule.h"

#include <cmath>
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

/// What ten roundings to float can do to a linear function of octree coordinates, which begin at 1.
inline double roundingSlack(const glm::dvec4& f)
{
  return (std::abs(f.x) + std::abs(f.y) + std::abs(f.z) + std::abs(f.x + f.y + f.z + f.w)) /
    (1 << 18);
}

/// The sides in float, with what rounding can do to them allowed for: functions of octree
/// coordinates minus 1, negative beyond the side.
struct PyramidSides
{
  alignas(16) float x[4], y[4], z[4], w[4];

  explicit PyramidSides(const TilePyramid& pyramid)
  {
    for (int k = 0; k < 4; ++k)
    {
      const glm::dvec4& f = pyramid.side[k];
      x[k] = static_cast<float>(f.x);
      y[k] = static_cast<float>(f.y);
      z[k] = static_cast<float>(f.z);
      w[k] = static_cast<float>(f.x + f.y + f.z + f.w + roundingSlack(f));
    }
  }
};

/// A node that a tile's rays may meet: one with a short list, or a brick.
struct TileNode
{
  float tNear; // not above the t of any hit inside
  std::uint32_t node;
};

/// Pixels of a group, the last ones included.
struct GroupWindow
{
  std::uint8_t x0 = 0, x1 = GroupView::Pixels - 1, y0 = 0, y1 = GroupView::Pixels - 1;
};

/// A node that the rays of a group of 4x4 tiles may meet.
struct GroupNode
{
  float tNear; // likewise
  std::uint32_t node;
  GroupWindow box; // pixels whose centres it may cover
};

/// Finds the nodes inside the pyramid between tMin and tMax, nearest first. False if there are more
/// than `most`: then they are not all there. The octree must have a surface.
VTKSVOTRACING_EXPORT bool findTileNodes(const Octree& octree, const TilePyramid& pyramid,
  float tMin, float tMax, std::size_t most, std::vector<TileNode>& nodes);

/// The same for a group of 4x4 tiles: nearer ones first, by and large, and none that lies between
/// the centres of pixels. The pyramid is that of the group; nodes are those of the `window`.
VTKSVOTRACING_EXPORT bool findGroupNodes(const Octree& octree, const TilePyramid& pyramid,
  float tMin, float tMax, std::size_t most, std::vector<GroupNode>& nodes,
  const GroupWindow& window = {});
}

#endif
