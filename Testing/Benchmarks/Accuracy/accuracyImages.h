// Pictures of what is wrong, pixel by pixel.
#ifndef accuracyImages_h
#define accuracyImages_h

#include "accuracyMetrics.h"

#include <string>

namespace accuracy
{
/// Grey: the exact picture. Red: dark but should be lit. Blue: lit but should be dark.
void writeShadowDifference(const std::vector<Light>& shown, const std::vector<Light>& truth,
  const std::vector<TruePixel>& exact, int width, const std::string& path);

/// White where the depth is exact, red where it is up to two voxels too near, blue where too far,
/// black for false hits and misses, pale grey where nothing is.
void writeDepthDifference(const Picture& picture, const std::vector<TruePixel>& truth,
  const svo::View& view, double voxel, const std::string& path);
}

#endif
