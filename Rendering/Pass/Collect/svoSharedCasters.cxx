#include "svoSharedCasters.h"

#include "svoControllerProcesses.h"
#include "svoMeshOctree.h"

#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

namespace svo
{
/// A caster, as the processes tell each other.
struct SharedCasters::Record
{
  std::uint64_t signature;
  int level;
  int leafGeometry;
  std::uint64_t id;
  std::uint64_t version; // Instance::version, of the process that it comes from
  glm::dmat4 localToWorld;
  int instance;  // index on the process that it comes from
  float opacity; // Instance::opacity

  Key key() const { return { this->signature, this->level, this->leafGeometry }; }
};

void SharedCasters::receive(vtkMultiProcessController* controller, int owner, const Record& record,
  const CollectedScene& collected)
{
  Known& known = this->Meshes[record.key()];
  vtkNew<vtkPolyData> mesh;
  if (controller->GetLocalProcessId() == owner)
  {
    vtkPolyData* own = collected.meshes[record.instance];
    mesh->SetPoints(own->GetPoints());
    mesh->SetVerts(own->GetVerts());
    mesh->SetLines(own->GetLines());
    mesh->SetPolys(own->GetPolys());
    mesh->SetStrips(own->GetStrips());
    attachOctree(mesh, collected.scene.instances[record.instance].body->octree);
  }
  vtkTypeInt64 bytes =
    static_cast<vtkTypeInt64>(mesh->GetActualMemorySize()) * 1024; // GetActualMemorySize: KiB
  controller->Broadcast(&bytes, 1, owner);
  known.bytes = static_cast<std::size_t>(bytes);
  controller->Broadcast(mesh.GetPointer(), owner);
  if (controller->GetLocalProcessId() == owner)
  {
    known.octree = collected.scene.instances[record.instance].body->octree;
    return;
  }
  std::string ignored; // an octree that does not open casts nothing here
  openAttachedOctree(mesh, known.octree, ignored);
}

void SharedCasters::exchange(
  vtkMultiProcessController* controller, std::size_t memoryLimit, CollectedScene& collected)
{
  ++this->Frame;
  const int self = controller->GetLocalProcessId();
  std::vector<Record> own;
  for (std::size_t i = 0; i < collected.scene.instances.size(); ++i)
  {
    const Instance& instance = collected.scene.instances[i];
    if (!instance.castShadow)
    {
      continue;
    }
    const Octree& octree = instance.body->octree;
    own.push_back({ octree.header().signature, octree.level(),
      static_cast<int>(octree.header().leafGeometry), instance.id, instance.version,
      instance.localToWorld, static_cast<int>(i), instance.opacity });
  }

  std::vector<Record> all;
  ControllerProcesses processes(controller);
  const std::vector<std::size_t> begins = gatherRecords(processes, own, all);
  if (all.empty())
  {
    return;
  }
  for (int owner = 0; owner < processes.count(); ++owner)
  {
    for (std::size_t k = begins[owner]; k < begins[owner + 1]; ++k)
    {
      const Record& record = all[k];
      if (this->Meshes.count(record.key()) == 0)
      {
        this->receive(controller, owner, record, collected);
      }
      Known& known = this->Meshes[record.key()];
      known.lastFrame = this->Frame;
      if (owner == self || !known.octree)
      {
        continue;
      }
      Instance instance;
      Body& body = instance.body.own();
      body.octree = known.octree;
      body.leafGeometry = static_cast<LeafGeometry>(record.leafGeometry);
      instance.localToWorld = record.localToWorld;
      instance.visible = false;
      instance.receiveShadow = false;
      instance.opacity = record.opacity;
      instance.version = record.version | std::uint64_t(owner + 1) << 48; // like no other's
      instance.id = record.id ^ (0x9e3779b97f4a7c15ull * (owner + 1));
      collected.scene.instances.push_back(instance);
      collected.scene.version = 0;
    }
  }
  this->forget(memoryLimit);
}

void SharedCasters::forget(std::size_t memoryLimit)
{
  std::size_t used = 0;
  for (const auto& entry : this->Meshes)
  {
    used += entry.second.bytes;
  }
  while (used > memoryLimit)
  {
    auto oldest = this->Meshes.end();
    for (auto entry = this->Meshes.begin(); entry != this->Meshes.end(); ++entry)
    {
      if (entry->second.lastFrame != this->Frame &&
        (oldest == this->Meshes.end() || entry->second.lastFrame < oldest->second.lastFrame))
      {
        oldest = entry;
      }
    }
    if (oldest == this->Meshes.end())
    {
      return;
    }
    used -= oldest->second.bytes;
    this->Meshes.erase(oldest);
  }
}
}
