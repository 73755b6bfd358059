#include "svoOwnedOctrees.h"

#include <utility>
#include <vector>

namespace svo
{
void OwnedOctrees::asked(const OctreeKey& key, bool another)
{
  if (another && this->Orphaned.erase(key) > 0)
  {
    this->Recurring.insert(key);
  }
  if (this->Asked.insert(key).second && this->AskedLast.count(key) == 0)
  {
    this->History.comes(key.id(), this->has(key));
  }
}

OwnedOctree* OwnedOctrees::find(const OctreeKey& key)
{
  const auto found = this->Octrees.find(key);
  if (found == this->Octrees.end())
  {
    return nullptr;
  }
  found->second.lastUse = this->Use;
  return &found->second;
}

OwnedOctree* OwnedOctrees::substitute(const OctreeKey& key)
{
  OwnedOctree* best = nullptr;
  for (auto i = this->Octrees.lower_bound({ key.signature, 0, LeafGeometry::Voxel });
       i != this->Octrees.end() && i->first.signature == key.signature; ++i)
  {
    // By level, coarse ones first.
    if (i->first.leafGeometry == key.leafGeometry && i->first.modelBounds == key.modelBounds &&
      i->second.octree)
    {
      best = &i->second;
      if (best->octree.level() > key.level)
      {
        break;
      }
    }
  }
  if (best)
  {
    best->lastUse = this->Use;
  }
  return best;
}

const OwnedOctree* OwnedOctrees::latest(const OctreeKey& key) const
{
  const OwnedOctree* best = nullptr;
  for (const auto& [other, octree] : this->Octrees)
  {
    if (other.signature == key.signature && other.modelBounds == key.modelBounds &&
      (!best || best->lastUse < octree.lastUse))
    {
      best = &octree;
    }
  }
  return best;
}

void OwnedOctrees::keep(const OctreeKey& key, const Octree& octree, const std::string& message)
{
  ++this->Version;
  const auto same = this->Octrees.find(key); // built in between, by a frame that an observer drew
  if (same != this->Octrees.end())
  {
    this->erase(same);
  }
  this->Bytes += octree.bytes();
  this->Octrees[key] = { octree, message, this->Use };
}

bool OwnedOctrees::takeOver(const OctreeKey& key)
{
  if (this->has(key))
  {
    return true;
  }
  std::string message;
  const Octree octree = OctreeLibrary::instance().built.find(key, message);
  if (octree)
  {
    this->keep(key, octree, message);
  }
  return static_cast<bool>(octree);
}

void OwnedOctrees::keepWithin(const OctreeKey& key, const Octree& octree, std::size_t limit)
{
  if (octree && octree.bytes() <= limit)
  {
    this->shrink(limit - octree.bytes(), false);
    this->keep(key, octree, {});
  }
}

OwnedOctrees::Iterator OwnedOctrees::erase(Iterator octree)
{
  ++this->Version;
  this->Bytes -= octree->second.octree.bytes();
  return this->Octrees.erase(octree);
}

void OwnedOctrees::freeOrphans(const std::set<OctreeKey>& owned)
{
  constexpr std::size_t Most = 1 << 16; // to remember
  if (this->Orphaned.size() + this->Recurring.size() > Most)
  {
    this->Orphaned.clear();
    this->Recurring.clear();
  }
  for (auto octree = this->Octrees.begin(); octree != this->Octrees.end();)
  {
    if (owned.count(octree->first) > 0 || this->Recurring.count(octree->first) > 0)
    {
      ++octree;
      continue;
    }
    this->Orphaned.insert(octree->first);
    octree = this->erase(octree);
  }
}

void OwnedOctrees::shrink(std::size_t limit, bool spare)
{
  if (this->Bytes <= limit)
  {
    return;
  }
  std::map<ReuseHistory::Id, OctreeKey> idle;
  std::vector<ReuseHistory::Id> going;
  for (const auto& [key, octree] : this->Octrees)
  {
    if (!(spare && octree.lastUse == this->Use) && idle.emplace(key.id(), key).second)
    {
      going.push_back(key.id());
    }
  }
  this->History.sortForGoing(going);
  for (auto id = going.begin(); this->Bytes > limit && id != going.end(); ++id)
  {
    this->erase(this->Octrees.find(idle.at(*id)));
  }
}

void OwnedOctrees::nextUse()
{
  ++this->Use;
  this->AskedLast = std::move(this->Asked);
  this->Asked.clear();
}

void OwnedOctrees::clear()
{
  ++this->Version;
  this->Octrees.clear();
  this->Bytes = 0;
  this->Orphaned.clear();
  this->Recurring.clear();
}
}
