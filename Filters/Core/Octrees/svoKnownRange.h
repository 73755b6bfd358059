// The range of an array's values, told to it so that nobody goes through them.
#ifndef svoKnownRange_h
#define svoKnownRange_h

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"

namespace svo
{
/// Of an array of one component. Holds until the array is modified.
inline void tellRange(vtkDataArray* array, const double all[2], const double finite[2])
{
  const auto tell = [&](vtkInformationInformationVectorKey* key, const double range[2])
  {
    vtkNew<vtkInformationVector> components;
    components->SetNumberOfInformationObjects(1);
    components->GetInformationObject(0)->Set(vtkDataArray::COMPONENT_RANGE(), range, 2);
    array->GetInformation()->Set(key, components);
  };
  tell(vtkAbstractArray::PER_COMPONENT(), all);
  tell(vtkAbstractArray::PER_FINITE_COMPONENT(), finite);
}
}

#endif
