// Shadow maps that are looked up together, and those that OpenGL has room for.
#ifndef svoMapGroups_h
#define svoMapGroups_h

#include "svoFrame.h"
#include "svoLight.h"

#include <cstddef>
#include <map>
#include <tuple>
#include <vector>

namespace svo
{
/// The maps of a light's opaque casters, or of a group of its translucent ones.
struct MapGroup
{
  bool translucent;
  int light; // index into Scene::lights, and its number in VTK's shaders
  int group; // ShadowMap::group

  /// Those of opaque casters first.
  bool operator<(const MapGroup& o) const
  {
    return std::tie(this->translucent, this->light, this->group) <
      std::tie(o.translucent, o.light, o.group);
  }
};
using MapGroups = std::map<MapGroup, std::vector<const ShadowMap*>>;

MapGroups groupsOf(const std::vector<ShadowMap>& maps);

/// Leaves maps of the faintest lights out, of each light those of translucent casters first, until
/// no more than `most` maps of no more than `mostNumbers` floats are left. True if there were more.
bool keepBrightest(
  MapGroups& groups, const std::vector<Light>& lights, std::size_t most, std::size_t mostNumbers);
}

#endif
