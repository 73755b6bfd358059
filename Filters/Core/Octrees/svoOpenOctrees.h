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
/// Keeps no octree alive. May be called from any thread.
///
/// An octree owns its bytes: the field-data array that it was opened from, or that it was attached
/// as, has a copy of them, since any code may write to the array. So an array is known by its
/// modification time. VTK's times grow over the whole process: an array that is made where another
/// one was freed never shows the same pair of address and time.
class OpenOctrees
{
public:
  static OpenOctrees& instance();

  /// The octree whose bytes the array has, by address and modification time; empty if it is not
  /// open.
  Octree find(vtkUnsignedCharArray* array);
  void add(vtkUnsignedCharArray* array, const Octree& octree);

  /// The inputs that make one octree of a mesh differ from another: the mesh's signature, the
  /// level, the leaf geometry and the bounds of the whole that the mesh is a part of.
  using Recipe = std::tuple<std::uint64_t, int, LeafGeometry, std::array<double, 6>>;

  /// The octree that was built by the recipe, and the message of its build.
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
