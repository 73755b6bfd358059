// The store of octrees: several levels of a mesh, built at once or in the background.
#include "svoOctreeStoreCase.h"

#include "svoMeshOctree.h"
#include "svoOctreeBytes.h"

#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

using Answer = svo::OctreeStore::Answer;

using svotest::bytesOf;
using svotest::OctreeStore;
using svotest::sphereMesh;

namespace
{
/// The bytes that a build at this level gives when nothing else is going on.
std::vector<std::byte> builtAlone(vtkPolyData* mesh, int level)
{
  svo::MeshOctreeOptions options;
  options.level = level;
  svo::Octree octree;
  std::string message;
  svo::buildMeshOctree(mesh, options, octree, message);
  return bytesOf(octree);
}
}

TEST_F(OctreeStore, StillFramesGetTheLevelThatTheyAskFor)
{
  for (const int level : { 4, 8, 6, 4 })
  {
    ASSERT_EQ(find(level, true), Answer::Found);
    EXPECT_EQ(octree.level(), level);
    EXPECT_EQ(bytesOf(octree), builtAlone(mesh, level));
    endFrame();
  }
  EXPECT_EQ(store.built(), 3);
  EXPECT_EQ(gate.started(), 0);
}

TEST_F(OctreeStore, ACoarserOctreeIsShownWhileADeeperOneIsBuilt)
{
  ASSERT_EQ(find(5, true), Answer::Found);
  for (int frame = 0; frame < 3; ++frame)
  {
    ASSERT_EQ(find(9, false), Answer::Found);
    EXPECT_EQ(octree.level(), 5);
    endFrame();
    EXPECT_EQ(store.building(), 1);
    EXPECT_EQ(store.built(), 1);
  }
  EXPECT_EQ(gate.started(), 1); // once, however many frames ask
  gate.letThrough();
  endFrame(); // it came too late for this one
  EXPECT_EQ(store.building(), 1);
  ASSERT_EQ(find(9, false), Answer::Found);
  EXPECT_EQ(octree.level(), 9);
  EXPECT_EQ(bytesOf(octree), builtAlone(mesh, 9));
  EXPECT_EQ(store.building(), 0);
  EXPECT_EQ(store.built(), 2);
}

TEST_F(OctreeStore, WithoutAnOctreeThereIsNoneUntilItIsBuilt)
{
  EXPECT_EQ(find(7, false), Answer::Building);
  EXPECT_FALSE(octree);
  gate.letThrough();
  EXPECT_EQ(find(7, false), Answer::Found);
}

TEST_F(OctreeStore, ADeeperOctreeDoesAndNothingIsBuiltForIt)
{
  ASSERT_EQ(find(8, true), Answer::Found);
  ASSERT_EQ(find(10, true), Answer::Found);
  ASSERT_EQ(find(6, false), Answer::Found);
  EXPECT_EQ(octree.level(), 8); // the coarsest of the deeper ones
  EXPECT_EQ(gate.started(), 0);
  // A still picture does not depend on what was built before.
  ASSERT_EQ(find(6, true), Answer::Found);
  EXPECT_EQ(octree.level(), 6);
}

TEST_F(OctreeStore, AStillFrameWaitsForTheBuildThatIsUnderWay)
{
  ASSERT_EQ(find(5, true), Answer::Found);
  find(8, false);
  ASSERT_EQ(gate.started(), 1);
  std::vector<double> progress;
  options.progress = [&](double amount)
  {
    // A still frame is waiting: now, and not before, the build may begin.
    if (progress.empty())
    {
      gate.letThrough();
    }
    progress.push_back(amount);
  };
  ASSERT_EQ(find(8, true), Answer::Found);
  EXPECT_EQ(octree.level(), 8);
  EXPECT_FALSE(progress.empty());
  EXPECT_EQ(store.built(), 2); // not built twice
}

TEST_F(OctreeStore, AMeshMayChangeWhileItsOctreeIsBuilt)
{
  const auto before = builtAlone(mesh, 8);
  find(8, false);
  vtkPoints* points = mesh->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double p[3];
    points->GetPoint(i, p);
    points->SetPoint(i, 2.0 * p[0], p[1], p[2]);
  }
  points->Modified();
  const auto after = builtAlone(mesh, 8);
  ASSERT_NE(before, after);
  gate.letThrough();
  endFrame();
  // What was built is not the changed mesh's.
  EXPECT_EQ(find(8, false), Answer::Building);
  EXPECT_EQ(store.building(), 2);
  gate.letThrough();
  ASSERT_EQ(find(8, false), Answer::Found);
  EXPECT_EQ(bytesOf(octree), after);
  // But it is kept for when the mesh looks like that again.
  mesh = sphereMesh(1.0);
  ASSERT_EQ(find(8, false), Answer::Found);
  EXPECT_EQ(bytesOf(octree), before);
}

TEST_F(OctreeStore, ABuildWhoseMeshIsGoneIsAbandoned)
{
  find(8, false);
  mesh = nullptr;
  endFrame();
  EXPECT_EQ(store.building(), 1); // another mesh may be the same
  for (int frame = 0; frame < 8; ++frame)
  {
    endFrame();
  }
  EXPECT_EQ(store.building(), 0);
  gate.letThrough();
  endFrame();
  EXPECT_EQ(store.built(), 0);
  // The same mesh again is built, not taken for one that cannot be.
  mesh = sphereMesh(1.0);
  EXPECT_EQ(find(8, true), Answer::Found);
}

TEST_F(OctreeStore, ABuildThatAnotherMeshNeedsIsNotAbandoned)
{
  find(8, false);
  const vtkSmartPointer<vtkPolyData> twin = sphereMesh(1.0);
  mesh = twin;
  find(8, false);
  for (int frame = 0; frame < 20; ++frame)
  {
    mesh = twin;
    find(8, false);
    mesh = nullptr;
    endFrame();
  }
  EXPECT_EQ(store.building(), 1);
  gate.letThrough();
  mesh = twin;
  EXPECT_EQ(find(8, false), Answer::Found);
  EXPECT_EQ(store.built(), 1);
}

TEST_F(OctreeStore, ABuildThatNoFrameAsksForIsKeptForLater)
{
  find(8, false);
  for (int frame = 0; frame < 20; ++frame)
  {
    endFrame();
  }
  EXPECT_EQ(store.building(), 1);
  gate.letThrough();
  endFrame();
  EXPECT_EQ(store.building(), 0);
  EXPECT_EQ(store.built(), 1);
  EXPECT_GT(store.bytes(), 0u);
  EXPECT_EQ(find(8, false), Answer::Found);
  EXPECT_EQ(gate.started(), 0);
}

TEST_F(OctreeStore, TheStoreMayGoWhileItBuilds)
{
  auto own = std::make_unique<svo::OctreeStore>(); // with plain threads
  options.wait = false;
  EXPECT_EQ(own->find(sphereMesh(1.0, 200), 10, options, octree), Answer::Building);
  own.reset();
  EXPECT_FALSE(octree);
}

TEST_F(OctreeStore, WhatIsTooLargeIsSaidByTheFrameThatWaits)
{
  ASSERT_EQ(find(20, false), Answer::Building);
  gate.letThrough();
  endFrame();
  for (int frame = 0; frame < 12; ++frame)
  {
    EXPECT_EQ(find(20, false), Answer::Building);
    endFrame();
  }
  EXPECT_EQ(gate.started(), 0); // not tried again and again
  EXPECT_EQ(store.building(), 0);
  EXPECT_TRUE(said.empty());
  EXPECT_EQ(find(20, true), Answer::None);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("stays with VTK's rasteriser"), std::string::npos) << said[0];
}

TEST_F(OctreeStore, WithoutAThreadTheOctreeIsBuiltByTheFrameThatWaits)
{
  svo::OctreeStore lonely([](std::function<void()>) -> std::thread
    { throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again)); });
  options.wait = false;
  EXPECT_EQ(lonely.find(mesh, 5, options, octree), Answer::Building);
  EXPECT_EQ(lonely.building(), 0);
  options.wait = true;
  EXPECT_EQ(lonely.find(mesh, 5, options, octree), Answer::Found);
}

TEST_F(OctreeStore, BuildsAtATimeAreLimited)
{
  std::vector<vtkSmartPointer<vtkPolyData>> meshes;
  for (int i = 0; i < 10; ++i)
  {
    meshes.push_back(sphereMesh(1.0 + i));
  }
  int found = 0;
  for (int frame = 0; frame < 10 && found < 10; ++frame)
  {
    found = 0;
    for (const auto& each : meshes)
    {
      mesh = each;
      found += find(6, false) == Answer::Found;
    }
    EXPECT_LE(store.building(), 4);
    gate.letThrough();
    endFrame();
  }
  EXPECT_EQ(found, 10);
  EXPECT_EQ(store.built(), 10);
}

TEST_F(OctreeStore, OctreesThatFramesDoNotUseGoWhenMemoryIsShort)
{
  find(5, true);
  const std::size_t coarse = store.bytes();
  find(9, true);
  const std::size_t both = store.bytes();
  endFrame();
  find(9, true);
  store.endFrame(both - 1); // the coarse one was not used
  EXPECT_EQ(store.bytes(), both - coarse);
}

TEST_F(OctreeStore, AnOctreeThatTheMeshBringsIsAllThereIs)
{
  svo::MeshOctreeOptions build;
  build.level = 3;
  svo::Octree own;
  std::string message;
  svo::buildMeshOctree(mesh, build, own, message);
  svo::attachOctree(mesh, own);
  ASSERT_EQ(find(8, true), Answer::Found);
  EXPECT_EQ(octree.level(), 3);
  ASSERT_EQ(find(8, false), Answer::Found);
  EXPECT_EQ(store.built(), 0);
  EXPECT_EQ(gate.started(), 0);
}

TEST_F(OctreeStore, NothingIsConvertedThatNobodyWantsConverted)
{
  options.convert = false;
  EXPECT_EQ(find(6, true), Answer::None);
  EXPECT_EQ(find(6, false), Answer::None);
  EXPECT_EQ(store.built(), 0);
  EXPECT_EQ(gate.started(), 0);
}

TEST_F(OctreeStore, AMessageIsSaidOnceAndNotForEachLevel)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  mesh->GetPoints()->SetPoint(5, nan, 0.0, 0.0);
  mesh->GetPoints()->Modified();
  find(5, true);
  EXPECT_EQ(said.size(), 1u);
  find(7, true);
  find(9, false);
  gate.letThrough();
  find(9, false);
  EXPECT_EQ(octree.level(), 9);
  EXPECT_EQ(said.size(), 1u);
}

TEST_F(OctreeStore, AMessageIsSaidOnceAndNotForEachPose)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int pose = 5; pose < 10; ++pose)
  {
    mesh->GetPoints()->SetPoint(pose, nan, 0.0, 0.0);
    mesh->GetPoints()->Modified();
    EXPECT_EQ(find(5, true), Answer::Found);
    endFrame();
  }
  EXPECT_EQ(store.built(), 5);
  EXPECT_EQ(said.size(), 1u);
}

TEST_F(OctreeStore, AnOctreeOfAnotherMeshIsReplacedAndThatIsSaidOnce)
{
  EXPECT_EQ(find(5, true), Answer::Found);
  svo::attachOctree(mesh, octree);
  mesh->Modified();
  svo::Octree own;
  EXPECT_TRUE(store.attached(mesh, options, own));
  EXPECT_TRUE(said.empty());
  for (int pose = 5; pose < 8; ++pose)
  {
    mesh->GetPoints()->SetPoint(pose, 0.1, 0.0, 0.0);
    mesh->GetPoints()->Modified();
    EXPECT_FALSE(store.attached(mesh, options, own));
    EXPECT_EQ(find(5, true), Answer::Found);
    endFrame();
  }
  EXPECT_EQ(said.size(), 1u);
}

// Who is told of the progress may do anything that the store's users may.
TEST_F(OctreeStore, ProgressMayAskForOctreesAndChangeTheMesh)
{
  int calls = 0;
  options.progress = [&](double)
  {
    if (++calls == 1)
    {
      svo::StoreOptions inner;
      inner.complain = options.complain;
      svo::Octree other;
      EXPECT_EQ(store.find(mesh, 6, inner, other), Answer::Found);
      EXPECT_EQ(other.level(), 6);
      store.endFrame(0);
      mesh->Initialize();
    }
  };
  EXPECT_EQ(find(6, true), Answer::Found);
  EXPECT_EQ(octree.level(), 6);
  EXPECT_GT(calls, 0);
}

TEST_F(OctreeStore, TheBoxIsThatOfTheFinitePointsAndStripsCountAsTriangles)
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(std::numeric_limits<double>::quiet_NaN(), 9.0, 9.0);
  points->InsertNextPoint(1.0, -2.0, 3.0);
  points->InsertNextPoint(-1.0, 5.0, 3.5);
  vtkNew<vtkPolyData> few;
  few->SetPoints(points);
  vtkNew<vtkCellArray> strips;
  strips->InsertNextCell({ 0, 1, 2, 1, 0 });
  few->SetStrips(strips);
  vtkNew<vtkCellArray> polys;
  polys->InsertNextCell({ 0, 1, 2, 0 });
  polys->InsertNextCell({ 0, 1, 2 });
  few->SetPolys(polys);
  svo::Body body;
  store.measure(few, options, body);
  EXPECT_TRUE(body.box.known());
  EXPECT_EQ(body.box.low, glm::dvec3(-1.0, -2.0, 3.0));
  EXPECT_EQ(body.box.high, glm::dvec3(1.0, 5.0, 3.5));
  EXPECT_EQ(body.triangles, 3u + 2u + 1u);
  vtkNew<vtkPolyData> none;
  store.measure(none, options, body);
  EXPECT_FALSE(body.box.known());
  EXPECT_EQ(body.triangles, 0u);
}

TEST_F(OctreeStore, StoresShareTheirOctrees)
{
  ASSERT_EQ(find(7, true), Answer::Found);
  svo::OctreeStore another(gate.launcher());
  svo::Octree same;
  options.wait = true;
  ASSERT_EQ(another.find(sphereMesh(1.0), 7, options, same), Answer::Found);
  EXPECT_EQ(same.key(), octree.key());
  EXPECT_EQ(another.built(), 0);
  EXPECT_EQ(another.bytes(), store.bytes());
  // An interactive frame need not even wait.
  svo::OctreeStore third(gate.launcher());
  options.wait = false;
  EXPECT_EQ(third.find(sphereMesh(1.0), 7, options, same), Answer::Found);
  EXPECT_EQ(gate.started(), 0);
  // It stays with the others when one is through with it.
  octree = svo::Octree();
  store.release();
  EXPECT_EQ(store.bytes(), 0u);
  another.endFrame(std::size_t(1) << 30);
  options.wait = true;
  EXPECT_EQ(another.find(sphereMesh(1.0), 7, options, same), Answer::Found);
  EXPECT_EQ(another.built(), 0);
}

TEST_F(OctreeStore, AreSharedByManyThreads)
{
  std::vector<std::thread> threads;
  std::vector<svo::Octree> found(4);
  for (std::size_t t = 0; t < found.size(); ++t)
  {
    threads.emplace_back(
      [t, &found]
      {
        svo::StoreOptions own;
        own.complain = [](const std::string&) {};
        for (int round = 0; round < 20; ++round)
        {
          svo::OctreeStore each;
          each.find(sphereMesh(1.0 + 0.1 * (round % 3), 12), 6, own, found[t]);
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  for (const svo::Octree& each : found)
  {
    ASSERT_TRUE(each);
    EXPECT_EQ(bytesOf(each), bytesOf(found[0]));
  }
}

TEST_F(OctreeStore, AFrameThatIsAbortedWaitsForNoBuild)
{
  bool abort = false;
  int asked = 0;
  options.aborted = [&]
  {
    ++asked;
    return abort;
  };
  options.progress = [&](double) { abort = true; };
  EXPECT_EQ(find(9, true), Answer::Building);
  EXPECT_GT(asked, 0);
  EXPECT_EQ(store.built(), 0);
  EXPECT_EQ(find(9, true), Answer::Building); // the rest of the frame, too
  EXPECT_EQ(gate.started(), 0);
  endFrame();
  // The next frame has it, and nothing was said.
  abort = false;
  options.progress = nullptr;
  EXPECT_EQ(find(9, true), Answer::Found);
  EXPECT_EQ(octree.level(), 9);
  EXPECT_TRUE(said.empty());
  // Meanwhile another octree of the mesh does.
  abort = true;
  EXPECT_EQ(find(8, true), Answer::Found);
  EXPECT_EQ(octree.level(), 9);
}

TEST_F(OctreeStore, AFrameThatIsAbortedLeavesABuildInTheBackgroundAlone)
{
  EXPECT_EQ(find(8, false), Answer::Building);
  ASSERT_EQ(gate.started(), 1);
  options.aborted = [] { return true; };
  EXPECT_EQ(find(8, true), Answer::Building); // and does not hang
  EXPECT_EQ(store.building(), 1);
  gate.letThrough();
  options.aborted = nullptr;
  EXPECT_EQ(find(8, true), Answer::Found);
  EXPECT_EQ(store.built(), 1);
}

TEST_F(OctreeStore, ReleasedEverythingIsBuiltAnew)
{
  find(6, true);
  find(8, false);
  ASSERT_EQ(store.building(), 1);
  gate.letThrough(); // an abandoned build is waited for
  octree = svo::Octree();
  store.release();
  EXPECT_EQ(store.bytes(), 0u);
  EXPECT_EQ(store.building(), 0);
  EXPECT_EQ(find(6, true), Answer::Found);
  EXPECT_EQ(store.built(), 2);
}

TEST_F(OctreeStore, WhatAFrameNeedsIsKeptAndTheExcessIsTold)
{
  find(8, true);
  const std::size_t bytes = store.bytes();
  EXPECT_EQ(store.endFrame(bytes - 10), 10u);
  EXPECT_EQ(store.bytes(), bytes);
  find(8, true);
  EXPECT_EQ(store.endFrame(bytes), 0u);
}
