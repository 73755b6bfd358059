// Shadows as data against closed forms: shares of area, every kind of light, sides, weights.
#include "svoShadowMeshes.h"

#include "vtkDoubleArray.h"
#include "vtkPolyDataNormals.h"
#include "vtkSphereSource.h"

#include <algorithm>

using namespace svotest;

namespace
{
/// A square of edge 1 at height 1 above the middle of a ground from -2 to 2.
struct Table
{
  MeshPointer ground = level(-2, 2, -2, 2, 0);
  MeshPointer board = level(-0.5, 0.5, -0.5, 0.5, 1);
  Shadows shadows{ this->ground };

  Table() { this->shadows.filter->AddCasterData(this->board); }
};
}

TEST(SVOShadowFilter, ShareOfAreaUnderABoard)
{
  Table table;
  table.shadows.filter->SetSamplesPerCell(4096);
  table.shadows.filter->AddLight(sun(0, 0, 1));
  table.shadows.filter->AddLight(sun(0.5, 0, 1)); // the same, beside the middle
  table.shadows.filter->AddLight(lamp(0, 0, 2));  // twice as wide
  table.shadows.filter->AddLight(sun(3, 0, 1));   // beside the ground
  EXPECT_NEAR(table.shadows.shadow(0, 0), 1.0 / 16.0, 2e-3);
  EXPECT_NEAR(table.shadows.shadow(0, 1), 1.0 / 16.0, 2e-3);
  EXPECT_NEAR(table.shadows.shadow(0, 2), 4.0 / 16.0, 2e-3);
  EXPECT_EQ(table.shadows.shadow(0, 3), 0.0);
  EXPECT_NEAR(table.shadows.exposure(0), 4.0 - 6.0 / 16.0, 6e-3);
  table.shadows.expectQuiet();
}

TEST(SVOShadowFilter, MoreSamplesAreCloser)
{
  // A light whose shadow of the board has edges along no axis of the ground.
  double last = 1.0;
  for (const int samples : { 16, 1024, 65536 })
  {
    Table table;
    MeshPointer board =
      polygons({ { 0.6, 0.1, 1 }, { 0, 0.7, 1 }, { -0.7, -0.2, 1 } }, { { 0, 1, 2 } });
    table.shadows.filter->RemoveAllCasters();
    table.shadows.filter->AddCasterData(board);
    table.shadows.filter->SetSamplesPerCell(samples);
    table.shadows.filter->AddLight(sun(0.1, 0.2, 1));
    const double area =
      0.5 * std::abs((0 - 0.6) * (-0.2 - 0.1) - (-0.7 - 0.6) * (0.7 - 0.1)) / 16.0;
    const double error = std::abs(table.shadows.shadow(0) - area);
    EXPECT_LT(error, 1.0 / std::pow(samples, 0.7)) << samples;
    EXPECT_LT(error, last);
    last = error;
  }
}

TEST(SVOShadowFilter, PolygonsCountByArea)
{
  // An L of one cell would be a fan that overlaps itself; a pentagon is none.
  MeshPointer house = polygons(
    { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 1, 2, 0 }, { 0, 1, 0 } }, { { 0, 1, 2, 3, 4 } });
  Shadows shadows(house);
  shadows.filter->SetSamplesPerCell(8192);
  shadows.filter->AddCasterData(level(-1, 3, 1, 3, 1)); // above the roof, 1 of 3
  shadows.filter->AddLight(sun(0, 0, 1));
  EXPECT_NEAR(shadows.shadow(0), 1.0 / 3.0, 1e-3);
}

TEST(SVOShadowFilter, StripsAreCellsToo)
{
  auto strip = MeshPointer::New();
  vtkNew<vtkPoints> points;
  for (const double x : { 0.0, 1.0, 2.0, 3.0 })
  {
    points->InsertNextPoint(x, 0, 0);
    points->InsertNextPoint(x, 1, 0);
  }
  vtkNew<vtkCellArray> strips;
  strips->InsertNextCell({ 1, 0, 3, 2, 5, 4, 7, 6 });
  strip->SetPoints(points);
  strip->SetStrips(strips);
  Shadows shadows(strip);
  shadows.filter->SetSamplesPerCell(6 * 1024);
  shadows.filter->AddCasterData(level(-1, 0.75, -1, 2, 1));
  shadows.filter->AddLight(sun(0, 0, 1));
  shadows.filter->SetTwoSided(true);
  EXPECT_NEAR(shadows.shadow(0), 0.25, 2e-3);
  shadows.expectQuiet();
}

TEST(SVOShadowFilter, ConesEndLight)
{
  // A cone of 45 degrees at height 1 lights a disc of radius 1 around (0.5, 0).
  Shadows shadows(level(-2, 2, -2, 2, 0));
  shadows.filter->SetSamplesPerCell(16384);
  shadows.filter->AddLight(lamp(0.5, 0, 1, 45.0));
  shadows.filter->AddLight(lamp(0.5, 0, 1, 90.0)); // as VTK draws it: no cone
  EXPECT_NEAR(shadows.shadow(0, 0), 1.0 - 3.14159265 / 16.0, 2e-3);
  EXPECT_EQ(shadows.shadow(0, 1), 0.0);
}

TEST(SVOShadowFilter, WhatLiesBehindALampCastsNothing)
{
  Table table;
  table.shadows.filter->AddLight(lamp(0, 0, 0.9));
  table.shadows.filter->AddLight(lamp(0, 0, 1.0)); // on the board
  EXPECT_EQ(table.shadows.shadow(0, 0), 0.0);
  EXPECT_EQ(table.shadows.shadow(0, 1), 0.0);
}

TEST(SVOShadowFilter, ASphereIsHalfInItsOwnShadow)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(200);
  source->SetPhiResolution(200);
  for (const bool byPoint : { false, true })
  {
    for (const bool normals : { false, true })
    {
      source->Update();
      MeshPointer ball = source->GetOutput();
      if (!normals)
      {
        ball->GetPointData()->SetNormals(nullptr);
      }
      Shadows shadows(ball, byPoint);
      shadows.filter->AddLight(sun(0.3, -0.4, 0.5));
      vtkDataArray* shadow = shadows.array("Shadow");
      const double length = std::sqrt(0.5);
      for (vtkIdType i = 0; i < shadow->GetNumberOfTuples(); ++i)
      {
        double x[3] = { 0, 0, 0 };
        if (byPoint)
        {
          ball->GetPoint(i, x);
        }
        else
        {
          vtkNew<vtkIdList> ids;
          ball->GetCellPoints(i, ids);
          for (vtkIdType k = 0; k < 3; ++k)
          {
            double p[3];
            ball->GetPoint(ids->GetId(k), p);
            for (int a = 0; a < 3; ++a)
            {
              x[a] += p[a] / 3.0;
            }
          }
        }
        const double cosine = (0.3 * x[0] - 0.4 * x[1] + 0.5 * x[2]) / (0.5 * length);
        // A facet is 0.03 wide, so its plane turns away by as much before or after the ball does.
        if (std::abs(cosine) > 0.02)
        {
          ASSERT_EQ(shadow->GetComponent(i, 0), cosine < 0.0 ? 1.0 : 0.0) << i << " " << cosine;
        }
      }
      shadows.expectQuiet();
    }
  }
}

TEST(SVOShadowFilter, SidesOfASheet)
{
  Shadows shadows(level(-1, 1, -1, 1, 0));
  shadows.filter->AddLight(sun(0, 0, -1));
  EXPECT_EQ(shadows.shadow(0), 1.0);
  shadows.filter->TwoSidedOn();
  EXPECT_EQ(shadows.shadow(0), 0.0) << "a sheet does not shadow itself";
  shadows.filter->SetAssociationToPoint();
  EXPECT_EQ(shadows.shadow(3), 0.0);
  shadows.filter->TwoSidedOff();
  EXPECT_EQ(shadows.shadow(3), 1.0);
}

TEST(SVOShadowFilter, PointsInAValleyAreOnTheirOwnFacets)
{
  // The two facets of a V, open, and a light that grazes the one and faces the other.
  MeshPointer valley =
    polygons({ { -1, -1, 1 }, { 0, -1, 0 }, { 0, 1, 0 }, { -1, 1, 1 }, { 1, -1, 1 }, { 1, 1, 1 } },
      { { 0, 1, 2, 3 }, { 1, 4, 5, 2 } });
  Shadows shadows(valley, true);
  shadows.filter->AddLight(sun(-1, 0, 0.5));
  EXPECT_EQ(shadows.shadow(1), 0.0) << "the facets that have the point are left out";
  shadows.filter->AddCasterData(level(-3, -0.5, -2, 2, 0.5));
  EXPECT_EQ(shadows.shadow(1), 1.0);
}

TEST(SVOShadowFilter, SamplesTogetherGetWhatTheyGetAlone)
{
  // As beams, or as blocks where beams see too much.
  for (const int samples : { 0, 1, 64 })
  {
    vtkSmartPointer<vtkDataArray> answers[2];
    for (const bool alone : { false, true })
    {
      Shadows shadows(hills(samples == 64 ? 12 : 60), samples == 0);
      shadows.filter->SetSamplesPerCell(std::max(samples, 1));
      shadows.filter->SetSingleRays(alone);
      shadows.filter->SetTwoSided(true);
      for (int i = 0; i < 20; ++i)
      {
        shadows.filter->AddLight(sun(std::cos(i), std::sin(i), 0.02 * i));
        shadows.filter->AddLight(lamp(0.9 * std::cos(i), 0.9 * std::sin(i), 0.25));
      }
      answers[alone] = shadows.array("Shadow");
    }
    const vtkIdType values = answers[0]->GetNumberOfTuples() * 40;
    vtkIdType differ = 0;
    for (vtkIdType i = 0; i < values; ++i)
    {
      differ +=
        answers[0]->GetComponent(i / 40, i % 40) != answers[1]->GetComponent(i / 40, i % 40);
    }
    // Of rays of 1 among edges 0.03 apart, those that pass one within 1e-6 on either side: 2e-6 /
    // 0.03.
    EXPECT_LE(differ, values / 15000) << "of " << values << " with " << samples << " samples";
  }
}

TEST(SVOShadowFilter, WeightsAndCosines)
{
  Shadows shadows(level(-1, 1, -1, 1, 0));
  shadows.filter->AddLight(sun(0, 0, 1));
  shadows.filter->AddLight(sun(std::sqrt(3.0), 0, 1));
  auto off = sun(0, 0, 1);
  off->SwitchOff();
  shadows.filter->AddLight(off);
  shadows.filter->SetWeight(1, 10.0);
  EXPECT_EQ(shadows.filter->GetWeight(0), 1.0);
  EXPECT_EQ(shadows.filter->GetWeight(1), 10.0);
  EXPECT_NEAR(shadows.exposure(0), 11.0, 1e-12);
  EXPECT_EQ(shadows.shadow(0, 2), 1.0) << "nothing arrives of a light that is off";
  shadows.filter->CosineWeightedOn();
  EXPECT_NEAR(shadows.exposure(0), 6.0, 1e-12);
  off->SwitchOn();
  EXPECT_NEAR(shadows.exposure(0), 7.0, 1e-12) << "lights are looked at again";
  shadows.filter->RemoveLight(shadows.filter->GetLight(0));
  EXPECT_EQ(shadows.filter->GetNumberOfLights(), 2);
  EXPECT_NEAR(shadows.exposure(0), 6.0, 1e-12);
  EXPECT_EQ(shadows.array("Shadow")->GetNumberOfComponents(), 2);
  shadows.filter->WriteShadowOff();
  EXPECT_EQ(shadows.array("Shadow"), nullptr);
  EXPECT_NEAR(shadows.exposure(0), 6.0, 1e-12);
  shadows.expectQuiet();
}

TEST(SVOShadowFilter, MatricesPlaceMeshAndCasters)
{
  // The ground upside down and mirrored, which is as it was; the board sheared, and farther away.
  Table table;
  table.shadows.filter->SetSamplesPerCell(4096);
  table.shadows.filter->AddLight(sun(0, 0, 1));
  table.shadows.filter->SetCasterMatrix(
    0, matrix({ -1, 0.4, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 100, 0, 0, 0, 1 }));
  EXPECT_NEAR(table.shadows.shadow(0), 1.0 / 16.0, 2e-3);
  auto place = matrix({ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 50, 0, 0, 0, 1 });
  table.shadows.filter->SetMeshMatrix(place);
  table.shadows.expectQuiet();
  EXPECT_EQ(table.shadows.shadow(0), 1.0) << "what was below is above, and the light is behind it";
  ASSERT_EQ(table.shadows.messages.warnings.size(), 1u);
  EXPECT_NE(
    table.shadows.messages.all().find("no cell faces any of the lights"), std::string::npos);
  place->SetElement(2, 2, 1.0);
  EXPECT_NEAR(table.shadows.shadow(0), 1.0 / 16.0, 2e-3) << "matrices are looked at again";
  place->SetElement(2, 3, 150.0);
  EXPECT_EQ(table.shadows.shadow(0), 0.0) << "the board is below";
  EXPECT_EQ(table.shadows.messages.warnings.size(), 1u) << "that was all";
}

TEST(SVOShadowFilter, TheMeshCastsIfItIsToldTo)
{
  // One mesh of a ground and a board.
  MeshPointer both =
    polygons({ { -2, -2, 0 }, { 2, -2, 0 }, { 2, 2, 0 }, { -2, 2, 0 }, { -0.5, -0.5, 1 },
               { 0.5, -0.5, 1 }, { 0.5, 0.5, 1 }, { -0.5, 0.5, 1 } },
      { { 0, 1, 2, 3 }, { 4, 5, 6, 7 } });
  Shadows shadows(both);
  shadows.filter->SetSamplesPerCell(1024);
  shadows.filter->AddLight(sun(0, 0, 1));
  EXPECT_NEAR(shadows.shadow(0), 1.0 / 16.0, 4e-3);
  EXPECT_EQ(shadows.shadow(1), 0.0);
  shadows.filter->MeshCastsOff();
  EXPECT_EQ(shadows.shadow(0), 0.0);
}

TEST(SVOShadowFilter, TwoMeshesInOnePlaceDoNotShadowEachOther)
{
  // The same ground as a caster, elsewhere in its own coordinates, so that it is rounded otherwise.
  MeshPointer slope = hills(20);
  Shadows shadows(slope);
  shadows.filter->AddLight(sun(0.1, 0.2, 1));
  shadows.filter->AddLight(sun(-0.3, 0.1, 1));
  shadows.filter->MeshCastsOff();
  auto other = MeshPointer::New();
  other->DeepCopy(slope);
  for (vtkIdType i = 0; i < other->GetNumberOfPoints(); ++i)
  {
    double p[3];
    other->GetPoint(i, p);
    other->GetPoints()->SetPoint(i, p[0] + 7.0, p[1] - 3.0, p[2]);
  }
  shadows.filter->AddCasterData(other);
  shadows.filter->SetCasterMatrix(0, matrix({ 1, 0, 0, -7, 0, 1, 0, 3, 0, 0, 1, 0, 0, 0, 0, 1 }));
  Shadows alone(slope);
  alone.filter->AddLight(sun(0.1, 0.2, 1));
  alone.filter->AddLight(sun(-0.3, 0.1, 1));
  vtkDataArray *a = shadows.array("Shadow"), *b = alone.array("Shadow");
  for (vtkIdType i = 0; i < slope->GetNumberOfCells(); ++i)
  {
    ASSERT_EQ(a->GetComponent(i, 0), b->GetComponent(i, 0)) << i;
    ASSERT_EQ(a->GetComponent(i, 1), b->GetComponent(i, 1)) << i;
  }
}

TEST(SVOShadowFilter, SensorsInTheAir)
{
  // Points that belong to no cell have no side.
  auto cloud = MeshPointer::New();
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 0.5);
  points->InsertNextPoint(0, 0, 1.5);
  points->InsertNextPoint(5, 0, 0.5);
  cloud->SetPoints(points);
  Shadows shadows(cloud, true);
  shadows.filter->AddCasterData(level(-1, 1, -1, 1, 1));
  shadows.filter->AddLight(lamp(0, 0, 2));
  shadows.filter->AddLight(sun(0, 0, -1));
  shadows.filter->CosineWeightedOn();
  EXPECT_EQ(shadows.shadow(0, 0), 1.0);
  EXPECT_EQ(shadows.shadow(1, 0), 0.0);
  EXPECT_EQ(shadows.shadow(2, 0), 0.0);
  EXPECT_EQ(shadows.shadow(0, 1), 0.0);
  EXPECT_EQ(shadows.shadow(1, 1), 1.0);
  EXPECT_EQ(shadows.exposure(2), 2.0) << "where there is no side there is no cosine";
  shadows.expectQuiet();
}
