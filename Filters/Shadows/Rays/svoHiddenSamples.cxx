#include "svoHiddenSamples.h"

#include "svoIntersect.h"
#include "svoInverse.h"
#include "svoLocalRay.h"
#include "svoOcclusion.h"
#include "svoShadowBeam.h"
#include "svoTriangle.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace svo
{
namespace
{
/// How far the points of an octree's triangles can be from the mesh's, of the edge of the root
/// cube: half of a float's last place in [1, 2) along each axis, and as much again for the
/// roundings of products that start from there.
constexpr double FloatError = 2.0 * 1.7320508075688772 / 16777216.0;

struct Start
{
  glm::dvec3 at; // world
  std::uint32_t own;
  int number; // of the answer's bit
};

/// One caster, to samples that lie on this.
struct Asked
{
  const RayCaster& caster;
  const OwnMesh& own;

  const Octree& octree() const { return this->caster.instance->body->octree; }
  /// True if it has the triangles or points that samples lie on.
  bool named() const
  {
    return this->caster.index == this->own.instance && this->octree().surface() != nullptr;
  }
  bool skips(std::uint32_t sample, Primitive triangle) const
  {
    if (!this->named())
    {
      return false;
    }
    if (!this->own.points)
    {
      return triangle == sample;
    }
    // By place, not by id: meshes may have a point once for each of its cells.
    const Surface& surface = *this->octree().surface();
    const glm::uvec3 corners = surface.triangles[triangle];
    const glm::vec3& x = surface.points[sample];
    return surface.points[corners.x] == x || surface.points[corners.y] == x ||
      surface.points[corners.z] == x;
  }
};

bool meets(const Asked& asked, const Light& light, const Start& start)
{
  const WorldToOctree& toOctree = asked.caster.toOctree;
  const Ray ray{ toOctree.point(start.at), toOctree.vector(-light.along(start.at)), 0.0,
    light.rayEnd() };
  if (!asked.octree().surface())
  {
    return occluded(asked.octree(), ray, { asked.caster.geometry, MaximumLevel });
  }
  return occludedByOthers(
    asked.octree(), ray, [&](Primitive triangle) { return asked.skips(start.own, triangle); });
}

/// Of at most 64, those that are hidden: side by side in float, what is dark confirmed in double.
std::uint64_t block(const Asked& asked, const Light& light, const Start* starts, int count)
{
  std::uint64_t dark = 0;
  OcclusionRays rays;
  LocalRay locals[BeamPoints::Most];
  int ofRay[BeamPoints::Most];
  for (int i = 0; i < count; ++i)
  {
    const WorldToOctree& toOctree = asked.caster.toOctree;
    const Ray ray{ toOctree.point(starts[i].at), toOctree.vector(-light.along(starts[i].at)), 0.0,
      light.rayEnd() };
    LocalRay& local = locals[rays.count];
    if (prepareRay(asked.octree(), ray, local))
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
  occluded(asked.octree(), rays, { LeafGeometry::Triangle, MaximumLevel }, &met, by);
  const Surface& surface = *asked.octree().surface();
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
        t >= 0.0 && t <= ray.tMax && !asked.skips(start.own, by[i]);
      dark |= std::uint64_t(sure || meets(asked, light, start)) << start.number;
    }
  }
  return dark;
}

/// The same together, or where that is slower as a block.
std::uint64_t beam(
  const Asked& asked, const Light& light, const Start* starts, int count, bool singleRays)
{
  std::uint64_t dark = 0;
  constexpr int Few = 4; // such a beam is no quicker than its rays
  const auto alone = [&](const Start& start)
  { dark |= std::uint64_t(meets(asked, light, start)) << start.number; };
  if (singleRays || count <= Few || !asked.caster.beams)
  {
    std::for_each(starts, starts + count, alone);
    return dark;
  }
  BeamPoints points;
  points.count = count;
  for (int i = 0; i < count; ++i)
  {
    points.at[i] = asked.caster.toOctree.point(starts[i].at);
  }
  BeamAnswer answers[BeamPoints::Most];
  Primitive nearest[BeamPoints::Most];
  // A beam that sees more is slower than its rays side by side, whatever they lie on.
  constexpr std::size_t MostNodes = 24;
  if (!traceBeam(asked.octree(), asked.caster.toOctree, light, points, answers, nearest, MostNodes))
  {
    return block(asked, light, starts, count);
  }
  for (int i = 0; i < count; ++i)
  {
    if (answers[i] == BeamAnswer::Undecided ||
      (answers[i] == BeamAnswer::Dark && asked.skips(starts[i].own, nearest[i])))
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

double triangleError(const Instance& instance)
{
  // No edge of local length 1 becomes longer than the matrix's norm.
  const glm::dmat3 m(instance.localToWorld);
  return FloatError * instance.body->octree.rootEdge() *
    std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

std::uint32_t addCaster(const Octree& octree, const glm::dmat4& toWorld, Scene& scene)
{
  assert(placesSomething(toWorld));
  if (!octree || octree.empty())
  {
    return OwnMesh::None;
  }
  Instance& instance = scene.instances.emplace_back();
  instance.body.own().octree = octree;
  instance.body.own().leafGeometry =
    octree.surface() ? LeafGeometry::Triangle : LeafGeometry::Plane;
  instance.localToWorld = toWorld;
  return static_cast<std::uint32_t>(scene.instances.size() - 1);
}

std::uint64_t hiddenSamples(const RayCasters& casters, const OwnMesh& own, const Light& light,
  const Sample* samples, int count, std::uint64_t asked, bool singleRays)
{
  assert(count >= 0 && count <= BeamPoints::Most);
  const glm::dvec3 farthest(own.error + casters.mostStartOffset());
  Box box;
  for (int i = 0; i < count; ++i)
  {
    if (asked >> i & 1)
    {
      box.add(samples[i].position, farthest);
    }
  }
  std::uint64_t dark = 0;
  if (!box.known())
  {
    return dark;
  }
  casters.anyOpaque(wayToLight(light, box),
    [&](const RayCaster& caster)
    {
      const Asked one{ caster, own };
      const double offset = own.error + (one.named() ? 0.0 : triangleError(*caster.instance));
      Start starts[BeamPoints::Most];
      int begun = 0;
      for (int i = 0; i < count; ++i)
      {
        if ((asked & ~dark) >> i & 1)
        {
          const Sample& sample = samples[i];
          const double side =
            glm::dot(sample.normal, light.along(sample.position)) > 0.0 ? -offset : offset;
          starts[begun++] = { sample.position + side * sample.normal, sample.own, i };
        }
      }
      dark |= beam(one, light, starts, begun, singleRays);
      return (asked & ~dark) == 0;
    });
  return dark;
}
}
