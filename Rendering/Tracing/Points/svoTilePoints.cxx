#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoTilePoints.cxx"
#include <hwy/foreach_target.h>

#include "svoTilePoints.h"

#include "svoTileNodes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <hwy/highway.h>

#ifndef SVO_TILE_POINTS_ONCE
#define SVO_TILE_POINTS_ONCE
namespace svo
{
/// Barycentric coordinates, by index of the point minus the first.
struct TileWeights
{
  alignas(64) float a[TilePoints::Room], b[TilePoints::Room], c[TilePoints::Room];
  glm::vec3 at(int i) const { return { a[i], b[i], c[i] }; }
};
}
#endif

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
constexpr int Step = TilePoints::Step;

// Loops vectorise where what they read of all points alike has been copied first.

void place(const View& from, TilePoints& p)
{
  const View view = from;
  const int n = (p.count + Step - 1) / Step * Step;
  for (int i = 0; i < n; ++i)
  {
    const double x = p.x[i], y = p.y[i], t = p.t[i];
    const glm::dvec3 ray = view.rayDirection(x, y);
    const glm::dvec3 position = view.rayOrigin(x, y) + t * ray;
    p.positionX[i] = position.x;
    p.positionY[i] = position.y;
    p.positionZ[i] = position.z;
    p.towardsX[i] = static_cast<float>(-ray.x);
    p.towardsY[i] = static_cast<float>(-ray.y);
    p.towardsZ[i] = static_cast<float>(-ray.z);
    p.window[i] = view.windowDepth(t);
  }
}

/// Facets of points [first, last), all on one triangle, and normals that are all the same.
void faceViewer(
  const glm::vec3& unitWinding, const glm::vec3& unitNormal, int first, int last, TilePoints& p)
{
  assert(first < last && last <= p.count);
  const glm::vec3 winding = unitWinding, normal = unitNormal;
  for (int i = first; i < last; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      const float side = sideLane(winding, p.towards(k));
      p.setFacet(k, side * winding);
      p.setNormal(k, side * normal);
    }
  }
}

void weigh(const TriangleLook& on, const WorldToOctree& from, const TilePoints& p, int first,
  int last, TileWeights& weights)
{
  const TriangleLook look = on;
  const WorldToOctree toOctree = from;
  for (int i = first; i < last; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      const glm::vec3 weight = look.weights(toOctree.point(p.position(k)));
      weights.a[k - first] = weight.x;
      weights.b[k - first] = weight.y;
      weights.c[k - first] = weight.z;
    }
  }
}

/// Interpolated normals. Returns false if one cannot be made a unit vector this way.
bool interpolateNormals(const TriangleLook& on, const glm::mat3& matrix,
  const glm::vec3& unitWinding, const TileWeights& weights, int first, int last, TilePoints& p)
{
  const TriangleLook look = on;
  const glm::mat3 toWorld = matrix;
  const glm::vec3 winding = unitWinding;
  int odd = 0;
  for (int i = first; i < last; i += Step)
  {
    for (int k = i; k < i + Step; ++k)
    {
      const glm::vec3 normal = toWorld * weighted(weights.at(k - first), look.normals);
      odd |= !hasUnitLane(normal);
      p.setNormal(k, sideLane(winding, p.towards(k)) * unitLane(normal));
    }
  }
  return odd == 0;
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(place);
HWY_EXPORT(faceViewer);
HWY_EXPORT(weigh);
HWY_EXPORT(interpolateNormals);

namespace
{
/// Orders the points by instance and primitive.
void makeRuns(TilePoints& p)
{
  assert(p.count > 0 && p.count <= TilePoints::Most);
  // Few are different, and neighbours mostly alike: they are counted, not sorted.
  std::uint64_t keys[TilePoints::Most];
  int counts[TilePoints::Most];
  std::uint8_t which[TilePoints::Most];
  int distinct = 0;
  int last = 0;
  for (int i = 0; i < p.count; ++i)
  {
    const std::uint64_t key = std::uint64_t(p.instance[i]) << 32 | p.primitive[i];
    if (distinct == 0 || keys[last] != key)
    {
      last = 0;
      while (last < distinct && keys[last] != key)
      {
        ++last;
      }
      if (last == distinct)
      {
        keys[distinct] = key;
        counts[distinct++] = 0;
      }
    }
    which[i] = static_cast<std::uint8_t>(last);
    ++counts[last];
  }
  std::uint8_t order[TilePoints::Most];
  for (int k = 0; k < distinct; ++k)
  {
    order[k] = static_cast<std::uint8_t>(k);
  }
  // Of one instance together; the order of its primitives does not matter.
  std::stable_sort(
    order, order + distinct, [&](int a, int b) { return keys[a] >> 32 < keys[b] >> 32; });
  int next[TilePoints::Most];
  int begin = 0;
  p.runCount = distinct;
  for (int k = 0; k < distinct; ++k)
  {
    const int run = order[k];
    next[run] = begin;
    p.runs[k] = { begin, begin + counts[run], static_cast<std::uint32_t>(keys[run] >> 32), false };
    begin += counts[run];
  }
  if (distinct == 1)
  {
    return;
  }
  std::uint8_t pixel[TilePoints::Most];
  double x[TilePoints::Most], y[TilePoints::Most], t[TilePoints::Most];
  std::uint64_t key[TilePoints::Most];
  for (int i = 0; i < p.count; ++i)
  {
    const int to = next[which[i]]++;
    pixel[to] = p.pixel[i];
    x[to] = p.x[i];
    y[to] = p.y[i];
    t[to] = p.t[i];
    key[to] = keys[which[i]];
  }
  for (int i = 0; i < p.count; ++i)
  {
    p.pixel[i] = pixel[i];
    p.x[i] = x[i];
    p.y[i] = y[i];
    p.t[i] = t[i];
    p.instance[i] = static_cast<std::uint32_t>(key[i] >> 32);
    p.primitive[i] = static_cast<Primitive>(key[i]);
  }
}

void pad(TilePoints& p)
{
  assert(p.count > 0 && p.count <= TilePoints::Most);
  for (int i = p.count; i < p.count + TilePoints::Step; ++i)
  {
    p.x[i] = p.x[p.count - 1];
    p.y[i] = p.y[p.count - 1];
    p.t[i] = p.t[p.count - 1];
  }
}

void lookAtRun(const SurfaceMatrices& frame, const View& view, TilePoints::Run& run, TilePoints& p)
{
  const auto oneByOne = [&]
  {
    for (int i = run.first; i < run.last; ++i)
    {
      lookAtPoint(frame, view, p.primitive[i], frame.toOctree.point(p.position(i)), run, i, p);
    }
  };
  if (!frame.instance->octree.surface())
  {
    oneByOne();
    return;
  }
  const TriangleLook look(frame, p.primitive[run.first]);
  if (!hasUnitLane(look.winding) || !hasUnitLane(look.normal))
  {
    oneByOne();
    return;
  }
  TileWeights weights;
  if (look.needsWeights())
  {
    HWY_DYNAMIC_DISPATCH(weigh)(look, frame.toOctree, p, run.first, run.last, weights);
  }
  const glm::vec3 winding = unitLane(look.winding);
  HWY_DYNAMIC_DISPATCH(faceViewer)(winding, unitLane(look.normal), run.first, run.last, p);
  if (look.smooth &&
    !HWY_DYNAMIC_DISPATCH(interpolateNormals)(
      look, frame.normalMatrix, winding, weights, run.first, run.last, p))
  {
    oneByOne();
    return;
  }
  for (int i = run.first; !view.plain && i < run.last; ++i)
  {
    if (shadersTurn(frame, view, p.position(i), p.facet(i)))
    {
      p.setNormal(i, -p.normal(i));
    }
  }
  run.hasColor = look.hasColor;
  const auto colorEach = [&](const auto& color)
  {
    for (int i = run.first; i < run.last; ++i)
    {
      p.setColor(i, color(weights.at(i - run.first)));
    }
  };
  if (look.coloredByPoints)
  {
    colorEach([look](const glm::vec3& weight) { return weighted(weight, look.colors); });
  }
  else if (look.hasColor)
  {
    colorEach([&](const glm::vec3& weight) { return look.color(weight); });
  }
}
}

void placePoints(const View& view, TilePoints& points)
{
  pad(points);
  HWY_DYNAMIC_DISPATCH(place)(view, points);
}

void lookAtPoints(const std::vector<SurfaceMatrices>& frames, const View& view, TilePoints& points)
{
  makeRuns(points);
  placePoints(view, points);
  for (int k = 0; k < points.runCount;)
  {
    const std::uint32_t instance = points.runs[k].instance;
    assert(instance < frames.size() && frames[instance].instance);
    const SurfaceMatrices& frame = frames[instance];
    const int first = k;
    bool nodes = false;
    for (; k < points.runCount && points.runs[k].instance == instance; ++k)
    {
      TilePoints::Run& run = points.runs[k];
      if (frame.instance->octree.surface() && points.primitive[run.first] & NodePrimitive)
      {
        nodes = true;
      }
      else
      {
        lookAtRun(frame, view, run, points);
      }
    }
    if (nodes)
    {
      lookAtNodes(frame, view, first, k, points);
    }
  }
}
}
#endif
