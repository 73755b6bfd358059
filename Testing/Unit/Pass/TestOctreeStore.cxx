// The store of octrees: several levels of a mesh, its messages, and what it keeps.
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

TEST_F(OctreeStore, StillFramesGetTheLevelThatTheyAskFor)
{
  for (const int level : { 4, 8, 6, 4 })
  {
    ASSERT_TRUE(find(level, true));
    EXPECT_EQ(octree.level(), level);
    EXPECT_EQ(bytesOf(octree), builtAlone(mesh, level));
    endFrame();
  }
  EXPECT_EQ(store.built(), 3);
  EXPECT_EQ(gate.started(), 0);
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
  ASSERT_TRUE(find(8, true));
  EXPECT_EQ(octree.level(), 3);
  ASSERT_TRUE(find(8, false));
  EXPECT_EQ(store.built(), 0);
  EXPECT_EQ(gate.started(), 0);
}

TEST_F(OctreeStore, NothingIsConvertedThatNobodyWantsConverted)
{
  options.convert = false;
  EXPECT_FALSE(find(6, true));
  EXPECT_FALSE(find(6, false));
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
    EXPECT_TRUE(find(5, true));
    endFrame();
  }
  EXPECT_EQ(store.built(), 5);
  EXPECT_EQ(said.size(), 1u);
}

TEST_F(OctreeStore, AnOctreeOfAnotherMeshIsReplacedAndThatIsSaidOnce)
{
  EXPECT_TRUE(find(5, true));
  svo::attachOctree(mesh, octree);
  mesh->Modified();
  EXPECT_TRUE(store.attached(mesh, options));
  EXPECT_TRUE(said.empty());
  for (int pose = 5; pose < 8; ++pose)
  {
    mesh->GetPoints()->SetPoint(pose, 0.1, 0.0, 0.0);
    mesh->GetPoints()->Modified();
    EXPECT_FALSE(store.attached(mesh, options));
    EXPECT_TRUE(find(5, true));
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
      const svo::Octree other = store.find(mesh, 6, inner);
      ASSERT_TRUE(other);
      EXPECT_EQ(other.level(), 6);
      store.endFrame(0);
      mesh->Initialize();
    }
  };
  EXPECT_TRUE(find(6, true));
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
  ASSERT_TRUE(find(7, true));
  svo::OctreeStore another(gate.launcher());
  options.wait = true;
  const svo::Octree same = another.find(sphereMesh(1.0), 7, options);
  ASSERT_TRUE(same);
  EXPECT_EQ(same.key(), octree.key());
  EXPECT_EQ(another.built(), 0);
  EXPECT_EQ(another.bytes(), store.bytes());
  // An interactive frame need not even wait.
  svo::OctreeStore third(gate.launcher());
  options.wait = false;
  EXPECT_TRUE(third.find(sphereMesh(1.0), 7, options));
  EXPECT_EQ(gate.started(), 0);
  // It stays with the others when one is through with it.
  octree = svo::Octree();
  store.release();
  EXPECT_EQ(store.bytes(), 0u);
  another.endFrame(std::size_t(1) << 30);
  options.wait = true;
  EXPECT_TRUE(another.find(sphereMesh(1.0), 7, options));
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
          found[t] = each.find(sphereMesh(1.0 + 0.1 * (round % 3), 12), 6, own);
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
  EXPECT_TRUE(find(6, true));
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
