#include "svoOpenOctrees.h"

#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace svo
{
namespace
{
template <typename Map>
void takeOutClosed(Map& map)
{
  for (auto i = map.begin(); i != map.end();)
  {
    i = i->second.expired() ? map.erase(i) : std::next(i);
  }
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
  if (this->OfArrays.size() >= this->Tidy)
  {
    takeOutClosed(this->OfArrays);
    this->Tidy = std::max<std::size_t>(2 * this->OfArrays.size(), 64);
  }
  this->OfArrays[{ array, array->GetMTime() }] = WeakOctree(octree);
}
}
