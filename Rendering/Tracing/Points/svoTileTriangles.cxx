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
class Writer
{
public:
  Writer(TileTriangles& triangles, int number)
    : Triangles(triangles)
    , Number(number)
  {
  }
  void put(int column, float value) { this->Triangles.column[column][this->Number] = value; }
  template <class Vector>
  void put(int column, const Vector& value)
  {
    for (int i = 0; i < Vector::length(); ++i)
    {
      this->put(column + i, value[i]);
    }
  }

private:
  TileTriangles& Triangles;
  int Number;
};

/// The weights of a triangle's points as affine functions of the way from the patch's origin,
/// which is `from`, octree coordinates. In double, as ratios of areas: what is lost on a triangle
/// that is n times as long as wide is the rounding of the result.
void putWeights(
  const SurfaceMatrices& frame, const TriangleLook& look, const glm::dvec3& from, Writer& writer)
{
  const glm::dvec3 e1(look.e1), e2(look.e2), area = glm::cross(e1, e2);
  const double area2 = glm::dot(area, area);
  const double scale = area2 > 0.0 ? 1.0 / area2 : 0.0;
  const glm::dvec3 v = scale * glm::cross(e2, area), w = scale * glm::cross(area, e1);
  const glm::dvec3 to = from - glm::dvec3(look.a);
  writer.put(TileTriangles::V, static_cast<float>(glm::dot(v, to)));
  writer.put(TileTriangles::AlongV, glm::vec3(frame.toOctree.gradient(v)));
  writer.put(TileTriangles::W, static_cast<float>(glm::dot(w, to)));
  writer.put(TileTriangles::AlongW, glm::vec3(frame.toOctree.gradient(w)));
}

/// Of a triangle with one normal at all corners: its points are those of the first corner.
void putNoWeights(Writer& writer)
{
  for (int column = TileTriangles::V; column < TileTriangles::AlongW + 3; ++column)
  {
    writer.put(column, 0.0f);
  }
}
}

void findTriangles(const SurfaceMatrices& frame, const TilePatch& patch, std::uint64_t lanes,
  TileTriangles& triangles)
{
  assert(lanes != 0 && (lanes & ~patch.mask) == 0 && frame.instance->body->octree.surface());
  HWY_DYNAMIC_DISPATCH(findDifferent)(patch.hits->primitive, lanes, triangles);
  for (int k = 0; k < triangles.count; ++k)
  {
    __builtin_prefetch(&frame.instance->body->octree.surface()->triangles[triangles.primitive[k]]);
  }
  const glm::dvec3 from = frame.toOctree.point(patch.origin.position);
  triangles.oddLanes = 0;
  triangles.smooth = false;
  for (int k = 0; k < triangles.count; ++k)
  {
    const TriangleLook look(frame, triangles.primitive[k]);
    Writer writer(triangles, k);
    triangles.textured = look.textured;
    triangles.coloredByPoints = look.coloredByPoints;
    triangles.coloredByCells = look.hasColor && !look.textured && !look.coloredByPoints;
    triangles.ownNormals = frame.instance->body->attributes.normals &&
      (look.smooth || frame.instance->body->attributes.normalAssociation == Association::Cell);
    const bool bends =
      look.smooth && (look.normals[0] != look.normals[1] || look.normals[0] != look.normals[2]);
    bool odd = !hasUnitLane(look.winding);
    triangles.smooth = triangles.smooth || bends;
    writer.put(TileTriangles::Facet, unitLane(look.winding));
    if (bends || look.textured || look.coloredByPoints)
    {
      putWeights(frame, look, from, writer);
    }
    else
    {
      putNoWeights(writer);
    }
    if (!bends) // else normals are interpolated, of all triangles
    {
      const glm::vec3 normal = look.smooth ? frame.normalMatrix * look.normals[0] : look.normal;
      odd = odd || !hasUnitLane(normal);
      if (triangles.ownNormals)
      {
        writer.put(TileTriangles::Normal, unitLane(normal));
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
        writer.put(TileTriangles::Normals + 3 * i, frame.normalMatrix * look.normals[i]);
      }
      if (look.coloredByPoints || (i == 0 && triangles.coloredByCells))
      {
        writer.put(TileTriangles::Colors + 3 * i, look.colors[i]);
      }
      if (look.textured)
      {
        writer.put(TileTriangles::Coordinates + 2 * i, look.coordinates[i]);
      }
    }
  }
}
}
#endif
