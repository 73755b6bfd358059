#include "svoDataSetSurfaces.h"

#include "vtkDataSetMapper.h"
#include "vtkDataSetSurfaceFilter.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"

namespace svo
{
vtkPolyDataMapper* DataSetSurfaces::mapperOf(vtkDataSetMapper* mapper, Kept& kept)
{
  vtkDataSet* input = mapper->GetInput();
  if (!input)
  {
    return nullptr;
  }
  Entry& entry = this->Entries.of(mapper, kept);
  if (!entry.mapper)
  {
    entry.mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
    entry.filter = vtkSmartPointer<vtkDataSetSurfaceFilter>::New();
  }
  if (entry.time != mapper->GetMTime())
  {
    entry.time = mapper->GetMTime();
    entry.mapper->vtkMapper::ShallowCopy(mapper);
  }
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
