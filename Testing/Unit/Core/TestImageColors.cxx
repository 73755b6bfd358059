// Values of an image at the leaves of an octree, which colour it.
#include "svoImageConversion.h"
#include "svoOctreeCells.h"
#include "vtkSVOToHyperTreeGrid.h"
#include "vtkSVOToPolyData.h"

#include "vtkBitArray.h"
#include "vtkCell.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkHyperTreeGrid.h"
#include "vtkShortArray.h"
#include "vtkUnsignedCharArray.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

using namespace svotest;

TEST(ImageColors, TellSeveralValuesApart)
{
  const auto image = distances(false);
  ImageConversion conversion(image);
  conversion.filter->SetValue(0, -0.5);
  conversion.filter->SetValue(1, 0.25);
  conversion.filter->SetColorArrayName("Distance");
  vtkPolyData* hull = conversion.output();
  vtkDataArray* values = hull->GetFieldData()->GetArray("Distance");
  ASSERT_NE(values, nullptr);
  int inner = 0, outer = 0;
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    inner += std::abs(values->GetComponent(i, 0) + 0.5) < 0.02;
    outer += std::abs(values->GetComponent(i, 0) - 0.25) < 0.02;
  }
  EXPECT_GT(inner, 1000);
  EXPECT_GT(outer, inner);
  EXPECT_EQ(inner + outer, values->GetNumberOfTuples());
  conversion.filter->SetValue(0, 90.0);
  conversion.filter->SetValue(1, 100.0);
  conversion.output();
  EXPECT_NE(conversion.messages.all().find("90, 100"), std::string::npos)
    << conversion.messages.all();
}

// Every voxel keeps the other array's value at the surface in it, in the octree's order.
TEST(ImageColors, LeavesHaveValues)
{
  const auto image = distances(true);
  const glm::dvec3 slope(0.5, -2.0, 1.0);
  vtkNew<vtkShortArray> linear;
  linear->SetName("Linear");
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Colors");
  colors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    glm::dvec3 x;
    image->GetPoint(i, &x.x);
    linear->InsertNextValue(static_cast<short>(std::lround(1000.0 * glm::dot(slope, x))));
    const unsigned char color[3] = { 200, static_cast<unsigned char>(i % 2 ? 0 : 255), 7 };
    colors->InsertNextTypedTuple(color);
  }
  image->GetPointData()->AddArray(linear);
  image->GetPointData()->AddArray(colors);
  ImageConversion conversion(image);
  for (const int level : { 1, 2, 5, 6, 7 })
  {
    conversion.filter->SetMaximumLevel(level);
    conversion.filter->SetColorArrayName("Linear");
    vtkPolyData* hull = conversion.output();
    const svo::Octree octree = octreeOf(hull);
    ASSERT_TRUE(octree);
    vtkDataArray* values = hull->GetFieldData()->GetArray("Linear");
    ASSERT_NE(values, nullptr);
    EXPECT_EQ(values->GetDataType(), VTK_FLOAT);
    ASSERT_EQ(values->GetNumberOfTuples(), vtkIdType(octree.header().voxelCount));
    const double voxel = octree.header().voxelSize;
    vtkIdType i = 0;
    svo::forEachCell(octree, level,
      [&](const svo::OctreeCell& c)
      {
        const double* o = octree.header().origin;
        const glm::dvec3 inFrame =
          glm::dvec3(o[0], o[1], o[2]) + voxel * (glm::dvec3(c.cell) + 0.5);
        const glm::dvec3 centre(octree.transform() * glm::dvec4(inFrame, 1.0));
        const glm::dvec3 along = glm::abs(glm::transpose(glm::dmat3(octree.transform())) * slope);
        const double most = 500.0 * voxel * (along.x + along.y + along.z) + 1.0;
        // Of a voxel that reaches beyond the image, values are those of its edge.
        if (level >= 5)
        {
          EXPECT_NEAR(values->GetComponent(i, 0), 1000.0 * glm::dot(slope, centre), most);
        }
        ++i;
        return true;
      });
    vtkDataArray* ofHull = hull->GetCellData()->GetArray("Linear");
    ASSERT_NE(ofHull, nullptr);
    EXPECT_EQ(ofHull->GetNumberOfTuples(), hull->GetNumberOfCells());
    EXPECT_EQ(ofHull->GetRange()[0], values->GetRange()[0]);
    EXPECT_EQ(ofHull->GetRange()[1], values->GetRange()[1]);
    for (vtkIdType k = 0; k < hull->GetNumberOfCells(); k += 7)
    {
      const double value = ofHull->GetComponent(k, 0);
      EXPECT_TRUE(value >= values->GetRange()[0] && value <= values->GetRange()[1]);
    }
  }
  conversion.filter->SetColorArrayName("Colors");
  vtkDataArray* bytes = conversion.output()->GetFieldData()->GetArray("Colors");
  ASSERT_NE(bytes, nullptr);
  EXPECT_EQ(bytes->GetDataType(), VTK_UNSIGNED_CHAR);
  EXPECT_EQ(bytes->GetNumberOfComponents(), 3);
  EXPECT_EQ(bytes->GetRange(0)[0], 200.0);
  EXPECT_EQ(bytes->GetRange(0)[1], 200.0);
  EXPECT_LT(bytes->GetRange(1)[0], 100.0);
  EXPECT_GT(bytes->GetRange(1)[1], 155.0);
  EXPECT_TRUE(conversion.messages.all().empty()) << conversion.messages.all();
}

TEST(ImageColors, CellsHandValuesOn)
{
  const auto image = distances(false);
  vtkNew<vtkDoubleArray> height;
  height->SetName("Height");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    height->InsertNextValue(image->GetPoint(i)[2]);
  }
  image->GetPointData()->AddArray(height);
  ImageConversion conversion(image);
  constexpr int Level = 6;
  conversion.filter->SetMaximumLevel(Level);
  conversion.filter->SetColorArrayName("Height");
  vtkPolyData* hull = conversion.output();
  const svo::Octree octree = octreeOf(hull);

  vtkNew<vtkSVOToPolyData> surface;
  surface->SetInputData(hull);
  for (const int level : { Level, Level - 1, Level - 2, 3 })
  {
    surface->SetLevel(level);
    surface->Update();
    vtkPolyData* cells = surface->GetOutput();
    vtkDataArray* values = cells->GetCellData()->GetArray("Height");
    ASSERT_NE(values, nullptr);
    ASSERT_EQ(values->GetNumberOfTuples(), cells->GetNumberOfCells());
    EXPECT_EQ(cells->GetFieldData()->GetArray("Height"), nullptr);
    const double edge = std::ldexp(octree.header().voxelSize, Level - level);
    for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i)
    {
      const double* b = cells->GetCell(i)->GetBounds();
      ASSERT_NEAR(values->GetComponent(i, 0), 0.5 * (b[4] + b[5]), 1.001 * edge);
    }
  }

  vtkNew<vtkSVOToHyperTreeGrid> tree;
  tree->SetInputData(hull);
  tree->Update();
  vtkHyperTreeGrid* grid = tree->GetHyperTreeGridOutput();
  vtkDataArray* values = grid->GetCellData()->GetArray("Height");
  vtkDataArray* levels = grid->GetCellData()->GetArray("Level");
  ASSERT_NE(values, nullptr);
  double expected = 0.0, sum = 0.0;
  vtkDataArray* leaves = hull->GetFieldData()->GetArray("Height");
  for (vtkIdType i = 0; i < leaves->GetNumberOfTuples(); ++i)
  {
    expected += leaves->GetComponent(i, 0);
  }
  for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
  {
    if (levels->GetComponent(i, 0) == Level && !grid->GetMask()->GetValue(i))
    {
      sum += values->GetComponent(i, 0);
    }
  }
  EXPECT_NEAR(sum, expected, 1e-6 * std::abs(expected));
}

TEST(ImageColors, SaysThatThereIsNoSuchArrayOfColors)
{
  ImageConversion conversion(distances(false));
  conversion.filter->SetColorArrayName("Nothing");
  vtkPolyData* hull = conversion.output();
  EXPECT_TRUE(octreeOf(hull));
  EXPECT_TRUE(conversion.messages.errors.empty());
  EXPECT_NE(conversion.messages.all().find("named Nothing; it has Distance"), std::string::npos)
    << conversion.messages.all();
}
