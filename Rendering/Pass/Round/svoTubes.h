// The tubes and spheres that VTK draws for the lines and points of a mesh
// (vtkProperty::RenderLinesAsTubes, RenderPointsAsSpheres).
#ifndef svoTubes_h
#define svoTubes_h

#include "svoCellAlpha.h"
#include "svoRoundShapes.h"

#include <memory>

class vtkPolyData;
class vtkProperty;

namespace svo
{
/// What a property has VTK draw as tubes and spheres.
struct RoundLook
{
  bool lines = false;    // of cells that are lines
  bool edges = false;    // and of all others
  bool vertices = false; // points of cells that are vertices
  bool points = false;   // and of all others

  bool any() const { return this->lines || this->vertices || this->points; }
};
RoundLook roundLookOf(vtkProperty* property);

/// RoundShapes of a mesh; none: null. `translucent`: some would be, and are not in it.
struct Tubes
{
  std::shared_ptr<RoundShapes> rods, balls;
  bool translucent = false;
};

/// Rods have the property's line width for their diameter, balls its point size, both in pixels.
/// Segments without a length, and points that are not finite, have none; an edge of several cells
/// has one.
Tubes tubesOf(vtkPolyData* mesh, vtkProperty* property, const CellAlpha& alpha);
}

#endif
