// The contour of an octree of planes: closed where the surface is, on it, turned outwards, ending
// where the surface ends, no larger than it may be.
#include "svoContour.h"

#include "svoCellPlanes.h"
#include "svoConversion.h"
#include "svoFieldSource.h"
#include "svoSourceOctree.h"
#include "vtkImageToSVO.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFlyingEdges3D.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPolyDataConnectivityFilter.h"

#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace
{
/// A distance, or something like it.
struct Field : svo::ScalarField
{
  std::function<double(const glm::dvec3&)> function;
  explicit Field(std::function<double(const glm::dvec3&)> f)
    : function(std::move(f))
  {
  }
  double value(const glm::dvec3& at) const override { return this->function(at); }
  glm::dvec3 gradient(const glm::dvec3& at) const override
  {
    constexpr double Step = 1e-5;
    glm::dvec3 g;
    for (int i = 0; i < 3; ++i)
    {
      glm::dvec3 aside(0.0);
      aside[i] = Step;
      g[i] = (this->value(at + aside) - this->value(at - aside)) / (2.0 * Step);
    }
    return g;
  }
};

const glm::dvec3 Centre(0.013, -0.024, 0.037);

double ball(const glm::dvec3& at, double radius)
{
  return glm::length(at - Centre) - radius;
}

/// In a box 2 wide.
svo::SourceOctree build(const std::function<double(const glm::dvec3&)>& f, int level,
  vtkPolyData* mesh, std::size_t cells = 1000000, const glm::dmat4& frame = glm::dmat4(1.0))
{
  const Field field(f);
  svo::BuildOptions options;
  options.level = level;
  options.leafGeometry = svo::LeafGeometry::Plane;
  options.modelLow = glm::dvec3(-1.0);
  options.modelHigh = glm::dvec3(1.0);
  options.transform = frame;
  svo::SourceOctree built =
    svo::buildSourceOctree(svo::FieldSource(field, { 0.0, 1.1, 0.0 }), options, { cells }, mesh);
  EXPECT_EQ(built.status, svo::BuildStatus::Built) << built.message;
  return built;
}

struct Edges
{
  int open = 0;    // of one quad
  int crossed = 0; // of two quads or more, two of which pass it the same way
  explicit Edges(vtkPolyData* mesh)
  {
    std::map<std::pair<vtkIdType, vtkIdType>, int> ways;
    vtkNew<vtkIdList> ids;
    for (vtkIdType c = 0; c < mesh->GetNumberOfCells(); ++c)
    {
      mesh->GetPolys()->GetCellAtId(c, ids);
      for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
      {
        ++ways[{ ids->GetId(k), ids->GetId((k + 1) % ids->GetNumberOfIds()) }];
      }
    }
    for (const auto& [way, count] : ways)
    {
      this->crossed += count > 1;
      this->open += ways.count({ way.second, way.first }) == 0;
    }
  }
};

glm::dvec3 pointOf(vtkPolyData* mesh, vtkIdType id)
{
  glm::dvec3 x;
  mesh->GetPoint(id, &x.x);
  return x;
}

/// Twice the area of a quad, as a vector to where it looks.
glm::dvec3 areaOf(vtkPolyData* mesh, vtkIdType cell)
{
  vtkNew<vtkIdList> ids;
  mesh->GetPolys()->GetCellAtId(cell, ids);
  return glm::cross(pointOf(mesh, ids->GetId(2)) - pointOf(mesh, ids->GetId(0)),
    pointOf(mesh, ids->GetId(3)) - pointOf(mesh, ids->GetId(1)));
}

/// Quads that look to another side than the normals of their points; slivers look anywhere.
int turnedQuads(vtkPolyData* mesh)
{
  int turned = 0;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < mesh->GetNumberOfCells(); ++c)
  {
    const glm::dvec3 area = areaOf(mesh, c);
    mesh->GetPolys()->GetCellAtId(c, ids);
    glm::dvec3 normal;
    mesh->GetPointData()->GetNormals()->GetTuple(ids->GetId(0), &normal.x);
    turned += glm::dot(area, normal) < -0.1 * glm::length(area) && glm::length(area) > 1e-5;
  }
  return turned;
}
}

TEST(Contour, OfASphereIsClosedAndOnIt)
{
  for (const int level : { 3, 4, 5, 6, 7 })
  {
    vtkNew<vtkPolyData> mesh;
    const auto built = build([](const glm::dvec3& x) { return ball(x, 0.8); }, level, mesh);
    const double voxel = built.octree.header().voxelSize;
    EXPECT_EQ(built.meshLevel, level);
    const Edges edges(mesh);
    EXPECT_EQ(edges.open, 0) << level;
    EXPECT_EQ(edges.crossed, 0) << level;
    EXPECT_EQ(turnedQuads(mesh), 0) << level;
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      const glm::dvec3 x = pointOf(mesh, i) - Centre;
      // In its cell, which the surface only just touches: a fifth of a voxel beside it.
      ASSERT_NEAR(glm::length(x), 0.8, 0.2 * voxel);
      glm::dvec3 normal;
      mesh->GetPointData()->GetNormals()->GetTuple(i, &normal.x);
      ASSERT_NEAR(glm::length(normal), 1.0, 1e-5);
      ASSERT_GT(glm::dot(normal, x) / glm::length(x), std::cos(voxel / 0.8));
    }
    const double* b = mesh->GetBounds();
    for (int i = 0; i < 3; ++i)
    {
      EXPECT_NEAR(b[2 * i], Centre[i] - 0.8, 0.1 * voxel);
      EXPECT_NEAR(b[2 * i + 1], Centre[i] + 0.8, 0.1 * voxel);
    }
  }
}

TEST(Contour, SurfacesNearEachOtherStayApart)
{
  // Shells of two and a half voxels.
  constexpr double Half = 1.25 * 2.0 / 64.0;
  vtkNew<vtkPolyData> mesh;
  build([](const glm::dvec3& x) { return std::abs(ball(x, 0.7)) - Half; }, 6, mesh);
  const Edges edges(mesh);
  EXPECT_EQ(edges.open, 0);
  EXPECT_EQ(edges.crossed, 0);
  vtkNew<vtkPolyDataConnectivityFilter> parts;
  parts->SetInputData(mesh);
  parts->SetExtractionModeToAllRegions();
  parts->Update();
  EXPECT_EQ(parts->GetNumberOfExtractedRegions(), 2);
}

TEST(Contour, WhatIsThinnerThanAVoxelIsSeen)
{
  // A sheet of a tenth of a voxel in the midst of a layer: about its area is left, once or twice.
  vtkNew<vtkPolyData> mesh;
  const auto built = build(
    [](const glm::dvec3& x) { return std::abs(x.z + 0.1 * x.x - 0.03) - 0.05 / 16.0; }, 5, mesh);
  ASSERT_GT(built.voxels, 0u);
  double area = 0.0;
  for (vtkIdType c = 0; c < mesh->GetNumberOfCells(); ++c)
  {
    area += 0.5 * glm::length(areaOf(mesh, c));
  }
  EXPECT_GT(area, 0.9 * 4.0);
  EXPECT_LT(area, 2.2 * 4.0);

  vtkNew<vtkPolyData> dot;
  EXPECT_GT(build([](const glm::dvec3& x) { return ball(x, 0.03); }, 4, dot).voxels, 0u);
  EXPECT_GT(dot->GetNumberOfCells(), 0);
}

TEST(Contour, AnOpenSurfaceEndsAtItsBox)
{
  for (const int level : { 4, 5 })
  {
    vtkNew<vtkPolyData> mesh;
    build(
      [](const glm::dvec3& x) { return 0.9 * (x.z - 0.2 * x.x + 0.1 * x.y * x.y); }, level, mesh);
    const double* b = mesh->GetBounds();
    for (int i = 0; i < 2; ++i)
    {
      EXPECT_NEAR(b[2 * i], -1.0, 1e-6);
      EXPECT_NEAR(b[2 * i + 1], 1.0, 1e-6);
    }
    EXPECT_EQ(turnedQuads(mesh), 0);
    // Nothing is open but the border.
    double area = 0.0;
    for (vtkIdType c = 0; c < mesh->GetNumberOfCells(); ++c)
    {
      area += 0.5 * areaOf(mesh, c).z;
    }
    EXPECT_NEAR(area, 4.0, 1e-3);
  }
}

TEST(Contour, StandsWhereTheFrameOfItsOctreeSays)
{
  glm::dmat4 frame(1.0);
  frame[0] = { -2.0, 0.1, 0.0, 0.0 }; // mirrored
  frame[1] = { 0.7, 1.0, 0.2, 0.0 };
  frame[3] = { 5.0, -3.0, 1.0, 1.0 };
  ASSERT_LT(glm::determinant(glm::dmat3(frame)), 0.0);
  vtkNew<vtkPolyData> mesh;
  const auto built =
    build([](const glm::dvec3& x) { return ball(x, 0.8); }, 6, mesh, 1000000, frame);
  const glm::dmat4 back = glm::inverse(frame);
  const glm::dvec3 middle(frame * glm::dvec4(Centre, 1.0));
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    const glm::dvec3 x = pointOf(mesh, i);
    const glm::dvec3 own = glm::dvec3(back * glm::dvec4(x, 1.0)) - Centre;
    ASSERT_NEAR(glm::length(own), 0.8, 0.2 * built.octree.header().voxelSize);
    glm::dvec3 normal;
    mesh->GetPointData()->GetNormals()->GetTuple(i, &normal.x);
    const glm::dvec3 expected = glm::normalize(glm::transpose(glm::dmat3(back)) * own);
    ASSERT_GT(glm::dot(normal, expected), 0.99);
    ASSERT_GT(glm::dot(normal, x - middle), 0.0);
  }
  EXPECT_EQ(Edges(mesh).open, 0);
  EXPECT_EQ(turnedQuads(mesh), 0);
}

TEST(Contour, IsNoLargerThanItMayBe)
{
  vtkNew<vtkPolyData> mesh;
  for (const std::size_t cells : { std::size_t(20000), std::size_t(6000), std::size_t(1500) })
  {
    const auto built = build([](const glm::dvec3& x) { return ball(x, 0.8); }, 7, mesh, cells);
    EXPECT_LT(built.meshLevel, 7);
    EXPECT_EQ(svo::deepestLevel(built.octree, cells), built.meshLevel);
    EXPECT_LE(svo::cellsOfLevel(built.octree, built.meshLevel), cells);
    EXPECT_GT(svo::cellsOfLevel(built.octree, built.meshLevel + 1), cells);
    EXPECT_LE(mesh->GetNumberOfCells(), vtkIdType(1.1 * cells));
    EXPECT_EQ(Edges(mesh).open, 0);
    const double cell = std::ldexp(built.octree.header().voxelSize, 7 - built.meshLevel);
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      ASSERT_NEAR(glm::length(pointOf(mesh, i) - Centre), 0.8, 0.2 * cell);
    }
  }
}

TEST(Contour, PointsFarAwayAreToldApart)
{
  glm::dmat4 frame(1.0);
  frame[3] = { 5e6, -3e6, 1e6, 1.0 };
  vtkNew<vtkPolyData> mesh;
  build([](const glm::dvec3& x) { return ball(x, 0.8); }, 6, mesh, 1000000, frame);
  const glm::dvec3 centre = glm::dvec3(frame[3]) + Centre;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    ASSERT_NEAR(glm::length(pointOf(mesh, i) - centre), 0.8, 0.01);
  }
}

TEST(Contour, FrontFacesOfImagesAreThoseOfFlyingEdges)
{
  for (const double sign : { 1.0, -1.0 })
  {
    vtkNew<vtkImageData> image;
    image->SetDimensions(21, 21, 21);
    image->SetOrigin(-10.0, -10.0, -10.0);
    vtkNew<vtkDoubleArray> values;
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      double x[3];
      image->GetPoint(i, x);
      values->InsertNextValue(sign * (std::hypot(x[0], x[1], x[2]) - 7.1));
    }
    values->SetName("Distance");
    image->GetPointData()->SetScalars(values);
    vtkNew<vtkImageToSVO> octree;
    octree->SetInputData(image);
    octree->SetMaximumLevel(5);
    octree->SetColorArrayName("Distance");
    octree->Update();
    vtkNew<vtkFlyingEdges3D> triangles;
    triangles->SetInputData(image);
    triangles->SetValue(0, 0.0);
    triangles->Update();
    vtkPolyData* theirs = triangles->GetOutput();
    double c[3], n[3];
    theirs->GetPoint(0, c);
    theirs->GetPointData()->GetNormals()->GetTuple(0, n);
    const double side = c[0] * n[0] + c[1] * n[1] + c[2] * n[2];
    vtkPolyData* ours = octree->GetOutput();
    EXPECT_EQ(turnedQuads(ours), 0);
    for (vtkIdType i = 0; i < ours->GetNumberOfPoints(); ++i)
    {
      ours->GetPoint(i, c);
      ours->GetPointData()->GetNormals()->GetTuple(i, n);
      ASSERT_GT(side * (c[0] * n[0] + c[1] * n[1] + c[2] * n[2]), 0.0);
    }
    // A quad has the mean of the four voxels that it joins.
    vtkDataArray* leaves = ours->GetFieldData()->GetArray("Distance");
    vtkDataArray* quads = ours->GetCellData()->GetArray("Distance");
    vtkNew<vtkIdList> ids;
    for (vtkIdType q = 0; q < ours->GetNumberOfCells(); ++q)
    {
      ours->GetPolys()->GetCellAtId(q, ids);
      double mean = 0.0;
      for (vtkIdType k = 0; k < 4; ++k)
      {
        mean += 0.25 * leaves->GetComponent(ids->GetId(k), 0);
      }
      ASSERT_NEAR(quads->GetComponent(q, 0), mean, 1e-6);
    }
  }
}
