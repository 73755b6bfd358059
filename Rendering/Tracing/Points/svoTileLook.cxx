#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoTileLook.cxx"
#include <hwy/foreach_target.h>

#include "svoTileLook.h"

#include "svoLaneBits-inl.h"

#include <cassert>
#include <cmath>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
constexpr int Step = TilePatch::Step;

/// Gives each point a number of the triangle that it is on.
void spread(const TileTriangles& triangles, int column, float* HWY_RESTRICT out)
{
  const Floats floats;
  const Integers indices;
  const float* from = triangles.column[column];
  const int lanes = width();
  if (triangles.count == 1)
  {
    const auto value = hn::Set(floats, from[0]);
    for (int i = 0; i < TilePatch::Most; i += lanes)
    {
      hn::Store(value, floats, out + i);
    }
  }
  else if (triangles.count <= lanes)
  {
    const auto table = hn::Load(floats, from);
    for (int i = 0; i < TilePatch::Most; i += lanes)
    {
      const auto which = hn::IndicesFromVec(floats, hn::Load(indices, triangles.which + i));
      hn::Store(hn::TableLookupLanes(table, which), floats, out + i);
    }
  }
  else
  {
    for (int i = 0; i < TilePatch::Most; i += lanes)
    {
      const auto which = hn::Load(indices, triangles.which + i);
      hn::Store(hn::GatherIndex(floats, from, which), floats, out + i);
    }
  }
}

void spread(const TileTriangles& triangles, int column, PixelVectors& out)
{
  spread(triangles, column, out.x);
  spread(triangles, column + 1, out.y);
  spread(triangles, column + 2, out.z);
}

/// Facets, and which side of their triangles they show.
void faceViewer(const TileTriangles& triangles, float* HWY_RESTRICT sides, TilePatch& p)
{
  const PointOrigin origin = p.origin;
  PixelVectors windings;
  spread(triangles, TileTriangles::Facet, windings);
  for (int i = 0; i < TilePatch::Most; i += Step)
  {
    if (!p.has(i))
    {
      continue;
    }
    const float *x = p.hits->x + i, *y = p.hits->y + i;
    for (int k = 0; k < Step; ++k)
    {
      const glm::vec3 winding = windings(i + k);
      const float side = sideLane(winding, -origin.rayTo(x[k], y[k]));
      sides[i + k] = side;
      p.facet.set(i + k, side * winding);
    }
  }
}

/// Normals that are one triangle's: its own, or its facet's.
void takeNormals(const TileTriangles& triangles, const float* HWY_RESTRICT sides, TilePatch& p)
{
  PixelVectors normals;
  spread(triangles, triangles.ownNormals ? TileTriangles::Normal : TileTriangles::Facet, normals);
  for (int k = 0; k < TilePatch::Most; ++k)
  {
    p.normal.set(k, sides[k] * normals(k));
  }
}

/// Barycentric coordinates.
void weigh(const TileTriangles& triangles, const TilePatch& p, PixelVectors& weights)
{
  alignas(64) float v[TilePatch::Most], w[TilePatch::Most];
  PixelVectors alongV, alongW;
  spread(triangles, TileTriangles::V, v);
  spread(triangles, TileTriangles::AlongV, alongV);
  spread(triangles, TileTriangles::W, w);
  spread(triangles, TileTriangles::AlongW, alongW);
  for (int i = 0; i < TilePatch::Most; i += Step)
  {
    if (!p.has(i))
    {
      continue;
    }
    for (int k = i; k < i + Step; ++k)
    {
      weights.set(k, affineWeights(p.way(k), v[k], alongV(k), w[k], alongW(k)));
    }
  }
}

/// The same where hits have their attributes from elsewhere on their triangles' planes; of planes
/// that are seen edge on as above.
void weighElsewhere(const TileTriangles& triangles, const TilePatch& p, PixelVectors& weights)
{
  eachBit(p.mask,
    [&](int i)
    {
      const float x = p.hits->lookX[i], y = p.hits->lookY[i];
      const glm::vec3 ray = p.origin.rayTo(x, y), facet = p.facet(i);
      const glm::vec3 beside = p.origin.wayTo(x, y, p.deeper[i]);
      const glm::vec3 way =
        beside + glm::dot(facet, p.way(i) - beside) / glm::dot(facet, ray) * ray;
      const int which = triangles.which[i];
      const auto number = [&](int column) { return triangles.column[column][which]; };
      const auto vector = [&](int column)
      { return glm::vec3(number(column), number(column + 1), number(column + 2)); };
      const glm::vec3 weight = planeWeights(way, number(TileTriangles::V),
        vector(TileTriangles::AlongV), number(TileTriangles::W), vector(TileTriangles::AlongW));
      constexpr float Most = 1e4f;
      if (std::abs(weight.y) + std::abs(weight.z) < Most)
      {
        weights.set(i, weight);
      }
    });
}

/// Returns those that cannot be made unit vectors this way.
std::uint64_t interpolateNormals(
  const TileTriangles& triangles, const PixelVectors& weights, const float* sides, TilePatch& p)
{
  PixelVectors corners[3];
  for (int c = 0; c < 3; ++c)
  {
    spread(triangles, TileTriangles::Normals + 3 * c, corners[c]);
  }
  std::uint64_t odd = 0;
  for (int i = 0; i < TilePatch::Most; i += Step)
  {
    if (!p.has(i))
    {
      continue;
    }
    alignas(64) std::uint32_t good[Step];
    for (int k = 0; k < Step; ++k)
    {
      const glm::vec3 each[3] = { corners[0](i + k), corners[1](i + k), corners[2](i + k) };
      const glm::vec3 normal = weighted(weights(i + k), each);
      good[k] = hasUnitLane(normal) ? 1u : 0u;
      p.normal.set(i + k, sides[i + k] * unitLane(normal));
    }
    odd |= lanesOf(good, 0, Step) << i;
  }
  return odd;
}

void colorByPoints(const TileTriangles& triangles, const PixelVectors& weights, TilePatch& p)
{
  PixelVectors corners[3];
  for (int c = 0; c < 3; ++c)
  {
    spread(triangles, TileTriangles::Colors + 3 * c, corners[c]);
  }
  for (int k = 0; k < TilePatch::Most; ++k)
  {
    const glm::vec3 each[3] = { corners[0](k), corners[1](k), corners[2](k) };
    p.color.set(k, weighted(weights(k), each));
  }
}

void colorByTexture(const TileTriangles& triangles, const Attributes& attributes,
  const PixelVectors& weights, TilePatch& p)
{
  eachBit(p.mask,
    [&](int i)
    {
      glm::vec2 corners[3];
      for (int c = 0; c < 3; ++c)
      {
        const int column = TileTriangles::Coordinates + 2 * c, which = triangles.which[i];
        corners[c] = { triangles.column[column][which], triangles.column[column + 1][which] };
      }
      const int texel = detail::texelAt(attributes, weighted(weights(i), corners));
      p.color.set(i, detail::colorAt(attributes.colorTexture, texel));
    });
}

/// Returns points that have to be done one by one.
std::uint64_t look(const TileTriangles& triangles, const Attributes& attributes, TilePatch& p)
{
  alignas(64) float sides[TilePatch::Most] = {};
  PixelVectors weights;
  std::uint64_t odd = triangles.oddLanes;
  faceViewer(triangles, sides, p);
  if (triangles.needsWeights())
  {
    weigh(triangles, p, weights);
    if (p.hits->lookX)
    {
      weighElsewhere(triangles, p, weights);
    }
  }
  if (triangles.smooth)
  {
    odd |= interpolateNormals(triangles, weights, sides, p);
  }
  else
  {
    takeNormals(triangles, sides, p);
  }
  p.hasColor = triangles.hasColor();
  if (triangles.textured)
  {
    colorByTexture(triangles, attributes, weights, p);
  }
  else if (triangles.coloredByPoints)
  {
    colorByPoints(triangles, weights, p);
  }
  else if (triangles.coloredByCells)
  {
    spread(triangles, TileTriangles::Colors, p.color);
  }
  return odd;
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(look);

namespace
{
/// Facet, normal and colour of one point, which is on a triangle at `at`; see pointOfTriangle().
void lookAtPoint(const SurfaceMatrices& matrices, Primitive triangle, const glm::dvec3& at, int i,
  TilePatch& patch)
{
  const SurfacePoint point =
    pointOfTriangle(matrices, *patch.view, patch.position(i), patch.towards(i), triangle, at);
  patch.facet.set(i, point.facet);
  patch.normal.set(i, point.normal);
  patch.color.set(i, point.color);
  patch.hasColor = point.hasColor;
}

/// The same of those points that are in `lanes`, all on nodes above the bricks; the octree has a
/// surface. Lines of sight to nodes without a triangle that faces the viewer are traced all at
/// once.
void lookAtNodes(const SurfaceMatrices& matrices, std::uint64_t lanes, TilePatch& patch)
{
  assert((lanes & ~patch.mask) == 0 && matrices.instance->body->octree.surface());
  NodeTriangle picked[TilePatch::Most];
  NodeTriangle* doubtful[TilePatch::Most];
  glm::dvec3 towards[TilePatch::Most];
  int doubts = 0;
  eachBit(lanes,
    [&](int i)
    {
      const glm::vec3 to = patch.towards(i);
      const Primitive primitive = patch.hits->primitive[i];
      assert(primitive & NodePrimitive);
      picked[i] = pickTriangle(matrices, primitive & ~NodePrimitive, patch.position(i), to);
      if (!picked[i].faces)
      {
        towards[doubts] = matrices.toOctree.vector(glm::dvec3(to));
        doubtful[doubts++] = &picked[i];
      }
    });
  if (doubts > 0)
  {
    settleTriangles(matrices.instance->body->octree, doubtful, towards, doubts);
  }
  eachBit(lanes, [&](int i) { lookAtPoint(matrices, picked[i].triangle, picked[i].at, i, patch); });
}
}

void lookAtPatch(const SurfaceMatrices& matrices, TilePatch& patch, TileTriangles& triangles)
{
  const bool hasSurface = matrices.instance->body->octree.surface() != nullptr;
  const std::uint64_t nodes = hasSurface ? patch.nodes : 0;
  std::uint64_t single = hasSurface ? 0 : patch.mask;
  if (hasSurface && nodes != patch.mask)
  {
    const std::uint64_t lanes = patch.mask & ~nodes;
    findTriangles(matrices, patch, lanes, triangles);
    single =
      HWY_DYNAMIC_DISPATCH(look)(triangles, matrices.instance->body->attributes, patch) & lanes;
    if (!patch.view->plain)
    {
      eachBit(lanes & ~single,
        [&](int i)
        {
          if (shadersTurn(matrices, *patch.view, patch.position(i), patch.facet(i)))
          {
            patch.normal.set(i, -patch.normal(i));
          }
        });
    }
  }
  eachBit(single,
    [&](int i)
    {
      lookAtPoint(
        matrices, patch.hits->primitive[i], matrices.toOctree.point(patch.position(i)), i, patch);
    });
  if (nodes != 0)
  {
    lookAtNodes(matrices, nodes, patch);
  }
}
}
#endif
