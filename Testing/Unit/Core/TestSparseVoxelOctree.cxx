// The handle on an octree: what it says about the octree, and where lines hit it.
#include "vtkSparseVoxelOctree.h"

#include "svoOctree.h"
#include "svoTestMessages.h"
#include "vtkPolyDataToSVO.h"

#include "vtkCellArray.h"
#include "vtkFieldData.h"
#include "vtkMinimalStandardRandomSequence.h"
#include "vtkNew.h"
#include "vtkParametricFunctionSource.h"
#include "vtkParametricTorus.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkStaticCellLocator.h"
#include "vtkStripper.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace
{
vtkSmartPointer<vtkPolyData> sphere(int precision = vtkAlgorithm::SINGLE_PRECISION)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(40);
  source->SetPhiResolution(30);
  source->SetRadius(1.0);
  source->SetCenter(3.0, -2.0, 10.0);
  source->SetOutputPointsPrecision(precision);
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkPolyData> torus()
{
  vtkNew<vtkParametricTorus> shape;
  vtkNew<vtkParametricFunctionSource> source;
  source->SetParametricFunction(shape);
  source->SetUResolution(40);
  source->SetVResolution(24);
  source->SetWResolution(24);
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkPolyData> converted(vtkPolyData* mesh, int level, int leafGeometry)
{
  vtkNew<vtkPolyDataToSVO> filter;
  filter->SetInputData(mesh);
  filter->SetMaximumLevel(level);
  filter->SetLeafGeometry(leafGeometry);
  filter->Update();
  return filter->GetOutput();
}

/// Lines across the bounding cube in all directions; half of them start or end inside it.
struct Lines
{
  explicit Lines(const double* bounds)
    : Bounds(bounds)
  {
    this->Random->SetSeed(7);
  }
  void next(double p1[3], double p2[3])
  {
    for (double* p : { p1, p2 })
    {
      const double margin = this->value() < 0.5 ? 0.0 : 1.0;
      for (int i = 0; i < 3; ++i)
      {
        const double low = this->Bounds[2 * i];
        const double extent = this->Bounds[2 * i + 1] - low;
        p[i] = low + extent * (this->value() * (1.0 + 2.0 * margin) - margin);
      }
    }
  }
  double value()
  {
    this->Random->Next();
    return this->Random->GetValue();
  }
  const double* Bounds;
  vtkNew<vtkMinimalStandardRandomSequence> Random;
};

/// Distance of the point to the border of a cell, relative to nothing: hits near an edge may name
/// either neighbour.
bool sameTriangleOrNeighbours(vtkPolyData* mesh, vtkIdType a, vtkIdType b)
{
  if (a == b)
  {
    return true;
  }
  vtkNew<vtkIdList> pa, pb;
  mesh->GetCellPoints(a, pa);
  mesh->GetCellPoints(b, pb);
  pa->IntersectWith(pb);
  return pa->GetNumberOfIds() > 0;
}

void compareWithLocator(vtkPolyData* mesh, int level, int count)
{
  const auto carrier = converted(mesh, level, vtkPolyDataToSVO::TRIANGLE);
  vtkNew<vtkSparseVoxelOctree> octree;
  ASSERT_TRUE(octree->Initialize(carrier));
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(mesh);
  locator->BuildLocator();

  Lines lines(mesh->GetBounds());
  int hits = 0;
  int borderline = 0; // through an edge, within rounding
  for (int i = 0; i < count; ++i)
  {
    double p1[3], p2[3], t = -1.0, x[3] = {}, expectedT = -1.0, expectedX[3], pcoords[3];
    vtkIdType cell = -1, expectedCell = -1;
    int subId = 0;
    lines.next(p1, p2);
    const int hit = octree->IntersectWithLine(p1, p2, t, x, cell);
    const int expected =
      locator->IntersectWithLine(p1, p2, 0.0, expectedT, expectedX, pcoords, subId, expectedCell);
    ASSERT_EQ(hit, expected) << "line " << i;
    if (!hit)
    {
      EXPECT_EQ(t, -1.0);
      EXPECT_EQ(cell, -1);
      continue;
    }
    ++hits;
    double length = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      length += (p2[k] - p1[k]) * (p2[k] - p1[k]);
      EXPECT_NEAR(x[k], p1[k] + t * (p2[k] - p1[k]), 1e-12 * (1.0 + std::abs(x[k])));
    }
    length = std::sqrt(length);
    EXPECT_NEAR(t * length, expectedT * length, 1e-3 * octree->GetVoxelSize()) << "line " << i;
    if (cell != expectedCell)
    {
      ++borderline;
      EXPECT_TRUE(sameTriangleOrNeighbours(mesh, cell, expectedCell)) << "line " << i;
    }
  }
  EXPECT_GT(hits, count / 4);
  EXPECT_LE(borderline, hits / 1000);
}
}

TEST(SparseVoxelOctree, DescribesTheOctree)
{
  const auto mesh = converted(sphere(), 6, vtkPolyDataToSVO::AUTOMATIC);
  vtkNew<vtkSparseVoxelOctree> octree;
  ASSERT_TRUE(octree->Initialize(mesh));
  EXPECT_EQ(octree->GetNumberOfLevels(), 6);
  EXPECT_GT(octree->GetNumberOfVoxels(), 0);
  EXPECT_GT(octree->GetNumberOfNodes(), octree->GetNumberOfVoxels() / 64);
  EXPECT_LT(octree->GetNumberOfNodes(), octree->GetNumberOfVoxels());
  EXPECT_EQ(octree->GetActualMemorySize(), (octree->GetOctree().bytes() + 1023) / 1024);
  double cube[6];
  octree->GetBounds(cube);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(cube[2 * i + 1] - cube[2 * i], 64.0 * octree->GetVoxelSize(), 1e-12);
    EXPECT_LE(cube[2 * i], mesh->GetBounds()[2 * i]);
    EXPECT_GE(cube[2 * i + 1], mesh->GetBounds()[2 * i + 1]);
    EXPECT_EQ(octree->GetBounds()[2 * i], cube[2 * i]);
  }
}

TEST(SparseVoxelOctree, EveryPointOfTheMeshIsInAnOccupiedCellOfEveryLevel)
{
  for (int level : { 5, 6 })
  {
    const auto mesh = converted(sphere(), level, vtkPolyDataToSVO::AUTOMATIC);
    vtkNew<vtkSparseVoxelOctree> octree;
    ASSERT_TRUE(octree->Initialize(mesh));
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      for (int l = 0; l <= level; ++l)
      {
        EXPECT_TRUE(octree->IsOccupied(mesh->GetPoint(i), l)) << "point " << i << " level " << l;
      }
    }
  }
}

TEST(SparseVoxelOctree, IsNotOccupiedInsideOutsideOrNowhere)
{
  vtkNew<vtkSparseVoxelOctree> octree;
  ASSERT_TRUE(octree->Initialize(converted(sphere(), 6, vtkPolyDataToSVO::AUTOMATIC)));
  const double centre[3] = { 3.0, -2.0, 10.0 };
  EXPECT_FALSE(octree->IsOccupied(centre, 6));
  EXPECT_FALSE(octree->IsOccupied(centre, 100)); // clamped to 6
  EXPECT_TRUE(octree->IsOccupied(centre, 0));
  EXPECT_TRUE(octree->IsOccupied(centre, -100));
  const double outside[3] = { 3.0, -2.0, 11.5 };
  EXPECT_FALSE(octree->IsOccupied(outside, 0));
  const double nan[3] = { std::nan(""), -2.0, 10.0 };
  EXPECT_FALSE(octree->IsOccupied(nan, 0));
  const double infinite[3] = { 3.0, -HUGE_VAL, 10.0 };
  EXPECT_FALSE(octree->IsOccupied(infinite, 0));
}

TEST(SparseVoxelOctree, LinesHitTrianglesWhereACellLocatorDoes)
{
  compareWithLocator(sphere(), 7, 4000);
  compareWithLocator(sphere(vtkAlgorithm::DOUBLE_PRECISION), 6, 4000);
  compareWithLocator(torus(), 7, 4000);
}

TEST(SparseVoxelOctree, LinesHitVoxelsAndPlanesNearTheSurface)
{
  for (int geometry :
    { vtkPolyDataToSVO::VOXEL, vtkPolyDataToSVO::PLANE, vtkPolyDataToSVO::AUTOMATIC })
  {
    const auto mesh = converted(sphere(), 7, geometry);
    vtkNew<vtkSparseVoxelOctree> octree;
    ASSERT_TRUE(octree->Initialize(mesh));
    // Towards the centre, so that a voxel's width is what an answer can be off by.
    Lines lines(mesh->GetBounds());
    for (int i = 0; i < 500; ++i)
    {
      const double z = 2.0 * lines.value() - 1.0;
      const double phi = 6.28 * lines.value();
      const double r = std::sqrt(1.0 - z * z);
      const double centre[3] = { 3.0, -2.0, 10.0 };
      const double p1[3] = { 3.0 + 3.0 * r * std::cos(phi), -2.0 + 3.0 * r * std::sin(phi),
        10.0 + 3.0 * z };
      double t = -1.0, x[3];
      vtkIdType cell = -1;
      ASSERT_EQ(octree->IntersectWithLine(p1, centre, t, x, cell), 1);
      EXPECT_NEAR(3.0 * t, 2.0, 0.02 + 3.5 * octree->GetVoxelSize()); // 0.02: the mesh's chords
      ASSERT_GE(cell, 0);
      ASSERT_LT(cell, mesh->GetNumberOfCells());
      double bounds[6];
      mesh->GetCellBounds(cell, bounds);
      for (int k = 0; k < 3; ++k)
      {
        EXPECT_GE(x[k], bounds[2 * k] - 8.0 * octree->GetVoxelSize());
        EXPECT_LE(x[k], bounds[2 * k + 1] + 8.0 * octree->GetVoxelSize());
      }
    }
  }
}

TEST(SparseVoxelOctree, HitsOnStripsNameTheStrip)
{
  const auto mesh = sphere();
  vtkNew<vtkStripper> stripper;
  stripper->SetInputData(mesh);
  stripper->Update();
  const auto strips = converted(stripper->GetOutput(), 6, vtkPolyDataToSVO::TRIANGLE);
  vtkNew<vtkSparseVoxelOctree> octree;
  ASSERT_TRUE(octree->Initialize(strips));
  Lines lines(mesh->GetBounds());
  for (int i = 0; i < 200; ++i)
  {
    double p1[3], t, x[3];
    const double centre[3] = { 3.0, -2.0, 10.0 };
    vtkIdType cell = -1;
    double ignored[3];
    lines.next(p1, ignored);
    p1[0] += 5.0;
    ASSERT_EQ(octree->IntersectWithLine(p1, centre, t, x, cell), 1);
    double bounds[6];
    strips->GetCellBounds(cell, bounds);
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_GE(x[k], bounds[2 * k] - 1e-5);
      EXPECT_LE(x[k], bounds[2 * k + 1] + 1e-5);
    }
  }
}

TEST(SparseVoxelOctree, LinesThatCannotHitLeaveTheArgumentsAlone)
{
  vtkNew<vtkSparseVoxelOctree> octree;
  double t = -7.0, x[3] = { 1.0, 2.0, 3.0 };
  vtkIdType cell = -7;
  const double a[3] = { 3.0, -2.0, 20.0 };
  const double b[3] = { 3.0, -2.0, 12.0 };
  const double nan[3] = { std::nan(""), 0.0, 0.0 };
  EXPECT_EQ(octree->IntersectWithLine(a, b, t, x, cell), 0); // before Initialize
  ASSERT_TRUE(octree->Initialize(converted(sphere(), 5, vtkPolyDataToSVO::TRIANGLE)));
  EXPECT_EQ(octree->IntersectWithLine(a, b, t, x, cell), 0); // ends before the surface
  EXPECT_EQ(octree->IntersectWithLine(a, a, t, x, cell), 0); // no direction
  EXPECT_EQ(octree->IntersectWithLine(a, nan, t, x, cell), 0);
  EXPECT_EQ(octree->IntersectWithLine(nan, a, t, x, cell), 0);
  EXPECT_EQ(t, -7.0);
  EXPECT_EQ(x[1], 2.0);
  EXPECT_EQ(cell, -7);
}

TEST(SparseVoxelOctree, AnOctreeThatIsMissingForeignOrDamagedIsOneError)
{
  vtkNew<vtkSparseVoxelOctree> octree;
  const auto mesh = converted(sphere(), 5, vtkPolyDataToSVO::AUTOMATIC);
  ASSERT_TRUE(octree->Initialize(mesh));
  {
    const svo::TestMessages messages(octree);
    EXPECT_FALSE(octree->Initialize(nullptr));
    EXPECT_EQ(messages.errors.size(), 1u);
  }
  {
    const svo::TestMessages messages(octree);
    EXPECT_FALSE(octree->Initialize(sphere()));
    EXPECT_EQ(messages.errors.size(), 1u);
    EXPECT_NE(messages.all().find("carries no octree"), std::string::npos);
  }
  {
    vtkNew<vtkPolyData> other;
    other->ShallowCopy(torus());
    other->GetFieldData()->ShallowCopy(mesh->GetFieldData());
    const svo::TestMessages messages(octree);
    EXPECT_FALSE(octree->Initialize(other));
    EXPECT_EQ(messages.errors.size(), 1u);
    EXPECT_NE(messages.all().find("another mesh"), std::string::npos);
  }
  {
    vtkNew<vtkPolyData> damaged;
    damaged->ShallowCopy(mesh);
    vtkNew<vtkFieldData> field;
    field->DeepCopy(mesh->GetFieldData());
    field->GetArray(0)->SetComponent(0, 0, 0.0);
    damaged->SetFieldData(field);
    const svo::TestMessages messages(octree);
    EXPECT_FALSE(octree->Initialize(damaged));
    EXPECT_EQ(messages.errors.size(), 1u);
    EXPECT_NE(messages.all().find("cannot be used"), std::string::npos);
  }
  EXPECT_EQ(octree->GetNumberOfVoxels(), 0);
  EXPECT_EQ(octree->GetNumberOfLevels(), 0);
  EXPECT_EQ(octree->GetActualMemorySize(), 0u);
  EXPECT_GT(octree->GetBounds()[0], octree->GetBounds()[1]);
}

TEST(SparseVoxelOctree, KeepsTheOctreeAliveWithoutTheMesh)
{
  vtkNew<vtkSparseVoxelOctree> octree;
  {
    const auto mesh = converted(sphere(), 5, vtkPolyDataToSVO::TRIANGLE);
    ASSERT_TRUE(octree->Initialize(mesh));
    mesh->Initialize();
  }
  const double above[3] = { 3.0, -2.0, 20.0 };
  const double centre[3] = { 3.0, -2.0, 10.0 };
  double t, x[3];
  vtkIdType cell;
  EXPECT_EQ(octree->IntersectWithLine(above, centre, t, x, cell), 1);
  EXPECT_NEAR(t, 0.9, 1e-3);
}

// Anybody can write to the array that the octree travels in.
TEST(SparseVoxelOctree, BytesThatChangeAfterwardsDoNotChangeTheHandle)
{
  const auto hits = [](vtkSparseVoxelOctree* octree)
  {
    std::vector<double> found;
    Lines lines(octree->GetBounds());
    for (int i = 0; i < 200; ++i)
    {
      double p1[3], p2[3], t = -1.0, x[3] = {};
      vtkIdType cell = -1;
      lines.next(p1, p2);
      octree->IntersectWithLine(p1, p2, t, x, cell);
      found.insert(found.end(), { t, x[0], x[1], x[2], static_cast<double>(cell) });
    }
    return found;
  };
  using Change = void (*)(vtkUnsignedCharArray*);
  const Change changes[] = { [](vtkUnsignedCharArray* bytes) { bytes->FillValue(0xb7); },
    [](vtkUnsignedCharArray* bytes)
    {
      for (vtkIdType i = static_cast<vtkIdType>(sizeof(svo::Header));
           i < bytes->GetNumberOfValues(); ++i)
      {
        bytes->SetValue(i, static_cast<unsigned char>(i * 167 >> 3));
      }
    },
    [](vtkUnsignedCharArray* bytes) { bytes->Initialize(); },
    [](vtkUnsignedCharArray* bytes) { bytes->Resize(100); } };
  for (const Change change : changes)
  {
    const auto mesh = converted(sphere(), 7, vtkPolyDataToSVO::AUTOMATIC);
    auto* bytes = vtkUnsignedCharArray::SafeDownCast(
      mesh->GetFieldData()->GetAbstractArray("SparseVoxelOctree"));
    vtkNew<vtkSparseVoxelOctree> octree;
    ASSERT_TRUE(octree->Initialize(mesh));
    const vtkIdType voxels = octree->GetNumberOfVoxels();
    const std::vector<double> before = hits(octree);
    change(bytes);
    EXPECT_EQ(octree->GetNumberOfVoxels(), voxels);
    EXPECT_EQ(hits(octree), before);
    // A new handle sees what there is now.
    bytes->Modified();
    vtkNew<vtkSparseVoxelOctree> later;
    const svo::TestMessages messages(later);
    EXPECT_FALSE(later->Initialize(mesh));
    EXPECT_EQ(messages.errors.size(), 1u);
    EXPECT_EQ(hits(octree), before);
  }
}
