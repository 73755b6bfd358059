// The opaque cells of a surface, by its mapped colours, as a mesh that casts.
#ifndef svoOpaqueCells_h
#define svoOpaqueCells_h

#include "svoKeepAlive.h"
#include "svoScene.h"
#include "svoSurfaceLook.h"

#include "vtkSmartPointer.h"

#include <array>
#include <utility>

class vtkMapper;
class vtkPolyData;

namespace svo
{
struct OpaqueAnswer
{
  /// Of the opaque cells: the surface's own if all are; none if none.
  vtkSmartPointer<vtkPolyData> mesh{};
  bool translucent = false; // there are cells that are neither opaque nor invisible
  /// Where there are, and it was asked for: all cells but the invisible ones, the surface's own
  /// mesh if none is. Cells and points have the numbers that they have there.
  vtkSmartPointer<vtkPolyData> visible{};
  bool mapped = false; // colours make these cells translucent, perhaps the part's opacity, too
  double alpha = 1.0;  // if mapped: the mean of what they have at the corners of visible cells
};
/// Kept until the mesh or its colours change, or nobody has them. Stamps have times of the mesh and
/// of what its colours are made of, and whether what is visible was asked for.
using OpaqueCells = CachedValues<std::pair<vtkPolyData*, vtkMapper*>, OpaqueAnswer,
  std::pair<std::array<vtkMTimeType, 4>, bool>>;

/// The part's scalars have been mapped to `attributes`. A cell is opaque if all of its points are,
/// and all colours between them. `visible`: what is visible is asked for.
OpaqueAnswer opaqueCellsOf(const SurfacePart& part, const Attributes& attributes, bool visible,
  OpaqueCells& cells, KeepAlive& kept);
}

#endif
