// The instances that can throw a shadow from a light: a light's maps are fitted to these only.
#ifndef svoCasters_h
#define svoCasters_h

#include "svoOutline.h"
#include "svoScene.h"

#include <cstdint>
#include <vector>

namespace svo
{
/// One byte per outline, 1 if it casts: it is allowed to, and something can lie in its shadow. A
/// flat mesh (a ground, a wall) shadows nothing if the light and every receiver are on one side of
/// its plane; half a voxel through it is allowed, since its octree resolves no less: a voxel of the
/// deepest octree that it may get.
std::vector<std::uint8_t> castersOf(const std::vector<Outline>& outlines, const Light& light);
}

#endif
