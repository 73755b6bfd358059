#include "svoSharedMappers.h"

#include <algorithm>
#include <unordered_set>

namespace svo
{
void leaveShared(std::vector<PropSurfaces>& props)
{
  std::unordered_set<const vtkMapper*> drawing;
  const auto draw = [&](const PropSurfaces& prop)
  { drawing.insert(prop.mappers.begin(), prop.mappers.end()); };
  for (const PropSurfaces& prop : props)
  {
    if (!prop.shown)
    {
      draw(prop);
    }
  }
  bool found = !drawing.empty();
  while (found) // an assembly that is left has further mappers
  {
    found = false;
    for (PropSurfaces& prop : props)
    {
      if (prop.shown &&
        std::any_of(prop.mappers.begin(), prop.mappers.end(),
          [&](const vtkMapper* mapper) { return drawing.count(mapper) > 0; }))
      {
        prop.shown = false;
        draw(prop);
        found = true;
      }
    }
  }
}

Reason reasonOfSharing(const PropSurfaces& prop)
{
  return prop.traced && !prop.shown && prop.hasOctrees()
    ? "shares its mapper with a prop that is left to the rasteriser"
    : nullptr;
}
}
