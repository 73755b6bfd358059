// The views of a light: those that its shadow buffer is traced through.
#ifndef svoLightView_h
#define svoLightView_h

#include "svoOutline.h"
#include "svoScene.h"
#include "svoView.h"
#include "vtkSVOTracingModule.h"

#include <cstdint>
#include <vector>

namespace svo
{
/// The views that a light needs, whatever is seen: a parallel one around the casters for a
/// directional light; for a positional one a perspective view if they subtend less than 120
/// degrees, else six square faces of a cube; for a spot never more than its cone. Views of
/// `resolution`^2 texels fitted to the corners of the casters' cubes; none if nothing casts.
/// `casters` as from castersOf().
VTKSVOTRACING_EXPORT std::vector<View> fitLight(const std::vector<Outline>& outlines,
  const std::vector<std::uint8_t>& casters, const Light& light, int resolution);
}

#endif
