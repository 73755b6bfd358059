// The surfaces that vtkDataSetMapper shows of grids and other data sets.
#ifndef svoDataSetSurfaces_h
#define svoDataSetSurfaces_h

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <map>

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
  DataSetSurfaces();
  ~DataSetSurfaces();

  /// A mapper of the surface with the settings of the given one; its input is up to date. Null if
  /// there is no data set.
  vtkPolyDataMapper* mapperOf(vtkDataSetMapper* mapper);

  /// Drops entries that were not asked for since the last call.
  void endFrame();

private:
  struct Entry
  {
    vtkSmartPointer<vtkDataSetSurfaceFilter> filter;
    vtkSmartPointer<vtkPolyDataMapper> mapper;
    vtkMTimeType time = 0; // of the settings
    bool asked = false;
  };
  std::map<vtkDataSetMapper*, Entry> Entries;
};
}

#endif
