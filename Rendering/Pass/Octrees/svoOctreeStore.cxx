#include "svoOctreeStore.h"

#include "svoLeafTraits.h"
#include "svoMeshDetail.h"
#include "svoMeshOctree.h"
#include "svoSideBySide.h"

#include "vtkCellArray.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <new>
#include <thread>
#include <vector>

#include <glm/common.hpp>

namespace svo
{
namespace
{
Box finiteBox(vtkPolyData* mesh)
{
  Box box;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    glm::dvec3 p;
    mesh->GetPoint(i, &p.x);
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z))
    {
      box.add(p);
    }
  }
  return box;
}

/// A build that has not been asked for in so many frames is nobody's.
constexpr std::uint64_t FramesOfOthers = 8;

template <typename Key>
MeshOctreeOptions optionsOf(const Key& key)
{
  MeshOctreeOptions options;
  options.signature = std::get<0>(key);
  options.level = std::get<1>(key);
  options.leafGeometry = std::get<2>(key);
  return options;
}

template <typename Key>
ReuseHistory::Id idOf(const Key& key)
{
  return std::get<0>(key) ^
    (static_cast<std::uint64_t>(std::get<1>(key)) * 4 +
      static_cast<std::uint64_t>(std::get<2>(key))) *
    0x9e3779b97f4a7c15ull;
}

/// A polygon or strip of n points makes n - 2.
std::size_t trianglesOf(vtkPolyData* mesh)
{
  vtkIdType sum = 0;
  for (vtkCellArray* cells : { mesh->GetPolys(), mesh->GetStrips() })
  {
    sum +=
      std::max<vtkIdType>(cells->GetNumberOfConnectivityIds() - 2 * cells->GetNumberOfCells(), 0);
  }
  return static_cast<std::size_t>(sum);
}
}

OctreeStore::OctreeStore(BackgroundBuild::Launcher launcher)
  : Launch(std::move(launcher))
{
}

OctreeStore::~OctreeStore()
{
  this->release();
}

OctreeStore::Known& OctreeStore::knownOf(vtkPolyData* mesh, const StoreOptions& options)
{
  Known& known = this->Meshes[mesh];
  const std::uint64_t time = mesh->GetMTime();
  if (known.mesh != mesh || known.time != time)
  {
    const Octree former = known.attached; // found again, not opened again, if it is still the one
    Known fresh;
    if (known.mesh == mesh)
    {
      fresh.said = std::move(known.said);
      fresh.keys.swap(known.keys);
    }
    this->Orphans = this->Orphans || !known.keys.empty(); // of a mesh that was at this address
    known = std::move(fresh);
    known.mesh = mesh;
    known.time = time;
    std::string message;
    const Attached state = openAttachedOctree(mesh, known.attached, message);
    const std::string complaint = describe(state, message);
    if (state != Attached::None && !complaint.empty() && known.said.insert(complaint).second)
    {
      options.complain(complaint);
    }
    if (!known.attached)
    {
      known.signature = meshSignature(mesh);
      known.box = finiteBox(mesh);
      known.triangles = trianglesOf(mesh);
    }
  }
  return known;
}

bool OctreeStore::attached(vtkPolyData* mesh, const StoreOptions& options, Octree& octree)
{
  octree = this->knownOf(mesh, options).attached;
  return static_cast<bool>(octree);
}

void OctreeStore::measure(vtkPolyData* mesh, const StoreOptions& options, Instance& instance)
{
  Known& known = this->knownOf(mesh, options);
  const bool exact = traitsOf(options.leafGeometry).exact();
  if (exact && options.convert && known.detailLevel == 0)
  {
    known.detailLevel = detailLevel(mesh);
  }
  instance.box = known.box;
  instance.triangles = known.triangles;
  instance.detailLevel = exact ? known.detailLevel : 0;
}

/// Notes that the frame asks for an octree.
OctreeStore::Key OctreeStore::asked(Known& known, int level, const StoreOptions& options)
{
  const Key key(known.signature, level, options.leafGeometry);
  if (known.keys.insert(key).second && this->Orphaned.erase(key) > 0)
  {
    this->Recurring.insert(key);
  }
  if (this->Asked.insert(key).second && this->AskedLast.count(key) == 0)
  {
    this->History.comes(idOf(key), this->Octrees.count(key) > 0);
  }
  return key;
}

void OctreeStore::prepare(const Wanted& wanted, const StoreOptions& options)
{
  constexpr std::size_t MostAtOnce = 64; // between two reports of the progress
  std::map<Key, vtkWeakPointer<vtkPolyData>> missing;
  for (const auto& [mesh, level] : wanted)
  {
    Known& known = this->knownOf(mesh, options);
    if (!options.convert || !options.wait || known.attached || known.triangles > SmallMesh)
    {
      continue;
    }
    const Key key = this->asked(known, level, options);
    if (this->Octrees.count(key) == 0 && this->Jobs.count(key) == 0)
    {
      this->takeOver(key);
    }
    if (this->Octrees.count(key) == 0 && this->Jobs.count(key) == 0)
    {
      missing.emplace(key, mesh);
    }
  }
  std::vector<SideBySide> builds;
  double done = 0.0;
  for (auto next = missing.begin(); missing.size() > 1 && next != missing.end();)
  {
    if (options.aborted && options.aborted())
    {
      return;
    }
    builds.clear();
    for (; next != missing.end() && builds.size() < MostAtOnce; ++next, done += 1.0)
    {
      // Who was told of the progress may have changed meshes, or let them go.
      vtkPolyData* mesh = next->second;
      if (mesh && this->knownOf(mesh, options).signature == std::get<0>(next->first))
      {
        builds.push_back({ mesh, optionsOf(next->first) });
      }
    }
    buildSideBySide(builds);
    for (SideBySide& build : builds)
    {
      const MeshOctreeOptions& o = build.options;
      this->BuiltSoFar += build.octree ? 1 : 0;
      this->keep(
        Key(o.signature, o.level, o.leafGeometry), { build.octree, 0, std::move(build.message) });
    }
    if (options.progress)
    {
      options.progress(done / static_cast<double>(missing.size()));
    }
  }
}

OctreeStore::Answer OctreeStore::find(
  vtkPolyData* mesh, int level, const StoreOptions& options, Octree& octree)
{
  if (this->attached(mesh, options, octree))
  {
    return Answer::Found;
  }
  if (!options.convert)
  {
    return Answer::None;
  }
  Known& known = this->knownOf(mesh, options);
  const Key key = this->asked(known, level, options);
  const auto job = this->Jobs.find(key);
  if (job != this->Jobs.end() && (job->second.build->done() || options.wait))
  {
    this->waitFor(key, options);
  }
  if (this->Octrees.count(key) == 0)
  {
    this->takeOver(key);
  }
  if (options.wait && this->Octrees.count(key) == 0 && this->Jobs.count(key) == 0)
  {
    this->build(mesh, key, options);
  }
  const auto found = this->Octrees.find(key);
  if (found != this->Octrees.end())
  {
    return this->answer(mesh, found->second, options, octree);
  }
  Built* other = this->substitute(key);
  if (!options.wait && (!other || other->octree.level() < level))
  {
    this->buildInBackground(mesh, key);
  }
  return other ? this->answer(mesh, *other, options, octree) : Answer::Building;
}

OctreeStore::Answer OctreeStore::answer(
  vtkPolyData* mesh, Built& built, const StoreOptions& options, Octree& octree)
{
  built.lastFrame = this->Frame;
  if (!built.message.empty())
  {
    // The same of each level is said once; that an octree lacks triangles, once for all poses, each
    // of which has another number of them.
    if (this->knownOf(mesh, options)
          .said.insert(built.octree ? "incomplete" : built.message)
          .second)
    {
      options.complain(built.message);
    }
    built.message.clear();
  }
  octree = built.octree;
  return octree ? Answer::Found : Answer::None;
}

/// The octree to go on with while the right one is built; null if there is none.
OctreeStore::Built* OctreeStore::substitute(const Key& key)
{
  const auto [signature, level, leafGeometry] = key;
  Built* best = nullptr;
  for (auto i = this->Octrees.lower_bound(Key(signature, 0, LeafGeometry::Voxel));
       i != this->Octrees.end() && std::get<0>(i->first) == signature; ++i)
  {
    // By level, coarse ones first.
    if (std::get<2>(i->first) == leafGeometry && i->second.octree)
    {
      best = &i->second;
      if (best->octree.level() > level)
      {
        break;
      }
    }
  }
  return best;
}

void OctreeStore::build(vtkPolyData* mesh, const Key& key, const StoreOptions& options)
{
  if (options.aborted && options.aborted())
  {
    return;
  }
  MeshOctreeOptions build = optionsOf(key);
  vtkSmartPointer<vtkPolyData> source = mesh;
  if (options.progress || options.aborted)
  {
    try
    {
      // Who is told of the progress may change the mesh, or ask for other octrees.
      source = privateCopy(mesh);
      build.progress = [&options](double amount)
      {
        if (options.progress)
        {
          options.progress(amount);
        }
        return !options.aborted || !options.aborted();
      };
    }
    catch (const std::bad_alloc&)
    {
    }
  }
  Built built;
  if (buildMeshOctree(source, build, built.octree, built.message) != BuildStatus::Aborted)
  {
    this->BuiltSoFar += built.octree ? 1 : 0;
    this->keep(key, std::move(built));
  }
}

void OctreeStore::keep(const Key& key, Built built)
{
  const auto same = this->Octrees.find(key); // built in between, by a frame that an observer drew
  if (same != this->Octrees.end())
  {
    this->erase(same);
  }
  this->Bytes += built.octree ? built.octree.bytes() : 0;
  built.lastFrame = this->Frame;
  this->Octrees[key] = std::move(built);
}

/// An octree that another pass or a filter has built.
void OctreeStore::takeOver(const Key& key)
{
  Built built;
  built.octree = findBuiltOctree(optionsOf(key), built.message);
  if (built.octree)
  {
    this->keep(key, std::move(built));
  }
}

void OctreeStore::buildInBackground(vtkPolyData* mesh, const Key& key)
{
  const auto running = this->Jobs.find(key);
  if (running != this->Jobs.end())
  {
    running->second.lastFrame = this->Frame;
    return;
  }
  const auto atWork = std::count_if(this->Jobs.begin(), this->Jobs.end(),
    [](const auto& job) { return !job.second.build->done(); });
  if (atWork >= BackgroundBuild::MostAtATime || this->TooLarge.count(key) > 0)
  {
    return;
  }
  if (auto begun = BackgroundBuild::start(mesh, optionsOf(key), this->Launch))
  {
    this->Jobs[key] = { std::move(begun), mesh, this->Frame };
  }
}

void OctreeStore::waitFor(const Key& key, const StoreOptions& options)
{
  auto job = this->Jobs.find(key);
  while (
    (options.progress || options.aborted) && job != this->Jobs.end() && !job->second.build->done())
  {
    if (options.aborted && options.aborted())
    {
      return; // it goes on in the background
    }
    if (options.progress)
    {
      options.progress(job->second.build->progress());
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    job = this->Jobs.find(key); // who was told may have waited for it, too
  }
  if (job != this->Jobs.end())
  {
    this->keepResult(key, *job->second.build);
    this->Jobs.erase(job);
  }
}

void OctreeStore::keepResult(const Key& key, BackgroundBuild& build)
{
  const BackgroundBuild::Result& result = build.result();
  if (result.status == BuildStatus::TooLarge)
  {
    this->TooLarge.insert(key); // a frame that waits has all memory for it
  }
  else if (!build.abandoned())
  {
    this->keep(key, { result.octree, this->Frame, result.message });
    this->BuiltSoFar += result.octree ? 1 : 0;
  }
}

std::map<OctreeStore::Key, OctreeStore::Built>::iterator OctreeStore::erase(
  std::map<Key, Built>::iterator octree)
{
  this->Bytes -= octree->second.octree ? octree->second.octree.bytes() : 0;
  return this->Octrees.erase(octree);
}

/// Frees octrees whose meshes are all gone. Where another mesh came later that looked the same, as
/// with a reader that makes new ones for each time step, more are expected.
void OctreeStore::freeOrphans()
{
  constexpr std::size_t Most = 1 << 16; // to remember
  if (this->Orphaned.size() + this->Recurring.size() > Most)
  {
    this->Orphaned.clear();
    this->Recurring.clear();
  }
  std::set<Key> owned;
  for (const auto& mesh : this->Meshes)
  {
    owned.insert(mesh.second.keys.begin(), mesh.second.keys.end());
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

std::size_t OctreeStore::endFrame(std::size_t memoryLimit)
{
  for (auto mesh = this->Meshes.begin(); mesh != this->Meshes.end();)
  {
    const bool gone = !mesh->second.mesh;
    this->Orphans = this->Orphans || gone;
    mesh = gone ? this->Meshes.erase(mesh) : std::next(mesh);
  }
  // What a frame asks for stays until a frame has it: so long there is more to be seen. (Other
  // renderers have frames in between.) What nobody asks for any more is kept for later, as a mesh
  // may come back to a pose; but nobody waits for those of a mesh that is gone.
  for (auto job = this->Jobs.begin(); job != this->Jobs.end();)
  {
    const bool asked = this->Frame - job->second.lastFrame < FramesOfOthers;
    if (!asked && !job->second.mesh)
    {
      job->second.build->abandon();
    }
    if (asked || !job->second.build->done())
    {
      ++job;
      continue;
    }
    this->keepResult(job->first, *job->second.build);
    job = this->Jobs.erase(job);
  }
  if (this->Orphans)
  {
    this->freeOrphans();
    this->Orphans = false;
  }
  if (this->Bytes > memoryLimit)
  {
    std::map<ReuseHistory::Id, Key> idle;
    std::vector<ReuseHistory::Id> going;
    for (const auto& entry : this->Octrees)
    {
      if (entry.second.lastFrame != this->Frame &&
        idle.emplace(idOf(entry.first), entry.first).second)
      {
        going.push_back(idOf(entry.first));
      }
    }
    this->History.sortForGoing(going);
    for (auto id = going.begin(); this->Bytes > memoryLimit && id != going.end(); ++id)
    {
      this->erase(this->Octrees.find(idle.at(*id)));
    }
    for (auto& mesh : this->Meshes)
    {
      std::set<Key>& keys = mesh.second.keys;
      for (auto key = keys.begin(); key != keys.end();)
      {
        const bool used = this->Octrees.count(*key) > 0 || this->Jobs.count(*key) > 0;
        key = used ? std::next(key) : keys.erase(key);
      }
    }
  }
  this->AskedLast = std::move(this->Asked);
  this->Asked.clear();
  ++this->Frame;
  return this->Bytes > memoryLimit ? this->Bytes - memoryLimit : 0;
}

void OctreeStore::release()
{
  for (auto& job : this->Jobs)
  {
    job.second.build->abandon(); // all of them before the first is waited for
  }
  this->Jobs.clear();
  this->Meshes.clear();
  this->Octrees.clear();
  this->Bytes = 0;
  this->TooLarge.clear();
  this->Orphaned.clear();
  this->Recurring.clear();
}

int OctreeStore::building() const
{
  return static_cast<int>(std::count_if(this->Jobs.begin(), this->Jobs.end(),
    [](const auto& job) { return !job.second.build->abandoned(); }));
}
}
