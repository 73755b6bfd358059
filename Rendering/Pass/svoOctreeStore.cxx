#include "svoOctreeStore.h"

#include "svoMeshOctree.h"

#include "vtkCellArray.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <iterator>
#include <vector>

namespace svo
{
namespace
{
MeshOctreeOptions buildOptions(const StoreOptions& options)
{
  MeshOctreeOptions result;
  result.level = options.level;
  result.leafGeometry = options.leafGeometry;
  return result;
}

/// Points and cells of its own, so that the original may change while a thread reads the copy.
vtkSmartPointer<vtkPolyData> privateCopy(vtkPolyData* mesh)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  auto points = vtkSmartPointer<vtkPoints>::New();
  if (mesh->GetPoints())
  {
    points->DeepCopy(mesh->GetPoints());
  }
  copy->SetPoints(points);
  const auto cells = [](vtkCellArray* source)
  {
    auto result = vtkSmartPointer<vtkCellArray>::New();
    result->DeepCopy(source);
    return result;
  };
  copy->SetVerts(cells(mesh->GetVerts()));
  copy->SetLines(cells(mesh->GetLines()));
  copy->SetPolys(cells(mesh->GetPolys()));
  copy->SetStrips(cells(mesh->GetStrips()));
  return copy;
}
}

OctreeStore::Job::~Job()
{
  this->abandon = true;
  if (this->thread.joinable())
  {
    this->thread.join();
  }
}

OctreeStore::~OctreeStore() = default;

OctreeStore::Known& OctreeStore::knownOf(vtkPolyData* mesh, const StoreOptions& options)
{
  Known& known = this->Meshes[mesh];
  const std::uint64_t time = mesh->GetMTime();
  if (known.mesh != mesh || known.time != time)
  {
    known = Known();
    known.mesh = mesh;
    known.time = time;
    std::string message;
    if (openAttachedOctree(mesh, known.attached, message) == Attached::Damaged)
    {
      options.complain(message);
    }
    if (!known.attached)
    {
      known.signature = meshSignature(mesh);
    }
  }
  return known;
}

OctreeStore::Answer OctreeStore::find(
  vtkPolyData* mesh, const StoreOptions& options, Octree& octree)
{
  const Known& known = this->knownOf(mesh, options);
  if (known.attached)
  {
    octree = known.attached;
    return Answer::Found;
  }
  const Key key(known.signature, options.level, options.leafGeometry);
  const auto job = this->Jobs.find(key);
  if (job != this->Jobs.end() && (job->second->done || options.wait))
  {
    this->keepResult(key, *job->second);
    this->Jobs.erase(job);
  }
  const auto found = this->Octrees.find(key);
  if (found != this->Octrees.end())
  {
    Built& built = found->second;
    built.lastFrame = this->Frame;
    if (!built.message.empty())
    {
      options.complain(built.message);
      built.message.clear();
    }
    octree = built.octree;
    return octree ? Answer::Found : Answer::None;
  }
  return options.convert ? this->build(mesh, key, options, octree) : Answer::None;
}

OctreeStore::Answer OctreeStore::build(
  vtkPolyData* mesh, const Key& key, const StoreOptions& options, Octree& octree)
{
  if (!options.wait)
  {
    std::unique_ptr<Job>& job = this->Jobs[key];
    if (!job)
    {
      job = std::make_unique<Job>();
      MeshOctreeOptions build = buildOptions(options);
      build.progress = [running = job.get()](double) { return !running->abandon.load(); };
      job->thread = std::thread(
        [running = job.get(), copy = privateCopy(mesh), build]()
        {
          buildMeshOctree(copy, build, running->octree, running->message);
          running->done = true;
        });
    }
    return Answer::Building;
  }
  MeshOctreeOptions build = buildOptions(options);
  build.progress = [&options](double amount)
  {
    if (options.progress)
    {
      options.progress(amount);
    }
    return true;
  };
  std::string message;
  buildMeshOctree(mesh, build, octree, message);
  if (!message.empty())
  {
    options.complain(message);
  }
  this->Octrees[key] = { octree, this->Frame, std::string() };
  return octree ? Answer::Found : Answer::None;
}

void OctreeStore::keepResult(const Key& key, Job& job)
{
  job.thread.join();
  this->Octrees[key] = { job.octree, this->Frame, job.message };
}

void OctreeStore::endFrame(std::size_t memoryLimit)
{
  for (auto mesh = this->Meshes.begin(); mesh != this->Meshes.end();)
  {
    mesh = mesh->second.mesh ? std::next(mesh) : this->Meshes.erase(mesh);
  }
  // Those whose mesh nobody asks for any more would otherwise stay for ever.
  for (auto job = this->Jobs.begin(); job != this->Jobs.end();)
  {
    if (!job->second->done)
    {
      ++job;
      continue;
    }
    this->keepResult(job->first, *job->second);
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

bool OctreeStore::building() const
{
  return !this->Jobs.empty();
}
}
