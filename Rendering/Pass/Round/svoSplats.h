// The balls that the splats of a vtkPointGaussianMapper stand for.
#ifndef svoSplats_h
#define svoSplats_h

#include "svoRoundShapes.h"

#include <cstdint>
#include <memory>

class vtkMapper;
class vtkPointGaussianMapper;
class vtkPolyData;

namespace svo
{
/// True for the class that draws splats by known rules.
bool isSplatMapper(vtkMapper* mapper);

/// The time of all that a splat mapper's own time does not tell of: its functions. 0 of others.
std::uint64_t timeOfSplats(vtkMapper* mapper);

/// The radius, in units of a splat's size, of the opaque disc that a splat shader draws; 0 if it
/// draws something else, or nobody can tell. Known are shaders that discard what lies farther than
/// some number from the centre and leave the opacity alone, as ParaView's presets Sphere,
/// Black-edged circle and Plain circle do, and PyVista's.
double discOf(const char* splatShader);

/// True if an actor's matrix scales its splats, as it does from VTK 9.4 on.
bool actorsScaleSplats();

/// Why (a Reason) the mapper's splats stand for no opaque shapes, whatever the points are; null if
/// they do.
const char* beyondSplats(vtkPointGaussianMapper* mapper);

struct Splats
{
  std::shared_ptr<RoundShapes> shapes;
  bool translucent = false; // some points are, and are not in `shapes`
};

/// The balls of one input, as vtkOpenGLPointGaussianMapper::BuildBufferObjects has them. `all`:
/// those of translucent points, too. Points and sizes that are not finite have none.
Splats splatsOf(vtkPointGaussianMapper* mapper, vtkPolyData* input, bool all);
}

#endif
