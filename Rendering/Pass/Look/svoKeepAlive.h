// What a collected prop keeps for as long as it is kept itself: the arrays that its surfaces point
// into, and what was computed for them.
#ifndef svoKeepAlive_h
#define svoKeepAlive_h

#include "svoEraseIf.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkDataArray.h"
#include "vtkObject.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <map>
#include <memory>
#include <vector>

namespace svo
{
/// 0 where there is no object.
inline vtkMTimeType timeOf(vtkObject* object)
{
  return object ? object->GetMTime() : 0;
}

class KeepAlive
{
public:
  /// An array whose values are pointed at, unless they are of a type that nobody points at.
  void add(vtkDataArray* array)
  {
    this->Arrays.push_back({ array, valuesOf(array), array->GetNumberOfTuples() });
  }

  /// What a cache keeps for as long as somebody has it.
  void add(std::shared_ptr<const void> computed) { this->Computed.push_back(std::move(computed)); }

  /// Something that is not noticed when it changes.
  void addUnknown() { this->Unknown = true; }

  /// False if an array lies elsewhere than when it was added, which its time may not tell, or
  /// something unknown was added.
  bool inPlace() const
  {
    return !this->Unknown &&
      std::all_of(this->Arrays.begin(), this->Arrays.end(),
        [](const Borrowed& one)
        {
          return !one.values ||
            (one.array->GetVoidPointer(0) == one.values &&
              one.array->GetNumberOfTuples() == one.tuples);
        });
  }

private:
  struct Borrowed
  {
    vtkSmartPointer<vtkDataArray> array;
    const void* values;
    vtkIdType tuples;
  };

  /// Null for arrays of other types, which may have to make what is asked for.
  static const void* valuesOf(vtkDataArray* array)
  {
    const bool plain = vtkAOSDataArrayTemplate<float>::FastDownCast(array) ||
      vtkAOSDataArrayTemplate<double>::FastDownCast(array) ||
      vtkAOSDataArrayTemplate<unsigned char>::FastDownCast(array);
    return plain && array->GetNumberOfTuples() > 0 ? array->GetVoidPointer(0) : nullptr;
  }

  bool Unknown = false;
  std::vector<Borrowed> Arrays;
  std::vector<std::shared_ptr<const void>> Computed;
};

/// Values by key, for as long as somebody keeps them. A stamp has the times of what a value is made
/// of, which are never given twice: another object in an old one's place is noticed, too.
template <class Key, class Value, class Stamp = vtkMTimeType>
class CachedValues
{
public:
  /// The key's value, which `kept` keeps from now on. make(value) fills it in if it is new or was
  /// made at another stamp.
  template <class Make>
  Value& of(const Key& key, const Stamp& stamp, KeepAlive& kept, const Make& make)
  {
    std::shared_ptr<Entry>& entry = this->Entries[key];
    if (!entry)
    {
      entry = std::make_shared<Entry>();
    }
    kept.add(entry);
    if (entry->stamp != stamp)
    {
      make(entry->value); // anew where it has thrown
      entry->stamp = stamp;
    }
    return entry->value;
  }

  /// Drops what nobody keeps.
  void sweep()
  {
    eraseIf(this->Entries, [](const auto& entry) { return entry.second.use_count() == 1; });
  }

  std::size_t size() const { return this->Entries.size(); }

private:
  struct Entry
  {
    Stamp stamp{}; // that of no time
    Value value{};
  };
  std::map<Key, std::shared_ptr<Entry>> Entries;
};
}

#endif
