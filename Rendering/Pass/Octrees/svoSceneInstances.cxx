#include "svoSceneInstances.h"

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
  const Instance& instance = surface.instance;
  WrittenSurface result;
  result.deepestLevel = instance.deepestLevel;
  result.detailLevel = instance.detailLevel;
  result.leafGeometry = instance.leafGeometry;
  if (stage == Stage::Shown)
  {
    result.octree = idOf(instance.octree);
    result.caster = idOf(instance.casterOctree);
    result.neededLevel = instance.neededLevel;
    result.givesWay = instance.givesWay;
    result.visible = prop.shown;
    result.casts = surface.casts && instance.octree;
  }
  else
  {
    result.octree = surface.bringsOctree ? idOf(instance.octree) : 0;
    result.visible = prop.traced;
    result.casts = surface.casts;
  }
  return result;
}

/// What does not come from the prop.
void writeFrame(
  const SceneSurface& surface, const WrittenSurface& as, Instance* first, std::size_t count)
{
  const Instance& from = surface.instance;
  for (Instance* one = first; one != first + count; ++one)
  {
    one->octree = as.octree ? from.octree : Octree();
    one->casterOctree = as.caster ? from.casterOctree : Octree();
    one->leafGeometry = from.leafGeometry;
    one->neededLevel = as.neededLevel;
    one->givesWay = as.givesWay;
    one->visible = as.visible;
    one->castShadow = as.casts;
    one->box = from.box;
    one->triangles = from.triangles;
    one->deepestLevel = from.deepestLevel;
    one->detailLevel = from.detailLevel;
  }
}

/// What comes from the prop, and from the octree's own frame.
void writeProp(const SceneSurface& surface, bool onlyMatrices, Instance* first)
{
  const Instance& from = surface.instance;
  const bool framed = from.octree && from.octree.hasFrame();
  const glm::dmat4 frame = framed ? from.octree.frame() : glm::dmat4(1.0);
  if (!surface.copies)
  {
    if (!onlyMatrices)
    {
      *first = from;
    }
    // To the tracer the octree's own frame is the object's.
    first->localToWorld = framed ? from.localToWorld * frame : from.localToWorld;
    return;
  }
  for (const GlyphCopy& copy : surface.copies->copies)
  {
    Instance& one = *first++;
    if (!onlyMatrices)
    {
      one = from;
      const glm::vec3 color = glm::vec3(copy.color[0], copy.color[1], copy.color[2]) / 255.0f;
      one.material.ambientColor = color;
      one.material.diffuseColor = color;
      // Where copies are opaque, or cast as if they were, this is another surface.
      one.opacity = surface.translucent ? static_cast<float>(copy.color[3]) / 255.0f : 1.0f;
      one.id = scatter(from.id + static_cast<std::uint64_t>(copy.point));
    }
    one.localToWorld = from.localToWorld * glm::dmat4(copy.place);
    one.localToWorld = framed ? one.localToWorld * frame : one.localToWorld;
  }
}
}

void SceneInstances::write(
  std::vector<PropSurfaces>& props, Stage stage, std::vector<Instance>& instances)
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
  for (PropSurfaces& prop : props)
  {
    for (SceneSurface& surface : prop.surfaces)
    {
      const std::size_t many = surface.count();
      WrittenSurface now = wanted(prop, surface, stage);
      now.place = place;
      // Another octree may have another frame.
      const bool whole = prop.fresh || surface.written.place != place || place + many > before ||
        (surface.bringsOctree && surface.written.octree != now.octree);
      if (whole || prop.moved)
      {
        writeProp(surface, !whole, instances.data() + place);
      }
      if (whole || !(surface.written == now))
      {
        writeFrame(surface, now, instances.data() + place, many);
      }
      surface.written = now;
      place += many;
    }
    prop.fresh = false;
    prop.moved = false;
  }
}
}
