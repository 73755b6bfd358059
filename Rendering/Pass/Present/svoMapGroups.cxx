#include "svoMapGroups.h"

#include <algorithm>

namespace svo
{
namespace
{
double brightness(const Light& light)
{
  return light.color.r + light.color.g + light.color.b;
}

std::size_t numbersOf(const std::vector<const ShadowMap*>& maps)
{
  std::size_t numbers = 0;
  for (const ShadowMap* map : maps)
  {
    numbers += map->texels ? map->texels->tiles.size() + map->texels->numbers.size() : 0;
  }
  return numbers;
}
}

MapGroups groupsOf(const std::vector<ShadowMap>& maps)
{
  MapGroups groups;
  for (const ShadowMap& map : maps)
  {
    groups[{ map.group > 0, map.light, map.group }].push_back(&map);
  }
  return groups;
}

bool keepBrightest(
  MapGroups& groups, const std::vector<Light>& lights, std::size_t most, std::size_t mostNumbers)
{
  std::size_t count = 0, numbers = 0;
  for (const auto& entry : groups)
  {
    count += entry.second.size();
    numbers += numbersOf(entry.second);
  }
  if (count <= most && numbers <= mostNumbers)
  {
    return false;
  }
  const auto rank = [&](const MapGroup& group)
  {
    // Of equally bright lights the first one.
    return std::make_tuple(brightness(lights[group.light]), group.light, -group.group);
  };
  while (count > most || numbers > mostNumbers)
  {
    const auto faintest = std::min_element(groups.begin(), groups.end(),
      [&](const auto& a, const auto& b) { return rank(a.first) < rank(b.first); });
    count -= faintest->second.size();
    numbers -= numbersOf(faintest->second);
    groups.erase(faintest);
  }
  return true;
}
}
