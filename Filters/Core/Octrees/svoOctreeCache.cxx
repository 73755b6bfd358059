#include "svoOctreeCache.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace svo
{
const OctreeCache::Entry* OctreeCache::find(const OctreeKey& key)
{
  // Tens of poses, hundreds at most: a walk costs nothing beside the hash that made the key.
  const auto found = std::find_if(this->Entries.begin(), this->Entries.end(),
    [&key](const Entry& entry) { return !(entry.key < key) && !(key < entry.key); });
  const ReuseHistory::Id id = key.id();
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

const OctreeCache::Entry* OctreeCache::latest(const OctreeKey& key) const
{
  const auto found = std::find_if(this->Entries.begin(), this->Entries.end(),
    [&](const Entry& entry)
    { return entry.key.signature == key.signature && entry.key.modelBounds == key.modelBounds; });
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
    going.push_back(entry.key.id());
  }
  this->History.sortForGoing(going);
  for (auto id = going.begin(); this->Bytes > limit && id != going.end(); ++id)
  {
    const auto entry = std::find_if(this->Entries.begin(), this->Entries.end(),
      [id](const Entry& candidate) { return candidate.key.id() == *id; });
    this->Bytes -= entry->octree.bytes();
    this->Entries.erase(entry);
  }
}
}
