#include "svoKnownMeshes.h"

#include "svoEraseIf.h"
#include "svoMeshOctree.h"
#include "svoMeshTriangles.h"

#include <cmath>
#include <utility>

#include <glm/vec3.hpp>

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
}

KnownMesh& KnownMeshes::of(
  vtkPolyData* mesh, const std::function<void(const std::string&)>& complain)
{
  KnownMesh& known = this->Meshes[mesh];
  const std::uint64_t time = mesh->GetMTime();
  if (known.mesh != mesh || known.time != time)
  {
    const Octree former = known.attached; // found again, not opened again, if it is still the one
    KnownMesh fresh;
    if (known.mesh == mesh)
    {
      fresh.said = std::move(known.said);
      fresh.keys.swap(known.keys);
    }
    this->Lost = this->Lost || !known.keys.empty(); // of a mesh that was at this address
    known = std::move(fresh);
    known.mesh = mesh;
    known.time = time;
    std::string message;
    const Attached state = openAttachedOctree(mesh, known.attached, message);
    const std::string complaint = describe(state, message);
    if (state != Attached::None && !complaint.empty() && known.said.insert(complaint).second)
    {
      complain(complaint);
    }
    if (!known.attached)
    {
      known.signature = meshSignature(mesh);
      known.box = finiteBox(mesh);
      known.triangles = triangleBound(mesh);
    }
  }
  return known;
}

bool KnownMeshes::forgetGone()
{
  const bool lost = std::exchange(this->Lost, false);
  const std::size_t before = this->Meshes.size();
  eraseIf(this->Meshes, [](const auto& mesh) { return !mesh.second.mesh; });
  return lost || this->Meshes.size() < before;
}

std::set<OctreeKey> KnownMeshes::keys() const
{
  std::set<OctreeKey> all;
  for (const auto& mesh : this->Meshes)
  {
    all.insert(mesh.second.keys.begin(), mesh.second.keys.end());
  }
  return all;
}

void KnownMeshes::forgetKeys(const std::function<bool(const OctreeKey&)>& unused)
{
  for (auto& mesh : this->Meshes)
  {
    eraseIf(mesh.second.keys, unused);
  }
}
}
