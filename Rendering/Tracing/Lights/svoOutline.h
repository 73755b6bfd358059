// An instance without its octree: the data that fit a light's view, and that tell whether the
// instance's shadow is still the same.
#ifndef svoOutline_h
#define svoOutline_h

#include "svoBox.h"
#include "svoScene.h"
#include "vtkSVOTracingModule.h"

#include <array>
#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace svo
{
/// Plain bytes, without gaps: processes send them to each other and compare them.
struct Outline
{
  glm::dmat4 localToWorld{ 1.0 };
  Box cube{ glm::dvec3(0.0), glm::dvec3(0.0) }; // the octree's, local coordinates
  Box mesh;                // the mesh's own; empty where the octree does not know it
  double voxelSize;        // local coordinates; 0: there is no octree yet, and the cube is the box
  double smallestVoxel;    // of the deepest octree that the mesh may get, local coordinates
  double pixelError;       // Instance::pixelError
  std::uint64_t signature; // of the mesh
  std::int32_t level;
  std::int32_t leafGeometry; // LeafGeometry
  std::int32_t casts;        // the instance is allowed to cast, and has voxels
  std::int32_t receives;     // the instance is visible, and shows shadows
  float opacity;             // Instance::opacity
  std::int32_t translucent;  // Instance::translucent()
};
static_assert(sizeof(Outline) == 16 * 8 + 12 * 8 + 4 * 8 + 6 * 4, "no gaps");

/// Of the instances of a scene, then of its receivers. `known`: those that there were of the same
/// instances, perhaps for other receivers.
VTKSVOTRACING_EXPORT std::vector<Outline> outlinesOf(
  const Scene& scene, std::vector<Outline> known = {});

/// Corners of the mesh's box, `margin` (local units) wider on all sides but never beyond the
/// octree's cube, in the world; of the cube where there is no such box.
VTKSVOTRACING_EXPORT std::array<glm::dvec3, 8> worldCorners(const Outline& outline, double margin);
}

#endif
