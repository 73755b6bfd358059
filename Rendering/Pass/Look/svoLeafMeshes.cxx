#include "svoLeafMeshes.h"

#include "svoLeafValues.h"

#include "vtkAbstractMapper.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"

#include <string>

namespace svo
{
namespace
{
/// The name of the cell data that a mapper colours by; nullptr: it colours by something else.
const char* nameOfCellData(vtkPolyData* carrier, vtkMapper* mapper)
{
  int association = 0;
  vtkAbstractArray* array = vtkAbstractMapper::GetAbstractScalars(carrier, mapper->GetScalarMode(),
    mapper->GetArrayAccessMode(), mapper->GetArrayId(), mapper->GetArrayName(), association);
  constexpr int Cells = 1;
  return array && association == Cells ? array->GetName() : nullptr;
}

vtkSmartPointer<vtkPolyData> meshOf(vtkPolyData* carrier, vtkDataArray* values)
{
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  // By index or by name, a mapper finds the array where it is in the carrier.
  vtkCellData* from = carrier->GetCellData();
  for (int i = 0; i < from->GetNumberOfArrays(); ++i)
  {
    const char* name = from->GetArrayName(i);
    if (name && std::string(name) == values->GetName())
    {
      mesh->GetCellData()->AddArray(values);
      continue;
    }
    vtkNew<vtkFloatArray> other;
    other->SetName(name);
    mesh->GetCellData()->AddArray(other);
  }
  mesh->GetCellData()->SetActiveScalars(values->GetName());
  return mesh;
}
}

LeafMesh* leafMeshOf(vtkPolyData* carrier, vtkMapper* mapper, LeafMeshes& meshes, KeepAlive& kept)
{
  const char* name = nameOfCellData(carrier, mapper);
  vtkDataArray* values = name ? leafValues(carrier, name) : nullptr;
  const auto make = [&](LeafMesh& leaves)
  {
    leaves.mesh = meshOf(carrier, values);
    leaves.colors = vtkSmartPointer<vtkPolyDataMapper>::New();
    leaves.colors->vtkMapper::ShallowCopy(mapper);
    leaves.colors->SetInputData(leaves.mesh);
  };
  return values
    ? &meshes.of({ values, mapper }, { carrier->GetMTime(), mapper->GetMTime() }, kept, make)
    : nullptr;
}
}
