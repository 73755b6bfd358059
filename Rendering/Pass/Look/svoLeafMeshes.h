// Surfaces that are coloured by the values of their octrees' leaves, as data sets that a mapper
// maps the colours of.
#ifndef svoLeafMeshes_h
#define svoLeafMeshes_h

#include "svoKeepAlive.h"

#include "vtkSmartPointer.h"

class vtkDataArray;
class vtkMapper;
class vtkPolyData;

namespace svo
{
/// By values of leaves. Kept for as long as somebody has them: a mapper maps colours again only of
/// a data set that is new or has changed.
using LeafMeshes = CachedValues<vtkDataArray*, vtkSmartPointer<vtkPolyData>>;

/// What has the values of leaves as cell data, in the place of the mesh's of that name, where the
/// mapper colours it by such; else nullptr.
vtkPolyData* leafMeshOf(
  vtkPolyData* carrier, vtkMapper* mapper, LeafMeshes& meshes, KeepAlive& kept);
}

#endif
