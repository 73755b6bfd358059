// An octree in the making, on a thread of its own.
#ifndef svoBackgroundBuild_h
#define svoBackgroundBuild_h

#include "svoMeshOctree.h"
#include "svoOctree.h"

#include "vtkSmartPointer.h"

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>

class vtkPolyData;

namespace svo
{
/// A mesh's points and cells, in memory of their own.
vtkSmartPointer<vtkPolyData> privateCopy(vtkPolyData* mesh);

/// It reads a copy of the mesh's points and cells: the mesh may change or go meanwhile.
class BackgroundBuild
{
public:
  /// Gives the thread that runs the function it is given.
  using Launcher = std::function<std::thread(std::function<void()>)>;

  /// Builds at a time. Each may use as large a share of the memory that there is.
  static constexpr int MostAtATime = 4;

  /// As buildMeshOctree() has them.
  struct Result
  {
    BuildStatus status = BuildStatus::Aborted;
    Octree octree;
    std::string message;
  };

  /// Null if there is not enough memory for the copy, or no thread to be had. Without a launcher it
  /// is std::thread's constructor. options.progress and options.parallelFor have no part in it.
  static std::unique_ptr<BackgroundBuild> start(
    vtkPolyData* mesh, const MeshOctreeOptions& options, const Launcher& launch = {});

  /// Abandons it and waits for its end.
  ~BackgroundBuild();
  BackgroundBuild(const BackgroundBuild&) = delete;
  BackgroundBuild& operator=(const BackgroundBuild&) = delete;

  /// The result is there, and the thread is about to end.
  bool done() const { return this->Done; }

  /// 0..1.
  double progress() const { return this->Progress; }

  /// Abandons the result: the build ends at its next report of progress.
  void abandon() { this->Abandoned = true; }
  bool abandoned() const { return this->Abandoned; }

  /// Waits for the end.
  const Result& result();

private:
  BackgroundBuild() = default;
  void run(vtkPolyData* mesh, MeshOctreeOptions options);

  std::atomic<bool> Done{ false };
  std::atomic<bool> Abandoned{ false };
  std::atomic<double> Progress{ 0.0 };
  Result Made;
  std::thread Thread;
};
}

#endif
