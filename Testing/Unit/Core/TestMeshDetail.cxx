// How deep an octree must be to tell a mesh's triangles apart, and what is built then.
#include "svoMeshDetail.h"
#include "svoMeshOctree.h"
#include "svoOctree.h"

#include "vtkAppendPolyData.h"
#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace
{
vtkSmartPointer<vtkPolyData> sphere(int resolution, double radius = 1.0)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->SetRadius(radius);
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkPolyData> grid(int resolution, double halfSize)
{
  vtkNew<vtkPlaneSource> source;
  source->SetOrigin(-halfSize, -halfSize, 0.0);
  source->SetPoint1(halfSize, -halfSize, 0.0);
  source->SetPoint2(-halfSize, halfSize, 0.0);
  source->SetResolution(resolution, resolution);
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkPolyData> together(vtkPolyData* a, vtkPolyData* b)
{
  vtkNew<vtkAppendPolyData> append;
  append->AddInputData(a);
  append->AddInputData(b);
  append->Update();
  return append->GetOutput();
}

svo::Octree built(vtkPolyData* mesh, int level)
{
  svo::MeshOctreeOptions options;
  options.level = level;
  svo::Octree octree;
  std::string message;
  svo::buildMeshOctree(mesh, options, octree, message);
  return octree;
}

/// Share of the bricks that have more triangles than a ray's lanes test side by side.
double longLists(const svo::Octree& octree)
{
  constexpr std::uint32_t Few = 16;
  const std::uint32_t first = octree.brickBegin();
  const auto end = static_cast<std::uint32_t>(octree.header().nodeCount);
  std::uint32_t lists = 0;
  for (std::uint32_t brick = first; brick < end; ++brick)
  {
    std::uint32_t count, inlineId;
    octree.brickTriangles(brick, count, inlineId);
    lists += count > Few;
  }
  return static_cast<double>(lists) / (end - first);
}
}

TEST(MeshDetail, BricksHaveFewTrianglesAndThereAreFewBricks)
{
  const vtkSmartPointer<vtkPolyData> meshes[] = { sphere(16), sphere(34), sphere(80), grid(40, 1.0),
    together(grid(50, 1.0), sphere(40, 0.1)) };
  for (const auto& mesh : meshes)
  {
    const int level = svo::detailLevel(mesh);
    ASSERT_LE(level, 14);
    const svo::Octree octree = built(mesh, level);
    EXPECT_LT(longLists(octree), 0.02) << mesh->GetNumberOfPolys();
    if (level > 4)
    {
      EXPECT_GT(longLists(built(mesh, level - 4)), 0.01) << mesh->GetNumberOfPolys();
    }
  }
}

TEST(MeshDetail, ADenseCornerOfALargeMeshCounts)
{
  EXPECT_EQ(svo::detailLevel(grid(1, 1.0)), 4);
  const int alone = svo::detailLevel(grid(40, 1.0));
  EXPECT_LE(alone, 8);
  // A hundred times smaller: six or seven levels more.
  const int both = svo::detailLevel(together(grid(40, 1.0), grid(40, 0.01)));
  EXPECT_GE(both, alone + 6);
  EXPECT_LE(both, alone + 7);
}

TEST(MeshDetail, TheSameWhereverAndHoweverLargeTheMeshIs)
{
  const auto small = sphere(30);
  const auto large = sphere(30);
  for (vtkIdType i = 0; i < large->GetNumberOfPoints(); ++i)
  {
    double x[3];
    large->GetPoint(i, x);
    large->GetPoints()->SetPoint(i, 4096.0 * x[0], 4096.0 * x[1], 4096.0 * x[2]);
  }
  EXPECT_EQ(svo::detailLevel(large), svo::detailLevel(small));
  EXPECT_NEAR(svo::detailVoxel(large), 4096.0 * svo::detailVoxel(small), 1.0);
  const int level = svo::detailLevel(small);
  EXPECT_EQ(svo::levelOfVoxel(small->GetBounds(), svo::detailVoxel(small), 10), level);
  EXPECT_EQ(svo::levelOfVoxel(small->GetBounds(), svo::detailVoxel(small), 3), 3);
  EXPECT_EQ(svo::levelOfVoxel(small->GetBounds(), 0.0, 10), 10);
  // In a cube of eight times the edge it takes three levels more to have that voxel.
  const double wide[6] = { -8.0, 8.0, -1.0, 1.0, -1.0, 1.0 };
  EXPECT_EQ(svo::levelOfVoxel(wide, svo::detailVoxel(small), 20), level + 3);
}

TEST(MeshDetail, MeshesWithoutMeasureDoNoHarm)
{
  vtkNew<vtkPolyData> none;
  EXPECT_GE(svo::detailLevel(none), 4);
  const auto broken = sphere(20);
  broken->GetPoints()->SetPoint(7, std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0);
  broken->GetPoints()->SetPoint(8, std::numeric_limits<double>::infinity(), 0.0, 0.0);
  EXPECT_EQ(svo::detailLevel(broken), svo::detailLevel(sphere(20)));
  // All in one place: no level tells them apart.
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (vtkIdType i = 0; i < 300; ++i)
  {
    points->InsertNextPoint(1.0, 2.0, 3.0);
  }
  for (vtkIdType i = 0; i < 300; i += 3)
  {
    cells->InsertNextCell({ i, i + 1, i + 2 });
  }
  vtkNew<vtkPolyData> heap;
  heap->SetPoints(points);
  heap->SetPolys(cells);
  EXPECT_EQ(svo::detailLevel(heap), svo::MaximumLevel);
  EXPECT_EQ(svo::detailVoxel(heap), 0.0);
}
