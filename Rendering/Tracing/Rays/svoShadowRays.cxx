#include "svoShadowRays.h"

#include "svoIntersect.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
/// The facet's normal on the light's side.
glm::dvec3 sideOf(const Light& light, const glm::dvec3& position, const glm::vec3& facet)
{
  assert(std::abs(glm::dot(facet, facet) - 1.0f) < 1e-3f); // offsets are along it
  const glm::dvec3 normal(facet);
  return glm::dot(normal, light.along(position)) > 0.0 ? -normal : normal;
}

/// A point that asks, and its answer.
struct Start
{
  glm::dvec3 position, side; // world; side: unit, of its facet, towards the light
  int number;                // of the answer's bit

  glm::dvec3 off(double offset) const { return this->position + offset * this->side; }
};

bool blocks(const RayCaster& caster, const Light& light, const Start& start, double offset)
{
  const glm::dvec3 at = start.off(offset);
  const glm::dvec3 direction = -light.along(at);
  const Ray ray{ caster.toOctree.point(at), caster.toOctree.vector(direction), 0.0,
    light.rayEnd() };
  const TraceOptions options{ caster.geometry, MaximumLevel };
  if (!occluded(caster.instance->body->octree, ray, options))
  {
    return false;
  }
  if (caster.planeError <= offset)
  {
    return true;
  }
  // Triangles and planes are mixed: the start may lie behind the planes of its own surface, or in
  // cells that refuse the ray. What is met before the ray can have left them has to be met from
  // outside of them too.
  const double length = glm::length(direction);
  const double slope = std::max(glm::dot(start.side, direction) / length, 0.05);
  const Hit hit = intersect(caster.instance->body->octree, ray, options);
  if (hit.t * length > caster.planeError / slope)
  {
    return true;
  }
  const Ray outer{ caster.toOctree.point(start.off(caster.planeError)), ray.direction, 0.0,
    ray.tMax };
  return occluded(caster.instance->body->octree, outer, options);
}

/// How opaque the caster is where the light of a point that it blocks() meets it first.
float opacityMet(const RayCaster& caster, const Light& light, const Start& start, double offset)
{
  // From the light to where blocks() began.
  for (const double above : { std::max(offset, caster.planeError), offset })
  {
    const glm::dvec3 end = start.off(above);
    const float opacity = svo::opacityMet(caster, end, -light.along(end), light.rayEnd());
    if (opacity > 0.0f)
    {
      return opacity;
    }
  }
  return 0.0f; // the ray only grazes it
}

/// Those that the caster shadows, one bit each.
std::uint64_t beam(
  const RayCaster& caster, const Light& light, const Start* starts, int count, double offset)
{
  std::uint64_t dark = 0;
  const auto setIf = [&dark](bool isDark, const Start& start)
  { dark |= std::uint64_t(isDark) << start.number; };
  const auto alone = [&](const Start& start) { return blocks(caster, light, start, offset); };
  constexpr int Few = 4; // such a beam is no quicker than its rays
  if (count <= Few || !caster.beams)
  {
    std::for_each(starts, starts + count, [&](const Start& start) { setIf(alone(start), start); });
    return dark;
  }
  BeamPoints points;
  points.count = count;
  for (int i = 0; i < count; ++i)
  {
    points.at[i] = caster.toOctree.point(starts[i].off(offset));
  }
  BeamAnswer answers[BeamPoints::Most];
  if (!traceBeam(caster.instance->body->octree, caster.toOctree, light, points, answers))
  {
    const int half = count / 2;
    return beam(caster, light, starts, half, offset) |
      beam(caster, light, starts + half, count - half, offset);
  }
  for (int i = 0; i < count; ++i)
  {
    setIf(
      answers[i] == BeamAnswer::Dark || (answers[i] == BeamAnswer::Undecided && alone(starts[i])),
      starts[i]);
  }
  return dark;
}

/// The same of all casters. Changes the order of the starts.
std::uint64_t shadowed(
  const RayCasters& casters, const Light& light, Start* starts, int count, double offset)
{
  Box box;
  for (int i = 0; i < count; ++i)
  {
    box.add(starts[i].position, glm::dvec3(offset));
  }
  std::uint64_t dark = 0;
  if (count == 0)
  {
    return dark;
  }
  casters.anyOpaque(wayToLight(light, box),
    [&](const RayCaster& caster)
    {
      dark |= beam(caster, light, starts, count, offset);
      count = static_cast<int>(std::remove_if(starts, starts + count,
                                 [&](const Start& start) { return dark >> start.number & 1; }) -
        starts);
      return count == 0;
    });
  return dark;
}
}

void ShadowRays::taken(const Light& light, const TilePatch& patch, double offset,
  std::uint64_t asked, float* taken) const
{
  Start starts[Most];
  Box box;
  int count = 0;
  eachBit(asked & patch.mask,
    [&](int i)
    {
      const glm::dvec3 position = patch.position(i);
      box.add(position, glm::dvec3(offset));
      starts[count++] = { position, sideOf(light, position, patch.facet(i)), i };
    });
  std::fill_n(taken, TilePatch::Most, 0.0f);
  for (const RayCaster& caster : this->Casters.translucent())
  {
    if (count == 0 || !caster.box.mayBlock(light, box))
    {
      continue;
    }
    const std::uint64_t met = beam(caster, light, starts, count, offset);
    for (int k = 0; k < count; ++k)
    {
      const Start& at = starts[k];
      if (met >> at.number & 1)
      {
        float& all = taken[at.number];
        const float one = opacityMet(caster, light, at, offset);
        all = all > 0.0f ? 1.0f - (1.0f - all) * (1.0f - one) : one;
      }
    }
  }
}

bool ShadowRays::shadows(
  const Light& light, const glm::dvec3& position, const glm::vec3& facet, double offset) const
{
  Start start{ position, sideOf(light, position, facet), 0 };
  return shadowed(this->Casters, light, &start, 1, offset) != 0;
}

std::uint64_t ShadowRays::shadows(
  const Light& light, const TilePatch& patch, double offset, std::uint64_t asked) const
{
  static_assert(Most >= TilePatch::Most, "a tile's points fit");
  Start starts[Most];
  int count = 0;
  eachBit(asked & patch.mask,
    [&](int i)
    {
      const glm::dvec3 position = patch.position(i);
      starts[count++] = { position, sideOf(light, position, patch.facet(i)), i };
    });
  return shadowed(this->Casters, light, starts, count, offset);
}

std::uint64_t ShadowRays::shadows(
  const Light& light, const SurfacePoint* const* points, int count, double offset) const
{
  assert(count >= 0 && count <= Most);
  Start starts[Most];
  for (int i = 0; i < count; ++i)
  {
    const SurfacePoint& point = *points[i];
    starts[i] = { point.position, sideOf(light, point.position, point.facet), i };
  }
  return shadowed(this->Casters, light, starts, count, offset);
}

glm::dvec3 ShadowRays::start(
  const Light& light, const glm::dvec3& position, const glm::vec3& facet, double offset)
{
  return position + offset * sideOf(light, position, facet);
}

bool ShadowRays::between(const glm::dvec3& from, const glm::dvec3& to, double offset) const
{
  const glm::dvec3 direction = to - from;
  const double length = glm::length(direction);
  return this->Casters.anyOpaque({ from, glm::dvec3(0.0), direction, 1.0, 0.0 },
    [&](const RayCaster& caster)
    {
      const double first = std::max(offset, caster.leafError);
      const Ray ray{ caster.toOctree.point(from), caster.toOctree.vector(direction), first / length,
        1.0 };
      return first < length &&
        occluded(caster.instance->body->octree, ray, { caster.geometry, MaximumLevel });
    });
}
}
