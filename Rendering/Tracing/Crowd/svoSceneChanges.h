// Which instances of a scene have changed: found once a scene, and told to all who keep
// anything of them.
#ifndef svoSceneChanges_h
#define svoSceneChanges_h

#include "svoScene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
struct SceneChanges
{
  /// By index, ascending: those that anything is new of, and those that have come.
  std::vector<std::uint32_t> instances;
  std::size_t before = 0, count = 0; // how many there were, and are

  bool none() const { return this->instances.empty() && this->before == this->count; }
};

/// Finds them by the versions that whoever writes instances gives them: no matter which scenes
/// somebody has not seen, he is told of all that is new since he was asked last.
class SceneFollower
{
public:
  /// Since the last call; of the first one all.
  SceneChanges follow(const Scene& scene)
  {
    SceneChanges changes;
    changes.before = this->Versions.size();
    changes.count = scene.instances.size();
    if (scene.version != 0 && scene.version == this->OfScene)
    {
      return changes;
    }
    this->OfScene = scene.version;
    this->Versions.resize(changes.count); // 0: as of one that is not known
    for (std::size_t i = 0; i < changes.count; ++i)
    {
      const std::uint64_t version = scene.instances[i].version;
      if (version == 0 || version != this->Versions[i])
      {
        changes.instances.push_back(static_cast<std::uint32_t>(i));
      }
      this->Versions[i] = version;
    }
    return changes;
  }

private:
  std::uint64_t OfScene = 0;
  std::vector<std::uint64_t> Versions; // by index
};
}

#endif
