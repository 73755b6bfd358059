// What the conversion filter cannot use leads to one message, and the mesh passes through.
#include "svoConversion.h"

#include "vtkCellArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

TEST(PolyDataToSVOBadInput, PointsThatAreNotFiniteLeadToOneWarning)
{
  for (double bad : { std::numeric_limits<double>::quiet_NaN(),
         std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() })
  {
    const auto mesh = sphere();
    mesh->GetPoints()->SetPoint(40, 0.0, bad, 0.0);
    const Conversion conversion(mesh);
    EXPECT_EQ(conversion.messages.warnings.size(), 1u);
    EXPECT_EQ(conversion.messages.errors.size(), 0u);
    EXPECT_NE(conversion.messages.all().find("6 of the mesh's"), std::string::npos)
      << conversion.messages.all();
    EXPECT_GT(conversion.filter->GetNumberOfVoxels(), 0);
    EXPECT_TRUE(conversion.octree());
  }
}

TEST(PolyDataToSVOBadInput, ASeriesWithPointsThatAreNotFiniteLeadsToOneWarning)
{
  vtkNew<vtkPolyDataToSVO> filter;
  const svo::TestMessages messages(filter);
  const auto mesh = sphere();
  filter->SetInputData(mesh);
  for (int step = 0; step < 5; ++step)
  {
    mesh->GetPoints()->SetPoint(40 + step, 0.0, std::nan(""), 0.0);
    mesh->GetPoints()->Modified();
    filter->Update();
  }
  EXPECT_EQ(filter->GetNumberOfBuilds(), 5);
  EXPECT_EQ(messages.warnings.size(), 1u);
  filter->SetMaximumLevel(5); // other octrees: told anew
  filter->Update();
  EXPECT_EQ(messages.warnings.size(), 2u);
}

TEST(PolyDataToSVOBadInput, OnlyPointsThatAreNotFiniteLeadToOneWarning)
{
  const auto mesh = sphere();
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    mesh->GetPoints()->SetPoint(i, std::nan(""), std::nan(""), std::nan(""));
  }
  const Conversion conversion(mesh);
  EXPECT_EQ(conversion.messages.warnings.size(), 1u);
  EXPECT_EQ(conversion.messages.errors.size(), 0u);
  ASSERT_TRUE(conversion.octree());
  EXPECT_EQ(conversion.filter->GetNumberOfVoxels(), 0);
}

TEST(PolyDataToSVOBadInput, AnEmptyMeshIsNothingToTalkAbout)
{
  vtkNew<vtkPolyData> mesh;
  const Conversion conversion(mesh);
  EXPECT_EQ(conversion.messages.all(), "");
  ASSERT_TRUE(conversion.octree());
  EXPECT_TRUE(conversion.octree().empty());
}

TEST(PolyDataToSVOBadInput, AMeshOfLinesOrVerticesIsNothingToTalkAbout)
{
  for (bool lines : { false, true })
  {
    vtkNew<vtkPoints> points;
    points->InsertNextPoint(0.0, 0.0, 0.0);
    points->InsertNextPoint(1.0, 0.0, 0.0);
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell({ 0, 1 });
    vtkNew<vtkPolyData> mesh;
    mesh->SetPoints(points);
    if (lines)
    {
      mesh->SetLines(cells);
    }
    else
    {
      mesh->SetVerts(cells);
    }
    const Conversion conversion(mesh);
    EXPECT_EQ(conversion.messages.all(), "");
    EXPECT_TRUE(conversion.octree());
    EXPECT_EQ(conversion.filter->GetNumberOfVoxels(), 0);
  }
}

TEST(PolyDataToSVOBadInput, AllPointsInOnePlaceAreOneVoxelAndOneWarning)
{
  for (double where : { 0.0, 1e6 })
  {
    const auto mesh = sphere();
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      mesh->GetPoints()->SetPoint(i, where, where, where);
    }
    const Conversion conversion(mesh);
    EXPECT_EQ(conversion.messages.warnings.size(), 1u);
    EXPECT_EQ(conversion.messages.errors.size(), 0u);
    EXPECT_GE(conversion.filter->GetNumberOfVoxels(), 1);
    EXPECT_LE(conversion.filter->GetNumberOfVoxels(), 8); // it may lie on a corner
  }
}

TEST(PolyDataToSVOBadInput, APlaneWithoutThicknessIsAnOrdinaryMesh)
{
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, 5.0);
  points->InsertNextPoint(2.0, 0.0, 5.0);
  points->InsertNextPoint(2.0, 1.0, 5.0);
  points->InsertNextPoint(0.0, 1.0, 5.0);
  vtkNew<vtkCellArray> polys;
  polys->InsertNextCell({ 0, 1, 2, 3 });
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(polys);
  const Conversion conversion(mesh);
  EXPECT_EQ(conversion.messages.all(), "");
  EXPECT_GE(conversion.filter->GetNumberOfVoxels(), 16 * 8);
}

TEST(PolyDataToSVOBadInput, BoundsThatAreNotFiniteAreRefused)
{
  vtkNew<vtkPolyDataToSVO> filter;
  const svo::TestMessages messages(filter);
  filter->SetModelBounds(-1.0, 1.0, -2.0, 2.0, -3.0, 3.0);
  const vtkMTimeType time = filter->GetMTime();
  filter->SetModelBounds(std::nan(""), 1.0, -2.0, 2.0, -3.0, 3.0);
  const double infinite[6] = { -1.0, 1.0, -2.0, 2.0, -3.0,
    std::numeric_limits<double>::infinity() };
  filter->SetModelBounds(infinite);
  EXPECT_EQ(messages.warnings.size(), 2u);
  EXPECT_EQ(filter->GetModelBounds()[0], -1.0);
  EXPECT_EQ(filter->GetModelBounds()[5], 3.0);
  EXPECT_EQ(filter->GetMTime(), time);
}

TEST(PolyDataToSVOBadInput, AnOctreeBeyondTheMemoryLimitIsRefusedBeforeItIsBuilt)
{
  const auto mesh = sphere();
  vtkNew<vtkPolyDataToSVO> filter;
  const svo::TestMessages messages(filter);
  filter->SetInputData(mesh);
  filter->SetMaximumLevel(14);
  filter->SetMemoryLimit(16384); // KiB
  filter->Update();
  EXPECT_EQ(messages.errors.size(), 1u);
  EXPECT_EQ(messages.warnings.size(), 0u);
  EXPECT_NE(messages.all().find("level 14"), std::string::npos) << messages.all();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), mesh->GetNumberOfPolys());
  EXPECT_FALSE(octreeOf(filter->GetOutput()));
  filter->SetMaximumLevel(3);
  filter->Update();
  EXPECT_TRUE(octreeOf(filter->GetOutput()));
}

TEST(PolyDataToSVOBadInput, TheDeepestLevelIsRefusedWithinTheMachinesMemory)
{
  const auto mesh = sphere();
  const Conversion conversion(mesh, 20); // 10^12 voxels
  EXPECT_EQ(conversion.messages.errors.size(), 1u);
  EXPECT_FALSE(conversion.octree());
}
