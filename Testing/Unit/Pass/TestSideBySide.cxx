// Octrees of many small meshes, built together for a frame that waits for them.
#include "svoOctreeStore.h"
#include "svoSideBySide.h"

#include "svoMeshOctree.h"
#include "svoOctreeBytes.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <limits>
#include <mutex>
#include <set>
#include <string>
#include <vector>

using svotest::bytesOf;

namespace
{
vtkSmartPointer<vtkPolyData> ball(double radius, int resolution = 12)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->Update();
  return source->GetOutput();
}

/// Where builds wait for each other, once it is open.
class Meeting
{
public:
  void open(std::size_t guests)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Here.clear();
    this->Guests = guests;
  }
  void enter(const void* guest)
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->Here.insert(guest);
    this->Changed.notify_all();
    if (!this->Changed.wait_for(
          lock, std::chrono::seconds(20), [this] { return this->Here.size() >= this->Guests; }))
    {
      this->Guests = 0; // the others need not wait as long
      this->Missed = true;
    }
  }
  bool missed() const { return this->Missed; }

private:
  std::mutex Mutex;
  std::condition_variable Changed;
  std::set<const void*> Here;
  std::size_t Guests = 0;
  bool Missed = false;
};

/// A mesh that enters a meeting when it is read.
class MeetingMesh : public vtkPolyData
{
public:
  static MeetingMesh* New();
  vtkTypeMacro(MeetingMesh, vtkPolyData);
  vtkPoints* GetPoints() override
  {
    if (this->Where)
    {
      this->Where->enter(this);
    }
    return this->Superclass::GetPoints();
  }
  Meeting* Where = nullptr;
};
vtkStandardNewMacro(MeetingMesh);

struct SideBySide : ::testing::Test
{
  svo::OctreeStore store;
  svo::StoreOptions options;
  std::vector<std::string> said;
  std::vector<vtkSmartPointer<vtkPolyData>> meshes;
  svo::OctreeStore::Wanted wanted;

  SideBySide()
  {
    options.complain = [this](const std::string& text) { this->said.push_back(text); };
  }

  /// `first` sets this test's meshes apart from others': octrees are shared over the process.
  void want(double first, int count, int resolution = 12)
  {
    for (int i = 0; i < count; ++i)
    {
      meshes.push_back(ball(first + 0.001 * i, resolution));
      wanted.emplace_back(meshes.back(), 6);
    }
  }
  svo::Octree find(std::size_t i) { return store.find(wanted[i].first, wanted[i].second, options); }
};
}

TEST_F(SideBySide, TheyAreThoseThatAreBuiltAlone)
{
  want(1.0, 150);
  wanted.emplace_back(meshes[0], 8); // another level, for lights
  store.prepare(wanted, options);
  EXPECT_EQ(store.built(), 151);
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    const svo::Octree octree = find(i);
    ASSERT_TRUE(octree);
    svo::MeshOctreeOptions alone;
    alone.level = wanted[i].second;
    svo::Octree other;
    std::string message;
    ASSERT_EQ(
      svo::buildMeshOctree(wanted[i].first, alone, other, message), svo::BuildStatus::Built);
    ASSERT_EQ(bytesOf(octree), bytesOf(other)) << i;
  }
  EXPECT_EQ(store.built(), 151);
  store.prepare(wanted, options);
  EXPECT_EQ(store.built(), 151); // nothing is built twice
}

// None of two builds goes on before the other one has begun.
TEST_F(SideBySide, TheyAreBuiltAtTheSameTime)
{
  const std::string before = vtkSMPTools::GetBackend();
  ASSERT_TRUE(vtkSMPTools::SetBackend("STDThread"));
  const bool alone = vtkSMPTools::GetEstimatedNumberOfThreads() < 2;
  if (!alone)
  {
    Meeting meeting;
    for (const double radius : { 6.0, 6.1 })
    {
      vtkNew<MeetingMesh> mesh;
      mesh->ShallowCopy(ball(radius));
      meshes.emplace_back(mesh);
      wanted.emplace_back(mesh, 6);
      mesh->Where = &meeting;
    }
    // Asked when all meshes are known, before any of them is built.
    options.aborted = [&]
    {
      meeting.open(wanted.size());
      return false;
    };
    store.prepare(wanted, options);
    EXPECT_EQ(store.built(), 2);
    EXPECT_FALSE(meeting.missed());
    for (const auto& each : wanted)
    {
      static_cast<MeetingMesh*>(each.first)->Where = nullptr;
    }
  }
  vtkSMPTools::SetBackend(before.c_str());
  if (alone)
  {
    GTEST_SKIP() << "there is one processor";
  }
}

TEST_F(SideBySide, EachIsBuiltOnOneThread)
{
  want(7.0, 5);
  std::atomic<int> asked{ 0 };
  std::vector<svo::SideBySide> builds;
  for (const auto& [mesh, level] : wanted)
  {
    svo::MeshOctreeOptions o;
    o.level = level;
    o.parallelFor = [&](std::size_t begin, std::size_t end, std::size_t grain, const auto& body)
    {
      ++asked;
      svo::serialFor(begin, end, grain, body);
    };
    o.progress = [&](double)
    {
      ++asked;
      return true;
    };
    builds.push_back({ mesh, o });
  }
  svo::buildSideBySide(builds);
  for (const svo::SideBySide& build : builds)
  {
    EXPECT_TRUE(build.octree) << build.message;
  }
  EXPECT_EQ(asked, 0);
}

TEST_F(SideBySide, LargeMeshesAndInteractiveFramesAreLeftToFind)
{
  want(2.0, 2, 120);
  store.prepare(wanted, options);
  EXPECT_EQ(store.built(), 0);
  wanted.clear();
  want(2.1, 2);
  options.wait = false;
  store.prepare(wanted, options);
  options.wait = true;
  options.convert = false;
  store.prepare(wanted, options);
  EXPECT_EQ(store.built(), 0);
}

TEST_F(SideBySide, WhatIsLeftOutOfAMeshIsSaidWhenItIsFound)
{
  want(3.0, 3);
  meshes[1]->GetPoints()->SetPoint(5, std::numeric_limits<double>::quiet_NaN(), 0, 0);
  meshes[1]->GetPoints()->Modified();
  meshes[1]->Modified();
  store.prepare(wanted, options);
  EXPECT_TRUE(said.empty());
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_TRUE(find(i));
  }
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("not finite"), std::string::npos) << said[0];
}

// Who is told of the progress may change meshes, let them go, and end the frame.
TEST_F(SideBySide, ProgressMayChangeMeshesAndAbort)
{
  want(4.0, 200);
  double last = 0.0;
  int reports = 0;
  options.progress = [&](double amount)
  {
    EXPECT_GT(amount, last);
    last = amount;
    if (++reports == 1)
    {
      for (int i = 0; i < 200; ++i)
      {
        if (i % 3 == 0)
        {
          meshes[i] = nullptr;
        }
        else if (i % 3 == 1)
        {
          meshes[i]->GetPoints()->SetPoint(0, 0.0, 0.0, 9.0 + i);
          meshes[i]->GetPoints()->Modified();
          meshes[i]->Modified();
        }
      }
    }
  };
  store.prepare(wanted, options);
  options.progress = nullptr;
  EXPECT_GT(reports, 1);
  EXPECT_EQ(last, 1.0);
  EXPECT_GE(store.built(), 64 + 30);
  EXPECT_LT(store.built(), 64 + 60);
  for (std::size_t i = 1; i < wanted.size(); i += 3)
  {
    const svo::Octree octree = find(i);
    ASSERT_TRUE(octree);
    EXPECT_GT(octree.header().meshBounds[5], 9.0); // of the mesh as it is now
  }

  const int built = store.built();
  wanted.clear();
  meshes.clear();
  want(5.0, 200);
  bool abort = false;
  options.progress = [&](double) { abort = true; };
  options.aborted = [&] { return abort; };
  store.prepare(wanted, options);
  EXPECT_LT(store.built(), built + 100);
}
