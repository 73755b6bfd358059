#include "svoOpenOctrees.h"

#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace svo
{
namespace
{
bool isClosed(const WeakOctree& octree)
{
  return octree.expired();
}

bool isClosed(const std::pair<WeakOctree, std::string>& octree)
{
  return octree.first.expired();
}

/// Takes closed octrees out where there are many entries.
template <typename Map>
void tidy(Map& map, std::size_t& most)
{
  if (map.size() < most)
  {
    return;
  }
  for (auto i = map.begin(); i != map.end();)
  {
    i = isClosed(i->second) ? map.erase(i) : std::next(i);
  }
  most = std::max<std::size_t>(2 * map.size(), 64);
}
}

OpenOctrees& OpenOctrees::instance()
{
  static auto* const instance = new OpenOctrees; // octrees may outlive static objects
  return *instance;
}

Octree OpenOctrees::find(vtkUnsignedCharArray* array)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto found = this->OfArrays.find({ array, array->GetMTime() });
  return found != this->OfArrays.end() ? found->second.lock() : Octree();
}

void OpenOctrees::add(vtkUnsignedCharArray* array, const Octree& octree)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  tidy(this->OfArrays, this->TidyArrays);
  this->OfArrays[{ array, array->GetMTime() }] = WeakOctree(octree);
}

Octree OpenOctrees::find(const Recipe& recipe, std::string& message)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto found = this->Built.find(recipe);
  if (found == this->Built.end())
  {
    return {};
  }
  message = found->second.second;
  return found->second.first.lock();
}

void OpenOctrees::add(const Recipe& recipe, const Octree& octree, const std::string& message)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  tidy(this->Built, this->TidyBuilt);
  this->Built[recipe] = { WeakOctree(octree), message };
}
}
