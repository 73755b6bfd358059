#include "svoTileNodes.h"

#include "svoSurfacePoint.h"

namespace svo
{
void lookAtNodes(
  const SurfaceMatrices& frame, const View& view, int firstRun, int lastRun, TilePoints& p)
{
  NodeTriangle picked[TilePoints::Most];
  NodeTriangle* doubtful[TilePoints::Most];
  glm::dvec3 towards[TilePoints::Most];
  int doubts = 0;
  const auto each = [&](auto&& f)
  {
    for (int k = firstRun; k < lastRun; ++k)
    {
      for (int i = p.runs[k].first; i < p.runs[k].last && p.primitive[i] & NodePrimitive; ++i)
      {
        f(p.runs[k], i, glm::dvec3(p.positionX[i], p.positionY[i], p.positionZ[i]),
          glm::vec3(p.towardsX[i], p.towardsY[i], p.towardsZ[i]));
      }
    }
  };
  each(
    [&](const TilePoints::Run&, int i, const glm::dvec3& position, const glm::vec3& to)
    {
      picked[i] = pickTriangle(frame, p.primitive[i] & ~NodePrimitive, position, to);
      if (!picked[i].faces)
      {
        towards[doubts] = frame.toOctree.vector(glm::dvec3(to));
        doubtful[doubts++] = &picked[i];
      }
    });
  if (doubts > 0)
  {
    settleTriangles(frame.instance->octree, doubtful, towards, doubts);
  }
  each(
    [&](TilePoints::Run& run, int i, const glm::dvec3& position, const glm::vec3& to)
    {
      SurfacePoint point = pointOfTriangle(frame, position, to, picked[i].triangle, picked[i].at);
      if (!view.plain)
      {
        turnAsShaders(frame, view, point);
      }
      p.set(i, point);
      run.hasColor = point.hasColor;
    });
}
}
