// The cells of an octree as a surface: closed, outwards, with shared points, at every level.
#include "vtkSVOToPolyData.h"

#include "svoTestMessages.h"
#include "vtkPolyDataToSVO.h"
#include "vtkSparseVoxelOctree.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFeatureEdges.h"
#include "vtkFieldData.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkTriangleFilter.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace
{
vtkSmartPointer<vtkPolyData> octreeSphere(int level, int precision = vtkAlgorithm::SINGLE_PRECISION)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(40);
  source->SetPhiResolution(30);
  source->SetRadius(2.0);
  source->SetCenter(5.0, 0.0, -1.0);
  source->SetOutputPointsPrecision(precision);
  vtkNew<vtkPolyDataToSVO> filter;
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetMaximumLevel(level);
  filter->Update();
  return filter->GetOutput();
}

vtkSmartPointer<vtkPolyData> cellsOf(vtkPolyData* mesh, int level, bool interior = false)
{
  vtkNew<vtkSVOToPolyData> filter;
  filter->SetInputData(mesh);
  filter->SetLevel(level);
  filter->SetInteriorFaces(interior);
  filter->Update();
  return filter->GetOutput();
}

vtkIdType boundaryEdges(vtkPolyData* surface)
{
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(surface);
  edges->FeatureEdgesOff();
  edges->NonManifoldEdgesOff();
  edges->ManifoldEdgesOff();
  edges->BoundaryEdgesOn();
  edges->Update();
  return edges->GetOutput()->GetNumberOfCells();
}

double volumeOf(vtkPolyData* surface)
{
  // Signed, by the divergence theorem: negative if faces look inwards.
  double volume = 0.0;
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(surface);
  triangles->Update();
  vtkPolyData* mesh = triangles->GetOutput();
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    mesh->GetCellPoints(i, ids);
    double a[3], b[3], c[3], n[3];
    mesh->GetPoint(ids->GetId(0), a);
    mesh->GetPoint(ids->GetId(1), b);
    mesh->GetPoint(ids->GetId(2), c);
    vtkMath::Cross(b, c, n);
    volume += vtkMath::Dot(a, n) / 6.0;
  }
  return volume;
}

/// Occupied cells of a level, by asking for each.
vtkIdType countOccupied(vtkPolyData* mesh, int level)
{
  vtkNew<vtkSparseVoxelOctree> octree;
  octree->Initialize(mesh);
  const int n = 1 << level;
  const double* b = octree->GetBounds();
  const double edge = (b[1] - b[0]) / n;
  vtkIdType count = 0;
  for (int z = 0; z < n; ++z)
  {
    for (int y = 0; y < n; ++y)
    {
      for (int x = 0; x < n; ++x)
      {
        const double centre[3] = { b[0] + (x + 0.5) * edge, b[2] + (y + 0.5) * edge,
          b[4] + (z + 0.5) * edge };
        count += octree->IsOccupied(centre, level);
      }
    }
  }
  return count;
}
}

TEST(SVOToPolyData, TheSurfaceOfEveryLevelIsClosedAndLooksOutwards)
{
  for (int depth : { 5, 6 }) // an odd and an even octree
  {
    const auto mesh = octreeSphere(depth, vtkAlgorithm::DOUBLE_PRECISION);
    vtkNew<vtkSparseVoxelOctree> octree;
    ASSERT_TRUE(octree->Initialize(mesh));
    for (int level = 0; level <= depth; ++level)
    {
      const auto surface = cellsOf(mesh, level);
      ASSERT_GT(surface->GetNumberOfPolys(), 0);
      EXPECT_EQ(boundaryEdges(surface), 0) << "level " << level;
      const double edge = std::ldexp(octree->GetVoxelSize(), depth - level);
      const vtkIdType occupied = countOccupied(mesh, level);
      EXPECT_NEAR(volumeOf(surface), occupied * edge * edge * edge, 1e-6 * volumeOf(surface))
        << "level " << level;
    }
  }
}

TEST(SVOToPolyData, TheWholeCubeIsSixQuadsOnEightPoints)
{
  for (int depth : { 4, 5 })
  {
    const auto mesh = octreeSphere(depth);
    const auto surface = cellsOf(mesh, 0);
    EXPECT_EQ(surface->GetNumberOfPolys(), 6);
    EXPECT_EQ(surface->GetNumberOfPoints(), 8);
    vtkNew<vtkSparseVoxelOctree> octree;
    octree->Initialize(mesh);
    for (int i = 0; i < 6; ++i)
    {
      EXPECT_NEAR(surface->GetBounds()[i], octree->GetBounds()[i], 1e-6);
    }
  }
}

TEST(SVOToPolyData, LeavesAreTheDefaultAndTheLimit)
{
  const auto mesh = octreeSphere(5);
  const auto leaves = cellsOf(mesh, -1);
  EXPECT_EQ(leaves->GetNumberOfPolys(), cellsOf(mesh, 5)->GetNumberOfPolys());
  EXPECT_EQ(leaves->GetNumberOfPolys(), cellsOf(mesh, 17)->GetNumberOfPolys());
  EXPECT_EQ(leaves->GetCellData()->GetArray("Level")->GetRange()[0], 5.0);
  EXPECT_EQ(cellsOf(mesh, 3)->GetCellData()->GetArray("Level")->GetRange()[1], 3.0);
  vtkNew<vtkSVOToPolyData> filter;
  EXPECT_EQ(filter->GetLevel(), -1);
  filter->SetLevel(-5);
  EXPECT_EQ(filter->GetLevel(), -1);
}

TEST(SVOToPolyData, InteriorFacesGiveEveryCellItsSix)
{
  const auto mesh = octreeSphere(5);
  for (int level : { 2, 3, 4, 5 })
  {
    EXPECT_EQ(cellsOf(mesh, level, true)->GetNumberOfPolys(), 6 * countOccupied(mesh, level));
  }
}

TEST(SVOToPolyData, PointsAreSharedAndKeepThePrecisionOfTheMesh)
{
  for (int precision : { vtkAlgorithm::SINGLE_PRECISION, vtkAlgorithm::DOUBLE_PRECISION })
  {
    const auto mesh = octreeSphere(4, precision);
    const auto surface = cellsOf(mesh, -1);
    EXPECT_EQ(surface->GetPoints()->GetDataType(), mesh->GetPoints()->GetDataType());
    std::set<std::vector<double>> different;
    for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
    {
      const double* p = surface->GetPoint(i);
      different.insert({ p[0], p[1], p[2] });
    }
    EXPECT_EQ(static_cast<vtkIdType>(different.size()), surface->GetNumberOfPoints());
  }
}

TEST(SVOToPolyData, EveryFaceNamesAMeshCellThatTouchesItsNeighbourhood)
{
  const auto mesh = octreeSphere(6);
  vtkNew<vtkSparseVoxelOctree> octree;
  octree->Initialize(mesh);
  for (int level : { 4, 5, 6 })
  {
    const auto surface = cellsOf(mesh, level);
    vtkDataArray* ids = surface->GetCellData()->GetArray("CellId");
    ASSERT_NE(ids, nullptr);
    const double edge = std::ldexp(octree->GetVoxelSize(), 6 - level);
    // The cell lies in the same brick of 4^3 voxels or in the same coarser cell.
    const double reach = std::max(edge, 4.0 * octree->GetVoxelSize());
    for (vtkIdType i = 0; i < surface->GetNumberOfCells(); ++i)
    {
      double face[6], cell[6];
      surface->GetCellBounds(i, face);
      mesh->GetCellBounds(static_cast<vtkIdType>(ids->GetComponent(i, 0)), cell);
      for (int k = 0; k < 3; ++k)
      {
        EXPECT_LE(cell[2 * k], face[2 * k + 1] + reach);
        EXPECT_GE(cell[2 * k + 1], face[2 * k] - reach);
      }
    }
  }
}

TEST(SVOToPolyData, TheResultCarriesNoOctree)
{
  EXPECT_EQ(cellsOf(octreeSphere(3), -1)->GetFieldData()->GetNumberOfArrays(), 0);
}

TEST(SVOToPolyData, AnInputWithoutAFittingOctreeIsOneError)
{
  vtkNew<vtkSphereSource> plain;
  vtkNew<vtkSVOToPolyData> filter;
  filter->SetInputConnection(plain->GetOutputPort());
  {
    const svo::TestMessages messages(filter);
    filter->Update();
    EXPECT_EQ(messages.errors.size(), 1u);
    EXPECT_NE(messages.all().find("carries no octree"), std::string::npos);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  }
  vtkNew<vtkPolyData> changed;
  changed->DeepCopy(octreeSphere(4));
  changed->GetPoints()->SetPoint(0, 9.0, 9.0, 9.0);
  changed->GetPoints()->Modified();
  filter->SetInputData(changed);
  const svo::TestMessages messages(filter);
  filter->Update();
  EXPECT_EQ(messages.errors.size(), 1u);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
}

TEST(SVOToPolyData, AnEmptyOctreeIsAnEmptySurface)
{
  vtkNew<vtkPolyData> empty;
  vtkNew<vtkPolyDataToSVO> convert;
  convert->SetInputData(empty);
  vtkNew<vtkSVOToPolyData> filter;
  filter->SetInputConnection(convert->GetOutputPort());
  const svo::TestMessages messages(filter);
  filter->Update();
  EXPECT_EQ(messages.all(), "");
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
}

TEST(SVOToPolyData, CanBeAborted)
{
  vtkNew<vtkSVOToPolyData> filter;
  filter->SetInputData(octreeSphere(8)); // more cells than one stride between reports
  vtkNew<vtkCallbackCommand> observer;
  observer->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1); });
  filter->AddObserver(vtkCommand::ProgressEvent, observer);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
}
