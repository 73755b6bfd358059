// The octrees that are open in this process, so that none is opened, or built, twice.
#ifndef svoOpenOctrees_h
#define svoOpenOctrees_h

#include "svoOctree.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <tuple>
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

  /// What makes one octree of a mesh differ from another: the mesh's signature, the level, the leaf
  /// geometry and the bounds of what the mesh is a part of.
  using Recipe = std::tuple<std::uint64_t, int, LeafGeometry, std::array<double, 6>>;

  /// The octree that was built like that, and what was said of it.
  Octree find(const Recipe& recipe, std::string& message);
  void add(const Recipe& recipe, const Octree& octree, const std::string& message);

private:
  using Key = std::pair<const void*, unsigned long long>; // array, modification time
  OpenOctrees() = default;

  std::mutex Mutex;
  std::map<Key, WeakOctree> OfArrays;
  std::map<Recipe, std::pair<WeakOctree, std::string>> Built;
  // Entries at which closed octrees are taken out.
  std::size_t TidyArrays = 64;
  std::size_t TidyBuilt = 64;
};
}

#endif
