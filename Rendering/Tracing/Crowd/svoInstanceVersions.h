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
  /// come. looksSame() is of the same calls.
  std::vector<std::uint32_t> update(const Scene& scene)
  {
    std::vector<std::uint32_t> changed;
    this->Same = true;
    if (scene.version != 0 && scene.version == this->OfScene)
    {
      return changed;
    }
    this->OfScene = scene.version;
    this->Same = scene.instances.size() == this->Versions.size();
    this->Versions.resize(scene.instances.size()); // 0: as of one that is not known
    this->Appearances.resize(scene.instances.size());
    for (std::size_t i = 0; i < this->Versions.size(); ++i)
    {
      const std::uint64_t version = scene.instances[i].version;
      if (version == 0 || version != this->Versions[i])
      {
        changed.push_back(static_cast<std::uint32_t>(i));
      }
      const std::uint64_t appearance = scene.instances[i].appearance;
      this->Same = this->Same && appearance != 0 && appearance == this->Appearances[i];
      this->Versions[i] = version;
      this->Appearances[i] = appearance;
    }
    return changed;
  }
  /// All have the appearance that they had.
  bool looksSame() const { return this->Same; }
  /// Instances at the last call.
  std::size_t size() const { return this->Versions.size(); }

private:
  std::uint64_t OfScene = 0;
  std::vector<std::uint64_t> Versions, Appearances; // by index
  bool Same = false;
};
}

#endif
