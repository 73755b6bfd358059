// The octrees that are open in this process, so that none is opened, or built, twice.
#ifndef svoOctreeLibrary_h
#define svoOctreeLibrary_h

#include "svoMeshOctree.h"
#include "svoReuse.h"
#include "vtkType.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <tuple>
#include <utility>

namespace svo
{
/// The name of an octree that is built from a mesh: the inputs that make it differ from others.
struct OctreeKey
{
  std::uint64_t signature; // meshSignature()
  int level;
  LeafGeometry leafGeometry;
  std::array<double, 6> modelBounds; // those that say nothing are all NoBounds

  OctreeKey(std::uint64_t mesh, int depth, LeafGeometry geometry,
    const std::array<double, 6>& model = NoBounds)
    : signature(mesh)
    , level(depth)
    , leafGeometry(geometry)
    , modelBounds(
        model[0] <= model[1] && model[2] <= model[3] && model[4] <= model[5] ? model : NoBounds)
  {
  }
  /// Of a mesh of options.signature.
  explicit OctreeKey(const MeshOctreeOptions& options)
    : OctreeKey(options.signature, options.level, options.leafGeometry, options.modelBounds)
  {
  }

  bool operator<(const OctreeKey& other) const
  {
    return std::tie(this->signature, this->level, this->leafGeometry, this->modelBounds) <
      std::tie(other.signature, other.level, other.leafGeometry, other.modelBounds);
  }
  MeshOctreeOptions options() const
  {
    return { this->level, this->leafGeometry, this->modelBounds, 0, this->signature,
      smpParallelFor(), {} };
  }
  ReuseHistory::Id id() const;
};

/// Finds octrees by their names. Keeps none alive. May be called from any thread.
template <class Name>
class OpenOctrees
{
public:
  /// The octree, and the message of its build; empty if it is not open.
  Octree find(const Name& name, std::string& message);
  void add(const Name& name, const Octree& octree, const std::string& message);

private:
  std::mutex Mutex;
  std::map<Name, std::pair<WeakOctree, std::string>> Octrees; // and messages
  std::size_t Most = 64;                                      // at which closed ones are taken out
};

struct OctreeLibrary
{
  /// By address and modification time of the field-data array whose bytes they have.
  ///
  /// An octree owns its bytes: the array that it was opened from, or that it was attached as, has a
  /// copy of them, since any code may write to the array. So an array is known by its modification
  /// time. VTK's times grow over the whole process: an array that is made where another one was
  /// freed never shows the same pair of address and time.
  OpenOctrees<std::pair<const void*, vtkMTimeType>> ofArrays;

  OpenOctrees<OctreeKey> built;

  static OctreeLibrary& instance();
};
}

#endif
