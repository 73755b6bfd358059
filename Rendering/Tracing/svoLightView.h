// The views of a light: what its shadow buffer is traced through.
#ifndef svoLightView_h
#define svoLightView_h

#include "svoOutline.h"
#include "svoScene.h"
#include "svoView.h"

#include <cstdint>
#include <vector>

namespace svo
{
/// Views of `resolution`^2 texels fitted to the corners of the casters' cubes; none if nothing
/// casts. One for directional lights and for casters within 120 degrees, else six.
/// `casters` as from castersOf().
std::vector<View> fitLight(const std::vector<Outline>& outlines,
  const std::vector<std::uint8_t>& casters, const Light& light, int resolution);
}

#endif
