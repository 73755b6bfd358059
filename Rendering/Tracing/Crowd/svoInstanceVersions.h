// Which instances of a scene are not what they were when it was looked at last.
#ifndef svoInstanceVersions_h
#define svoInstanceVersions_h

#include "svoScene.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace svo
{
class InstanceVersions
{
public:
  /// By index, ascending: those with another version than at the last call, and those that have
  /// come.
  std::vector<std::uint32_t> update(const Scene& scene)
  {
    std::vector<std::uint32_t> changed;
    if (scene.version != 0 && scene.version == this->OfScene)
    {
      return changed;
    }
    this->OfScene = scene.version;
    this->Versions.resize(scene.instances.size()); // 0: as of one that is not known
    for (std::size_t i = 0; i < this->Versions.size(); ++i)
    {
      const std::uint64_t version = scene.instances[i].version;
      if (version == 0 || version != this->Versions[i])
      {
        changed.push_back(static_cast<std::uint32_t>(i));
      }
      this->Versions[i] = version;
    }
    return changed;
  }
  /// Instances at the last call.
  std::size_t size() const { return this->Versions.size(); }

private:
  std::uint64_t OfScene = 0;
  std::vector<std::uint64_t> Versions; // by index
};
}

#endif
