// The balls and rods that VTK's mappers of spheres, sticks and molecules draw without polygons.
#ifndef svoImpostors_h
#define svoImpostors_h

#include "svoRoundShapes.h"

#include <memory>
#include <vector>

class vtkMapper;

namespace svo
{
/// True for vtkOpenGLSphereMapper, vtkOpenGLStickMapper and vtkOpenGLMoleculeMapper.
bool isImpostorMapper(vtkMapper* mapper);

/// The shapes that such a mapper draws, and whether its colours are opaque. The mapper's input is
/// up to date. Places, sizes and directions that are not finite have no shapes.
struct Impostors
{
  std::vector<std::shared_ptr<RoundShapes>> shapes; // none is empty
  bool opaque = true;
};
Impostors impostorsOf(vtkMapper* mapper);
}

#endif
