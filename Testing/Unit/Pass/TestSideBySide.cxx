// Octrees of many small meshes, built together for a frame that waits for them.
#include "svoOctreeStore.h"
#include "svoSideBySide.h"

#include "svoMeshOctree.h"
#include "svoOctreeBytes.h"

#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
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
  svo::Octree find(std::size_t i)
  {
    svo::Octree octree;
    store.find(wanted[i].first, wanted[i].second, options, octree);
    return octree;
  }
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
