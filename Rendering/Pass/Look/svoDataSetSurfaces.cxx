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
  const auto copySettings = [mapper](Entry& entry)
  {
    if (!entry.mapper)
    {
      entry.mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
      entry.filter = vtkSmartPointer<vtkDataSetSurfaceFilter>::New();
    }
    entry.mapper->vtkMapper::ShallowCopy(mapper);
  };
  const Entry& entry = this->Entries.of(mapper, mapper->GetMTime(), kept, copySettings);
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
