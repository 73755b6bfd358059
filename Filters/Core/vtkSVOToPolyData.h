/**
 * @class vtkSVOToPolyData
 * @brief the cells of an octree as a surface
 *
 * The input is a mesh with an octree, from vtkPolyDataToSVO. The output is the surface of the
 * octree's voxels, or of the occupied cells of a coarser level: quads that face outwards and share
 * points, in the mesh's coordinates. A face between two occupied cells is dropped, so that the
 * surface of any set of cells is closed.
 *
 * Cell data of the output: "Level" (int), the octree level that was shown, and "CellId"
 * (vtkIdType), the input's cell that a voxel stands for: of the cells near it the nearest one. The
 * octree of a surface that is no mesh (vtkImplicitFunctionToSVO) has no "CellId"; where its voxels
 * have values (vtkImageToSVO's ColorArrayName), cells have those of the first voxel in them.
 *
 * An input without an octree, or with one that does not belong to it, is an error, and the output
 * is empty. So is an output that would not fit in memory. Progress and abort work.
 *
 * @sa vtkPolyDataToSVO vtkSparseVoxelOctree
 */
#ifndef vtkSVOToPolyData_h
#define vtkSVOToPolyData_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkSVOCoreModule.h" // for the export macro

class VTKSVOCORE_EXPORT vtkSVOToPolyData : public vtkPolyDataAlgorithm
{
public:
  static vtkSVOToPolyData* New();
  vtkTypeMacro(vtkSVOToPolyData, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  //@{
  /**
   * Octree level whose cells are shown: 0 is the whole cube, and -1 (default) or anything beyond
   * the octree's depth its voxels. -1 to 20.
   */
  vtkSetClampMacro(Level, int, -1, 20);
  vtkGetMacro(Level, int);
  //@}

  //@{
  /**
   * Whether faces between two occupied cells are kept. Default off. With it on every cell has its
   * six quads, so that cells can be told apart after a cut.
   */
  vtkSetMacro(InteriorFaces, bool);
  vtkGetMacro(InteriorFaces, bool);
  vtkBooleanMacro(InteriorFaces, bool);
  //@}

protected:
  vtkSVOToPolyData() = default;
  ~vtkSVOToPolyData() override = default;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  int Level = -1;
  bool InteriorFaces = false;
};

#endif
