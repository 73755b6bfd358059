/**
 * @class vtkSVOToHyperTreeGrid
 * @brief the cells of an octree, with all its levels, as a hyper tree grid
 *
 * The input is a mesh with an octree, from vtkPolyDataToSVO or any source of octrees. The output is
 * a grid of one tree of branching factor 2, the octree's cube, in the mesh's coordinates: its
 * depths are the octree's levels, empty cells are masked. VTK's filters of hyper tree grids and
 * ParaView's slice, threshold and probe it.
 *
 * Cell data: "Level" (unsigned char), 0 for the cube; and "CellId" (vtkIdType), the input's cell
 * that a cell stands for, as of vtkSVOToPolyData; masked cells have -1. The octree of a surface
 * that is no mesh (vtkImplicitFunctionToSVO) has no "CellId"; where its voxels have values
 * (vtkImageToSVO's ColorArrayName), cells have those of the first voxel in them.
 *
 * Cells of a grid that was stretched are boxes; where a grid was turned, mirrored or sheared
 * (vtkSVOVDBReader), the octree cannot be converted.
 *
 * A hyper tree grid takes about 10 to 25 bytes a cell, masked ones included, of which there are
 * some three for a voxel of a surface; the octree itself has about 5. So choose a Level.
 *
 * An input without an octree, or with one that does not belong to it, and an output that would not
 * fit in memory are errors, and the output is empty. Progress and abort work.
 *
 * @sa vtkSVOToPolyData vtkPolyDataToSVO vtkHyperTreeGrid
 */
#ifndef vtkSVOToHyperTreeGrid_h
#define vtkSVOToHyperTreeGrid_h

#include "vtkHyperTreeGridAlgorithm.h"
#include "vtkSVOCoreModule.h" // for the export macro

class VTKSVOCORE_EXPORT vtkSVOToHyperTreeGrid : public vtkHyperTreeGridAlgorithm
{
public:
  static vtkSVOToHyperTreeGrid* New();
  vtkTypeMacro(vtkSVOToHyperTreeGrid, vtkHyperTreeGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  //@{
  /**
   * The deepest octree level of the output; -1 or anything beyond the octree's depth: its voxels.
   * -1 to 20, values outside are clamped; default -1.
   */
  vtkSetClampMacro(Level, int, -1, 20);
  vtkGetMacro(Level, int);
  //@}

protected:
  vtkSVOToHyperTreeGrid() = default;
  ~vtkSVOToHyperTreeGrid() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  /** Asked by the superclass only, which has hyper tree grids as input. */
  int ProcessTrees(vtkHyperTreeGrid* input, vtkDataObject* output) override;

private:
  int Level = -1;
};

#endif
