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
    Entry& entry = this->Entries.of(array, kept);
    // Times are never given twice, so a new array in an old one's place is noticed, too.
    if (!entry.copy || entry.time != array->GetMTime())
    {
      entry.time = array->GetMTime();
      entry.copy = vtkSmartPointer<vtkFloatArray>::New();
      entry.copy->DeepCopy(array);
    }
    return entry.copy->GetPointer(0);
  }

  /// Drops what nobody keeps.
  void sweep() { this->Entries.sweep(); }

  std::size_t size() const { return this->Entries.size(); }

private:
  struct Entry
  {
    vtkSmartPointer<vtkFloatArray> copy;
    vtkMTimeType time = 0;
  };
  KeptValues<vtkDataArray*, Entry> Entries;
};
}

#endif
