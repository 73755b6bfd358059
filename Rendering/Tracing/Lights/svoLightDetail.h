// Finer maps of a light, where texels of the map of all casters would look wide.
#ifndef svoLightDetail_h
#define svoLightDetail_h

#include "svoFrame.h"
#include "svoOutline.h"
#include "svoScene.h"
#include "svoView.h"
#include "vtkSVOTracingModule.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace svo
{
/// The maps of a light's shadow buffer.
struct LightMaps
{
  std::vector<std::uint8_t> casters; // castersOf(); of translucent ones the group
  std::vector<View> views;           // a point is looked up in the first one that holds it
  /// How wide texels of maps that are fitted to the eye's view look there at most, pixels; 0 where
  /// the maps are fitted to casters.
  double coarsest = 0.0;
  double widest = 0.0;       // no texel looks wider, pixels
  int translucentGroups = 0; // see svoTranslucentGroups.h; each has a buffer with these views
};

/// How wide texels look, of the maps of a frame.
struct TexelWidths
{
  double coarsest = 0.0, widest = 0.0; // as LightMaps has them
  bool fewer = false;                  // texels than the settings ask for

  void add(const LightMaps& light, const FrameSettings& settings)
  {
    this->coarsest = std::max(this->coarsest, light.coarsest);
    this->widest = std::max(this->widest, light.widest);
    this->fewer = this->fewer ||
      (!light.views.empty() && settings.shadowCoarseness == 1.0 &&
        light.views.front().crop.x1 - light.views.front().crop.x0 < settings.shadowResolution);
  }
  void tell(FrameStatistics& statistics) const
  {
    statistics.coarsestTexel = this->coarsest;
    statistics.widestTexel = this->widest;
    statistics.fewerTexels = this->fewer;
  }
};

/// The maps of a light: those that fit its casters (fitLight()), of resolution^2 texels, unless a
/// texel would look wider than four pixels: of a ground or a terrain that casts, and of which the
/// eye sees a small part only. Then a map is as fine as it can be and yet cover the receivers in
/// the eye's view, a crop of an image of 2^k times as many texels; where that is still too coarse
/// nearby, further maps inside of it cover what lies nearer to the eye.
/// Outlines and views alone decide: processes that agree on these agree on the maps. An eye without
/// pixels sees nothing. `coarseness`: texels may look so many times as wide.
LightMaps mapsOfLight(const std::vector<Outline>& outlines, const Light& light, int resolution,
  const View& eye, double coarseness = 1.0);

/// The maps of all lights that cast, by index of the light, of FrameSettings::shadowResolution
/// texels, by its shadowCoarseness fewer, or of half as many, and so on, until all of them fit into
/// FrameSettings::shadowMemoryLimit.
VTKSVOTRACING_EXPORT std::vector<LightMaps> mapsOfLights(const std::vector<Outline>& outlines,
  const std::vector<Light>& lights, const FrameSettings& settings, const View& eye);
}

#endif
