// Offsets and point ids of cells as plain arrays, however VTK stores them.
#ifndef svoCellIds_h
#define svoCellIds_h

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellArray.h"
#include "vtkNew.h"

namespace svo
{
/// Calls use(offsets, ids) if both arrays lie in memory as values of type Id.
template <typename Id, typename Use>
bool useStoredCellIds(vtkCellArray* cells, const Use& use)
{
  using Values = vtkAOSDataArrayTemplate<Id>;
  auto* offsets = Values::FastDownCast(cells->GetOffsetsArray());
  auto* ids = Values::FastDownCast(cells->GetConnectivityArray());
  if (!offsets || !ids)
  {
    return false;
  }
  use(static_cast<const Id*>(offsets->GetPointer(0)), static_cast<const Id*>(ids->GetPointer(0)));
  return true;
}

/// Calls use(offsets, ids): pointers to the GetNumberOfCells() + 1 offsets and the point ids, of 32
/// or 64 bits, valid during the call. Keeps no state in the cells, so that several threads may read
/// the same ones. From VTK 9.6 on offsets may be computed and ids may be of any kind (cells that
/// all have one size are stored so by flying edges, surface nets, plane cutters); such ones are
/// copied. False if not even a copy can be had; nothing is called then.
template <typename Use>
bool useCellIds(vtkCellArray* cells, const Use& use)
{
  if (useStoredCellIds<vtkTypeInt64>(cells, use) || useStoredCellIds<vtkTypeInt32>(cells, use))
  {
    return true;
  }
  vtkNew<vtkCellArray> copy;
  copy->DeepCopy(cells); // converting empties the arrays that are converted
  return copy->ConvertTo64BitStorage() && useStoredCellIds<vtkTypeInt64>(copy, use);
}
}

#endif
