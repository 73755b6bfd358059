#include "svoTileNodes.h"

#include "svoSurfacePoint.h"

#include <cassert>

namespace svo
{
void lookAtNodes(
  const SurfaceMatrices& frame, const View& view, int firstRun, int lastRun, TilePoints& p)
{
  assert(firstRun >= 0 && lastRun <= p.runCount && frame.instance->octree.surface());
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
        f(p.runs[k], i);
      }
    }
  };
  each(
    [&](const TilePoints::Run&, int i)
    {
      const glm::vec3 to = p.towards(i);
      picked[i] = pickTriangle(frame, p.primitive[i] & ~NodePrimitive, p.position(i), to);
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
  each([&](TilePoints::Run& run, int i)
    { lookAtPoint(frame, view, picked[i].triangle, picked[i].at, run, i, p); });
}
}
