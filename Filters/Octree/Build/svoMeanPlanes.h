// The mean plane of the surface in a block: area-weighted moments, summed from triangles to bricks
// and from children to parents.
#ifndef svoMeanPlanes_h
#define svoMeanPlanes_h

#include "svoVoxelize.h"

#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

namespace svo
{
/// What the moments need of a triangle, before it was snapped.
struct TriangleShape
{
  glm::vec3 normal;   // unit length; any across the segment where a triangle has no area
  float areaPerVoxel; // its area, in faces of a voxel, over the voxels that it touches
};

/// The surface in a block. Sheets that face each other do not cancel: every contribution is turned
/// to the side of the largest one, and their sum to the side that most of the area faces.
struct SurfaceMoment
{
  glm::vec3 normal; // sum of area times normal
  float area;       // in faces of a voxel, above 0
  glm::vec3 centre; // mean point of the surface, voxels, from the block's centre
};

/// Of a brick, from its records. A triangle's area is shared out among its bricks by the voxels it
/// touches there; its mean point is the middle of the brick's voxels, put on its plane.
SurfaceMoment brickMoment(
  const BrickRecord* records, std::size_t count, std::uint64_t mask, const TriangleShape* shapes);

/// Of a block, from its children in Morton order; `childEdge` is their edge in voxels.
SurfaceMoment blockMoment(const SurfaceMoment* children, std::uint64_t mask, float childEdge);

/// The moment as a plane (svoPlane.h) of a block with that edge in voxels.
std::uint32_t planeOfMoment(const SurfaceMoment& moment, float edge);
}

#endif
