#include "svoKeptOctrees.h"

#include <utility>
#include <vector>

namespace svo
{
void KeptOctrees::asked(const OctreeKey& key, bool another)
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

KeptOctree* KeptOctrees::find(const OctreeKey& key)
{
  const auto found = this->Octrees.find(key);
  return found != this->Octrees.end() ? &found->second : nullptr;
}

KeptOctree* KeptOctrees::substitute(const OctreeKey& key)
{
  KeptOctree* best = nullptr;
  for (auto i = this->Octrees.lower_bound({ key.signature, 0, LeafGeometry::Voxel });
       i != this->Octrees.end() && i->first.signature == key.signature; ++i)
  {
    // By level, coarse ones first.
    if (i->first.leafGeometry == key.leafGeometry && i->second.octree)
    {
      best = &i->second;
      if (best->octree.level() > key.level)
      {
        break;
      }
    }
  }
  return best;
}

void KeptOctrees::keep(const OctreeKey& key, KeptOctree octree)
{
  ++this->Version;
  const auto same = this->Octrees.find(key); // built in between, by a frame that an observer drew
  if (same != this->Octrees.end())
  {
    this->erase(same);
  }
  this->Bytes += octree.octree ? octree.octree.bytes() : 0;
  this->Octrees[key] = std::move(octree);
}

KeptOctrees::Iterator KeptOctrees::erase(Iterator octree)
{
  ++this->Version;
  this->Bytes -= octree->second.octree ? octree->second.octree.bytes() : 0;
  return this->Octrees.erase(octree);
}

void KeptOctrees::freeOrphans(const std::set<OctreeKey>& owned)
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

void KeptOctrees::shrink(std::size_t memoryLimit, std::uint64_t frame)
{
  std::map<ReuseHistory::Id, OctreeKey> idle;
  std::vector<ReuseHistory::Id> going;
  for (const auto& [key, octree] : this->Octrees)
  {
    if (octree.lastFrame != frame && idle.emplace(key.id(), key).second)
    {
      going.push_back(key.id());
    }
  }
  this->History.sortForGoing(going);
  for (auto id = going.begin(); this->Bytes > memoryLimit && id != going.end(); ++id)
  {
    this->erase(this->Octrees.find(idle.at(*id)));
  }
}

void KeptOctrees::endFrame()
{
  this->AskedLast = std::move(this->Asked);
  this->Asked.clear();
}

void KeptOctrees::clear()
{
  ++this->Version;
  this->Octrees.clear();
  this->Bytes = 0;
  this->Orphaned.clear();
  this->Recurring.clear();
}
}
