// The instances of a scene in a loose octree, followed from frame to frame.
#ifndef svoInstanceTree_h
#define svoInstanceTree_h

#include "svoLooseOctree.h"
#include "svoParallel.h"
#include "svoScene.h"
#include "svoSceneChanges.h"
#include "vtkSVOTracingModule.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace svo
{
/// Around the cubes of the octrees that an instance has, world. With a radius that is negative if
/// it has none, or not finite if it may be anywhere.
VTKSVOTRACING_EXPORT Ball ballOf(const Instance& instance);

/// Instances that have changed are put where they are now; it is made anew where many have left its
/// cube.
class VTKSVOTRACING_EXPORT InstanceTree
{
public:
  /// Where there are fewer instances there is no tree: they are asked one by one.
  static constexpr std::size_t Fewest = 64;

  /// Makes it that of a scene. `changes`: since the last call, of which none may be left out.
  void follow(const Scene& scene, const SceneChanges& changes, const ParallelFor& parallelFor);

  /// Its objects are the indices of the instances that have octrees. Null if there is none.
  const LooseOctree* tree() const { return this->Tree ? &*this->Tree : nullptr; }
  /// How many of the scene's instances are visible and have voxels.
  std::size_t shown() const { return this->Shown; }

private:
  void build(const Scene& scene, const ParallelFor& parallelFor);
  void put(std::uint32_t object, const Ball& ball);

  std::optional<LooseOctree> Tree;
  std::size_t Shown = 0;
  std::size_t OutsidersAtFirst = 0;
};
}

#endif
