// Translucent casters of a light, divided into groups: each group has a shadow buffer of its own.
#ifndef svoTranslucentGroups_h
#define svoTranslucentGroups_h

#include "svoOutline.h"
#include "svoView.h"

#include <cstdint>
#include <vector>

namespace svo
{
/// Opaque casters among the values of LightMaps::casters; greater ones are groups of translucent
/// casters.
constexpr std::uint8_t OpaqueCasters = 1;
constexpr int MostTranslucentGroups = 4;

/// Gives the translucent ones among the casters of a light (castersOf()) the numbers of their
/// groups, OpaqueCasters + 1 and so on, and returns how many groups there are. `views`: of all
/// casters. A buffer knows the nearest caster alone, so those that lie over each other in the one
/// view that there may be go to different groups, as far as there are groups left; where there are
/// several views, or more casters than can be compared, they take turns. What outlines and views
/// say decides, and nothing else.
int groupTranslucent(const std::vector<Outline>& outlines, const std::vector<View>& views,
  std::vector<std::uint8_t>& casters);
}

#endif
