// The octrees of the meshes that a pass meets: those that travel on a mesh, and those built here.
#ifndef svoOctreeStore_h
#define svoOctreeStore_h

#include "svoBackgroundBuild.h"
#include "svoOctree.h"
#include "svoScene.h"

#include "vtkWeakPointer.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>

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
  std::function<void(const std::string&)> complain; // once per mesh and what is wrong
};

/// Octrees are kept by the signature of their mesh: an animated mesh that returns to a pose finds
/// that pose's octree, and a mesh shared by many actors has one. A mesh may have octrees of several
/// levels: which one a frame needs is its own affair (svoNeededLevels.h).
///
/// All functions are called by one thread. A progress function may call them, too, change meshes
/// and let them go. Background builds have private copies of their meshes,
/// and what they build is put in place by find() and endFrame() alone: a mesh may change or go
/// while its octree is built, and the store may go.
class OctreeStore
{
public:
  enum class Answer
  {
    Found,
    Building, // in the background; ask again in the next frame
    None      // not wanted, or not possible (said once)
  };

  /// The launcher is that of background builds.
  explicit OctreeStore(BackgroundBuild::Launcher launcher = {});
  ~OctreeStore();

  /// True if the mesh brings an octree; it is all there will be for that mesh.
  bool attached(vtkPolyData* mesh, const StoreOptions& options, Octree& octree);

  /// Says what is known of a mesh that brings no octree: the box of its finite points, its number
  /// of triangles and, where they will be exact, its level of detail.
  void measure(vtkPolyData* mesh, const StoreOptions& options, Instance& instance);

  /// The octree of exactly this level, or the one that the mesh brings. With options.wait it is
  /// built where there is none. Else it is built in the background, and meanwhile another one is
  /// found if there is one: the coarsest that is deeper, or the deepest. If that one is deeper
  /// nothing is built.
  Answer find(vtkPolyData* mesh, int level, const StoreOptions& options, Octree& octree);

  /// Between frames: frees octrees of meshes that are gone and, least recently used first, those
  /// that the last frame did not use until the rest fits into `memoryLimit` bytes.
  void endFrame(std::size_t memoryLimit);

  /// Bytes of the octrees that were built here.
  std::size_t bytes() const;

  /// Background builds whose result no frame has had yet.
  int building() const;

  /// Octrees built here so far, kept or not.
  int built() const { return this->BuiltSoFar; }

private:
  using Key = std::tuple<std::uint64_t, int, LeafGeometry>; // signature, level, leaf geometry
  struct Built
  {
    Octree octree; // empty if the build failed
    std::uint64_t lastFrame = 0;
    std::string message; // not said yet
  };
  struct Job
  {
    std::unique_ptr<BackgroundBuild> build;
    vtkWeakPointer<vtkPolyData> mesh;
    std::uint64_t lastFrame; // that asked for it
  };
  /// What is known of a mesh until it is modified.
  struct Known
  {
    vtkWeakPointer<vtkPolyData> mesh;
    std::uint64_t time = 0; // MTime
    Octree attached;        // empty: it brings none
    std::uint64_t signature = 0;
    MeshBox box;
    std::size_t triangles = 0;
    int detailLevel = 0; // 0: nobody asked
    std::set<std::string> said; // of the mesh, whatever its poses
  };

  Known& knownOf(vtkPolyData* mesh, const StoreOptions& options);
  void build(vtkPolyData* mesh, const Key& key, const StoreOptions& options);
  void buildInBackground(vtkPolyData* mesh, const Key& key);
  void waitFor(const Key& key, const StoreOptions& options);
  void keepResult(const Key& key, BackgroundBuild& build);
  Built* substitute(const Key& key);
  Answer answer(vtkPolyData* mesh, Built& built, const StoreOptions& options, Octree& octree);

  BackgroundBuild::Launcher Launch;
  int BuiltSoFar = 0;
  std::map<vtkPolyData*, Known> Meshes;
  std::map<Key, Built> Octrees;
  std::map<Key, Job> Jobs;
  std::set<Key> TooLarge; // for the share of memory that a background build may use
  std::uint64_t Frame = 1;
};
}

#endif
