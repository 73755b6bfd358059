// Makes one triangle ready for a group of tiles that cannot be projected corner by corner: it
// crosses the plane of the eye, or reaches too close to it.
//
// Before w is divided by, edges are linear in the pixel all the same: the determinant of two
// corners and the pixel, each as (x, y, w). Its sign is right wherever the triangle is in front of
// the eye; the bounds are those of svoReadyTriangles.cxx in homogeneous coordinates. A corner that
// is off by e changes the determinant at a pixel by no more than e times the distance of the other
// corner from the pixel, |x - px w| + |y - py w|; and what rays hit is off, in w, by the changes of
// the edges' sum and of the whole triangle's determinant, relative to these.
#ifndef svoCrossingTriangle_h
#define svoCrossingTriangle_h

#include "svoSurface.h"
#include "svoTriangleGroup.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// A point as a group sees it: times w.
struct SeenPoint
{
  glm::dvec3 p; // x, y, w
  double k;

  SeenPoint(const GroupView& view, const glm::vec3& point)
  {
    const glm::dvec4 v(glm::dvec3(point) - 1.0, 1.0);
    const auto at = [&](const glm::vec4& f) { return f.x * v.x + f.y * v.y + f.z * v.z + f.w; };
    p = { at(view.x), at(view.y), at(view.w) };
    k = at(view.k);
  }
};

/// The pixels of a group that a triangle may cover; none if x0 > x1 or y0 > y1.
struct PixelBox
{
  double x0 = 1e30, x1 = -1e30, y0 = 1e30, y1 = -1e30;

  void add(const glm::dvec3& p, double error)
  {
    const double x = p.x / p.z, y = p.y / p.z;
    const double shift = error * (1.0 + std::max(std::abs(x), std::abs(y))) / p.z;
    x0 = std::min(x0, x - shift);
    x1 = std::max(x1, x + shift);
    y0 = std::min(y0, y - shift);
    y1 = std::max(y1, y + shift);
  }
  /// From coordinates to the numbers of pixels whose centres lie inside.
  void toPixels()
  {
    constexpr double middle = 0.5 * (GroupView::Pixels - 1), last = GroupView::Pixels - 1;
    x0 = std::max(std::ceil(x0 + middle), 0.0);
    y0 = std::max(std::ceil(y0 + middle), 0.0);
    x1 = std::min(std::floor(x1 + middle), last);
    y1 = std::min(std::floor(y1 + middle), last);
  }
};

/// Adds a triangle to the slots, which have room for it, unless the group does not see it. False if
/// it is seen edge-on, or where too little is known: then it is not added.
inline bool addCrossing(const Surface& surface, std::uint32_t id, const GroupView& view,
  std::uint32_t owner, TriangleGroup::Slots& slots)
{
  constexpr double u = 0x1p-24;
  constexpr double middle = 0.5 * (GroupView::Pixels - 1);
  const glm::uvec3 triangle = surface.triangles[id];
  const SeenPoint corners[3] = { { view, surface.points[triangle.x] },
    { view, surface.points[triangle.y] }, { view, surface.points[triangle.z] } };
  const double error = view.error + 0.5 * GroupView::Pixels * double(view.errorFar);

  // What of it lies where rays are.
  const double front = 0.5 * view.beforeRays;
  const bool far = front >= view.leastW;
  PixelBox box;
  for (int i = 0; i < 3; ++i)
  {
    const glm::dvec3& a = corners[i].p;
    const glm::dvec3& b = corners[(i + 1) % 3].p;
    if (!far)
    {
      box = { -middle, middle, -middle, middle };
      break;
    }
    if (a.z >= front)
    {
      box.add(a, error);
    }
    if ((a.z >= front) != (b.z >= front))
    {
      const glm::dvec3 cut = a + (front - a.z) / (b.z - a.z) * (b - a);
      box.add({ cut.x, cut.y, front }, error);
    }
  }
  box.toPixels();
  if (!(box.x0 <= box.x1 && box.y0 <= box.y1))
  {
    return true;
  }

  // Edges.
  const auto reachOf = [&](const glm::dvec3& p)
  {
    double most = 0.0;
    for (const double x : { box.x0 - middle, box.x1 - middle })
    {
      for (const double y : { box.y0 - middle, box.y1 - middle })
      {
        most = std::max(most, std::abs(p.x - x * p.z) + std::abs(p.y - y * p.z));
      }
    }
    return most;
  };
  const double whole = glm::dot(corners[0].p, glm::cross(corners[1].p, corners[2].p));
  const double sign = whole < 0.0 ? -1.0 : 1.0;
  glm::dvec3 sum(0.0), key(0.0); // of the edges
  double doubts = 0.0, wholeDoubt = 0.0;
  const std::size_t s = slots.count;
  for (int e = 0; e < 3; ++e)
  {
    const SeenPoint& across = corners[e];
    const glm::dvec3& a = corners[(e + 1) % 3].p;
    const glm::dvec3& b = corners[(e + 2) % 3].p;
    const glm::dvec3 edge = sign * glm::cross(a, b);
    const double size =
      0.5 * GroupView::Pixels * (std::abs(edge.x) + std::abs(edge.y)) + std::abs(edge.z);
    const double reachA = reachOf(a), reachB = reachOf(b);
    const double doubt = error * (reachA + reachB + 2.0 * error) +
      2.0 * view.rounding * reachA * reachB + 8.0 * u * size;
    slots.ex[e][s] = static_cast<float>(edge.x / doubt);
    slots.ey[e][s] = static_cast<float>(edge.y / doubt);
    slots.ec[e][s] = static_cast<float>(edge.z / doubt);
    sum += edge;
    key += across.k * edge;
    doubts += doubt;
    const glm::dvec3 other(std::abs(a.y * b.z) + std::abs(a.z * b.y),
      std::abs(a.z * b.x) + std::abs(a.x * b.z), std::abs(a.x * b.y) + std::abs(a.y * b.x));
    wholeDoubt += error * (other.x + other.y) + view.errorFar * other.z;
  }
  const double size = std::abs(whole);
  if (!(size > 4.0 * wholeDoubt))
  {
    return false;
  }

  // Depth: 1 / w is sum / size.
  double nearest = 0.0, farthest = 1e30; // 1 / w
  for (const double x : { box.x0 - middle, box.x1 - middle })
  {
    for (const double y : { box.y0 - middle, box.y1 - middle })
    {
      const double at = (sum.x * x + sum.y * y + sum.z) / size;
      nearest = std::max(nearest, at + doubts / size);
      farthest = std::min(farthest, at - doubts / size);
    }
  }
  nearest = far ? std::min(1.4 * nearest, 1.0 / front) : 1.4 * nearest;
  farthest = std::max(0.7 * farthest, 1.0 / view.farW);
  const double scale = view.scale, toKey = scale * nearest;
  const glm::dvec3 plane = scale / size * key;
  const double planeSize =
    0.5 * GroupView::Pixels * (std::abs(plane.x) + std::abs(plane.y)) + std::abs(plane.z);
  const double slack = 1.4 * scale * scale * (doubts + wholeDoubt * nearest) / size +
    toKey * toKey * view.depthError + 8.0 * u * planeSize;
  const double depthSlack = slack / (scale * scale * farthest * farthest);
  slots.kx[s] = static_cast<float>(plane.x);
  slots.ky[s] = static_cast<float>(plane.y);
  slots.kc[s] = static_cast<float>(plane.z);
  slots.slack[s] = static_cast<float>(slack + toKey * toKey * view.apart);
  slots.kNear[s] = view.kNear;
  slots.kFar[s] = view.kFar;
  slots.x0[s] = static_cast<std::int32_t>(box.x0);
  slots.x1[s] = static_cast<std::int32_t>(box.x1);
  slots.y0[s] = static_cast<std::int32_t>(box.y0);
  slots.y1[s] = static_cast<std::int32_t>(box.y1);
  slots.tiles[s] = 0;
  for (int tile = 0; tile < GroupView::Tiles * GroupView::Tiles; ++tile)
  {
    const int x = 8 * (tile % GroupView::Tiles), y = 8 * (tile / GroupView::Tiles);
    const bool in =
      slots.x0[s] < x + 8 && slots.x1[s] >= x && slots.y0[s] < y + 8 && slots.y1[s] >= y;
    slots.tiles[s] |= std::int32_t(in) << tile;
  }
  slots.flags[s] = TriangleGroup::Clipped | (depthSlack <= view.reach ? 0 : TriangleGroup::Unsure) |
    (depthSlack <= view.nearReach ? 0 : TriangleGroup::Steep);
  slots.id[s] = id;
  slots.owner[s] = owner;
  ++slots.count;
  return true;
}
}

#endif
