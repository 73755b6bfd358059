// Pieces of a surface get voxels of the whole's.
#include "svoAbort.h"
#include "vtkPPolyDataToSVO.h"
#include "vtkSparseVoxelOctree.h"

#include "vtkAppendPolyData.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiPieceDataSet.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <vector>

namespace
{
/// A part of a sphere, from one meridian to another.
vtkSmartPointer<vtkPolyData> slice(double from, double to)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(24);
  source->SetPhiResolution(24);
  source->SetStartTheta(from);
  source->SetEndTheta(to);
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkSparseVoxelOctree> octreeOf(vtkDataObject* mesh)
{
  auto octree = vtkSmartPointer<vtkSparseVoxelOctree>::New();
  EXPECT_TRUE(octree->Initialize(vtkPolyData::SafeDownCast(mesh)));
  return octree;
}

void expectSameCube(vtkSparseVoxelOctree* a, vtkSparseVoxelOctree* b)
{
  double boundsA[6], boundsB[6];
  a->GetBounds(boundsA);
  b->GetBounds(boundsB);
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(boundsA[i], boundsB[i]);
  }
  EXPECT_EQ(a->GetVoxelSize(), b->GetVoxelSize());
}

double leftOf(vtkSparseVoxelOctree* octree)
{
  double bounds[6];
  octree->GetBounds(bounds);
  return bounds[0];
}

vtkSmartPointer<vtkDataObject> converted(vtkDataObject* input)
{
  vtkNew<vtkPPolyDataToSVO> filter;
  filter->SetMaximumLevel(5);
  filter->SetInputDataObject(input);
  filter->Update();
  EXPECT_STREQ(filter->GetOutputDataObject(0)->GetClassName(), input->GetClassName());
  return filter->GetOutputDataObject(0);
}
}

TEST(PPolyDataToSVO, PiecesHaveTheVoxelsOfTheWhole)
{
  const std::vector<vtkSmartPointer<vtkPolyData>> slices = { slice(0, 100), slice(100, 180),
    slice(180, 360) };
  vtkNew<vtkAppendPolyData> append;
  vtkNew<vtkPartitionedDataSet> pieces;
  for (const auto& part : slices)
  {
    append->AddInputData(part);
    pieces->SetPartition(pieces->GetNumberOfPartitions(), part);
  }
  append->Update();
  const auto whole = octreeOf(converted(append->GetOutput()));
  const auto output = converted(pieces);
  std::vector<vtkSmartPointer<vtkSparseVoxelOctree>> parts;
  for (unsigned int i = 0; i < 3; ++i)
  {
    parts.push_back(octreeOf(vtkPartitionedDataSet::SafeDownCast(output)->GetPartition(i)));
    expectSameCube(parts.back(), whole);
    EXPECT_LT(parts.back()->GetNumberOfVoxels(), whole->GetNumberOfVoxels());
  }
  double bounds[6];
  whole->GetBounds(bounds);
  const int n = 1 << 5;
  int occupied = 0;
  for (int i = 0; i < n * n * n; ++i)
  {
    const double v = whole->GetVoxelSize();
    double x[3] = { bounds[0] + (i % n + 0.5) * v, bounds[2] + (i / n % n + 0.5) * v,
      bounds[4] + (i / n / n + 0.5) * v };
    bool any = false;
    for (const auto& part : parts)
    {
      any = any || part->IsOccupied(x, 5);
    }
    ASSERT_EQ(any, whole->IsOccupied(x, 5));
    occupied += any;
  }
  EXPECT_EQ(occupied, whole->GetNumberOfVoxels());
}

TEST(PPolyDataToSVO, BlocksHaveTheirOwnAndKeepNamesAndFieldData)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, slice(0, 90));
  blocks->GetMetaData(0u)->Set(vtkCompositeDataSet::NAME(), "quarter");
  vtkNew<vtkMultiPieceDataSet> pieces;
  pieces->SetPiece(0, slice(0, 180));
  pieces->SetPiece(1, slice(180, 270));
  blocks->SetBlock(1, pieces);
  blocks->SetBlock(2, nullptr);
  vtkNew<vtkImageData> image;
  blocks->SetBlock(3, image);

  const auto output = converted(blocks);
  auto* tree = vtkMultiBlockDataSet::SafeDownCast(output);
  ASSERT_EQ(tree->GetNumberOfBlocks(), 4u);
  EXPECT_STREQ(tree->GetMetaData(0u)->Get(vtkCompositeDataSet::NAME()), "quarter");
  EXPECT_EQ(tree->GetBlock(2), nullptr);
  EXPECT_TRUE(vtkImageData::SafeDownCast(tree->GetBlock(3)));
  auto* together = vtkMultiPieceDataSet::SafeDownCast(tree->GetBlock(1));
  const auto first = octreeOf(together->GetPiece(0));
  expectSameCube(first, octreeOf(together->GetPiece(1)));
  EXPECT_GT(leftOf(octreeOf(tree->GetBlock(0))), leftOf(first) + 0.1); // the quarter's middle
  // The inputs are as they were.
  EXPECT_EQ(slice(0, 90)->GetFieldData()->GetNumberOfArrays(),
    vtkPolyData::SafeDownCast(blocks->GetBlock(0))->GetFieldData()->GetNumberOfArrays());
}

TEST(PPolyDataToSVO, ACollectionsPartitionsShareTheirCube)
{
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetPartition(0, 0, slice(0, 90));
  collection->SetPartition(0, 1, slice(90, 360));
  collection->SetPartition(1, 0, slice(0, 90));
  const auto output = converted(collection);
  auto* tree = vtkPartitionedDataSetCollection::SafeDownCast(output);
  const auto part = octreeOf(tree->GetPartition(0, 0));
  expectSameCube(part, octreeOf(tree->GetPartition(0, 1)));
  EXPECT_GT(leftOf(octreeOf(tree->GetPartition(1, 0))), leftOf(part) + 0.1);
}

TEST(PPolyDataToSVO, OneSurfaceIsWhatTheSerialFilterMakes)
{
  const auto mesh = slice(0, 120);
  vtkNew<vtkPolyDataToSVO> serial;
  serial->SetMaximumLevel(5);
  serial->SetInputData(mesh);
  serial->Update();
  const auto parallel = converted(mesh);
  expectSameCube(octreeOf(serial->GetOutput()), octreeOf(parallel));
}

TEST(PPolyDataToSVO, AnAbortLeavesNoMeshWithOnlyAPartOfAnOctree)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, slice(0, 90));
  blocks->SetBlock(1, slice(0, 360));
  vtkNew<vtkPPolyDataToSVO> filter;
  filter->SetMaximumLevel(8);
  filter->SetInputDataObject(blocks);
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1); });
  const unsigned long observer = filter->AddObserver(vtkCommand::ProgressEvent, stop);
  filter->Update();
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  for (unsigned int i = 0; i < 2; ++i)
  {
    auto* mesh = vtkPolyData::SafeDownCast(output->GetBlock(i));
    if (svo::ExecutiveEmptiesAbortedOutput)
    {
      EXPECT_EQ(mesh, nullptr) << i;
      continue;
    }
    EXPECT_EQ(
      mesh->GetNumberOfPolys(), vtkPolyData::SafeDownCast(blocks->GetBlock(i))->GetNumberOfPolys());
    EXPECT_EQ(mesh->GetFieldData()->GetNumberOfArrays(), 0) << i;
  }
  filter->RemoveObserver(observer);
  filter->SetAbortExecute(0);
  filter->Modified();
  filter->Update();
  output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  EXPECT_GT(octreeOf(output->GetBlock(0))->GetNumberOfVoxels(), 0);
  EXPECT_GT(octreeOf(output->GetBlock(1))->GetNumberOfVoxels(), 0);
}

TEST(PPolyDataToSVO, AModelsBoundsCountInTheCacheAndForOctreesThatCome)
{
  const auto mesh = slice(0, 90);
  vtkNew<vtkPolyDataToSVO> filter;
  filter->SetMaximumLevel(5);
  filter->SetInputData(mesh);
  filter->Update();
  const double own = octreeOf(filter->GetOutput())->GetVoxelSize();
  vtkNew<vtkPolyData> carrying;
  carrying->ShallowCopy(filter->GetOutput());

  filter->SetModelBounds(-2, 2, -2, 2, -2, 2);
  filter->Update();
  const double model = octreeOf(filter->GetOutput())->GetVoxelSize();
  EXPECT_NEAR(model * 32.0, 4.0, 0.01);
  EXPECT_EQ(filter->GetNumberOfBuilds(), 2);
  filter->SetModelBounds(1, -1, 1, -1, 1, -1);
  filter->Update();
  EXPECT_EQ(octreeOf(filter->GetOutput())->GetVoxelSize(), own);
  EXPECT_EQ(filter->GetNumberOfBuilds(), 2);
  filter->SetModelBounds(-2, 2, 5, -5, 1, -1); // says nothing, either
  filter->Update();
  EXPECT_EQ(octreeOf(filter->GetOutput())->GetVoxelSize(), own);
  EXPECT_EQ(filter->GetNumberOfBuilds(), 2);
  EXPECT_EQ(filter->GetNumberOfCachedOctrees(), 2);

  vtkNew<vtkPolyDataToSVO> second;
  second->SetMaximumLevel(5);
  second->SetInputData(carrying);
  second->Update();
  EXPECT_EQ(second->GetNumberOfBuilds(), 0); // it is what would be built
  second->SetModelBounds(-2, 2, -2, 2, -2, 2);
  filter->ReleaseCache(); // which would be shared
  second->Update();
  EXPECT_EQ(second->GetNumberOfBuilds(), 1);
  EXPECT_EQ(octreeOf(second->GetOutput())->GetVoxelSize(), model);
  vtkNew<vtkPolyDataToSVO> third;
  third->SetMaximumLevel(5);
  third->SetModelBounds(-2, 2, -2, 2, -2, 2);
  third->SetInputData(second->GetOutput());
  third->Update();
  EXPECT_EQ(third->GetNumberOfBuilds(), 0);
}

// A block of few triangles needs no voxels as small as those of a large mesh.
TEST(PPolyDataToSVO, BlocksAreNoFinerThanTheirTrianglesAndPiecesAgree)
{
  vtkNew<vtkPPolyDataToSVO> filter;
  filter->AdaptLevelOn();
  const auto levelOf = [&filter](vtkPolyData* mesh)
  {
    filter->SetInputDataObject(mesh);
    filter->Update();
    return octreeOf(filter->GetOutputDataObject(0))->GetNumberOfLevels();
  };
  const int level = levelOf(slice(0.0, 360.0));
  EXPECT_LT(level, 8);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, slice(0.0, 360.0));
  blocks->SetBlock(1, slice(0.0, 180.0));
  filter->SetInputDataObject(blocks);
  filter->Update();
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  EXPECT_EQ(octreeOf(output->GetBlock(0))->GetNumberOfLevels(), level);
  EXPECT_LE(octreeOf(output->GetBlock(1))->GetNumberOfLevels(), 8);

  vtkNew<vtkPartitionedDataSet> pieces;
  pieces->SetPartition(0, slice(0.0, 200.0));
  pieces->SetPartition(1, slice(200.0, 220.0));
  filter->SetInputDataObject(pieces);
  filter->Update();
  auto* parts = vtkPartitionedDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  expectSameCube(
    octreeOf(parts->GetPartitionAsDataObject(0)), octreeOf(parts->GetPartitionAsDataObject(1)));

  filter->SetMaximumLevel(3);
  EXPECT_EQ(levelOf(slice(0.0, 360.0)), 3); // it stays the limit
  filter->SetMaximumLevel(9);
  filter->SetLeafGeometryToPlane(); // whose error is the voxel
  EXPECT_EQ(levelOf(slice(0.0, 360.0)), 9);
  filter->SetLeafGeometryToAutomatic();
  filter->AdaptLevelOff();
  EXPECT_EQ(levelOf(slice(0.0, 360.0)), 9);
}
