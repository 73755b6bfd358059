// Casters that other processes hold, where the surfaces of a picture are spread over several.
#ifndef svoSharedCasters_h
#define svoSharedCasters_h

#include "svoSceneCollector.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>

class vtkMultiProcessController;

namespace svo
{
/// Every process gets the others' casters as instances that it does not show. So each traces the
/// same shadow buffers (or exact shadow rays) as one process with all of the data would, for its
/// own visible points. A mesh and its octree are sent once, when they first cast; afterwards a
/// frame costs a matrix per caster.
class SharedCasters
{
public:
  /// Adds the others' casters to the scene. A collective call: all processes of the controller make
  /// it in the same frames. Octrees that no process used in this frame are let go, least recently
  /// used first, until the others fit into `memoryLimit` bytes.
  void exchange(
    vtkMultiProcessController* controller, std::size_t memoryLimit, CollectedScene& collected);

private:
  using Key = std::tuple<std::uint64_t, int, int>; // signature of the mesh, level, leaf geometry
  struct Known
  {
    Octree octree;
    std::size_t bytes = 0; // as sent, with the mesh: the same number on all processes
    std::uint64_t lastFrame = 0;
  };
  struct Record;

  void receive(vtkMultiProcessController* controller, int owner, const Record& record,
    const CollectedScene& collected);
  void forget(std::size_t memoryLimit);

  std::map<Key, Known> Meshes; // the same keys on all processes
  std::uint64_t Frame = 0;
};
}

#endif
