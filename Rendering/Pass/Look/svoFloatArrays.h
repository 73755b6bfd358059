// Arrays of any type as floats, converted once.
#ifndef svoFloatArrays_h
#define svoFloatArrays_h

#include "svoKeepAlive.h"

#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkSmartPointer.h"

namespace svo
{
/// Copies of arrays that are not floats, for as long as somebody keeps them.
using FloatArrays = CachedValues<vtkDataArray*, vtkSmartPointer<vtkFloatArray>>;

/// The array's values in its own order; valid as long as `kept`, or until the array changes.
inline const float* floatsOf(vtkDataArray* array, FloatArrays& copies, KeepAlive& kept)
{
  if (auto* floats = vtkFloatArray::SafeDownCast(array))
  {
    return floats->GetPointer(0);
  }
  const auto convert = [array](vtkSmartPointer<vtkFloatArray>& copy)
  {
    copy = vtkSmartPointer<vtkFloatArray>::New();
    copy->DeepCopy(array);
  };
  return copies.of(array, array->GetMTime(), kept, convert)->GetPointer(0);
}
}

#endif
