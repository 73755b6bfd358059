// The surfaces that vtkDataSetMapper shows of grids and other data sets.
#ifndef svoDataSetSurfaces_h
#define svoDataSetSurfaces_h

#include "svoKept.h"

#include "vtkSmartPointer.h"

class vtkDataSetMapper;
class vtkDataSetSurfaceFilter;
class vtkPolyDataMapper;

namespace svo
{
/// vtkDataSetMapper makes its surface while it draws. A traced one never draws, so the same is made
/// here, by the same filter, and kept until the data set changes.
class DataSetSurfaces
{
public:
  /// A mapper of the surface with the settings of the given one; its input is up to date. Null if
  /// there is no data set.
  vtkPolyDataMapper* mapperOf(vtkDataSetMapper* mapper, Kept& kept);

  /// Drops what nobody keeps.
  void sweep() { this->Entries.sweep(); }

private:
  struct Entry
  {
    vtkSmartPointer<vtkDataSetSurfaceFilter> filter;
    vtkSmartPointer<vtkPolyDataMapper> mapper;
  };
  KeptValues<vtkDataSetMapper*, Entry> Entries;
};
}

#endif
