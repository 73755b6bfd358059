/**
 * @class vtkSparseVoxelOctree
 * @brief a handle on the sparse voxel octree that travels with a mesh
 *
 * vtkPolyDataToSVO puts an octree into the field data of its output mesh. Initialize() opens it,
 * and this class answers questions to it. Changing the mesh afterwards, its points, its cells or
 * the bytes of the octree in its field data, does not change the handle: it has bytes of its own,
 * which all handles and render passes share that open the same array.
 *
 * All points are in the mesh's own coordinates (not the actor's). The octree divides a cube,
 * see GetBounds(), into 2^level cells along an edge, level 0 to GetNumberOfLevels(); the cells of
 * the last level are the voxels. A cell is occupied if the surface touches it.
 *
 * @sa vtkPolyDataToSVO vtkSVOToPolyData
 */
#ifndef vtkSparseVoxelOctree_h
#define vtkSparseVoxelOctree_h

#include "vtkObject.h"
#include "vtkSVOCoreModule.h" // for the export macro

#include <memory> // for std::unique_ptr

class vtkPolyData;
#ifndef __VTK_WRAP__
namespace svo
{
class Octree;
}
#endif

class VTKSVOCORE_EXPORT vtkSparseVoxelOctree : public vtkObject
{
public:
  static vtkSparseVoxelOctree* New();
  vtkTypeMacro(vtkSparseVoxelOctree, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Opens the octree that `mesh` carries. Returns false and reports one error if there is none, if
   * it does not belong to the mesh (anymore), or if it is damaged; the handle is empty then, and
   * its former octree is gone.
   */
  bool Initialize(vtkPolyData* mesh);

  /**
   * The octree's depth: there are 2^levels voxels along an edge of its cube. 0 before Initialize().
   */
  int GetNumberOfLevels();

  /**
   * Number of occupied voxels, which are the octree's leaves.
   */
  vtkIdType GetNumberOfVoxels();

  /**
   * Number of nodes in memory. A node stands for 4 x 4 x 4 cells, that is for two octree levels;
   * those of the deepest rank hold the voxels.
   */
  vtkIdType GetNumberOfNodes();

  /**
   * Memory in use in KiB (1024 bytes), rounded up: the octree and the triangles that its leaves
   * refer to.
   */
  unsigned long GetActualMemorySize();

  //@{
  /**
   * The octree's cube: xmin, xmax, ymin, ymax, zmin, zmax, in the mesh's coordinates. It encloses
   * the mesh, which lies in its middle. Where the octree is that of a grid whose voxels are
   * stretched, turned or sheared (vtkSVOVDBReader), the bounds of what that makes of the cube. An
   * uninitialized handle has VTK's empty bounds (1, -1, 1, -1, 1, -1). The form that returns a
   * pointer points into the handle, valid until it is next called.
   */
  void GetBounds(double bounds[6]);
  double* GetBounds() VTK_SIZEHINT(6);
  //@}

  /**
   * Edge of a voxel in the mesh's coordinates; of a stretched or sheared one the cube root of its
   * volume. 0 before Initialize().
   */
  double GetVoxelSize();

  /**
   * Whether the cell of octree level `level` that contains the point `x` is occupied. Cells are
   * half-open: a point on a face between two cells belongs to the upper one. `level` is clamped to
   * 0 .. GetNumberOfLevels(). False outside the cube and for a point that is not finite.
   */
  bool IsOccupied(const double x[3], int level);

  /**
   * Intersects the line from `p1` to `p2` with the octree's leaves, as VTK's cell locators do.
   * Returns 1 if something is hit, and then the nearest hit: `t` in [0, 1] along the line, the
   * point `x`, and the id of the mesh's cell, as in vtkPolyData (-1 where the octree is that of a
   * surface that is no mesh). Returns 0, and leaves the
   * arguments as they are, if nothing is hit. What a leaf looks like is the leaf geometry that was
   * chosen in vtkPolyDataToSVO: exact for triangles, and within voxels for the others. From Python
   * pass vtkmodules.vtkCommonCore.reference objects for `t` and `cellId`, and a list for `x`.
   */
  int IntersectWithLine(
    const double p1[3], const double p2[3], double& t, double x[3], vtkIdType& cellId);

#ifndef __VTK_WRAP__
  /**
   * The engine's view of the octree; false in a boolean context before Initialize(). C++ only.
   */
  const svo::Octree& GetOctree() const;
#endif

protected:
  vtkSparseVoxelOctree();
  ~vtkSparseVoxelOctree() override;

private:
  class vtkInternals;
  std::unique_ptr<vtkInternals> Internals;
};

#endif
