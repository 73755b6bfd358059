// Surfaces that are coloured by the values of their octrees' leaves, as data sets that a mapper
// maps the colours of.
#ifndef svoLeafMeshes_h
#define svoLeafMeshes_h

#include "svoKept.h"

#include "vtkSmartPointer.h"

class vtkDataArray;
class vtkMapper;
class vtkPolyData;

namespace svo
{
/// Kept for as long as somebody has them: a mapper maps colours again only of a data set
/// that is new or has changed.
class LeafMeshes
{
public:
  /// What has the values of leaves as cell data, in the place of the mesh's of that name, where the
  /// mapper colours it by such; else nullptr.
  vtkPolyData* of(vtkPolyData* carrier, vtkMapper* mapper, Kept& kept);

  /// Drops what nobody keeps.
  void sweep() { this->Meshes.sweep(); }

private:
  KeptValues<vtkDataArray*, vtkSmartPointer<vtkPolyData>> Meshes; // by values; times of carriers
};
}

#endif
