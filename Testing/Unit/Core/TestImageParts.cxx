// Images that are parts of others, that have holes, and that are given as they come: pieces of
// several processes, blanked points and cells, levels by default, arrays without a name.
#include "vtkImageToSVO.h"

#include "svoConversion.h"
#include "svoOctreeCells.h"
#include "svoPlane.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkRTAnalyticSource.h"
#include "vtkUniformGrid.h"

#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace
{
/// Planes by their voxels.
using Planes = std::map<std::tuple<int, int, int>, std::uint32_t>;

Planes planesOf(const svo::Octree& octree)
{
  Planes planes;
  svo::forEachCell(octree, octree.level(),
    [&](const svo::OctreeCell& c)
    {
      planes[{ c.cell.x, c.cell.y, c.cell.z }] = octree.lists()[octree.planeOf(c.node, c.firstBit)];
      return true;
    });
  return planes;
}

/// Values that grow along x, y and z, in an image with cells of 1.
template <class Image>
vtkSmartPointer<Image> makeImage(int points, const glm::dvec3& spacing = glm::dvec3(1.0))
{
  auto image = vtkSmartPointer<Image>::New();
  image->SetDimensions(points, points, points);
  image->SetSpacing(spacing.x, spacing.y, spacing.z);
  vtkNew<vtkDoubleArray> values;
  values->SetName("Height");
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    values->InsertNextValue(image->GetPoint(i)[2]);
  }
  image->GetPointData()->SetScalars(values);
  return image;
}

int defaultLevel(vtkImageData* image, double value)
{
  vtkNew<vtkImageToSVO> filter;
  filter->SetInputData(image);
  filter->SetValue(value);
  filter->Update();
  const svo::Octree octree = octreeOf(filter->GetOutput());
  return octree ? octree.level() : 0;
}

/// The surface where the image is 5.3.
svo::Octree planeOfLevel6(vtkImageData* image)
{
  vtkNew<vtkImageToSVO> filter;
  filter->SetInputData(image);
  filter->SetValue(5.3);
  filter->SetMaximumLevel(6);
  filter->Update();
  return octreeOf(filter->GetOutput());
}
}

TEST(ImageParts, PiecesHaveTheVoxelsOfTheWhole)
{
  vtkNew<vtkRTAnalyticSource> source;
  source->SetWholeExtent(-12, 12, -9, 9, -14, 15);
  for (const int level : { 0, 4, 6 })
  {
    SCOPED_TRACE(level);
    vtkNew<vtkImageToSVO> filter;
    filter->SetInputConnection(source->GetOutputPort());
    filter->SetValue(150.0);
    filter->SetMaximumLevel(level);
    filter->Update();
    const Planes whole = planesOf(octreeOf(filter->GetOutput()));
    ASSERT_GT(whole.size(), 100u);
    Planes all;
    std::size_t sum = 0;
    for (int piece = 0; piece < 3; ++piece)
    {
      vtkNew<vtkImageToSVO> part;
      svo::TestMessages messages{ part };
      part->SetInputConnection(source->GetOutputPort());
      part->SetValue(150.0);
      part->SetMaximumLevel(level);
      part->UpdatePiece(piece, 3, 0);
      const Planes planes = planesOf(octreeOf(part->GetOutput()));
      EXPECT_LT(planes.size(), whole.size());
      sum += planes.size();
      all.insert(planes.begin(), planes.end());
      EXPECT_TRUE(messages.all().empty()) << messages.all();
    }
    EXPECT_EQ(sum, whole.size()) << "no voxel twice";
    ASSERT_EQ(all.size(), whole.size());
    std::size_t turned = 0; // at the parts' borders, too, by no more than rounding
    for (const auto& [voxel, plane] : whole)
    {
      ASSERT_EQ(all.count(voxel), 1u);
      const svo::MeanPlane a = svo::decodePlane(plane), b = svo::decodePlane(all.at(voxel));
      turned += glm::dot(a.normal, b.normal) < 0.99999f || std::abs(a.offset - b.offset) > 0.01f;
    }
    EXPECT_EQ(turned, 0u);
  }
}

TEST(ImageParts, AnEmptyPartIsNoReasonForAMessage)
{
  vtkNew<vtkRTAnalyticSource> source; // largest at 0, 0, 0
  source->SetWholeExtent(-10, 10, -10, 10, -10, 40);
  vtkNew<vtkImageToSVO> filter;
  svo::TestMessages messages{ filter };
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetValue(260.0);
  filter->UpdatePiece(7, 8, 0);
  EXPECT_EQ(filter->GetNumberOfVoxels(), 0);
  EXPECT_TRUE(messages.all().empty()) << messages.all();
}

TEST(ImageParts, BlankedCellsHaveNoSurface)
{
  const auto grid = makeImage<vtkUniformGrid>(17);
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    if (cell % 16 < 8)
    {
      grid->BlankCell(cell);
    }
  }
  const svo::Octree octree = planeOfLevel6(grid);
  ASSERT_TRUE(octree);
  const double voxel = octree.header().voxelSize;
  double least = 99.0;
  for (const auto& [cell, plane] : planesOf(octree))
  {
    least = std::min(least, octree.header().origin[0] + voxel * (std::get<0>(cell) + 0.5));
  }
  EXPECT_GT(least, 8.0);
  EXPECT_LT(least, 8.0 + voxel);
  EXPECT_NEAR(static_cast<double>(octree.header().voxelCount), 0.5 * 64 * 64, 70);
}

TEST(ImageParts, BlankedPointsHaveNoSurfaceAroundThem)
{
  const auto grid = makeImage<vtkUniformGrid>(17);
  grid->GetPointData()->GetScalars()->SetComponent(grid->FindPoint(8.0, 8.0, 5.0), 0, 1e30);
  grid->BlankPoint(grid->FindPoint(8.0, 8.0, 5.0));
  const svo::Octree octree = planeOfLevel6(grid);
  ASSERT_TRUE(octree);
  const double voxel = octree.header().voxelSize;
  for (const auto& [cell, plane] : planesOf(octree))
  {
    const glm::dvec2 at = glm::dvec2(octree.header().origin[0], octree.header().origin[1]) +
      voxel * (glm::dvec2(std::get<0>(cell), std::get<1>(cell)) + 0.5);
    ASSERT_TRUE(glm::any(glm::greaterThan(glm::abs(at - 8.0), glm::dvec2(1.0))));
    // Around the hole, too, the value that is not to be seen turns no plane.
    ASSERT_GT(std::abs(svo::decodePlane(plane).normal.z), 0.999) << at.x << " " << at.y;
  }
  EXPECT_GT(octree.header().voxelCount, 3900u);
}

TEST(ImageParts, LevelsByDefault)
{
  EXPECT_EQ(defaultLevel(makeImage<vtkImageData>(3), 1.2), 8) << "at least";
  EXPECT_EQ(defaultLevel(makeImage<vtkImageData>(65), 1.2), 8);
  EXPECT_EQ(defaultLevel(makeImage<vtkImageData>(65, { 1.0, 1.0, 0.2 }), 1.2), 8)
    << "an edge of 64 and spacings of 0.2 would be 9, but 64 cells are no more than 8";
  EXPECT_EQ(defaultLevel(makeImage<vtkImageData>(130, { 1.0, 1.0, 0.1 }), 0.6), 10);
  EXPECT_EQ(defaultLevel(makeImage<vtkImageData>(33, { 1.0, 1.0, 50.0 }), 60.0), 8);
  EXPECT_EQ(defaultLevel(makeImage<vtkImageData>(17, { 1.0, 1.0, 100.0 }), 60.0), 9)
    << "at least four voxels across its 16 units";
}

TEST(ImageParts, WhyNothingWasFound)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto noValues = makeImage<vtkImageData>(9);
  noValues->GetPointData()->GetScalars()->Fill(nan);
  const std::pair<vtkSmartPointer<vtkImageData>, const char*> cases[] = {
    { noValues, "no finite values" },
    { makeImage<vtkImageData>(9), "its finite values are 0 to 8" },
    { makeImage<vtkImageData>(9, { 1.0, 1.0, 1e8 }), "thinner than a voxel" },
  };
  for (const auto& [image, message] : cases)
  {
    vtkNew<vtkImageToSVO> filter;
    svo::TestMessages messages{ filter };
    filter->SetInputData(image);
    filter->SetValue(30.3);
    filter->Update();
    EXPECT_EQ(filter->GetNumberOfVoxels(), 0) << message;
    ASSERT_EQ(messages.warnings.size(), 1u) << message;
    EXPECT_NE(messages.all().find(message), std::string::npos) << messages.all();
  }
}

TEST(ImageParts, WithoutANameItIsTheActiveArray)
{
  vtkNew<vtkImageToSVO> filter;
  svo::TestMessages messages{ filter };
  filter->SetInputData(makeImage<vtkImageData>(9));
  filter->SetValue(3.3);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "");
  filter->Update();
  EXPECT_GT(filter->GetNumberOfVoxels(), 0);
  EXPECT_TRUE(messages.all().empty()) << messages.all();
}

TEST(ImageParts, StatisticsTravelOnRequest)
{
  vtkNew<vtkImageToSVO> filter;
  filter->SetInputData(makeImage<vtkImageData>(9));
  filter->SetValue(3.3);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetFieldData()->GetArray("SVO Voxels"), nullptr);
  filter->WriteStatisticsOn();
  filter->Update();
  vtkFieldData* field = filter->GetOutput()->GetFieldData();
  for (const auto& [name, value] : { std::pair<const char*, double>{ "SVO Level", 8.0 },
         { "SVO Voxels", static_cast<double>(filter->GetNumberOfVoxels()) },
         { "SVO Build Time", filter->GetBuildTime() } })
  {
    ASSERT_NE(field->GetArray(name), nullptr) << name;
    EXPECT_EQ(field->GetArray(name)->GetTuple1(0), value) << name;
  }
  EXPECT_GT(field->GetArray("SVO Memory")->GetTuple1(0), 100.0);
}

TEST(ImageParts, ImagesThatAreNoneSaySo)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::pair<glm::dvec3, const char*> cases[] = { { { 1.0, 0.0, 1.0 }, "is flat" },
    { { 1.0, nan, 1.0 }, "not finite" }, { { 1e-9, 1e-9, 1e-9 }, "so far from the origin" } };
  for (const auto& [spacing, message] : cases)
  {
    const auto image = makeImage<vtkImageData>(9, spacing);
    image->SetOrigin(1e9, 0.0, 0.0);
    vtkNew<vtkImageToSVO> filter;
    svo::TestMessages messages{ filter };
    filter->SetInputData(image);
    filter->Update();
    EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
    ASSERT_EQ(messages.errors.size(), 1u) << message;
    EXPECT_NE(messages.all().find(message), std::string::npos) << messages.all();
  }
}
