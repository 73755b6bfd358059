// The conversion filter where nobody may wait: it goes on without octrees that are not there yet.
#include "vtkPPolyDataToSVO.h"
#include "vtkPolyDataToSVO.h"

#include "svoMeshOctree.h"
#include "svoTestMessages.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkFieldData.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"

#include <chrono>
#include <cstddef>
#include <cstring>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace
{
vtkSmartPointer<vtkPolyData> sphere(double radius = 0.5, int resolution = 16)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->SetRadius(radius);
  source->Update();
  return source->GetOutput();
}

svo::Octree octreeOf(vtkPolyData* mesh)
{
  svo::Octree octree;
  std::string message;
  svo::openAttachedOctree(mesh, octree, message);
  return octree;
}

std::vector<std::byte> bytesOf(const svo::Octree& octree)
{
  const auto* first = reinterpret_cast<const std::byte*>(octree.key());
  const std::size_t size = sizeof(svo::Header) + octree.header().nodeCount * sizeof(svo::Node) +
    octree.header().listWords * sizeof(std::uint32_t);
  return { first, first + size };
}

/// What the filter makes of a mesh if it waits.
std::vector<std::byte> waitedFor(vtkPolyData* mesh, int level)
{
  vtkNew<vtkPolyDataToSVO> filter;
  filter->SetInputData(mesh);
  filter->SetMaximumLevel(level);
  filter->Update();
  return bytesOf(octreeOf(filter->GetOutput()));
}

struct BackgroundOctrees : ::testing::Test
{
  vtkNew<vtkPolyDataToSVO> filter;
  svo::TestMessages messages{ filter };
  vtkSmartPointer<vtkPolyData> mesh = sphere();

  BackgroundOctrees()
  {
    filter->SetInputData(mesh);
    filter->SetMaximumLevel(6);
    filter->BuildInBackgroundOn();
  }

  svo::Octree output() { return octreeOf(filter->GetOutput()); }

  /// Executes until nothing is under way.
  void settle()
  {
    do
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      filter->Modified();
      filter->Update();
    } while (filter->GetNumberOfOctreesInProgress() > 0);
  }
};
}

TEST_F(BackgroundOctrees, TheMeshGoesOutAtOnceAndItsOctreeFollows)
{
  filter->Update();
  EXPECT_FALSE(output());
  EXPECT_FALSE(filter->GetOutput()->GetFieldData()->HasArray(svo::OctreeArrayName));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), mesh->GetNumberOfPolys());
  EXPECT_EQ(filter->GetNumberOfOctreesInProgress(), 1);
  EXPECT_EQ(filter->GetNumberOfBuilds(), 0);
  settle();
  ASSERT_TRUE(output());
  EXPECT_EQ(bytesOf(output()), waitedFor(mesh, 6));
  EXPECT_EQ(filter->GetNumberOfBuilds(), 1);
  EXPECT_EQ(filter->GetNumberOfCachedOctrees(), 1);
  EXPECT_EQ(messages.all(), "");
}

TEST_F(BackgroundOctrees, TurnedOffTheNextUpdateWaits)
{
  filter->Update();
  filter->BuildInBackgroundOff();
  filter->Update();
  ASSERT_TRUE(output());
  EXPECT_EQ(bytesOf(output()), waitedFor(mesh, 6));
  EXPECT_EQ(filter->GetNumberOfOctreesInProgress(), 0);
  EXPECT_EQ(filter->GetNumberOfBuilds(), 1);
}

TEST_F(BackgroundOctrees, SwitchingMakesNothingOutdatedThatIsComplete)
{
  settle();
  const auto time = filter->GetMTime();
  filter->BuildInBackgroundOff();
  filter->BuildInBackgroundOn();
  EXPECT_EQ(filter->GetMTime(), time);
}

TEST_F(BackgroundOctrees, MeanwhileTheMeshHasTheOctreeThatItHadLast)
{
  filter->BuildInBackgroundOff();
  for (const int level : { 4, 6, 5 })
  {
    filter->SetMaximumLevel(level);
    filter->Update();
  }
  filter->BuildInBackgroundOn();
  filter->SetMaximumLevel(7);
  filter->SetLeafGeometryToPlane();
  filter->Update();
  ASSERT_TRUE(output());
  EXPECT_EQ(bytesOf(output()), waitedFor(mesh, 5));
  EXPECT_EQ(filter->GetNumberOfVoxels(), static_cast<vtkIdType>(output().header().voxelCount));
  settle();
  EXPECT_EQ(output().level(), 7);
  EXPECT_EQ(output().header().leafGeometry, static_cast<std::uint32_t>(svo::LeafGeometry::Plane));
}

TEST_F(BackgroundOctrees, MeanwhileAMeshKeepsAnOctreeThatItBrings)
{
  vtkNew<vtkPolyDataToSVO> upstream;
  upstream->SetInputData(mesh);
  upstream->SetMaximumLevel(3);
  upstream->Update();
  filter->SetInputData(upstream->GetOutput());
  filter->Update();
  ASSERT_TRUE(output());
  EXPECT_EQ(output().level(), 3);
  settle();
  EXPECT_EQ(output().level(), 6);
}

TEST_F(BackgroundOctrees, AnotherMeshesOctreeIsNoSubstitute)
{
  settle();
  filter->SetInputData(sphere(0.7));
  filter->Update();
  EXPECT_FALSE(output());
}

TEST_F(BackgroundOctrees, WhatIsNoLongerAskedForIsAbandoned)
{
  for (int i = 0; i < 20; ++i)
  {
    filter->SetInputData(sphere(1.0 + i, 64));
    filter->SetMaximumLevel(9);
    filter->Update();
    EXPECT_LE(filter->GetNumberOfOctreesInProgress(), 1);
  }
  const auto last = sphere(0.3);
  filter->SetInputData(last);
  filter->BuildInBackgroundOff();
  filter->Update();
  ASSERT_TRUE(output());
  EXPECT_EQ(bytesOf(output()), waitedFor(last, 9));
  EXPECT_EQ(filter->GetNumberOfOctreesInProgress(), 0);
  EXPECT_EQ(filter->GetNumberOfBuilds(), 1);
}

TEST_F(BackgroundOctrees, TheMeshMayChangeAndTheFilterMayGoWhileItBuilds)
{
  const auto large = sphere(1.0, 400);
  filter->SetInputData(large);
  filter->SetMaximumLevel(11);
  filter->Update();
  large->GetPoints()->SetPoint(7, 5.0, 5.0, 5.0);
  large->Modified();
  large->Initialize();
}

TEST_F(BackgroundOctrees, WithoutTheCacheTheOctreeGoesOutOnce)
{
  filter->CacheTimeStepsOff();
  filter->Update();
  filter->BuildInBackgroundOff();
  filter->Update();
  EXPECT_TRUE(output());
  EXPECT_EQ(filter->GetNumberOfBuilds(), 1);
  EXPECT_EQ(filter->GetNumberOfCachedOctrees(), 0);
}

TEST_F(BackgroundOctrees, WhoWaitsSeesProgressAndMayAbort)
{
  // Much longer than it takes to begin to wait.
  filter->SetInputData(sphere(1.0, 500));
  filter->SetMaximumLevel(12);
  filter->Update();
  filter->BuildInBackgroundOff();
  int calls = 0;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&calls);
  observer->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void*)
    {
      ++*static_cast<int*>(data);
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    });
  filter->AddObserver(vtkCommand::ProgressEvent, observer);
  filter->Update();
  EXPECT_GT(calls, 0);
  EXPECT_FALSE(filter->GetOutput()->GetFieldData()->HasArray(svo::OctreeArrayName));
  EXPECT_EQ(filter->GetNumberOfBuilds(), 0);
  EXPECT_EQ(filter->GetNumberOfOctreesInProgress(), 0);
  EXPECT_EQ(messages.all(), "");
}

TEST_F(BackgroundOctrees, AMessageComesWithTheOctree)
{
  mesh->GetPoints()->SetPoint(7, std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
  filter->Update();
  EXPECT_EQ(messages.all(), "");
  settle();
  EXPECT_TRUE(output());
  EXPECT_EQ(messages.warnings.size(), 1u);
  EXPECT_EQ(messages.errors.size(), 0u);
}

TEST_F(BackgroundOctrees, ARefusedBuildIsOneError)
{
  filter->SetMaximumLevel(12);
  filter->SetMemoryLimit(1);
  filter->Update();
  EXPECT_EQ(messages.all(), "");
  filter->BuildInBackgroundOff();
  filter->Update();
  EXPECT_FALSE(output());
  EXPECT_EQ(messages.errors.size(), 1u);
  EXPECT_EQ(messages.warnings.size(), 0u);
}

TEST(BackgroundOctreesOfBlocks, AllAreThereInTheEnd)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  for (unsigned int i = 0; i < 12; ++i)
  {
    blocks->SetBlock(i, sphere(1.0 + i % 9));
  }
  vtkNew<vtkPPolyDataToSVO> filter;
  filter->SetInputData(blocks);
  filter->BuildInBackgroundOn();
  filter->Update();
  EXPECT_GT(filter->GetNumberOfOctreesInProgress(), 0);
  EXPECT_LE(filter->GetNumberOfOctreesInProgress(), 4);
  filter->BuildInBackgroundOff();
  filter->Update();
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  for (unsigned int i = 0; i < 12; ++i)
  {
    EXPECT_TRUE(octreeOf(vtkPolyData::SafeDownCast(output->GetBlock(i))));
  }
  EXPECT_EQ(filter->GetNumberOfBuilds(), 9);
  EXPECT_EQ(filter->GetNumberOfOctreesInProgress(), 0);
}
