// The store of octrees while it builds in the background, and frames that wait, or do not.
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

using svotest::builtAlone;
using svotest::bytesOf;
using svotest::OctreeStore;
using svotest::sphereMesh;

TEST_F(OctreeStore, ACoarserOctreeIsShownWhileADeeperOneIsBuilt)
{
  ASSERT_TRUE(find(5, true));
  for (int frame = 0; frame < 3; ++frame)
  {
    ASSERT_TRUE(find(9, false));
    EXPECT_EQ(octree.level(), 5);
    endFrame();
    EXPECT_EQ(store.building(), 1);
    EXPECT_EQ(store.built(), 1);
  }
  EXPECT_EQ(gate.started(), 1); // once, however many frames ask
  gate.letThrough();
  endFrame(); // it came too late for this one
  EXPECT_EQ(store.building(), 1);
  ASSERT_TRUE(find(9, false));
  EXPECT_EQ(octree.level(), 9);
  EXPECT_EQ(bytesOf(octree), builtAlone(mesh, 9));
  EXPECT_EQ(store.building(), 0);
  EXPECT_EQ(store.built(), 2);
}

TEST_F(OctreeStore, WithoutAnOctreeThereIsNoneUntilItIsBuilt)
{
  EXPECT_FALSE(find(7, false));
  EXPECT_EQ(store.building(), 1);
  gate.letThrough();
  EXPECT_TRUE(find(7, false));
}

TEST_F(OctreeStore, ADeeperOctreeDoesAndNothingIsBuiltForIt)
{
  ASSERT_TRUE(find(8, true));
  ASSERT_TRUE(find(10, true));
  ASSERT_TRUE(find(6, false));
  EXPECT_EQ(octree.level(), 8); // the coarsest of the deeper ones
  EXPECT_EQ(gate.started(), 0);
  // A still picture does not depend on what was built before.
  ASSERT_TRUE(find(6, true));
  EXPECT_EQ(octree.level(), 6);
}

TEST_F(OctreeStore, AStillFrameWaitsForTheBuildThatIsUnderWay)
{
  ASSERT_TRUE(find(5, true));
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
  ASSERT_TRUE(find(8, true));
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
  EXPECT_FALSE(find(8, false));
  EXPECT_EQ(store.building(), 2);
  gate.letThrough();
  ASSERT_TRUE(find(8, false));
  EXPECT_EQ(bytesOf(octree), after);
  // But it is kept for when the mesh looks like that again.
  mesh = sphereMesh(1.0);
  ASSERT_TRUE(find(8, false));
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
  EXPECT_TRUE(find(8, true));
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
  EXPECT_TRUE(find(8, false));
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
  EXPECT_TRUE(find(8, false));
  EXPECT_EQ(gate.started(), 0);
}

TEST_F(OctreeStore, TheStoreMayGoWhileItBuilds)
{
  auto own = std::make_unique<svo::OctreeStore>(); // with plain threads
  options.wait = false;
  EXPECT_FALSE(own->find(sphereMesh(1.0, 200), 10, options));
  EXPECT_EQ(own->building(), 1);
  own.reset();
}

TEST_F(OctreeStore, WhatIsTooLargeIsSaidByTheFrameThatWaits)
{
  ASSERT_FALSE(find(20, false));
  EXPECT_EQ(store.building(), 1);
  gate.letThrough();
  endFrame();
  for (int frame = 0; frame < 12; ++frame)
  {
    EXPECT_FALSE(find(20, false));
    endFrame();
  }
  EXPECT_EQ(gate.started(), 0); // not tried again and again
  EXPECT_EQ(store.building(), 0);
  EXPECT_TRUE(said.empty());
  EXPECT_FALSE(find(20, true));
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("stays with VTK's rasteriser"), std::string::npos) << said[0];
}

TEST_F(OctreeStore, WithoutAThreadTheOctreeIsBuiltByTheFrameThatWaits)
{
  svo::OctreeStore lonely([](std::function<void()>) -> std::thread
    { throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again)); });
  options.wait = false;
  EXPECT_FALSE(lonely.find(mesh, 5, options));
  EXPECT_EQ(lonely.building(), 0);
  options.wait = true;
  EXPECT_TRUE(lonely.find(mesh, 5, options));
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
      found += find(6, false);
    }
    EXPECT_LE(store.building(), 4);
    gate.letThrough();
    endFrame();
  }
  EXPECT_EQ(found, 10);
  EXPECT_EQ(store.built(), 10);
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
  EXPECT_FALSE(find(9, true));
  EXPECT_GT(asked, 0);
  EXPECT_EQ(store.built(), 0);
  EXPECT_FALSE(find(9, true)); // the rest of the frame, too
  EXPECT_EQ(gate.started(), 0);
  endFrame();
  // The next frame has it, and nothing was said.
  abort = false;
  options.progress = nullptr;
  EXPECT_TRUE(find(9, true));
  EXPECT_EQ(octree.level(), 9);
  EXPECT_TRUE(said.empty());
  // Meanwhile another octree of the mesh does.
  abort = true;
  EXPECT_TRUE(find(8, true));
  EXPECT_EQ(octree.level(), 9);
}

TEST_F(OctreeStore, AFrameThatIsAbortedLeavesABuildInTheBackgroundAlone)
{
  EXPECT_FALSE(find(8, false));
  ASSERT_EQ(gate.started(), 1);
  options.aborted = [] { return true; };
  EXPECT_FALSE(find(8, true)); // and does not hang
  EXPECT_EQ(store.building(), 1);
  gate.letThrough();
  options.aborted = nullptr;
  EXPECT_TRUE(find(8, true));
  EXPECT_EQ(store.built(), 1);
}
