#include "vtkSparseVoxelOctree.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkSparseVoxelOctree);

vtkSparseVoxelOctree::vtkSparseVoxelOctree() = default;
vtkSparseVoxelOctree::~vtkSparseVoxelOctree() = default;
