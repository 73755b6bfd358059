// Mappers that several props share, and what follows for which of these are traced.
//
// A mapper of VTK's keeps buffers, textures and a shader from what it drew last, and of what
// another actor changes it notices only a part. So what it draws depends on all that it has drawn:
// on a surface that is traced in between, too.
#ifndef svoSharedMappers_h
#define svoSharedMappers_h

#include "svoSceneOctrees.h"

#include <vector>

namespace svo
{
/// Leaves props to the rasteriser whose mappers draw others of these props as well.
void leaveShared(std::vector<PropSurfaces>& props);

/// Why that was done with a prop; null if it was not.
Reason reasonOfSharing(const PropSurfaces& prop);
}

#endif
