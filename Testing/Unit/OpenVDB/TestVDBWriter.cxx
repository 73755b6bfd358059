// Octrees to files and back: the same leaves, and level sets that are the surface.
#include "svoVDBLeaves.h"
#include "svoVDBLevelSet.h"
#include "svoVDBTest.h"
#include "vtkImplicitFunctionToSVO.h"
#include "vtkPolyDataToSVO.h"

#include "vtkErrorCode.h"
#include "vtkPlaneSource.h"
#include "vtkPoints.h"
#include "vtkSphere.h"
#include "vtkStaticCellLocator.h"

#include <fstream>

namespace
{
using namespace svotest;

struct Writing
{
  vtkNew<vtkSVOVDBWriter> writer;
  svo::TestMessages messages{ writer };
  Writing(vtkPolyData* mesh, const char* file, bool levelSet = false)
  {
    this->writer->SetInputData(mesh);
    this->writer->SetFileName(file);
    this->writer->SetWriteLevelSet(levelSet);
    this->writer->Write();
  }
};

/// A sphere of triangles with three waves around it.
vtkSmartPointer<vtkPolyData> waves()
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(120);
  source->SetPhiResolution(80);
  source->SetRadius(1.0);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  vtkPoints* points = source->GetOutput()->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double x[3];
    points->GetPoint(i, x);
    const double f = 1.0 + 0.15 * std::sin(5.0 * x[2]) * std::cos(4.0 * x[0]);
    points->SetPoint(i, 3.0 + f * x[0], -2.0 + f * x[1], 0.5 + f * x[2]);
  }
  return source->GetOutput();
}

vtkSmartPointer<vtkPolyData> ball(int level)
{
  vtkNew<vtkSphere> sphere;
  sphere->SetCenter(4.0, 5.0, 6.0);
  sphere->SetRadius(0.8);
  vtkNew<vtkImplicitFunctionToSVO> filter;
  filter->SetImplicitFunction(sphere);
  filter->SetModelBounds(3.0, 5.0, 4.0, 6.0, 5.0, 7.0);
  filter->SetMaximumLevel(level);
  filter->Update();
  return filter->GetOutput();
}

void expectSameLeaves(vtkPolyData* mesh)
{
  const TemporaryFile file("leaves.vdb");
  Writing writing(mesh, file.name());
  EXPECT_EQ(writing.messages.all(), "");
  const svo::Octree before = octreeOf(mesh);
  Reading reading(file.name());
  const svo::Octree after = reading.octree();
  EXPECT_EQ(after.level(), before.level());
  EXPECT_EQ(after.header().voxelCount, before.header().voxelCount);
  ASSERT_EQ(cellsOf(after), cellsOf(before));
  for (const Cell& cell : cellsOf(before))
  {
    ASSERT_LT(glm::length(placeOf(before, cell) - placeOf(after, cell)),
      1e-9 * before.header().voxelSize * std::exp2(before.level()));
  }
}
}

TEST(VDBWriter, LeavesAreTheSameWhenReadAgain)
{
  const auto mesh = waves();
  for (int level = 6; level <= 9; ++level)
  {
    expectSameLeaves(converted(mesh, level));
    expectSameLeaves(ball(level));
  }
  expectSameLeaves(converted(mesh, 3));
}

TEST(VDBWriter, SmallOctreesAreTheSameButForTheirCube)
{
  for (const int level : { 1, 2 })
  {
    const auto mesh = ball(level);
    const TemporaryFile file("small.vdb");
    Writing writing(mesh, file.name());
    Reading reading(file.name());
    EXPECT_EQ(cellsOf(reading.octree()), cellsOf(octreeOf(mesh)));
  }
}

TEST(VDBWriter, FramesAndSolidsAreTheSameWhenReadAgain)
{
  auto grid = openvdb::FloatGrid::create(0.0f);
  grid->fill(openvdb::CoordBBox({ -40, 3, 7 }, { 30, 50, 33 }), 1.0f, true);
  grid->getAccessor().setValueOff({ 0, 20, 20 });
  grid->setTransform(transformOfMatrix(affine(true)));
  const TemporaryFile file("solid.vdb"), again("again.vdb");
  file.write({ grid });
  Reading first(file.name());
  const svo::Octree before = first.octree();
  ASSERT_TRUE(before.hasTransform());
  ASSERT_EQ(before.header().voxelCount, 71u * 48u * 27u - 1u);
  expectSameLeaves(first.output());
  // Full nodes are tiles.
  const openvdb::BoolGrid::Ptr leaves = svo::leavesOf(before);
  EXPECT_GT(leaves->tree().activeTileCount(), 0u);
  EXPECT_EQ(leaves->activeVoxelCount(), before.header().voxelCount);
  // Without cubes there are no distances.
  Writing sheared(first.output(), again.name(), true);
  EXPECT_EQ(sheared.messages.errors.size(), 0u);
  ASSERT_EQ(sheared.messages.warnings.size(), 1u);
  EXPECT_NE(sheared.messages.all().find("stretched"), std::string::npos);
  Reading second(again.name());
  EXPECT_EQ(second.reader->GetNumberOfGrids(), 1);
}

TEST(VDBWriter, DistancesAreThoseToTheTriangles)
{
  const auto mesh = converted(waves(), 6);
  const svo::Octree octree = octreeOf(mesh);
  std::string message;
  const auto grid = svo::levelSetOf(octree, mesh, 3.0, nullptr, message);
  ASSERT_TRUE(grid);
  EXPECT_EQ(message, "");
  EXPECT_EQ(grid->getGridClass(), openvdb::GRID_LEVEL_SET);
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(mesh);
  locator->BuildLocator();
  const double voxel = octree.header().voxelSize;
  std::size_t compared = 0, inside = 0;
  double worst = 0.0;
  for (auto value = grid->cbeginValueOn(); value; ++value)
  {
    EXPECT_LT(std::abs(*value), 3.0 * voxel);
    const openvdb::Vec3d at = grid->transform().indexToWorld(value.getCoord());
    double nearest[3], square;
    vtkIdType cell;
    int part;
    locator->FindClosestPoint(at.asPointer(), nearest, cell, part, square);
    const double error = std::abs(std::abs(*value) - std::sqrt(square)) / voxel;
    worst = std::max(worst, error);
    if (std::sqrt(square) < voxel)
    {
      const double r = glm::length(glm::dvec3(at.x() - 3.0, at.y() + 2.0, at.z() - 0.5));
      inside += *value < 0.0;
      EXPECT_FALSE(r < 0.8 && *value > 0.0);
      EXPECT_FALSE(r > 1.2 && *value < 0.0);
    }
    ++compared;
  }
  EXPECT_GT(compared, 10000u);
  // The band is whole: what is not in it is further away.
  const auto values = grid->getConstAccessor();
  for (int i = 0; i < 100000; ++i)
  {
    const openvdb::Coord at(i * 7 % 70 - 3, i * 13 % 71 - 3, i * 29 % 69 - 3);
    const openvdb::Vec3d x = grid->transform().indexToWorld(at);
    double nearest[3], square;
    vtkIdType cell;
    int part;
    locator->FindClosestPoint(x.asPointer(), nearest, cell, part, square);
    ASSERT_EQ(values.isValueOn(at), std::sqrt(square) < 3.0 * voxel)
      << std::sqrt(square) / voxel << at;
  }
  EXPECT_GT(inside, 1000u);
  EXPECT_LT(worst, 1e-4) << "floats";
}

TEST(VDBWriter, LevelSetsReadAgainAreTheSurface)
{
  for (const bool planes : { false, true })
  {
    for (int level = 6; level <= 8; ++level)
    {
      const auto mesh = planes ? ball(level) : converted(waves(), level);
      const TemporaryFile file("surface.vdb");
      Writing writing(mesh, file.name(), true);
      EXPECT_EQ(writing.messages.all(), "");
      Reading reading(file.name());
      reading.reader->SetGridName("surface");
      const svo::Octree after = reading.octree();
      vtkNew<vtkSparseVoxelOctree> a, b;
      ASSERT_TRUE(a->Initialize(mesh));
      ASSERT_TRUE(b->Initialize(reading.output()));
      const double voxel = a->GetVoxelSize();
      double bounds[6];
      a->GetBounds(bounds);
      const glm::dvec3 centre(0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]),
        0.5 * (bounds[4] + bounds[5]));
      for (int i = 0; i < 1000; ++i)
      {
        const double z = -0.999 + i * 0.002, angle = 2.4 * i, r = std::sqrt(1.0 - z * z);
        const glm::dvec3 from =
          centre + 3.0 * glm::dvec3(r * std::cos(angle), r * std::sin(angle), z);
        double s, t, x[3], y[3];
        vtkIdType cell;
        ASSERT_EQ(a->IntersectWithLine(&from[0], &centre[0], s, x, cell), 1);
        ASSERT_EQ(b->IntersectWithLine(&from[0], &centre[0], t, y, cell), 1);
        ASSERT_LT(glm::length(glm::dvec3(x[0] - y[0], x[1] - y[1], x[2] - y[2])), voxel)
          << planes << level << " " << i;
      }
      EXPECT_NEAR(static_cast<double>(after.header().voxelCount),
        static_cast<double>(octreeOf(mesh).header().voxelCount),
        0.1 * static_cast<double>(after.header().voxelCount));
    }
  }
}

TEST(VDBWriter, VoxelsHaveALevelSetOfTheirFaces)
{
  auto grid = openvdb::MaskGrid::create();
  grid->fill(openvdb::CoordBBox({ 0, 0, 0 }, { 9, 19, 29 }), true, true);
  const TemporaryFile file("box.vdb");
  file.write({ grid });
  Reading reading(file.name());
  std::string message;
  const auto surface = svo::levelSetOf(reading.octree(), reading.output(), 3.0, nullptr, message);
  ASSERT_TRUE(surface);
  const auto values = surface->getConstAccessor();
  // The voxels in the corners of the cube that the reader has put around them have other indices.
  const openvdb::Coord at = openvdb::Coord::round(surface->worldToIndex({ 0.0, 10.0, 15.0 }));
  EXPECT_NEAR(values.getValue(at), -0.5, 1e-5);
  EXPECT_NEAR(values.getValue(at.offsetBy(-1, 0, 0)), 0.5, 1e-5);
  EXPECT_NEAR(values.getValue(at.offsetBy(-3, 0, 0)), 2.5, 1e-5);
  EXPECT_NEAR(values.getValue(at.offsetBy(2, 0, 0)), -2.5, 1e-5);
}

TEST(VDBWriter, WhatEnclosesNothingIsAWarning)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(4, 4);
  plane->Update();
  const TemporaryFile file("plane.vdb");
  Writing writing(converted(plane->GetOutput(), 6), file.name(), true);
  EXPECT_EQ(writing.messages.errors.size(), 0u);
  EXPECT_EQ(writing.messages.warnings.size(), 1u);
  EXPECT_NE(writing.messages.all().find("encloses nothing"), std::string::npos);
  Reading reading(file.name());
  EXPECT_EQ(reading.reader->GetNumberOfGrids(), 2);
}

TEST(VDBWriter, WhatCannotBeWrittenIsOneErrorAndLosesNothing)
{
  const TemporaryFile file("kept.vdb");
  std::ofstream(file.name()) << "precious";
  const auto good = converted(waves(), 5);
  const auto expect = [&](vtkPolyData* mesh, const char* name, const std::string& text)
  {
    Writing writing(mesh, name);
    EXPECT_EQ(writing.messages.errors.size(), 1u) << writing.messages.all();
    EXPECT_NE(writing.messages.all().find(text), std::string::npos) << writing.messages.all();
    EXPECT_NE(writing.writer->GetErrorCode(), static_cast<unsigned long>(vtkErrorCode::NoError));
    std::string content;
    std::getline(std::ifstream(file.name()), content);
    EXPECT_EQ(content, "precious");
  };
  expect(waves(), file.name(), "carries no octree");
  expect(good, "/nowhere/file.vdb", "cannot be opened");
  expect(good, nullptr, "has no name");
}
