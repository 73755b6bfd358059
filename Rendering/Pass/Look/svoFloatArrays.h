// Arrays of any type as floats, converted once.
#ifndef svoFloatArrays_h
#define svoFloatArrays_h

#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkSmartPointer.h"

#include <iterator>
#include <map>

namespace svo
{
/// Copies of arrays that are not floats, kept for as long as every frame asks for them.
class FloatArrays
{
public:
  /// The array's values in its own order; valid until the second endFrame() after this call, or
  /// until the array changes.
  const float* values(vtkDataArray* array)
  {
    if (auto* floats = vtkFloatArray::SafeDownCast(array))
    {
      return floats->GetPointer(0);
    }
    Entry& entry = this->Entries[array];
    entry.asked = true;
    // Times are never given twice, so a new array in an old one's place is noticed, too.
    if (!entry.copy || entry.time != array->GetMTime())
    {
      entry.time = array->GetMTime();
      entry.copy = vtkSmartPointer<vtkFloatArray>::New();
      entry.copy->DeepCopy(array);
    }
    return entry.copy->GetPointer(0);
  }

  /// Drops entries that were not asked for since the last call.
  void endFrame()
  {
    for (auto entry = this->Entries.begin(); entry != this->Entries.end();)
    {
      const bool asked = entry->second.asked;
      entry->second.asked = false;
      entry = asked ? std::next(entry) : this->Entries.erase(entry);
    }
  }

  std::size_t size() const { return this->Entries.size(); }

private:
  struct Entry
  {
    vtkSmartPointer<vtkFloatArray> copy;
    vtkMTimeType time = 0;
    bool asked = false;
  };
  std::map<vtkDataArray*, Entry> Entries;
};
}

#endif
