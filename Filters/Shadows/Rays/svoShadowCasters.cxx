#include "svoShadowCasters.h"

#include "svoIntersect.h"
#include "svoLocalRay.h"
#include "svoOcclusion.h"
#include "svoShadowBeam.h"
#include "svoTriangle.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
/// How far the points of an octree's triangles can be from the mesh's, of the edge of the root
/// cube: half of a float's last place in [1, 2) along each axis, and as much again for the
/// roundings of products that start from there.
constexpr double FloatError = 2.0 * 1.7320508075688772 / 16777216.0;

/// Longest way that an edge of local length 1 becomes: the matrix's norm is at most this.
double norm(const glm::dmat3& m)
{
  return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

struct Start
{
  glm::dvec3 at; // world
  std::uint32_t own;
  int number; // of the answer's bit
};

bool skips(const ShadowCaster& caster, std::uint32_t own, Primitive triangle)
{
  if (caster.own == ShadowCaster::Own::Nothing)
  {
    return false;
  }
  if (caster.own == ShadowCaster::Own::Triangles)
  {
    return triangle == own;
  }
  // By place, not by id: meshes may have a point once for each of its cells.
  const Surface& surface = *caster.octree.surface();
  const glm::uvec3 corners = surface.triangles[triangle];
  const glm::vec3& x = surface.points[own];
  return surface.points[corners.x] == x || surface.points[corners.y] == x ||
    surface.points[corners.z] == x;
}

bool meets(const ShadowCaster& caster, const Light& light, const Start& start)
{
  const Ray ray{ caster.toOctree.point(start.at), caster.toOctree.vector(-light.along(start.at)),
    0.0, light.rayEnd() };
  if (!caster.octree.surface())
  {
    return occluded(caster.octree, ray, { LeafGeometry::Plane, MaximumLevel });
  }
  return occludedByOthers(
    caster.octree, ray, [&](Primitive triangle) { return skips(caster, start.own, triangle); });
}

/// Of at most 64, those that are hidden: side by side in float, what is dark confirmed in double.
std::uint64_t block(const ShadowCaster& caster, const Light& light, const Start* starts, int count)
{
  std::uint64_t dark = 0;
  OcclusionRays rays;
  LocalRay locals[BeamPoints::Most];
  int ofRay[BeamPoints::Most];
  for (int i = 0; i < count; ++i)
  {
    const Ray ray{ caster.toOctree.point(starts[i].at),
      caster.toOctree.vector(-light.along(starts[i].at)), 0.0, light.rayEnd() };
    LocalRay& local = locals[rays.count];
    if (prepareRay(caster.octree, ray, local))
    {
      ofRay[rays.count] = i;
      rays.add(glm::vec3(local.ray.origin), glm::vec3(local.ray.direction),
        static_cast<float>(local.ray.tMax));
    }
  }
  std::uint64_t met;
  Primitive by[OcclusionRays::Most];
  if (rays.count == 0)
  {
    return 0;
  }
  occluded(caster.octree, rays, { LeafGeometry::Triangle, MaximumLevel }, &met, by);
  const Surface& surface = *caster.octree.surface();
  for (int i = 0; i < rays.count; ++i)
  {
    if (met >> i & 1)
    {
      // What floats say is dark has to be so in double; else, as where a ray starts on its own
      // surface, the ray alone knows.
      const Start& start = starts[ofRay[i]];
      const ClippedRay<double>& ray = locals[i].ray;
      const glm::uvec3 triangle = surface.triangles[by[i]];
      double t;
      const bool sure =
        intersectTriangle(ShearedRay<double>(ray.origin, ray.direction), surface.points[triangle.x],
          surface.points[triangle.y], surface.points[triangle.z], t) &&
        t >= 0.0 && t <= ray.tMax && !skips(caster, start.own, by[i]);
      dark |= std::uint64_t(sure || meets(caster, light, start)) << start.number;
    }
  }
  return dark;
}

/// The same together, or where that is slower as a block.
std::uint64_t beam(
  const ShadowCaster& caster, const Light& light, const Start* starts, int count, bool singleRays)
{
  std::uint64_t dark = 0;
  constexpr int Few = 4; // such a beam is no quicker than its rays
  const auto alone = [&](const Start& start)
  { dark |= std::uint64_t(meets(caster, light, start)) << start.number; };
  if (singleRays || count <= Few || !caster.octree.surface())
  {
    std::for_each(starts, starts + count, alone);
    return dark;
  }
  BeamPoints points;
  points.count = count;
  for (int i = 0; i < count; ++i)
  {
    points.at[i] = caster.toOctree.point(starts[i].at);
  }
  BeamAnswer answers[BeamPoints::Most];
  Primitive nearest[BeamPoints::Most];
  // A beam that sees more is slower than its rays side by side, whatever they lie on.
  constexpr std::size_t MostNodes = 24;
  if (!traceBeam(caster.octree, caster.toOctree, light, points, answers, nearest, MostNodes))
  {
    return block(caster, light, starts, count);
  }
  for (int i = 0; i < count; ++i)
  {
    if (answers[i] == BeamAnswer::Undecided ||
      (answers[i] == BeamAnswer::Dark && skips(caster, starts[i].own, nearest[i])))
    {
      alone(starts[i]);
    }
    else
    {
      dark |= std::uint64_t(answers[i] == BeamAnswer::Dark) << starts[i].number;
    }
  }
  return dark;
}
}

void ShadowCasters::add(const Octree& octree, const glm::dmat4& toWorld, Own own)
{
  assert(placesSomething(toWorld));
  if (!octree || octree.empty())
  {
    return;
  }
  Instance instance;
  instance.body.own().octree = octree;
  instance.localToWorld = toWorld;
  const double error = FloatError * octree.rootEdge() * norm(glm::dmat3(toWorld));
  const bool named = octree.surface() != nullptr;
  this->Casters.push_back({ octree, WorldToOctree(octree, toWorld), CasterBox(instance), error,
    named ? own : Own::Nothing });
  this->OwnError = own != Own::Nothing ? std::max(this->OwnError, error) : this->OwnError;
}

std::uint64_t ShadowCasters::hidden(
  const Light& light, const Sample* samples, int count, std::uint64_t asked, bool singleRays) const
{
  assert(count >= 0 && count <= BeamPoints::Most);
  std::uint64_t dark = 0;
  for (const ShadowCaster& caster : this->Casters)
  {
    const double offset = this->OwnError + (caster.own == Own::Nothing ? caster.error : 0.0);
    Start starts[BeamPoints::Most];
    Box box;
    int begun = 0;
    for (int i = 0; i < count; ++i)
    {
      if ((asked & ~dark) >> i & 1)
      {
        const Sample& sample = samples[i];
        const double side =
          glm::dot(sample.normal, light.along(sample.position)) > 0.0 ? -offset : offset;
        const glm::dvec3 at = sample.position + side * sample.normal;
        starts[begun++] = { at, sample.own, i };
        box.add(at);
      }
    }
    if (begun == 0 || !caster.box.mayBlock(light, box))
    {
      continue;
    }
    dark |= beam(caster, light, starts, begun, singleRays);
  }
  return dark;
}
}
