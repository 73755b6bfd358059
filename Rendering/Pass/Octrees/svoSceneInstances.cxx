#include "svoSceneInstances.h"

#include <algorithm>
#include <atomic>
#include <tuple>

#include <glm/mat4x4.hpp>

namespace svo
{
namespace
{
std::uint64_t scatter(std::uint64_t a)
{
  // The finalizer of SplitMix64 (Steele, Lea, Flood 2014): neighbours' ids have nothing in common.
  a = (a ^ (a >> 30)) * 0xbf58476d1ce4e5b9ull;
  a = (a ^ (a >> 27)) * 0x94d049bb133111ebull;
  return a ^ (a >> 31);
}

std::uint64_t idOf(const Octree& octree)
{
  return octree ? octree.id() : 0;
}

WrittenSurface wanted(const PropSurfaces& prop, const SceneSurface& surface, Stage stage)
{
  const Body& body = *surface.instance.body;
  WrittenSurface result;
  result.deepestLevel = body.deepestLevel;
  result.detailLevel = body.detailLevel;
  result.leafGeometry = body.leafGeometry;
  if (stage == Stage::Shown)
  {
    result.octree = idOf(body.octree);
    result.caster = idOf(body.casterOctree);
    result.neededLevel = body.neededLevel;
    result.coincidentOrder = surface.instance.coincidentOrder;
    result.visible = prop.shown;
    result.casts = surface.casts && body.octree;
  }
  else
  {
    result.octree = surface.bringsOctree ? idOf(body.octree) : 0;
    result.visible = prop.traced;
    result.casts = surface.casts;
  }
  return result;
}

Body bodyOf(const SceneSurface& surface, const WrittenSurface& as)
{
  Body body = *surface.instance.body;
  body.octree = as.octree ? body.octree : Octree();
  body.casterOctree = as.caster ? body.casterOctree : Octree();
  body.neededLevel = as.neededLevel;
  return body;
}

/// What does not come from the prop: what copies have in common, and the flags of each.
void writeFrame(SceneSurface& surface, const WrittenSurface& as, Instance* first, std::size_t count)
{
  // Once for all of them, unless somebody has copied one.
  if (surface.body.holders() == count + 1 && first->body.same(surface.body))
  {
    surface.body.all() = bodyOf(surface, as);
  }
  else
  {
    surface.body = Shared<Body>(bodyOf(surface, as));
    for (Instance* one = first; one != first + count; ++one)
    {
      one->body = surface.body;
    }
  }
  const WrittenSurface& was = surface.written;
  if (std::tie(as.coincidentOrder, as.visible, as.casts) !=
    std::tie(was.coincidentOrder, was.visible, was.casts))
  {
    for (Instance* one = first; one != first + count; ++one)
    {
      one->coincidentOrder = as.coincidentOrder;
      one->visible = as.visible;
      one->castShadow = as.casts;
    }
  }
}

/// What comes from the prop, and from the octree's own coordinates.
void writeProp(const SceneSurface& surface, const Instance* whole, Instance* first)
{
  const Instance& from = surface.instance;
  const Octree& octree = from.body->octree;
  const bool transformed = octree && octree.hasTransform();
  const glm::dmat4 toLocal = transformed ? octree.transform() : glm::dmat4(1.0);
  if (!surface.copies)
  {
    if (whole)
    {
      *first = *whole;
    }
    // To the tracer the octree's own coordinates are the object's.
    first->localToWorld = transformed ? from.localToWorld * toLocal : from.localToWorld;
    return;
  }
  for (const GlyphCopy& copy : surface.copies->copies)
  {
    Instance& one = *first++;
    if (whole)
    {
      one = *whole;
      const glm::vec3 color = glm::vec3(copy.color[0], copy.color[1], copy.color[2]) / 255.0f;
      one.material.ambientColor = color;
      one.material.diffuseColor = color;
      // Where copies are opaque, or cast as if they were, this is another surface.
      one.opacity = surface.translucent ? static_cast<float>(copy.color[3]) / 255.0f : 1.0f;
      one.id = scatter(from.id + static_cast<std::uint64_t>(copy.point));
    }
    one.localToWorld = from.localToWorld * glm::dmat4(copy.place);
    one.localToWorld = transformed ? one.localToWorld * toLocal : one.localToWorld;
  }
}

void writeWhole(SceneSurface& surface, const WrittenSurface& as, Instance* first)
{
  surface.body = Shared<Body>(bodyOf(surface, as));
  Instance whole = surface.instance;
  whole.body = surface.body;
  whole.coincidentOrder = as.coincidentOrder;
  whole.visible = as.visible;
  whole.castShadow = as.casts;
  writeProp(surface, &whole, first);
}
}

std::uint64_t newVersion()
{
  static std::atomic<std::uint64_t> last{ 0 };
  return ++last;
}

bool writeInstances(std::vector<PropSurfaces>& props, Stage stage, std::vector<Instance>& instances)
{
  std::size_t count = 0;
  for (const PropSurfaces& prop : props)
  {
    for (const SceneSurface& surface : prop.surfaces)
    {
      count += surface.count();
    }
  }
  const std::size_t before = instances.size();
  instances.resize(count);
  std::size_t place = 0;
  bool changed = false;
  for (PropSurfaces& prop : props)
  {
    for (SceneSurface& surface : prop.surfaces)
    {
      const std::size_t many = surface.count();
      WrittenSurface now = wanted(prop, surface, stage);
      now.place = place;
      // Another octree may have another transform.
      const bool whole = prop.fresh || surface.written.place != place || place + many > before ||
        (surface.bringsOctree && surface.written.octree != now.octree);
      Instance* const first = instances.data() + place;
      if (whole)
      {
        writeWhole(surface, now, first);
      }
      else if (prop.moved)
      {
        writeProp(surface, nullptr, first);
      }
      if (whole || prop.moved)
      {
        surface.shown = WrittenSurface();
      }
      if (!whole && surface.written.values() != now.values())
      {
        writeFrame(surface, now, first, many);
      }
      surface.written = now;
      if (stage == Stage::Shown && surface.shown.values() != now.values())
      {
        std::for_each(first, first + many, [](Instance& one) { one.version = newVersion(); });
        surface.shown = now;
        changed = true;
      }
      place += many;
    }
    prop.fresh = false;
    prop.moved = false;
  }
  return changed;
}
}
