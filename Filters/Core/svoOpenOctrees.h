// The octrees that are open in this process, so that none is opened, or built, twice.
#ifndef svoOpenOctrees_h
#define svoOpenOctrees_h

#include "svoOctree.h"

#include <cstddef>
#include <map>
#include <mutex>
#include <utility>

class vtkUnsignedCharArray;

namespace svo
{
/// Keeps none of them alive. Any thread may ask.
///
/// An octree owns its bytes: the field-data array that it was opened from, or that it was attached
/// as, has a copy of them, since anybody may write to that. So an array is known by its
/// modification time. VTK's times grow over the whole process: an array that is made where another
/// one was freed never shows the same pair of address and time.
class OpenOctrees
{
public:
  static OpenOctrees& instance();

  /// The octree whose bytes the array has, as far as it says; empty if it is not open.
  Octree find(vtkUnsignedCharArray* array);
  void add(vtkUnsignedCharArray* array, const Octree& octree);

private:
  using Key = std::pair<const void*, unsigned long long>; // array, modification time
  OpenOctrees() = default;

  std::mutex Mutex;
  std::map<Key, WeakOctree> OfArrays;
  std::size_t Tidy = 64; // entries at which closed octrees are taken out
};
}

#endif
