#include "svoOctreeStore.h"

#include "svoLeafTraits.h"
#include "svoMeshDetail.h"
#include "svoMeshOctree.h"
#include "svoSideBySide.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <chrono>
#include <new>
#include <thread>
#include <vector>

namespace svo
{
namespace
{
/// A build that has not been asked for in so many frames is nobody's.
constexpr std::uint64_t FramesOfOthers = 8;
}

OctreeStore::OctreeStore(BackgroundBuild::Launcher launcher)
  : Launch(std::move(launcher))
{
}

OctreeStore::~OctreeStore()
{
  this->release();
}

Octree OctreeStore::attached(vtkPolyData* mesh, const StoreOptions& options)
{
  return this->Meshes.of(mesh, options.complain).attached;
}

void OctreeStore::measure(vtkPolyData* mesh, const StoreOptions& options, Body& body)
{
  KnownMesh& known = this->Meshes.of(mesh, options.complain);
  const bool exact = traitsOf(options.leafGeometry).exact();
  if (exact && options.convert && known.detailLevel == 0)
  {
    known.detailLevel = detailLevel(mesh);
  }
  body.box = known.box;
  body.triangles = known.triangles;
  body.detailLevel = exact ? known.detailLevel : 0;
}

/// Notes that the frame asks for an octree.
OctreeKey OctreeStore::asked(KnownMesh& known, int level, const StoreOptions& options)
{
  const OctreeKey key{ known.signature, level, options.leafGeometry };
  this->Octrees.asked(key, known.keys.insert(key).second);
  return key;
}

void OctreeStore::prepare(const Wanted& wanted, const StoreOptions& options)
{
  constexpr std::size_t MostAtOnce = 64; // between two reports of the progress
  std::map<OctreeKey, vtkWeakPointer<vtkPolyData>> missing;
  for (const auto& [mesh, level] : wanted)
  {
    KnownMesh& known = this->Meshes.of(mesh, options.complain);
    if (!options.convert || !options.wait || known.attached || known.triangles > SmallMesh)
    {
      continue;
    }
    const OctreeKey key = this->asked(known, level, options);
    if (this->Jobs.count(key) == 0 && !this->Octrees.takeOver(key))
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
      if (mesh && this->Meshes.of(mesh, options.complain).signature == next->first.signature)
      {
        builds.push_back({ mesh, next->first.options() });
      }
    }
    buildSideBySide(builds);
    for (SideBySide& build : builds)
    {
      this->BuiltSoFar += build.octree ? 1 : 0;
      this->Octrees.keep(OctreeKey(build.options), build.octree, build.message);
    }
    if (options.progress)
    {
      options.progress(done / static_cast<double>(missing.size()));
    }
  }
}

Octree OctreeStore::find(vtkPolyData* mesh, int level, const StoreOptions& options)
{
  KnownMesh& known = this->Meshes.of(mesh, options.complain);
  if (known.attached || !options.convert)
  {
    return known.attached;
  }
  const OctreeKey key = this->asked(known, level, options);
  const auto job = this->Jobs.find(key);
  if (job != this->Jobs.end() && (job->second.build->done() || options.wait))
  {
    this->waitFor(key, options);
  }
  if (!this->Octrees.takeOver(key) && options.wait && this->Jobs.count(key) == 0)
  {
    this->build(mesh, key, options);
  }
  if (OwnedOctree* found = this->Octrees.find(key))
  {
    return this->answer(mesh, *found, options);
  }
  OwnedOctree* other = this->Octrees.substitute(key);
  if (!options.wait && (!other || other->octree.level() < level))
  {
    this->buildInBackground(mesh, key);
  }
  return other ? this->answer(mesh, *other, options) : Octree();
}

/// Says what there is to be said of an octree that find() has.
Octree OctreeStore::answer(vtkPolyData* mesh, OwnedOctree& built, const StoreOptions& options)
{
  if (!built.message.empty())
  {
    // The same of each level is said once; that an octree lacks triangles, once for all poses, each
    // of which has another number of them.
    if (this->Meshes.of(mesh, options.complain)
          .said.insert(built.octree ? "incomplete" : built.message)
          .second)
    {
      options.complain(built.octree
          ? built.message
          : built.message + " (so a surface stays with VTK's rasteriser and casts no shadow)");
    }
    built.message.clear();
  }
  return built.octree;
}

void OctreeStore::build(vtkPolyData* mesh, const OctreeKey& key, const StoreOptions& options)
{
  if (options.aborted && options.aborted())
  {
    return;
  }
  MeshOctreeOptions build = key.options();
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
  Octree octree;
  std::string message;
  if (buildMeshOctree(source, build, octree, message) != BuildStatus::Aborted)
  {
    this->BuiltSoFar += octree ? 1 : 0;
    this->Octrees.keep(key, octree, message);
  }
}

void OctreeStore::buildInBackground(vtkPolyData* mesh, const OctreeKey& key)
{
  const auto running = this->Jobs.find(key);
  if (running != this->Jobs.end())
  {
    running->second.lastFrame = this->Octrees.use();
    return;
  }
  const auto atWork = std::count_if(this->Jobs.begin(), this->Jobs.end(),
    [](const auto& job) { return !job.second.build->done(); });
  if (atWork >= BackgroundBuild::MostAtATime || this->TooLarge.count(key) > 0)
  {
    return;
  }
  if (auto begun = BackgroundBuild::start(mesh, key.options(), this->Launch))
  {
    this->Jobs[key] = { std::move(begun), mesh, this->Octrees.use() };
  }
}

void OctreeStore::waitFor(const OctreeKey& key, const StoreOptions& options)
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

void OctreeStore::keepResult(const OctreeKey& key, BackgroundBuild& build)
{
  const BackgroundBuild::Result& result = build.result();
  if (result.status == BuildStatus::TooLarge)
  {
    this->TooLarge.insert(key); // a frame that waits has all memory for it
  }
  else if (!build.abandoned())
  {
    this->Octrees.keep(key, result.octree, result.message);
    this->BuiltSoFar += result.octree ? 1 : 0;
  }
}

std::size_t OctreeStore::endFrame(std::size_t memoryLimit)
{
  // What a frame asks for stays until a frame has it: so long there is more to be seen. (Other
  // renderers have frames in between.) What nobody asks for any more is kept for later, as a mesh
  // may come back to a pose; but nobody waits for those of a mesh that is gone.
  for (auto job = this->Jobs.begin(); job != this->Jobs.end();)
  {
    const bool asked = this->Octrees.use() - job->second.lastFrame < FramesOfOthers;
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
  if (this->Meshes.forgetGone())
  {
    this->Octrees.freeOrphans(this->Meshes.keys());
  }
  if (this->bytes() > memoryLimit)
  {
    this->Octrees.shrink(memoryLimit, true);
    this->Meshes.forgetKeys([this](const OctreeKey& key)
      { return !this->Octrees.has(key) && this->Jobs.count(key) == 0; });
  }
  this->Octrees.nextUse();
  return this->bytes() > memoryLimit ? this->bytes() - memoryLimit : 0;
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
  this->TooLarge.clear();
}

int OctreeStore::building() const
{
  return static_cast<int>(std::count_if(this->Jobs.begin(), this->Jobs.end(),
    [](const auto& job) { return !job.second.build->abandoned(); }));
}
}
