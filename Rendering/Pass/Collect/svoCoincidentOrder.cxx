#include "svoCoincidentOrder.h"

#include "vtkActor.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"

#include <algorithm>
#include <cmath>

namespace svo
{
namespace
{
/// Something with surfaces that the rasteriser draws.
struct Drawn
{
  std::size_t place; // in the renderer's order
  bool last;         // among translucent props
  double bounds[6];
};

/// Pairs of props that are looked at in a frame, at most: a tenth of a second.
constexpr std::size_t MostPairs = 1000000;

bool hasBounds(vtkProp* prop, double bounds[6])
{
  const double* own = prop->GetBounds();
  if (!own || !(own[0] <= own[1] && own[2] <= own[3] && own[4] <= own[5]))
  {
    return false;
  }
  std::copy_n(own, 6, bounds);
  return true;
}

/// Lines and points cross the pixels' centres nowhere: their depths are others than the surface's.
bool hasSurfaces(vtkProp* prop)
{
  auto* actor = vtkActor::SafeDownCast(prop);
  if (!actor)
  {
    return true;
  }
  auto* mapper = vtkPolyDataMapper::SafeDownCast(actor->GetMapper());
  vtkPolyData* mesh = mapper ? mapper->GetInput() : nullptr;
  return actor->GetProperty()->GetRepresentation() == VTK_SURFACE &&
    (!mesh || mesh->GetNumberOfPolys() > 0 || mesh->GetNumberOfStrips() > 0);
}

bool touch(const double* a, const double* b)
{
  bool apart = false;
  for (int i = 0; i < 6; i += 2)
  {
    const double slack = 1e-6 * std::max(std::abs(a[i]), std::abs(a[i + 1]));
    apart = apart || a[i + 1] + slack < b[i] || b[i + 1] + slack < a[i];
  }
  return !apart;
}
}

void orderCoincident(std::vector<PropSurfaces>& props)
{
  if (std::none_of(props.begin(), props.end(), [](const PropSurfaces& prop) { return prop.shown; }))
  {
    return;
  }
  std::vector<Drawn> drawn;
  for (std::size_t i = 0; i < props.size(); ++i)
  {
    vtkProp* prop = props[i].prop;
    Drawn one{ i, false, {} };
    if (!props[i].shown && hasSurfaces(prop) && hasBounds(prop, one.bounds))
    {
      one.last = prop->HasTranslucentPolygonalGeometry() != 0;
      drawn.push_back(one);
    }
  }
  if (drawn.empty() || drawn.size() * props.size() > MostPairs)
  {
    return;
  }
  for (std::size_t i = 0; i < props.size(); ++i)
  {
    double bounds[6];
    if (!props[i].shown || !hasBounds(props[i].prop, bounds))
    {
      continue;
    }
    int way = 0;
    for (const Drawn& other : drawn)
    {
      const bool over = other.place > i || other.last;
      if (way < 1 && touch(bounds, other.bounds))
      {
        way = over ? 1 : -1;
      }
    }
    for (SceneSurface& surface : props[i].surfaces)
    {
      surface.instance.coincidentOrder = way;
    }
  }
}
}
