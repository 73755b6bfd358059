// Which octrees a store keeps: loops that are longer than its memory, and meshes that are gone.
#include "svoOctreeStoreCase.h"

using svotest::OctreeStore;
using svotest::sphereMesh;

namespace
{
/// Frames that each show one of `count` poses of a mesh, `loops` times: how many octrees each loop
/// builds. There is room for `room` of them. With `anew` each frame has a mesh of its own.
std::vector<int> buildsOfLoops(
  svo::OctreeStore& store, svo::StoreOptions options, int count, int room, int loops, bool anew)
{
  std::vector<vtkSmartPointer<vtkPolyData>> poses;
  for (int i = 0; i < count; ++i)
  {
    poses.push_back(sphereMesh(1.0 + 0.001 * i, 6));
  }
  options.wait = true;
  const std::size_t bytes = store.find(poses[0], 4, options).bytes();
  const std::size_t limit = room * bytes + bytes / 2;
  std::vector<int> builds;
  for (int loop = 0; loop < loops; ++loop)
  {
    const int before = loop == 0 ? 0 : store.built();
    for (const auto& pose : poses)
    {
      vtkSmartPointer<vtkPolyData> mesh = pose;
      if (anew)
      {
        mesh = vtkSmartPointer<vtkPolyData>::New();
        mesh->DeepCopy(pose);
      }
      EXPECT_TRUE(store.find(mesh, 4, options));
      mesh = nullptr;
      store.endFrame(limit);
      EXPECT_LE(store.bytes(), limit);
    }
    builds.push_back(store.built() - before);
  }
  return builds;
}
}

// Least recently used first out kept nothing of a loop that is longer than the cache: 300 builds
// each time.
TEST_F(OctreeStore, OfALoopThatIsTooLongAsManyPosesAreKeptAsThereIsRoomFor)
{
  const std::vector<int> builds = buildsOfLoops(store, options, 300, 100, 4, false);
  EXPECT_EQ(builds[0], 300);
  for (std::size_t loop = 1; loop < builds.size(); ++loop)
  {
    EXPECT_LE(builds[loop], 300 - 100 + 5) << "loop " << loop;
  }
}

TEST_F(OctreeStore, AShortLoopIsBuiltOnceAndTheNextOneIsNotKeptOutForLong)
{
  EXPECT_EQ(buildsOfLoops(store, options, 90, 100, 3, false), (std::vector<int>{ 90, 0, 0 }));
  buildsOfLoops(store, options, 300, 100, 2, false);
  svo::OctreeStore other;
  std::vector<vtkSmartPointer<vtkPolyData>> poses;
  for (int i = 0; i < 90; ++i)
  {
    poses.push_back(sphereMesh(5.0 + 0.001 * i, 6));
  }
  const std::size_t limit = store.bytes();
  options.wait = true;
  int last = 0;
  for (int loop = 0; loop < 6; ++loop)
  {
    const int before = store.built();
    for (const auto& pose : poses)
    {
      octree = store.find(pose, 4, options);
      store.endFrame(limit);
    }
    last = store.built() - before;
  }
  EXPECT_EQ(last, 0);
}

TEST_F(OctreeStore, OctreesOfMeshesThatAreGoneAreFreed)
{
  std::size_t most = 0;
  for (int frame = 0; frame < 200; ++frame)
  {
    mesh = sphereMesh(1.0 + 0.01 * frame, 8);
    find(6, true);
    octree = svo::Octree();
    endFrame();
    most = std::max(most, store.bytes());
  }
  mesh = nullptr;
  endFrame();
  EXPECT_EQ(store.bytes(), 0u);
  mesh = sphereMesh(3.0, 8);
  find(6, true);
  EXPECT_LE(most, 3 * octree.bytes());
}

TEST_F(OctreeStore, OctreesOfEarlierPosesOfAMeshAreKeptWhileItLives)
{
  const auto other = sphereMesh(2.0);
  const auto own = vtkSmartPointer<vtkPolyData>::New();
  own->DeepCopy(mesh);
  mesh = own;
  find(6, true);
  endFrame();
  own->GetPoints()->DeepCopy(other->GetPoints());
  own->GetPoints()->Modified();
  find(6, true);
  endFrame();
  const std::size_t both = store.bytes();
  sphereMesh(9.0); // a mesh that comes and goes
  endFrame();
  EXPECT_EQ(store.bytes(), both);
  EXPECT_EQ(store.built(), 2);
}

// A reader that makes new meshes for each time step.
TEST_F(OctreeStore, WhatNewMeshesHaveAgainIsKeptFromThenOn)
{
  EXPECT_EQ(buildsOfLoops(store, options, 20, 100, 4, true), (std::vector<int>{ 20, 19, 0, 0 }));
}
