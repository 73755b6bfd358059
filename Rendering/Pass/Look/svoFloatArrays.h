// Arrays of any type as floats, converted once.
#ifndef svoFloatArrays_h
#define svoFloatArrays_h

#include "svoKept.h"

#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkSmartPointer.h"

namespace svo
{
/// Copies of arrays that are not floats, for as long as somebody keeps them.
class FloatArrays
{
public:
  /// The array's values in its own order; valid as long as `kept`, or until the array changes.
  const float* values(vtkDataArray* array, Kept& kept)
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
    return this->Copies.of(array, array->GetMTime(), kept, convert)->GetPointer(0);
  }

  /// Drops what nobody keeps.
  void sweep() { this->Copies.sweep(); }

  std::size_t size() const { return this->Copies.size(); }

private:
  KeptValues<vtkDataArray*, vtkSmartPointer<vtkFloatArray>> Copies;
};
}

#endif
