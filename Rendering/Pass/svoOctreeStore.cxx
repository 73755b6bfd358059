#include "svoOctreeStore.h"

#include "svoMeshDetail.h"
#include "svoMeshOctree.h"

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
MeshBox finiteBox(vtkPolyData* mesh)
{
  MeshBox box;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    glm::dvec3 p;
    mesh->GetPoint(i, &p.x);
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z))
    {
      box.low = box.known() ? glm::min(box.low, p) : p;
      box.high = box.known() ? glm::max(box.high, p) : p;
    }
  }
  return box;
}

/// A build that has not been asked for in so many frames is nobody's.
constexpr std::uint64_t FramesOfOthers = 8;

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
  for (auto& job : this->Jobs)
  {
    job.second.build->abandon(); // all of them before the first is waited for
  }
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
    }
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
  const bool exact = options.leafGeometry == LeafGeometry::Triangle ||
    options.leafGeometry == LeafGeometry::Automatic;
  if (exact && options.convert && known.detailLevel == 0)
  {
    known.detailLevel = detailLevel(mesh);
  }
  instance.box = known.box;
  instance.triangles = known.triangles;
  instance.detailLevel = exact ? known.detailLevel : 0;
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
  const Key key(this->knownOf(mesh, options).signature, level, options.leafGeometry);
  const auto job = this->Jobs.find(key);
  if (job != this->Jobs.end() && (job->second.build->done() || options.wait))
  {
    this->waitFor(key, options);
  }
  if (options.wait && this->Octrees.count(key) == 0)
  {
    this->build(mesh, key, options);
  }
  const auto found = this->Octrees.find(key);
  if (found != this->Octrees.end())
  {
    return this->answer(mesh, found->second, options, octree);
  }
  Built* other = this->substitute(key);
  if (!other || other->octree.level() < level)
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
  MeshOctreeOptions build;
  build.level = std::get<1>(key);
  build.leafGeometry = std::get<2>(key);
  build.signature = std::get<0>(key);
  vtkSmartPointer<vtkPolyData> source = mesh;
  if (options.progress)
  {
    try
    {
      // Who is told of the progress may change the mesh, or ask for other octrees.
      source = privateCopy(mesh);
      build.progress = [&options](double amount)
      {
        options.progress(amount);
        return true;
      };
    }
    catch (const std::bad_alloc&)
    {
    }
  }
  Built built;
  buildMeshOctree(source, build, built.octree, built.message);
  this->BuiltSoFar += built.octree ? 1 : 0;
  this->Octrees[key] = std::move(built);
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
  MeshOctreeOptions build;
  build.level = std::get<1>(key);
  build.leafGeometry = std::get<2>(key);
  build.signature = std::get<0>(key);
  if (auto begun = BackgroundBuild::begin(mesh, build, this->Launch))
  {
    this->Jobs[key] = { std::move(begun), mesh, this->Frame };
  }
}

void OctreeStore::waitFor(const Key& key, const StoreOptions& options)
{
  auto job = this->Jobs.find(key);
  while (options.progress && job != this->Jobs.end() && !job->second.build->done())
  {
    options.progress(job->second.build->progress());
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
    this->Octrees[key] = { result.octree, this->Frame, result.message };
    this->BuiltSoFar += result.octree ? 1 : 0;
  }
}

void OctreeStore::endFrame(std::size_t memoryLimit)
{
  for (auto mesh = this->Meshes.begin(); mesh != this->Meshes.end();)
  {
    mesh = mesh->second.mesh ? std::next(mesh) : this->Meshes.erase(mesh);
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
  std::size_t used = this->bytes();
  std::vector<std::pair<std::uint64_t, Key>> idle;
  for (const auto& entry : this->Octrees)
  {
    if (entry.second.lastFrame != this->Frame)
    {
      idle.emplace_back(entry.second.lastFrame, entry.first);
    }
  }
  std::sort(idle.begin(), idle.end());
  for (const auto& entry : idle)
  {
    if (used <= memoryLimit)
    {
      break;
    }
    const auto victim = this->Octrees.find(entry.second);
    used -= victim->second.octree ? victim->second.octree.bytes() : 0;
    this->Octrees.erase(victim);
  }
  ++this->Frame;
}

std::size_t OctreeStore::bytes() const
{
  std::size_t sum = 0;
  for (const auto& entry : this->Octrees)
  {
    sum += entry.second.octree ? entry.second.octree.bytes() : 0;
  }
  return sum;
}

int OctreeStore::building() const
{
  return static_cast<int>(std::count_if(this->Jobs.begin(), this->Jobs.end(),
    [](const auto& job) { return !job.second.build->abandoned(); }));
}
}
