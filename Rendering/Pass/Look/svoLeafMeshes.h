// Surfaces that are coloured by the values of their octrees' leaves, as data sets that a mapper
// maps the colours of.
#ifndef svoLeafMeshes_h
#define svoLeafMeshes_h

#include "svoKeepAlive.h"

#include "vtkSmartPointer.h"

#include <utility>

class vtkDataArray;
class vtkMapper;
class vtkPolyData;
class vtkPolyDataMapper;

namespace svo
{
/// Values of leaves as cell data, in the place of the mesh's of that name, and a mapper that maps
/// their colours as the mesh's does. (That one would take them for the mesh's own.)
struct LeafMesh
{
  vtkSmartPointer<vtkPolyData> mesh;
  vtkSmartPointer<vtkPolyDataMapper> colors;
};

/// By values of leaves and mapper. Kept for as long as somebody has them: a mapper maps colours
/// again only of a data set that is new or has changed.
using LeafMeshes = CachedValues<std::pair<vtkDataArray*, vtkMapper*>, LeafMesh,
  std::pair<vtkMTimeType, vtkMTimeType>>;

/// That of a mesh which the mapper colours by values of leaves; else nullptr.
LeafMesh* leafMeshOf(vtkPolyData* carrier, vtkMapper* mapper, LeafMeshes& meshes, KeepAlive& kept);
}

#endif
