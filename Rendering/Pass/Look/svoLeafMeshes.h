// Surfaces that are coloured by the values of their octrees' leaves, as data sets that a mapper
// maps the colours of.
#ifndef svoLeafMeshes_h
#define svoLeafMeshes_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <map>

class vtkDataArray;
class vtkMapper;
class vtkPolyData;

namespace svo
{
/// Kept for as long as every frame asks for them: a mapper maps colours again only of a data set
/// that is new or has changed.
class LeafMeshes
{
public:
  /// What has the values of leaves as cell data, in the place of the hull's of that name, where the
  /// mapper colours the hull by such; else nullptr.
  vtkPolyData* of(vtkPolyData* hull, vtkMapper* mapper);

  /// Drops entries that were not asked for since the last call.
  void endFrame();

private:
  struct Entry
  {
    vtkSmartPointer<vtkPolyData> mesh;
    vtkMTimeType time = 0; // of the hull
    bool asked = false;
  };
  std::map<vtkDataArray*, Entry> Entries;
};
}

#endif
