// A store of octrees and a mesh, for the tests of the store.
#ifndef svoOctreeStoreCase_h
#define svoOctreeStoreCase_h

#include "svoMeshOctree.h"
#include "svoOctreeBytes.h"
#include "svoOctreeStore.h"

#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <future>
#include <list>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace svotest
{
/// The bytes that a build at this level gives when nothing else is going on.
inline std::vector<std::byte> builtAlone(vtkPolyData* mesh, int level)
{
  svo::MeshOctreeOptions options;
  options.level = level;
  svo::Octree octree;
  std::string message;
  svo::buildMeshOctree(mesh, options, octree, message);
  return bytesOf(octree);
}

/// Background builds that begin when the test says so, on threads of their own.
class Gate
{
public:
  svo::BackgroundBuild::Launcher launcher()
  {
    return [this](std::function<void()> run)
    {
      this->Started.emplace_back();
      std::promise<void>& finished = this->Started.back();
      return std::thread(
        [run = std::move(run), open = this->Opened, &finished]
        {
          open.wait();
          run();
          finished.set_value();
        });
    };
  }

  /// Lets the builds that were started go on, and waits for the end of each.
  void letThrough()
  {
    this->Open.set_value();
    for (std::promise<void>& finished : this->Started)
    {
      finished.get_future().wait();
    }
    this->Open = std::promise<void>();
    this->Opened = this->Open.get_future().share();
    this->Started.clear();
  }

  int started() const { return static_cast<int>(this->Started.size()); }

private:
  std::promise<void> Open;
  std::shared_future<void> Opened = Open.get_future().share();
  std::list<std::promise<void>> Started; // and not let through yet
};

inline vtkSmartPointer<vtkPolyData> sphereMesh(double radius, int resolution = 24)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->Update();
  return source->GetOutput();
}

struct OctreeStore : ::testing::Test
{
  Gate gate;
  svo::OctreeStore store{ gate.launcher() };
  svo::StoreOptions options;
  std::vector<std::string> said;
  vtkSmartPointer<vtkPolyData> mesh = sphereMesh(1.0);
  svo::Octree octree;

  OctreeStore()
  {
    options.complain = [this](const std::string& text) { this->said.push_back(text); };
  }

  /// Whether there is an octree.
  bool find(int level, bool wait)
  {
    options.wait = wait;
    octree = svo::Octree();
    octree = store.find(mesh, level, options);
    return static_cast<bool>(octree);
  }

  void endFrame() { store.endFrame(std::size_t(1) << 30); }
};
}

#endif
