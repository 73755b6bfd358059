// Traced surfaces among rasterised ones that may have the same vertices: which of the two is seen.
#ifndef svoCoincidentOrder_h
#define svoCoincidentOrder_h

#include "svoSceneOctrees.h"

#include <vector>

namespace svo
{
/// Sets Instance::coincidentOrder of all traced surfaces: VTK draws opaque props in their order,
/// then translucent ones, and of equal depths the last one drawn is seen. Where that asks for both,
/// the surface gives way. `props`: all that are visible, in the renderer's order.
void orderCoincident(std::vector<PropSurfaces>& props);
}

#endif
