#include "svoDataSetSurfaces.h"

#include "vtkDataSetMapper.h"
#include "vtkDataSetSurfaceFilter.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"

namespace svo
{
vtkPolyDataMapper* surfaceMapperOf(
  vtkDataSetMapper* mapper, DataSetSurfaces& surfaces, KeepAlive& kept)
{
  vtkDataSet* input = mapper->GetInput();
  if (!input)
  {
    return nullptr;
  }
  const auto copySettings = [mapper](DataSetSurface& entry)
  {
    if (!entry.mapper)
    {
      entry.mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
      entry.filter = vtkSmartPointer<vtkDataSetSurfaceFilter>::New();
    }
    entry.mapper->vtkMapper::ShallowCopy(mapper);
  };
  const DataSetSurface& entry = surfaces.of(mapper, mapper->GetMTime(), kept, copySettings);
  auto* mesh = vtkPolyData::SafeDownCast(input);
  if (!mesh)
  {
    entry.filter->SetInputData(input);
    entry.filter->Update();
    mesh = entry.filter->GetOutput();
  }
  entry.mapper->SetInputData(mesh);
  return entry.mapper;
}
}
