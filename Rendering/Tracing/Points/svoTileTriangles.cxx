#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "svoTileTriangles.cxx"
#include <hwy/foreach_target.h>

#include "svoTileTriangles.h"

#include "svoLaneBits-inl.h"

#include <cassert>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace svo
{
namespace HWY_NAMESPACE
{
/// Finds the different primitives of some lanes, in the order of their first ones.
void findDifferent(const Primitive* primitives, std::uint64_t lanes, TileTriangles& triangles)
{
  const Words words;
  const Integers indices;
  triangles.count = 0;
  for (std::uint64_t left = lanes; left != 0;)
  {
    const Primitive primitive = primitives[__builtin_ctzll(left)];
    const auto wanted = hn::Set(words, primitive);
    const auto index = hn::Set(indices, triangles.count);
    std::uint64_t mine = 0;
    for (int i = 0; i < TileTriangles::Most; i += width())
    {
      const auto same = hn::Eq(hn::LoadU(words, primitives + i), wanted);
      mine |= bitsOf(words, same) << i;
      std::int32_t* which = triangles.which + i;
      const auto before = triangles.count == 0 ? hn::Zero(indices) : hn::Load(indices, which);
      hn::Store(hn::IfThenElse(hn::RebindMask(indices, same), index, before), indices, which);
    }
    triangles.primitive[triangles.count] = primitive;
    triangles.lanes[triangles.count++] = mine & left;
    left &= ~mine;
  }
}
}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace svo
{
HWY_EXPORT(findDifferent);

namespace
{
/// Numbers of triangle k from a column on.
template <class Vector>
void put(TileTriangles& triangles, int k, int column, const Vector& value)
{
  for (int i = 0; i < Vector::length(); ++i)
  {
    triangles.column[column + i][k] = value[i];
  }
}

/// The weights of the points of triangle k as affine functions of the way from the patch's origin,
/// which is `from`, octree coordinates. In double, as ratios of areas: what is lost on a triangle
/// that is n times as long as wide is the rounding of the result.
void putWeights(const SurfaceMatrices& matrices, const TriangleLook& look, const glm::dvec3& from,
  int k, TileTriangles& triangles)
{
  const glm::dvec3 e1(look.e1), e2(look.e2), area = glm::cross(e1, e2);
  const double area2 = glm::dot(area, area);
  const double scale = area2 > 0.0 ? 1.0 / area2 : 0.0;
  const glm::dvec3 v = scale * glm::cross(e2, area), w = scale * glm::cross(area, e1);
  const glm::dvec3 to = from - glm::dvec3(look.a);
  triangles.column[TileTriangles::V][k] = static_cast<float>(glm::dot(v, to));
  put(triangles, k, TileTriangles::AlongV, glm::vec3(matrices.toOctree.gradient(v)));
  triangles.column[TileTriangles::W][k] = static_cast<float>(glm::dot(w, to));
  put(triangles, k, TileTriangles::AlongW, glm::vec3(matrices.toOctree.gradient(w)));
}
}

void findTriangles(const SurfaceMatrices& matrices, const TilePatch& patch, std::uint64_t lanes,
  TileTriangles& triangles)
{
  assert(lanes != 0 && (lanes & ~patch.mask) == 0 && matrices.instance->body->octree.surface());
  HWY_DYNAMIC_DISPATCH(findDifferent)(patch.hits->primitive, lanes, triangles);
  for (int k = 0; k < triangles.count; ++k)
  {
    __builtin_prefetch(
      &matrices.instance->body->octree.surface()->triangles[triangles.primitive[k]]);
  }
  const glm::dvec3 from = matrices.toOctree.point(patch.origin.position);
  triangles.oddLanes = 0;
  triangles.smooth = false;
  for (int k = 0; k < triangles.count; ++k)
  {
    const TriangleLook look(matrices, triangles.primitive[k]);
    triangles.textured = look.textured;
    triangles.coloredByPoints = look.coloredByPoints;
    triangles.coloredByCells = look.hasColor && !look.textured && !look.coloredByPoints;
    triangles.ownNormals = matrices.instance->body->attributes.normals &&
      (look.smooth || matrices.instance->body->attributes.normalAssociation == Association::Cell);
    const bool bends =
      look.smooth && (look.normals[0] != look.normals[1] || look.normals[0] != look.normals[2]);
    bool odd = !hasUnitLane(look.winding);
    triangles.smooth = triangles.smooth || bends;
    put(triangles, k, TileTriangles::Facet, unitLane(look.winding));
    if (bends || look.textured || look.coloredByPoints)
    {
      putWeights(matrices, look, from, k, triangles);
    }
    else // one normal at all corners: points are those of the first corner
    {
      for (int column = TileTriangles::V; column < TileTriangles::AlongW + 3; ++column)
      {
        triangles.column[column][k] = 0.0f;
      }
    }
    if (!bends) // else normals are interpolated, of all triangles
    {
      const glm::vec3 normal = look.smooth ? matrices.normalMatrix * look.normals[0] : look.normal;
      odd = odd || !hasUnitLane(normal);
      if (triangles.ownNormals)
      {
        put(triangles, k, TileTriangles::Normal, unitLane(normal));
      }
    }
    if (odd)
    {
      triangles.oddLanes |= triangles.lanes[k];
    }
    for (int i = 0; i < 3; ++i)
    {
      if (look.smooth)
      {
        put(triangles, k, TileTriangles::Normals + 3 * i, matrices.normalMatrix * look.normals[i]);
      }
      if (look.coloredByPoints || (i == 0 && triangles.coloredByCells))
      {
        put(triangles, k, TileTriangles::Colors + 3 * i, look.colors[i]);
      }
      if (look.textured)
      {
        put(triangles, k, TileTriangles::Coordinates + 2 * i, look.coordinates[i]);
      }
    }
  }
}
}
#endif
