#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoTilePoints.cxx"
#include <hwy/foreach_target.h>

#include "svoTilePoints.h"

#include "svoTileNodes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <hwy/highway.h>

#ifndef SVO_TILE_POINTS_ONCE
#define SVO_TILE_POINTS_ONCE
namespace svo
{
/// What the points of a triangle share.
struct TriangleLook
{
  WorldToOctree toOctree;
  glm::vec3 winding; // world, unit
  // For barycentric coordinates; octree coordinates.
  glm::dvec3 a;
  glm::vec3 e1, e2;
  float d11, d12, d22, determinant;
  glm::mat3 normalMatrix;
  glm::vec3 normals[3]; // local
};
}
#endif

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
void place(const View& view, TilePoints& p)
{
  const glm::dvec3 o = view.origin, oX = view.originX, oY = view.originY;
  const glm::dvec3 d = view.direction, dX = view.directionX, dY = view.directionY;
  const double z1 = view.viewToClip[2][2], z0 = view.viewToClip[3][2];
  const double w1 = view.viewToClip[2][3], w0 = view.viewToClip[3][3];
  const int n = (p.count + TilePoints::Step - 1) / TilePoints::Step * TilePoints::Step;
  for (int i = 0; i < n; ++i)
  {
    const double x = p.x[i], y = p.y[i], t = p.t[i];
    const double rayX = d.x + x * dX.x + y * dY.x;
    const double rayY = d.y + x * dX.y + y * dY.y;
    const double rayZ = d.z + x * dX.z + y * dY.z;
    p.positionX[i] = o.x + x * oX.x + y * oY.x + t * rayX;
    p.positionY[i] = o.y + x * oX.y + y * oY.y + t * rayY;
    p.positionZ[i] = o.z + x * oX.z + y * oY.z + t * rayZ;
    p.towardsX[i] = static_cast<float>(-rayX);
    p.towardsY[i] = static_cast<float>(-rayY);
    p.towardsZ[i] = static_cast<float>(-rayZ);
    const double z = z1 * -t + z0;
    const double w = w1 * -t + w0;
    p.window[i] = 0.5 * z / w + 0.5;
  }
}

/// Facets of points [first, last), all on one triangle, and normals that are all the same.
void faceViewer(
  const glm::vec3& winding, const glm::vec3& normal, int first, int last, TilePoints& p)
{
  for (int i = first; i < last; i += TilePoints::Step)
  {
    for (int k = i; k < i + TilePoints::Step; ++k)
    {
      const float along =
        winding.x * p.towardsX[k] + winding.y * p.towardsY[k] + winding.z * p.towardsZ[k];
      const float side = along > 0.0f ? 1.0f : -1.0f;
      p.facetX[k] = side * winding.x;
      p.facetY[k] = side * winding.y;
      p.facetZ[k] = side * winding.z;
      p.normalX[k] = side * normal.x;
      p.normalY[k] = side * normal.y;
      p.normalZ[k] = side * normal.z;
    }
  }
}

/// Barycentric coordinates of points [first, last), from index 0 on.
void weigh(
  const TriangleLook& l, const TilePoints& p, int first, int last, float* wa, float* wb, float* wc)
{
  const glm::dmat3& m = l.toOctree.inverse;
  const glm::dvec3 from = l.toOctree.translation, o = l.toOctree.origin;
  const double scale = l.toOctree.scale;
  for (int i = first; i < last; i += TilePoints::Step)
  {
    for (int k = 0; k < TilePoints::Step; ++k)
    {
      const double x = p.positionX[i + k] - from.x;
      const double y = p.positionY[i + k] - from.y;
      const double z = p.positionZ[i + k] - from.z;
      const double lx = m[0].x * x + m[1].x * y + m[2].x * z;
      const double ly = m[0].y * x + m[1].y * y + m[2].y * z;
      const double lz = m[0].z * x + m[1].z * y + m[2].z * z;
      const float px = static_cast<float>(1.0 + (lx - o.x) * scale - l.a.x);
      const float py = static_cast<float>(1.0 + (ly - o.y) * scale - l.a.y);
      const float pz = static_cast<float>(1.0 + (lz - o.z) * scale - l.a.z);
      const float p1 = px * l.e1.x + py * l.e1.y + pz * l.e1.z;
      const float p2 = px * l.e2.x + py * l.e2.y + pz * l.e2.z;
      float v = l.determinant > 0.0f ? (l.d22 * p1 - l.d12 * p2) / l.determinant : 0.0f;
      float w = l.determinant > 0.0f ? (l.d11 * p2 - l.d12 * p1) / l.determinant : 0.0f;
      v = v < 0.0f ? 0.0f : 1.0f < v ? 1.0f : v;
      w = w < 0.0f ? 0.0f : 1.0f < w ? 1.0f : w;
      const float sum = v + w < 1.0f ? 1.0f : v + w;
      wa[i - first + k] = 1.0f - (v + w) / sum;
      wb[i - first + k] = v / sum;
      wc[i - first + k] = w / sum;
    }
  }
}

/// Interpolated normals. Returns true if one cannot be made a unit vector this way.
bool interpolateNormals(const TriangleLook& l, int first, int last, const float* wa,
  const float* wb, const float* wc, TilePoints& p)
{
  const glm::mat3 m = l.normalMatrix;
  const glm::vec3 winding = l.winding;
  const glm::vec3 a = l.normals[0], b = l.normals[1], c = l.normals[2];
  int odd = 0;
  for (int i = first; i < last; i += TilePoints::Step)
  {
    for (int k = 0; k < TilePoints::Step; ++k)
    {
      const int j = i - first + k;
      const float lx = wa[j] * a.x + wb[j] * b.x + wc[j] * c.x;
      const float ly = wa[j] * a.y + wb[j] * b.y + wc[j] * c.y;
      const float lz = wa[j] * a.z + wb[j] * b.z + wc[j] * c.z;
      const float x = m[0].x * lx + m[1].x * ly + m[2].x * lz;
      const float y = m[0].y * lx + m[1].y * ly + m[2].y * lz;
      const float z = m[0].z * lx + m[1].z * ly + m[2].z * lz;
      const float length2 = x * x + y * y + z * z;
      odd |= int(!(length2 > 1e-30f)) | int(!(length2 < 1e30f));
      const float length = std::sqrt(length2);
      const float along = winding.x * p.towardsX[i + k] + winding.y * p.towardsY[i + k] +
        winding.z * p.towardsZ[i + k];
      const float side = along > 0.0f ? 1.0f : -1.0f;
      p.normalX[i + k] = side * (x / length);
      p.normalY[i + k] = side * (y / length);
      p.normalZ[i + k] = side * (z / length);
    }
  }
  return odd != 0;
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
  for (int i = p.count; i < p.count + TilePoints::Step; ++i)
  {
    p.x[i] = p.x[p.count - 1];
    p.y[i] = p.y[p.count - 1];
    p.t[i] = p.t[p.count - 1];
  }
}

/// One by one, whatever they are.
void lookAtEach(const SurfaceMatrices& frame, const View& view, TilePoints::Run& run, TilePoints& p)
{
  for (int i = run.first; i < run.last; ++i)
  {
    const SurfacePoint point = surfacePoint(frame, view, p.x[i], p.y[i], p.t[i], p.primitive[i]);
    p.set(i, point);
    run.hasColor = point.hasColor;
  }
}

/// turnAsShaders() of all points.
void turnRun(
  const SurfaceMatrices& frame, const View& view, const TilePoints::Run& run, TilePoints& p)
{
  for (int i = run.first; !view.plain && i < run.last; ++i)
  {
    SurfacePoint point;
    point.position = { p.positionX[i], p.positionY[i], p.positionZ[i] };
    point.facet = { p.facetX[i], p.facetY[i], p.facetZ[i] };
    point.normal = { p.normalX[i], p.normalY[i], p.normalZ[i] };
    turnAsShaders(frame, view, point);
    p.normalX[i] = point.normal.x;
    p.normalY[i] = point.normal.y;
    p.normalZ[i] = point.normal.z;
  }
}

void setColor(TilePoints& p, int i, const glm::vec3& color)
{
  p.colorR[i] = color.r;
  p.colorG[i] = color.g;
  p.colorB[i] = color.b;
}

void lookAtRun(const SurfaceMatrices& frame, const View& view, TilePoints::Run& run, TilePoints& p)
{
  const Instance& instance = *frame.instance;
  const Attributes& attributes = instance.attributes;
  const Surface* surface = instance.octree.surface();
  const Primitive primitive = p.primitive[run.first];
  if (!surface)
  {
    lookAtEach(frame, view, run, p);
    return;
  }
  const glm::uvec3 triangle = surface->triangles[primitive];
  const glm::vec3 a = surface->points[triangle.x];
  TriangleLook l;
  l.e1 = surface->points[triangle.y] - a;
  l.e2 = surface->points[triangle.z] - a;
  const glm::vec3 winding = frame.windingMatrix * glm::cross(l.e1, l.e2);
  const float winding2 = glm::dot(winding, winding);
  if (!(winding2 > 1e-30f && winding2 < 1e30f))
  {
    lookAtEach(frame, view, run, p);
    return;
  }
  l.winding = winding / std::sqrt(winding2);
  const bool pointNormals =
    attributes.normals && attributes.normalAssociation == Association::Point;
  const bool cellNormals = attributes.normals && attributes.normalAssociation == Association::Cell;
  const bool smooth = !instance.material.flat && pointNormals;
  const bool texture = attributes.colorCoordinates && attributes.colorTextureSize > 0;
  const bool pointColors =
    !texture && attributes.colors && attributes.colorAssociation == Association::Point;
  const bool cellColors =
    !texture && attributes.colors && attributes.colorAssociation == Association::Cell;
  const std::uint32_t cell = surface->cells.empty() ? primitive : surface->cells[primitive];
  alignas(64) float wa[TilePoints::Room], wb[TilePoints::Room], wc[TilePoints::Room];
  if (smooth || texture || pointColors)
  {
    l.toOctree = frame.toOctree;
    l.a = glm::dvec3(a);
    l.d11 = glm::dot(l.e1, l.e1);
    l.d12 = glm::dot(l.e1, l.e2);
    l.d22 = glm::dot(l.e2, l.e2);
    l.determinant = l.d11 * l.d22 - l.d12 * l.d12;
    HWY_DYNAMIC_DISPATCH(weigh)(l, p, run.first, run.last, wa, wb, wc);
  }
  glm::vec3 normal = l.winding;
  if (cellNormals && !smooth)
  {
    const glm::vec3 ofCell = frame.normalMatrix * detail::vectorAt(attributes.normals, cell);
    const float length2 = glm::dot(ofCell, ofCell);
    if (!(length2 > 1e-30f && length2 < 1e30f))
    {
      lookAtEach(frame, view, run, p);
      return;
    }
    normal = ofCell / std::sqrt(length2);
  }
  HWY_DYNAMIC_DISPATCH(faceViewer)(l.winding, normal, run.first, run.last, p);
  if (smooth)
  {
    l.normalMatrix = frame.normalMatrix;
    l.normals[0] = detail::vectorAt(attributes.normals, triangle.x);
    l.normals[1] = detail::vectorAt(attributes.normals, triangle.y);
    l.normals[2] = detail::vectorAt(attributes.normals, triangle.z);
    if (HWY_DYNAMIC_DISPATCH(interpolateNormals)(l, run.first, run.last, wa, wb, wc, p))
    {
      lookAtEach(frame, view, run, p);
      return;
    }
  }
  turnRun(frame, view, run, p);
  run.hasColor = texture || pointColors || cellColors;
  if (texture)
  {
    const glm::vec2 ca = detail::coordinatesAt(attributes, triangle.x);
    const glm::vec2 cb = detail::coordinatesAt(attributes, triangle.y);
    const glm::vec2 cc = detail::coordinatesAt(attributes, triangle.z);
    for (int i = run.first, j = 0; i < run.last; ++i, ++j)
    {
      const int texel = detail::texelAt(attributes, wa[j] * ca + wb[j] * cb + wc[j] * cc);
      setColor(p, i, detail::colorAt(attributes.colorTexture, texel));
    }
  }
  else if (pointColors)
  {
    const glm::vec3 ca = detail::colorAt(attributes.colors, triangle.x);
    const glm::vec3 cb = detail::colorAt(attributes.colors, triangle.y);
    const glm::vec3 cc = detail::colorAt(attributes.colors, triangle.z);
    for (int i = run.first, j = 0; i < run.last; ++i, ++j)
    {
      setColor(p, i, wa[j] * ca + wb[j] * cb + wc[j] * cc);
    }
  }
  else if (cellColors)
  {
    const glm::vec3 color = detail::colorAt(attributes.colors, cell);
    for (int i = run.first; i < run.last; ++i)
    {
      setColor(p, i, color);
    }
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
