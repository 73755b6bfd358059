/**
 * @class vtkSparseVoxelOctree
 * @brief a handle on the octree that travels with a mesh
 */
#ifndef vtkSparseVoxelOctree_h
#define vtkSparseVoxelOctree_h

#include "vtkObject.h"
#include "vtkSVOCoreModule.h"

class VTKSVOCORE_EXPORT vtkSparseVoxelOctree : public vtkObject
{
public:
  static vtkSparseVoxelOctree* New();
  vtkTypeMacro(vtkSparseVoxelOctree, vtkObject);

protected:
  vtkSparseVoxelOctree();
  ~vtkSparseVoxelOctree() override;

private:
  vtkSparseVoxelOctree(const vtkSparseVoxelOctree&) = delete;
  void operator=(const vtkSparseVoxelOctree&) = delete;
};

#endif
