// The surfaces that vtkDataSetMapper shows of grids and other data sets.
#ifndef svoDataSetSurfaces_h
#define svoDataSetSurfaces_h

#include "svoKeepAlive.h"

#include "vtkSmartPointer.h"

class vtkDataSetMapper;
class vtkDataSetSurfaceFilter;
class vtkPolyDataMapper;

namespace svo
{
struct DataSetSurface
{
  vtkSmartPointer<vtkDataSetSurfaceFilter> filter;
  vtkSmartPointer<vtkPolyDataMapper> mapper;
};
/// vtkDataSetMapper makes its surface while it draws. A traced one never draws, so the same is made
/// here, by the same filter, and kept until the data set changes.
using DataSetSurfaces = CachedValues<vtkDataSetMapper*, DataSetSurface>;

/// A mapper of the surface with the settings of the given one; its input is up to date. Null if
/// there is no data set.
vtkPolyDataMapper* surfaceMapperOf(
  vtkDataSetMapper* mapper, DataSetSurfaces& surfaces, KeepAlive& kept);
}

#endif
