#include "svoOutline.h"

#include "svoLeafTraits.h"
#include "svoWorldToOctree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>

namespace svo
{
namespace
{
Outline outlineOf(const Instance& instance)
{
  Outline outline{};
  outline.localToWorld = instance.localToWorld;
  outline.pixelError = instance.pixelError;
  outline.leafGeometry = static_cast<std::int32_t>(instance.body->leafGeometry);
  outline.opacity = instance.opacity;
  outline.translucent = instance.translucent();
  const Octree& octree = instance.body->octree;
  const Box& box = instance.body->box;
  const bool placed = (octree || box.known()) && placesSomething(instance.localToWorld);
  outline.casts = placed && instance.castShadow && !(octree && octree.empty());
  outline.receives = placed && instance.visible && instance.receiveShadow;
  if (!octree)
  {
    if (box.known())
    {
      outline.cube = outline.mesh = box;
      const glm::dvec3 size = box.high - box.low;
      outline.smallestVoxel =
        std::ldexp(std::max({ size.x, size.y, size.z }), -instance.body->deepestLevel);
    }
    return outline;
  }
  const Header& h = octree.header();
  const glm::dvec3 origin(h.origin[0], h.origin[1], h.origin[2]);
  outline.cube = { origin, origin + h.voxelSize * static_cast<double>(1u << h.level) };
  outline.mesh = h.pointCount > 0 ? boxOf(h.meshBounds) : Box();
  // An octree whose leaves are exact may be coarse because its mesh is: its voxels say nothing then
  // of how far it reaches beyond the mesh.
  constexpr int FineEnough = 10;
  const int level = static_cast<int>(h.level);
  const bool exact = traitsOf(instance.body->leafGeometry).exact();
  outline.voxelSize = std::ldexp(h.voxelSize, exact ? std::min(level - FineEnough, 0) : 0);
  outline.smallestVoxel = std::min(
    outline.voxelSize, std::ldexp(h.voxelSize, std::min(level - instance.body->deepestLevel, 0)));
  outline.signature = h.signature;
  outline.level = static_cast<std::int32_t>(h.level);
  return outline;
}

Outline outlineOf(const Box& receiver)
{
  Outline outline{};
  outline.cube = outline.mesh = receiver;
  outline.opacity = 1.0f;
  outline.receives = 1;
  return outline;
}
}

std::vector<Outline> outlinesOf(const Scene& scene, std::vector<Outline> known)
{
  std::vector<Outline> outlines = std::move(known);
  outlines.resize(std::min(outlines.size(), scene.instances.size()));
  outlines.reserve(scene.instances.size() + scene.receivers.size());
  for (std::size_t i = outlines.size(); i < scene.instances.size(); ++i)
  {
    outlines.push_back(outlineOf(scene.instances[i]));
  }
  for (const Box& receiver : scene.receivers)
  {
    outlines.push_back(outlineOf(receiver));
  }
  return outlines;
}

std::array<glm::dvec3, 8> worldCorners(const Outline& outline, double margin)
{
  Box box = outline.cube;
  if (outline.mesh.known())
  {
    // The mesh is in the middle of the cube: its own box is tighter.
    box.low = glm::max(box.low, outline.mesh.low - margin);
    box.high = glm::min(box.high, outline.mesh.high + margin);
  }
  std::array<glm::dvec3, 8> corners;
  for (int i = 0; i < 8; ++i)
  {
    corners[i] = glm::dvec3(outline.localToWorld * glm::dvec4(box.corner(i), 1.0));
  }
  return corners;
}
}
