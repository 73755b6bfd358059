// What is known of the meshes that a pass meets, until they are modified.
#ifndef svoKnownMeshes_h
#define svoKnownMeshes_h

#include "svoBox.h"
#include "svoOctree.h"
#include "svoOctreeLibrary.h"

#include "vtkPolyData.h"
#include "vtkWeakPointer.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>

namespace svo
{
struct KnownMesh
{
  vtkWeakPointer<vtkPolyData> mesh;
  std::uint64_t time = 0; // MTime
  Octree attached;        // empty: it brings none, and the following are set
  std::uint64_t signature = 0;
  Box box;                    // of its finite points
  std::size_t triangles = 0;  // triangleBound()
  int detailLevel = 0;        // 0: not computed yet
  std::set<std::string> said; // of the mesh, whatever its poses
  std::set<OctreeKey> keys;   // of octrees that were asked for, whatever it looked like
};

class KnownMeshes
{
public:
  /// Looked up anew where the mesh was modified. What is wrong with the octree that it brings is
  /// said once.
  KnownMesh& of(vtkPolyData* mesh, const std::function<void(const std::string&)>& complain);

  /// Forgets meshes that are gone. Returns true if, since the last call, a mesh has gone, or
  /// another one has taken its address, so that its octrees may be nobody's.
  bool forgetGone();

  /// The octrees that were asked for by meshes that are there.
  std::set<OctreeKey> keys() const;
  /// Forgets the keys of which `unused(key)` is true.
  void forgetKeys(const std::function<bool(const OctreeKey&)>& unused);

  void clear() { this->Meshes.clear(); }

private:
  std::map<vtkPolyData*, KnownMesh> Meshes;
  bool Lost = false;
};
}

#endif
