#include "svoOctreeCache.h"

#include <algorithm>
#include <utility>

namespace svo
{
const OctreeCache::Entry* OctreeCache::find(const Key& key)
{
  // Tens of poses, hundreds at most: a walk costs nothing beside the hash that made the key.
  const auto found = std::find_if(this->Entries.begin(), this->Entries.end(),
    [&key](const Entry& entry) { return entry.key == key; });
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
  while (this->Bytes > limit)
  {
    this->Bytes -= this->Entries.back().octree.bytes();
    this->Entries.pop_back();
  }
}
}
