// Finer maps of a light where the map of all that casts would show its texels.
#ifndef svoLightDetail_h
#define svoLightDetail_h

#include "svoFrame.h"
#include "svoOutline.h"
#include "svoScene.h"
#include "svoView.h"

#include <cstdint>
#include <vector>

namespace svo
{
/// What a light's shadow buffer is traced through.
struct LightMaps
{
  std::vector<std::uint8_t> casters; // castersOf()
  std::vector<View> views;           // a point is looked up in the first one that holds it
  /// How wide their texels may look at most on what is seen, pixels; 0 where nobody asked, because
  /// the maps are those that casters ask for.
  double coarsest = 0.0;
};

/// The maps of a light: those that fit its casters (fitLight()), of resolution^2 texels, unless a
/// texel would look wider than eight pixels: of a ground or a terrain that casts, and of which the
/// eye sees a small part only. Then a map covers what receives shadows in the eye's view and no
/// more; and where that is still too coarse nearby, further ones inside of it cover what lies
/// nearer to the eye. All of it follows from outlines and views: processes that agree on these
/// agree on the maps. An eye without pixels sees nothing.
LightMaps mapsOfLight(
  const std::vector<Outline>& outlines, const Light& light, int resolution, const View& eye);

/// The maps of all lights that cast, by index of the light, of FrameSettings::shadowResolution
/// texels, or of half as many, and so on, until all of them fit into
/// FrameSettings::shadowMemoryLimit.
std::vector<LightMaps> mapsOfLights(const std::vector<Outline>& outlines,
  const std::vector<Light>& lights, const FrameSettings& settings, const View& eye);
}

#endif
