#include "svoOutline.h"

#include "svoLeafTraits.h"
#include "svoWorldToOctree.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include <glm/common.hpp>

namespace svo
{
Outline outlineOf(const Instance& instance)
{
  Outline outline{};
  std::memcpy(outline.localToWorld, &instance.localToWorld[0][0], sizeof(outline.localToWorld));
  outline.pixelError = instance.pixelError;
  outline.leafGeometry = static_cast<std::int32_t>(instance.body->leafGeometry);
  outline.opacity = instance.opacity;
  outline.translucent = instance.translucent();
  const bool placed = placesSomething(instance.localToWorld);
  if (!instance.body->octree)
  {
    const Box& box = instance.body->box;
    if (box.known())
    {
      for (int i = 0; i < 3; ++i)
      {
        outline.cubeLow[i] = outline.meshLow[i] = box.low[i];
        outline.cubeHigh[i] = outline.meshHigh[i] = box.high[i];
        outline.smallestVoxel = std::max(outline.smallestVoxel,
          std::ldexp(box.high[i] - box.low[i], -instance.body->deepestLevel));
      }
      outline.casts = instance.castShadow && placed;
      outline.receives = instance.visible && instance.receiveShadow && placed;
    }
    return outline;
  }
  const Header& h = instance.body->octree.header();
  for (int i = 0; i < 3; ++i)
  {
    outline.cubeLow[i] = h.origin[i];
    outline.cubeHigh[i] = h.origin[i] + h.voxelSize * static_cast<double>(1u << h.level);
    outline.meshLow[i] = h.pointCount > 0 ? h.meshBounds[2 * i] : 1.0;
    outline.meshHigh[i] = h.pointCount > 0 ? h.meshBounds[2 * i + 1] : -1.0;
  }
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
  outline.casts = instance.castShadow && !instance.body->octree.empty() && placed;
  outline.receives = instance.visible && instance.receiveShadow && placed;
  return outline;
}

Outline outlineOf(const Box& receiver)
{
  Outline outline{};
  for (int i = 0; i < 3; ++i)
  {
    outline.localToWorld[5 * i] = 1.0;
    outline.cubeLow[i] = outline.meshLow[i] = receiver.low[i];
    outline.cubeHigh[i] = outline.meshHigh[i] = receiver.high[i];
  }
  outline.localToWorld[15] = 1.0;
  outline.opacity = 1.0f;
  outline.receives = 1;
  return outline;
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

glm::dmat4 matrixOf(const Outline& outline)
{
  glm::dmat4 matrix;
  std::memcpy(&matrix[0][0], outline.localToWorld, sizeof(outline.localToWorld));
  return matrix;
}

bool knowsMeshBox(const Outline& outline)
{
  return outline.meshLow[0] <= outline.meshHigh[0] && outline.meshLow[1] <= outline.meshHigh[1] &&
    outline.meshLow[2] <= outline.meshHigh[2];
}

std::array<glm::dvec3, 8> worldCorners(const Outline& outline, double margin)
{
  double box[2][3];
  const bool known = knowsMeshBox(outline);
  for (int i = 0; i < 3; ++i)
  {
    // The mesh is in the middle of the cube: its own box is tighter.
    box[0][i] =
      known ? glm::max(outline.cubeLow[i], outline.meshLow[i] - margin) : outline.cubeLow[i];
    box[1][i] =
      known ? glm::min(outline.cubeHigh[i], outline.meshHigh[i] + margin) : outline.cubeHigh[i];
  }
  const glm::dmat4 localToWorld = matrixOf(outline);
  std::array<glm::dvec3, 8> corners;
  for (int i = 0; i < 8; ++i)
  {
    corners[i] = glm::dvec3(
      localToWorld * glm::dvec4(box[i & 1][0], box[i >> 1 & 1][1], box[i >> 2 & 1][2], 1.0));
  }
  return corners;
}
}
