// The visible points of an 8x8 tile, side by side, ordered so that points of one triangle are
// neighbours: shared values are computed once, the rest in loops that the compiler turns into
// vectors, for whatever instruction set the machine has.
//
// The results are those of pointOfTriangle() (svoSurfacePoint.h), bit for bit: both call the
// functions of svoPointLane.h.
#ifndef svoTilePoints_h
#define svoTilePoints_h

#include "svoDepthBuffer.h"
#include "svoSurfacePoint.h"
#include "svoView.h"

#include <cassert>
#include <cstdint>
#include <vector>

namespace svo
{
struct TilePoints
{
  static constexpr int Most = 64;
  /// Loops take this many points at once. They may run over the end of a part: what they write
  /// there is not valid until its own turn.
  static constexpr int Step = 16;
  static constexpr int Room = Most + Step;

  /// Points of one triangle of one instance.
  struct Run
  {
    int first, last;
    std::uint32_t instance;
    bool hasColor;
  };

  int count = 0;
  int runCount = 0;
  Run runs[Most];
  std::uint8_t pixel[Room]; // in the tile, row by row
  std::uint32_t instance[Room];
  Primitive primitive[Room];
  alignas(64) double x[Room], y[Room]; // on the image, pixels
  alignas(64) double t[Room];          // linear depth
  alignas(64) double window[Room];     // OpenGL window depth, without offsets
  alignas(64) double positionX[Room], positionY[Room], positionZ[Room]; // world
  alignas(64) float towardsX[Room], towardsY[Room], towardsZ[Room];     // to the viewer, not unit
  // As in SurfacePoint.
  alignas(64) float facetX[Room], facetY[Room], facetZ[Room];
  alignas(64) float normalX[Room], normalY[Room], normalZ[Room];
  alignas(64) float colorR[Room], colorG[Room], colorB[Room];

  /// Points [first, last) of one instance.
  int endOfInstance(int first) const
  {
    assert(first >= 0 && first < count);
    int last = first + 1;
    while (last < count && instance[last] == instance[first])
    {
      ++last;
    }
    return last;
  }
  glm::dvec3 position(int i) const { return { positionX[i], positionY[i], positionZ[i] }; }
  glm::vec3 towards(int i) const { return { towardsX[i], towardsY[i], towardsZ[i] }; }
  glm::vec3 facet(int i) const { return { facetX[i], facetY[i], facetZ[i] }; }
  glm::vec3 normal(int i) const { return { normalX[i], normalY[i], normalZ[i] }; }
  SurfacePoint point(int i) const
  {
    return { this->position(i), this->facet(i), this->normal(i),
      { colorR[i], colorG[i], colorB[i] }, false };
  }
  void setFacet(int i, const glm::vec3& facet)
  {
    facetX[i] = facet.x;
    facetY[i] = facet.y;
    facetZ[i] = facet.z;
  }
  void setNormal(int i, const glm::vec3& normal)
  {
    normalX[i] = normal.x;
    normalY[i] = normal.y;
    normalZ[i] = normal.z;
  }
  void setColor(int i, const glm::vec3& color)
  {
    colorR[i] = color.r;
    colorG[i] = color.g;
    colorB[i] = color.b;
  }
};

/// Facet, normal and colour of point i, which is on a triangle at `at`; see pointOfTriangle().
inline void lookAtPoint(const SurfaceMatrices& frame, const View& view, Primitive triangle,
  const glm::dvec3& at, TilePoints::Run& run, int i, TilePoints& points)
{
  const SurfacePoint point =
    pointOfTriangle(frame, view, points.position(i), points.towards(i), triangle, at);
  points.setFacet(i, point.facet);
  points.setNormal(i, point.normal);
  points.setColor(i, point.color);
  run.hasColor = point.hasColor;
}

/// Takes the hits of a tile whose instance `wanted(instance)`, in the order of the tile's pixels.
/// Sets everything up to and including `t`. Returns false if there is none.
template <class Wanted, class BaseOf>
bool takePoints(const DepthBuffer& depth, const View& view, int tileX, int tileY, Wanted&& wanted,
  BaseOf&& baseOf, TilePoints& points)
{
  assert(tileX >= 0 && tileX < depth.tilesX && tileY >= 0 && tileY < depth.tilesY);
  const std::size_t begin = 64 * (static_cast<std::size_t>(tileY) * depth.tilesX + tileX);
  points.count = 0;
  for (int k = 0; k < 64; ++k)
  {
    const int x = 8 * tileX + (k & 7);
    const int y = 8 * tileY + (k >> 3);
    const std::uint32_t instance = depth.instance[begin + k];
    if (instance == NoInstance || x >= view.width || y >= view.height || !wanted(instance))
    {
      continue;
    }
    const int i = points.count++;
    points.pixel[i] = static_cast<std::uint8_t>(k);
    points.instance[i] = instance;
    points.primitive[i] = depth.primitive[begin + k];
    points.x[i] = x + 0.5;
    points.y[i] = y + 0.5;
    points.t[i] = baseOf(instance) + depth.t[begin + k];
  }
  return points.count > 0;
}

/// Sets the positions, the directions to the viewer and the window depths.
void placePoints(const View& view, TilePoints& points);

/// Brings the points of one triangle together and sets facets, normals and colours. `frames` by
/// index of the instance.
void lookAtPoints(const std::vector<SurfaceMatrices>& frames, const View& view, TilePoints& points);
}

#endif
