// Isosurfaces of images to octrees: distances and densities, spacing, directions and origins, and
// what cannot be converted.
#include "svoImageConversion.h"
#include "svoOctreeCells.h"
#include "vtkSparseVoxelOctree.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkShortArray.h"
#include "vtkVoxel.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <set>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

using namespace svotest;

namespace
{
/// Shoots at the sphere from all sides.
void expectSphere(vtkPolyData* hull, double radius, double error)
{
  vtkNew<vtkSparseVoxelOctree> octree;
  ASSERT_TRUE(octree->Initialize(hull));
  for (int i = 0; i < 500; ++i)
  {
    const double z = -0.999 + i * 0.004, a = 2.4 * i, r = std::sqrt(1.0 - z * z);
    const double d[3] = { r * std::cos(a), r * std::sin(a), z };
    double from[3], to[3], x[3], t;
    vtkIdType cell;
    for (int k = 0; k < 3; ++k)
    {
      from[k] = Centre[k] + 9.0 * d[k];
      to[k] = Centre[k] + 0.1 * d[(k + 1) % 3];
    }
    ASSERT_EQ(octree->IntersectWithLine(from, to, t, x, cell), 1) << i;
    ASSERT_NEAR(std::hypot(x[0] - Centre[0], x[1] - Centre[1], x[2] - Centre[2]), radius, error);
  }
}

/// What a trilinear field of such distances is off by: a bend of 1 / Radius in half a cell along
/// each axis; and a tangent plane of voxels of up to 0.1, see TestOwnPlanes.
constexpr double Trilinear = (0.01 + 0.0225 + 0.04) / (8.0 * 1.5);
constexpr double Plane = 3.0 * 0.01 / (2.0 * 1.5);
}

TEST(ImageToSVO, DistancesInTurnedAndShiftedImages)
{
  for (const bool turned : { false, true })
  {
    for (const int from : { 0, 7 })
    {
      SCOPED_TRACE(testing::Message() << turned << " " << from);
      ImageConversion conversion(distances(turned, from));
      vtkPolyData* hull = conversion.output();
      EXPECT_TRUE(conversion.messages.all().empty()) << conversion.messages.all();
      const svo::Octree octree = octreeOf(hull);
      ASSERT_TRUE(octree);
      EXPECT_LE(octree.header().voxelSize, 0.1 * 1.001);
      expectSphere(hull, Radius, Trilinear + Plane);
    }
  }
}

TEST(ImageToSVO, ValuesAndArraysAreChosen)
{
  const auto image = distances(false);
  vtkNew<vtkShortArray> density; // larger inside
  density->SetName("Density");
  density->SetNumberOfValues(image->GetNumberOfPoints());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double distance = image->GetPointData()->GetScalars()->GetTuple1(i);
    density->SetValue(i, static_cast<short>(std::lround(-5000.0 * distance)));
  }
  image->GetPointData()->AddArray(density);
  ImageConversion conversion(image);
  conversion.filter->SetMaximumLevel(8);
  conversion.filter->SetValue(-0.5);
  expectSphere(conversion.output(), Radius - 0.5, Trilinear + Plane);
  EXPECT_EQ(octreeOf(conversion.filter->GetOutput()).level(), 8);
  conversion.filter->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  conversion.filter->SetValue(1250.0);
  expectSphere(conversion.output(), Radius - 0.25, Trilinear + Plane + 1e-4);
}

// The octree of several values has the voxels of each, however deep it is.
TEST(ImageToSVO, SeveralValuesAreAllThere)
{
  const auto image = distances(true);
  for (const int level : { 3, 7 })
  {
    const auto voxelsOf = [&](vtkImageToSVO* filter)
    {
      std::set<std::array<int, 3>> voxels;
      filter->Update();
      const svo::Octree octree = octreeOf(filter->GetOutput());
      svo::forEachCell(octree, octree.level(),
        [&](const svo::OctreeCell& c) {
          return voxels.insert({ c.cell.x, c.cell.y, c.cell.z }).second;
        });
      return voxels;
    };
    ImageConversion all(image);
    all.filter->SetMaximumLevel(level);
    all.filter->GenerateValues(3, -0.6, 0.6);
    all.filter->SetValue(3, 0.6); // twice
    all.filter->SetValue(4, std::numeric_limits<double>::quiet_NaN());
    ASSERT_EQ(all.filter->GetNumberOfContours(), 5);
    std::set<std::array<int, 3>> expected;
    for (const double value : { -0.6, 0.0, 0.6 })
    {
      ImageConversion one(image);
      one.filter->SetMaximumLevel(level);
      one.filter->SetValue(value);
      const auto voxels = voxelsOf(one.filter);
      expected.insert(voxels.begin(), voxels.end());
    }
    EXPECT_GT(expected.size(), 20u);
    EXPECT_EQ(voxelsOf(all.filter), expected);
    ImageConversion none(image);
    none.filter->SetValue(0, std::numeric_limits<double>::quiet_NaN());
    none.output();
    EXPECT_NE(none.messages.all().find("is not a number"), std::string::npos);
    // Without a list it is the one value again.
    all.filter->SetNumberOfContours(0);
    all.filter->SetValue(-0.3);
    expectSphere(all.output(), Radius - 0.3, level == 7 ? Trilinear + Plane : 0.4);
    EXPECT_TRUE(all.messages.all().empty()) << all.messages.all();
  }
}

TEST(ImageToSVO, WhatIsKeptOfAnImageIsOfThatImage)
{
  // Values, other arrays, changes in place, other images: as a new filter sees them.
  const vtkSmartPointer<vtkImageData> image = distances(false), other = distances(false, 7);
  auto* values = vtkDoubleArray::SafeDownCast(image->GetPointData()->GetScalars());
  vtkNew<vtkDoubleArray> squares;
  squares->SetName("Squares");
  for (vtkIdType i = 0; i < values->GetNumberOfValues(); ++i)
  {
    squares->InsertNextValue(100.0 + values->GetValue(i) * values->GetValue(i));
  }
  image->GetPointData()->AddArray(squares);
  ImageConversion kept(image);
  const auto expectSame = [&](vtkImageData* of, double value, const char* array)
  {
    SCOPED_TRACE(testing::Message() << array << " " << value);
    ImageConversion fresh(of);
    for (vtkImageToSVO* filter : { kept.filter.Get(), fresh.filter.Get() })
    {
      filter->SetInputData(of);
      filter->SetValue(value);
      filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, array);
    }
    const svo::Octree a = octreeOf(kept.output()), b = octreeOf(fresh.output());
    ASSERT_TRUE(a && b);
    EXPECT_GT(b.header().voxelCount, 100u);
    ASSERT_EQ(svo::bufferSize(a.header()), svo::bufferSize(b.header()));
    EXPECT_EQ(std::memcmp(a.key(), b.key(), svo::bufferSize(a.header())), 0);
  };
  expectSame(image, 0.0, "Distance");
  expectSame(image, 0.3, "Distance");
  expectSame(image, 100.04, "Squares");
  expectSame(image, -0.3, "Distance");
  for (vtkIdType i = 0; i < values->GetNumberOfValues(); ++i)
  {
    values->SetValue(i, values->GetValue(i) + 50.0);
  }
  values->Modified();
  expectSame(image, 50.2, "Distance");
  for (vtkIdType i = 0; i < values->GetNumberOfValues(); ++i)
  {
    values->SetValue(i, values->GetValue(i) + 50.0);
  }
  image->Modified(); // as programs say it that write through a pointer
  expectSame(image, 100.2, "Distance");
  expectSame(other, 0.2, "Distance");
  EXPECT_EQ(kept.messages.all(), "");
}

TEST(ImageToSVO, NothingOfTheSurfaceIsMissed)
{
  // One point of 8000 is inside: a surface smaller than a cell on each side of it.
  vtkNew<vtkImageData> image;
  image->SetDimensions(20, 20, 20);
  image->AllocateScalars(VTK_FLOAT, 1);
  image->GetPointData()->GetScalars()->Fill(1.0);
  image->SetScalarComponentFromDouble(11, 7, 13, 0, -0.2);
  ImageConversion conversion(image);
  conversion.filter->SetMaximumLevel(9);
  const double* b = conversion.output()->GetBounds();
  const double cell = 19.0 / 32.0;
  const double at[3] = { 11.0, 7.0, 13.0 };
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_LT(b[2 * i], at[i]);
    EXPECT_GT(b[2 * i + 1], at[i]);
    EXPECT_LT(b[2 * i + 1] - b[2 * i], 2.0 + 2.0 * cell);
  }
  EXPECT_GT(conversion.filter->GetNumberOfVoxels(), 100);
}

// A bar of 3 x 6 cells with sharp edges, seen along another direction than the axes'.
TEST(ImageToSVO, ThinStructuresAreNoFatterThanTheField)
{
  constexpr int N = 24;
  vtkNew<vtkImageData> image;
  image->SetDimensions(N, N, N);
  image->AllocateScalars(VTK_SHORT, 1);
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double* x = image->GetPoint(i);
    const bool bar = std::abs(x[0] - 11.0) <= 1.5 && std::abs(x[1] - 11.0) <= 3.0;
    image->GetPointData()->GetScalars()->SetTuple1(i, bar && std::abs(x[2] - 11.0) <= 8.0);
  }
  ImageConversion conversion(image);
  conversion.filter->SetValue(0.4);
  vtkNew<vtkSparseVoxelOctree> octree;
  conversion.filter->SetMaximumLevel(6); // half a cell
  ASSERT_TRUE(octree->Initialize(conversion.output()));
  ASSERT_EQ(octree->GetVoxelSize(), 0.5);
  const auto field = [&](const glm::dvec3& at)
  {
    double value = 0.0, in[3], weights[8];
    int ijk[3];
    double x[3] = { at.x, at.y, at.z };
    if (image->ComputeStructuredCoordinates(x, ijk, in) == 0)
    {
      return 0.0;
    }
    vtkVoxel::InterpolationFunctions(in, weights);
    for (int c = 0; c < 8; ++c)
    {
      value += weights[c] *
        image->GetScalarComponentAsDouble(
          ijk[0] + (c & 1), ijk[1] + (c >> 1 & 1), ijk[2] + (c >> 2), 0);
    }
    return value;
  };
  const glm::dvec3 ahead = glm::normalize(glm::dvec3(0.3, -1.0, 0.4));
  const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(0.0, 0.0, 1.0)));
  const glm::dvec3 up = glm::cross(right, ahead);
  int drawn = 0, extra = 0, missing = 0;
  for (int i = 0; i < 150 * 150; ++i)
  {
    const glm::dvec3 middle =
      glm::dvec3(11.0) + (i % 150 - 74.6) * 0.15 * right + (i / 150 - 74.6) * 0.15 * up;
    bool isThere = false;
    for (double t = -16.0; t < 16.0 && !isThere; t += 0.05)
    {
      isThere = field(middle + t * ahead) >= 0.4;
    }
    const glm::dvec3 from = middle - 20.0 * ahead, to = middle + 20.0 * ahead;
    double t, x[3];
    vtkIdType cell;
    const bool isHit = octree->IntersectWithLine(&from.x, &to.x, t, x, cell) != 0;
    drawn += isThere;
    extra += isHit && !isThere;
    missing += isThere && !isHit;
  }
  std::printf("%d rays meet the bar, %d more its octree, %d fewer\n", drawn, extra, missing);
  EXPECT_LT(extra, drawn / 20);
  EXPECT_LT(missing, drawn / 200);
}

TEST(ImageToSVO, OneMessageForWhatCannotBeConverted)
{
  {
    const auto image = distances(false);
    image->GetPointData()->Initialize();
    ImageConversion(image).expectNothing("no such point scalars");
  }
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(1, 1, 1);
    image->AllocateScalars(VTK_FLOAT, 1);
    ImageConversion(image).expectNothing("fewer than two points");
  }
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(4, 4, 4);
    image->AllocateScalars(VTK_FLOAT, 3);
    ImageConversion(image).expectNothing("more than one component; choose one by");
  }
  {
    const auto image = distances(false);
    image->GetPointData()->Initialize();
    vtkNew<vtkDoubleArray> ofCells;
    ofCells->SetName("Distance");
    ofCells->SetNumberOfValues(image->GetNumberOfCells());
    image->GetCellData()->SetScalars(ofCells);
    ImageConversion(image).expectNothing("by vtkCellDataToPointData");
  }
  {
    ImageConversion conversion(distances(false));
    conversion.filter->SetMaximumLevel(20);
    conversion.filter->SetMemoryLimit(20000);
    conversion.expectNothing("level 20 would need about");
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double constant : { 0.0, 1.0, nan })
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(9, 9, 9);
    image->AllocateScalars(VTK_DOUBLE, 1);
    image->GetPointData()->GetScalars()->Fill(constant);
    ImageConversion conversion(image);
    conversion.filter->SetMaximumLevel(16);
    EXPECT_EQ(conversion.output()->GetNumberOfCells(), 0);
    EXPECT_TRUE(conversion.messages.errors.empty()) << conversion.messages.all();
    EXPECT_EQ(conversion.messages.warnings.size(), 1u);
  }
}
