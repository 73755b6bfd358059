#include "svoOctreeLibrary.h"

#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cstring>
#include <iterator>

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

template <typename Name>
Octree OctreeLibrary::find(const Index<Name>& index, const Name& name, std::string& message)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const auto found = index.octrees.find(name);
  if (found == index.octrees.end())
  {
    return {};
  }
  message = found->second.second;
  return found->second.first.lock();
}

template <typename Name>
void OctreeLibrary::add(
  Index<Name>& index, const Name& name, const Octree& octree, const std::string& message)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  auto& octrees = index.octrees;
  if (octrees.size() >= index.most)
  {
    for (auto i = octrees.begin(); i != octrees.end();)
    {
      i = i->second.first.expired() ? octrees.erase(i) : std::next(i);
    }
    index.most = std::max<std::size_t>(2 * octrees.size(), 64);
  }
  octrees[name] = { WeakOctree(octree), message };
}

Octree OctreeLibrary::find(vtkUnsignedCharArray* array)
{
  std::string none;
  return this->find(this->OfArrays, { array, array->GetMTime() }, none);
}

void OctreeLibrary::add(vtkUnsignedCharArray* array, const Octree& octree)
{
  this->add(this->OfArrays, { array, array->GetMTime() }, octree, {});
}

Octree OctreeLibrary::find(const OctreeKey& key, std::string& message)
{
  return this->find(this->Built, key, message);
}

void OctreeLibrary::add(const OctreeKey& key, const Octree& octree, const std::string& message)
{
  this->add(this->Built, key, octree, message);
}
}
