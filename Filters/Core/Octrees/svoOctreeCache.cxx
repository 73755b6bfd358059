#include "svoOctreeCache.h"

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

namespace svo
{
namespace
{
ReuseHistory::Id idOf(const OctreeCache::Key& key)
{
  ReuseHistory::Id id = key.signature ^ (static_cast<std::uint64_t>(key.level) << 8) ^
    static_cast<std::uint64_t>(key.leafGeometry);
  for (const double bound : key.modelBounds)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &bound, sizeof(bits));
    id = (id ^ bits) * 0x9e3779b97f4a7c15ull;
  }
  return id;
}
}

const OctreeCache::Entry* OctreeCache::find(const Key& key)
{
  // Tens of poses, hundreds at most: a walk costs nothing beside the hash that made the key.
  const auto found = std::find_if(this->Entries.begin(), this->Entries.end(),
    [&key](const Entry& entry) { return entry.key == key; });
  const ReuseHistory::Id id = idOf(key);
  if (id != this->Last) // else it was in use all the time
  {
    this->History.comes(id, found != this->Entries.end());
    this->Last = id;
  }
  if (found == this->Entries.end())
  {
    return nullptr;
  }
  this->Entries.splice(this->Entries.begin(), this->Entries, found);
  return &this->Entries.front();
}

const OctreeCache::Entry* OctreeCache::latest(
  std::uint64_t signature, const std::array<double, 6>& modelBounds) const
{
  const auto found = std::find_if(this->Entries.begin(), this->Entries.end(),
    [&](const Entry& entry)
    { return entry.key.signature == signature && entry.key.modelBounds == modelBounds; });
  return found == this->Entries.end() ? nullptr : &*found;
}

void OctreeCache::insert(Entry entry, std::size_t limit)
{
  const std::size_t bytes = entry.octree.bytes();
  if (bytes > limit)
  {
    return;
  }
  this->shrink(limit - bytes);
  this->Entries.push_front(std::move(entry));
  this->Bytes += bytes;
}

void OctreeCache::shrink(std::size_t limit)
{
  if (this->Bytes <= limit)
  {
    return;
  }
  std::vector<ReuseHistory::Id> going;
  for (const Entry& entry : this->Entries)
  {
    going.push_back(idOf(entry.key));
  }
  this->History.sortForGoing(going);
  for (auto id = going.begin(); this->Bytes > limit && id != going.end(); ++id)
  {
    const auto entry = std::find_if(this->Entries.begin(), this->Entries.end(),
      [id](const Entry& candidate) { return idOf(candidate.key) == *id; });
    this->Bytes -= entry->octree.bytes();
    this->Entries.erase(entry);
  }
}
}
