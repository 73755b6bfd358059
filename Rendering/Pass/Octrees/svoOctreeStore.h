// The octrees of the meshes that a pass meets: those that travel on a mesh, and those built here.
#ifndef svoOctreeStore_h
#define svoOctreeStore_h

#include "svoBackgroundBuild.h"
#include "svoKnownMeshes.h"
#include "svoOctree.h"
#include "svoOctreeLibrary.h"
#include "svoOwnedOctrees.h"
#include "svoScene.h"

#include "vtkWeakPointer.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

class vtkPolyData;

namespace svo
{
struct StoreOptions
{
  bool convert = true; // build where a mesh brings no octree
  int level = 10;      // of the deepest octrees built here
  LeafGeometry leafGeometry = LeafGeometry::Automatic;
  bool wait = true;                                 // false: build in the background
  std::function<void(double)> progress;             // 0..1 of the build that is waited for
  std::function<bool()> aborted;                    // true: waits for no more builds
  std::function<void(const std::string&)> complain; // once per mesh and fault
};

/// Octrees are kept by the signature of their mesh: an animated mesh that returns to a pose finds
/// that pose's octree, and a mesh shared by many actors has one. A mesh may have octrees of several
/// levels: which one a frame needs is its own affair (svoNeededLevels.h). What another store or a
/// filter of this process has is not built again.
///
/// All functions are called by one thread. A progress function may call them, too, change meshes
/// and let them go. Background builds have private copies of their meshes,
/// and what they build is put in place by find() and endFrame() alone: a mesh may change or go
/// while its octree is built, and the store may go.
class OctreeStore
{
public:
  /// The launcher is that of background builds.
  explicit OctreeStore(BackgroundBuild::Launcher launcher = {});
  ~OctreeStore();

  /// The octree that the mesh brings, and all there will be for that mesh; empty if it brings none.
  Octree attached(vtkPolyData* mesh, const StoreOptions& options);

  /// Sets properties of a mesh that brings no octree: the box of its finite points, its number
  /// of triangles and, where they will be exact, its level of detail.
  void measure(vtkPolyData* mesh, const StoreOptions& options, Body& body);

  /// Before find() is asked for octrees that are waited for, each of a mesh and of a level: builds
  /// those of small meshes side by side. Whatever is not there then is built by find().
  using Wanted = std::vector<std::pair<vtkPolyData*, int>>;
  void prepare(const Wanted& wanted, const StoreOptions& options);

  /// The octree of exactly this level, or the one that the mesh brings. With options.wait it is
  /// built where there is none, unless the frame is aborted. Else it is built in the background.
  /// Meanwhile another one is found if there is one: the coarsest that is deeper, or the deepest.
  /// If that one is deeper nothing is built in the background. Empty if there is none, or none yet.
  Octree find(vtkPolyData* mesh, int level, const StoreOptions& options);

  /// Between frames: frees octrees of meshes that are gone, but for those of which other meshes
  /// were seen to come again, and of those that the last frame did not use the ones that will be
  /// used last (svoReuse.h), until the rest fits into `memoryLimit` bytes. Returns by how many
  /// bytes it does not: all of the rest is in use.
  std::size_t endFrame(std::size_t memoryLimit);

  /// Between frames: frees all octrees and properties of meshes, and abandons all builds.
  void release();

  /// Bytes of the octrees that were built here.
  std::size_t bytes() const { return this->Octrees.bytes(); }

  /// Background builds whose result no frame has had yet.
  int building() const;

  /// The same number as long as find() has the same answers for the same meshes, of which none is
  /// being built.
  std::uint64_t version() const { return this->Octrees.version(); }

  /// Octrees built here so far, kept or not.
  int built() const { return this->BuiltSoFar; }

private:
  struct Job
  {
    std::unique_ptr<BackgroundBuild> build;
    vtkWeakPointer<vtkPolyData> mesh;
    std::uint64_t lastFrame; // that asked for it
  };
  OctreeKey asked(KnownMesh& known, int level, const StoreOptions& options);
  void build(vtkPolyData* mesh, const OctreeKey& key, const StoreOptions& options);
  void buildInBackground(vtkPolyData* mesh, const OctreeKey& key);
  void waitFor(const OctreeKey& key, const StoreOptions& options);
  void keepResult(const OctreeKey& key, BackgroundBuild& build);
  Octree answer(vtkPolyData* mesh, OwnedOctree& built, const StoreOptions& options);

  BackgroundBuild::Launcher Launch;
  int BuiltSoFar = 0;
  KnownMeshes Meshes;
  OwnedOctrees Octrees;
  std::map<OctreeKey, Job> Jobs;
  std::set<OctreeKey> TooLarge; // for the share of memory that a background build may use
};
}

#endif
