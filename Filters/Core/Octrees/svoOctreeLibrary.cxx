#include "svoOctreeLibrary.h"

#include "svoEraseIf.h"

#include <algorithm>
#include <cstring>

namespace svo
{
ReuseHistory::Id OctreeKey::id() const
{
  ReuseHistory::Id id = this->signature ^ (static_cast<std::uint64_t>(this->level) << 8) ^
    static_cast<std::uint64_t>(this->leafGeometry);
  for (const double bound : this->modelBounds)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &bound, sizeof(bits));
    id = (id ^ bits) * 0x9e3779b97f4a7c15ull;
  }
  return id;
}

OctreeLibrary& OctreeLibrary::instance()
{
  static auto* const instance = new OctreeLibrary; // octrees may outlive static objects
  return *instance;
}

template <class Name>
Octree OpenOctrees<Name>::find(const Name& name, std::string& message)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto found = this->Octrees.find(name);
  if (found == this->Octrees.end())
  {
    return {};
  }
  message = found->second.second;
  return found->second.first.lock();
}

template <class Name>
void OpenOctrees<Name>::add(const Name& name, const Octree& octree, const std::string& message)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  if (this->Octrees.size() >= this->Most)
  {
    eraseIf(this->Octrees, [](const auto& entry) { return entry.second.first.expired(); });
    this->Most = std::max<std::size_t>(2 * this->Octrees.size(), 64);
  }
  this->Octrees[name] = { WeakOctree(octree), message };
}

template class OpenOctrees<std::pair<const void*, vtkMTimeType>>;
template class OpenOctrees<OctreeKey>;
}
