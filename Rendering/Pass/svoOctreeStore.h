// The octrees of the meshes that a pass meets: those that travel on a mesh, and those built here.
#ifndef svoOctreeStore_h
#define svoOctreeStore_h

#include "svoOctree.h"

#include "vtkWeakPointer.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <tuple>

class vtkPolyData;

namespace svo
{
struct StoreOptions
{
  bool convert = true; // build where a mesh brings no octree
  int level = 10;      // of octrees built here
  LeafGeometry leafGeometry = LeafGeometry::Automatic;
  bool wait = true;                                 // false: build in the background
  std::function<void(double)> progress;             // 0..1 of the build that is waited for
  std::function<void(const std::string&)> complain; // once per mesh and message
};

/// Octrees are kept by the signature of their mesh: an animated mesh that returns to a pose finds
/// that pose's octree, and a mesh shared by many actors has one.
class OctreeStore
{
public:
  enum class Answer
  {
    Found,
    Building, // in the background; ask again in the next frame
    None      // not wanted, or not possible (said once)
  };

  ~OctreeStore();

  Answer find(vtkPolyData* mesh, const StoreOptions& options, Octree& octree);

  /// Between frames: frees octrees of meshes that are gone and, least recently used first, those
  /// that the last frame did not use until the rest fits into `memoryLimit` bytes.
  void endFrame(std::size_t memoryLimit);

  /// Bytes of the octrees that were built here.
  std::size_t bytes() const;

  /// True while a background build runs.
  bool building() const;

private:
  using Key = std::tuple<std::uint64_t, int, LeafGeometry>; // signature, level, leaf geometry
  struct Built
  {
    Octree octree; // empty if the build failed
    std::uint64_t lastFrame = 0;
    std::string message; // not said yet
  };
  /// A build on a thread of its own, on a private copy of the mesh.
  struct Job
  {
    std::thread thread;
    std::atomic<bool> done{ false };
    std::atomic<bool> abandon{ false };
    Octree octree;
    std::string message;
    ~Job();
  };
  /// What is known of a mesh until it is modified.
  struct Known
  {
    vtkWeakPointer<vtkPolyData> mesh;
    std::uint64_t time = 0; // MTime
    Octree attached;        // empty: it brings none
    std::uint64_t signature = 0;
  };

  Known& knownOf(vtkPolyData* mesh, const StoreOptions& options);
  Answer build(vtkPolyData* mesh, const Key& key, const StoreOptions& options, Octree& octree);
  void keepResult(const Key& key, Job& job);

  std::map<vtkPolyData*, Known> Meshes;
  std::map<Key, Built> Octrees;
  std::map<Key, std::unique_ptr<Job>> Jobs;
  std::uint64_t Frame = 1;
};
}

#endif
