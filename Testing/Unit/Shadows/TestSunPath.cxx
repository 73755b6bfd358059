// The sun's place against published values, and skies against closed forms.
#include "svoShadowMeshes.h"
#include "svoSkyDirections.h"
#include "svoSunPosition.h"
#include "vtkSVOExposureFilter.h"
#include "vtkSVOSky.h"
#include "vtkSVOSunPath.h"

#include <limits>

#include <glm/geometric.hpp>

using namespace svotest;

namespace
{
constexpr double Pi = 3.14159265358979323846;

/// Place and clock of a sun path.
vtkSmartPointer<vtkSVOSunPath> pathAt(
  double latitude, double longitude, double zone, int year, int month, int day)
{
  auto path = vtkSmartPointer<vtkSVOSunPath>::New();
  path->SetLatitude(latitude);
  path->SetLongitude(longitude);
  path->SetTimeZone(zone);
  path->SetDate(year, month, day);
  return path;
}

/// The local hour, between two, at which the sun's centre passes an elevation.
double hourOf(vtkSVOSunPath* path, double elevation, double first, double last)
{
  const bool rises = path->GetElevation(first) < elevation;
  for (int i = 0; i < 60; ++i)
  {
    const double middle = 0.5 * (first + last);
    ((path->GetElevation(middle) < elevation) == rises ? first : last) = middle;
  }
  return first;
}
}

TEST(SunPath, JulianDaysOfMeeus)
{
  EXPECT_EQ(svo::julianDay(2000, 1, 1, 12.0), 2451545.0);
  EXPECT_EQ(svo::julianDay(1987, 1, 27, 0.0), 2446822.5);
  EXPECT_EQ(svo::julianDay(1600, 12, 31, 0.0), 2305812.5);
  EXPECT_EQ(svo::julianDay(1999, 12, 31, 36.0), svo::julianDay(2000, 1, 1, 12.0));
  EXPECT_TRUE(svo::isDate(2000, 2, 29));
  EXPECT_FALSE(svo::isDate(1900, 2, 29));
  EXPECT_FALSE(svo::isDate(2024, 4, 31));
  EXPECT_FALSE(svo::isDate(2024, 0, 1));
}

TEST(SunPath, ApparentPlaceOfMeeusExample25a)
{
  // 1992 October 13, 0 TD.
  const svo::SunPlace sun = svo::sunPlace(2448908.5);
  EXPECT_NEAR(sun.rightAscension, 198.38083, 2e-4);
  EXPECT_NEAR(sun.declination, -7.78507, 2e-4);
}

TEST(SunPath, ExampleOfNREL)
{
  // I. Reda, A. Andreas, "Solar position algorithm", NREL/TP-560-34302, 2008, table A5.1: Golden,
  // Colorado, 17 October 2003, 12:30:30; zenith 50.11162, azimuth 194.34024, with refraction of air
  // of 820 hPa, and parallax.
  auto path = pathAt(39.742476, -105.1786, -7.0, 2003, 10, 17);
  const double hour = 12.0 + 30.5 / 60.0;
  EXPECT_NEAR(path->GetElevation(hour), 90.0 - 50.11162, 0.01);
  EXPECT_NEAR(path->GetAzimuth(hour), 194.34024, 0.01);
  path->RefractionOff();
  EXPECT_NEAR(path->GetElevation(hour), 39.872046, 0.005); // e0 of the same example
}

TEST(SunPath, SolsticesAndEquinoxes)
{
  // Declinations of plus and minus 23.44, and 0: elevations at noon follow.
  struct Case
  {
    int month, day;
    double declination;
  };
  for (const Case& c : { Case{ 6, 20, 23.44 }, Case{ 12, 21, -23.44 } })
  {
    for (const double latitude : { -33.87, 0.0, 51.48, 69.65 })
    {
      auto path = pathAt(latitude, 0.0, 0.0, 2024, c.month, c.day);
      path->RefractionOff();
      double highest = -90.0;
      for (double hour = 11.0; hour < 13.0; hour += 0.01)
      {
        highest = std::max(highest, path->GetElevation(hour));
      }
      EXPECT_NEAR(highest, 90.0 - std::abs(latitude - c.declination), 0.01);
    }
  }
}

TEST(SunPath, RefractionOfNOAA)
{
  EXPECT_NEAR(svo::refraction(0.0), 1735.0 / 3600.0, 1e-12);
  EXPECT_NEAR(svo::refraction(-0.575), 0.575, 0.01) << "what looks like the horizon";
  EXPECT_NEAR(svo::refraction(30.0), 0.0277, 5e-4);
  EXPECT_EQ(svo::refraction(89.0), 0.0);
  const glm::dvec3 zenith(0, 0, 1);
  EXPECT_EQ(svo::refracted(zenith), zenith);
}

TEST(SunPath, PolarDaysAndNights)
{
  auto tromso = pathAt(69.65, 18.96, 1.0, 2024, 6, 21);
  for (int hour = 0; hour <= 24; ++hour)
  {
    EXPECT_GT(tromso->GetElevation(hour), 2.0) << hour;
  }
  Shadows ground(level(-1, 1, -1, 1, 0));
  EXPECT_EQ(tromso->AddLights(ground.filter), 48);
  EXPECT_NEAR(ground.exposure(0), 24.0, 1e-9);
  tromso->SetDate(2024, 12, 21);
  ground.filter->RemoveAllLights();
  EXPECT_EQ(tromso->AddLights(ground.filter), 0);
}

TEST(SunPath, LengthsOfDays)
{
  // By refraction and by nothing else: the centre's day at the equator lasts 12 hours and a bit.
  auto quito = pathAt(0.0, -78.5, -5.0, 2024, 3, 20);
  EXPECT_NEAR(
    hourOf(quito, 0.0, 12, 24) - hourOf(quito, 0.0, 0, 12), 12.0 + 2.0 * 0.575 / 15.0, 0.02);
  Shadows ground(level(-1, 1, -1, 1, 0));
  quito->SetStep(1.0);
  quito->AddLights(ground.filter);
  EXPECT_NEAR(ground.exposure(0), 12.07, 0.03);
}

TEST(SunPath, SouthOfTheTropicsTheSunIsNorth)
{
  auto sydney = pathAt(-33.87, 151.21, 10.0, 2024, 6, 21);
  double direction[3];
  EXPECT_TRUE(sydney->GetDirection(12.0, direction));
  EXPECT_GT(direction[1], 0.5);
  EXPECT_LT(std::abs(direction[0]), 0.05);
  EXPECT_TRUE(sydney->GetDirection(8.0, direction));
  EXPECT_GT(direction[0], 0.5) << "mornings are in the east";
  EXPECT_FALSE(sydney->GetDirection(3.0, direction));
}

TEST(SunPath, FramesOfModels)
{
  // North along x, up along y: east is z.
  auto path = pathAt(48.0, 11.0, 1.0, 2024, 9, 1);
  double plain[3], turned[3];
  path->GetDirection(10.0, plain);
  path->SetNorth(2.0, 5.0, 0.0);
  path->SetUp(0.0, 3.0, 0.0);
  path->GetDirection(10.0, turned);
  EXPECT_NEAR(turned[2], plain[0], 1e-12);
  EXPECT_NEAR(turned[0], plain[1], 1e-12);
  EXPECT_NEAR(turned[1], plain[2], 1e-12);
  svo::TestMessages messages(path);
  path->SetNorth(0.0, -1.0, 0.0);
  EXPECT_FALSE(path->GetDirection(10.0, turned));
  path->SetNorth(1.0, 0.0, 0.0);
  path->SetDate(2023, 2, 29);
  EXPECT_FALSE(path->GetDirection(10.0, turned));
  EXPECT_EQ(messages.errors.size(), 2u);
}

TEST(SunPath, NumbersThatAreWrongAreSaidAndNotUsed)
{
  auto path = pathAt(48.1, 11.6, 1.0, 2024, 6, 21);
  vtkNew<vtkSVOExposureFilter> filter;
  filter->SetLatitude(48.1);
  filter->SetLongitude(11.6);
  svo::TestMessages ofPath(path), ofFilter(filter);
  const double nan = std::nan("");
  for (const double value : { nan, std::numeric_limits<double>::infinity() })
  {
    path->SetLatitude(value);
    path->SetLongitude(value);
    path->SetTimeZone(value);
    path->SetStartHour(value);
    path->SetEndHour(value);
    path->SetStep(value);
    path->SetBinWidth(value);
    filter->SetLatitude(value);
    filter->SetLongitude(value);
    filter->SetTimeZone(value);
    filter->SetStartHour(value);
    filter->SetEndHour(value);
    filter->SetStep(value);
    filter->SetBinWidth(value);
  }
  EXPECT_EQ(ofPath.warnings.size(), 14u) << ofPath.all();
  EXPECT_EQ(ofFilter.warnings.size(), 14u) << ofFilter.all();
  EXPECT_EQ(path->GetLatitude(), 48.1);
  EXPECT_EQ(path->GetLongitude(), 11.6);
  EXPECT_EQ(path->GetStep(), 30.0);
  EXPECT_EQ(filter->GetLatitude(), 48.1);
  EXPECT_EQ(filter->GetEndHour(), 24.0);
  path->SetLatitude(480.1);
  EXPECT_EQ(path->GetLatitude(), 90.0);
  EXPECT_EQ(ofPath.warnings.size(), 15u);
}

TEST(SunPath, LongitudesGoRound)
{
  auto path = pathAt(37.8, -122.4, -7.0, 2024, 6, 21);
  vtkNew<vtkSVOExposureFilter> filter;
  svo::TestMessages messages(path);
  const double azimuth = path->GetAzimuth(13.0);
  for (const double same : { 237.6, -482.4, 957.6 })
  {
    path->SetLongitude(same);
    filter->SetLongitude(same);
    EXPECT_NEAR(path->GetLongitude(), -122.4, 1e-9);
    EXPECT_NEAR(filter->GetLongitude(), -122.4, 1e-9);
    EXPECT_NEAR(path->GetAzimuth(13.0), azimuth, 1e-9);
  }
  path->SetLongitude(180.0);
  EXPECT_EQ(path->GetLongitude(), 180.0);
  path->SetLongitude(-180.0);
  EXPECT_EQ(path->GetLongitude(), -180.0);
  EXPECT_EQ(messages.all(), "");
}

TEST(SunPath, WhatAddsNoLightSaysWhy)
{
  auto path = pathAt(48.1, 11.6, 1.0, 2024, 6, 21);
  vtkNew<vtkSVOSky> sky;
  svo::TestMessages messages(path), ofSky(sky);
  EXPECT_EQ(path->AddLights(nullptr), 0);
  EXPECT_EQ(sky->AddLights(nullptr), 0);
  vtkNew<vtkSVOShadowFilter> filter;
  path->SetStartHour(20.0);
  path->SetEndHour(4.0);
  EXPECT_EQ(path->AddLights(filter), 0);
  EXPECT_EQ(messages.errors.size(), 2u);
  EXPECT_EQ(ofSky.errors.size(), 1u);
}

TEST(SunPath, LightsHaveTheirTimes)
{
  auto path = pathAt(48.1, 11.6, 1.0, 2024, 2, 28);
  path->SetStartHour(12.0);
  path->SetEndHour(13.0);
  path->SetNumberOfDays(3);
  Shadows ground(level(-1, 1, -1, 1, 0));
  EXPECT_EQ(path->AddLights(ground.filter), 6);
  EXPECT_STREQ(ground.filter->GetLightName(0), "2024-02-28 12:15");
  EXPECT_STREQ(ground.filter->GetLightName(3), "2024-02-29 12:45");
  vtkDataArray* shadow = ground.array("Shadow");
  EXPECT_STREQ(shadow->GetComponentName(0), "2024-02-28 12:15");
  EXPECT_STREQ(shadow->GetComponentName(5), "2024-03-01 12:45");
  ground.filter->SetLightName(0, "noon");
  EXPECT_STREQ(ground.array("Shadow")->GetComponentName(0), "noon");
  ground.expectQuiet();
  EXPECT_EQ(ground.filter->GetLightName(6), nullptr);
  EXPECT_EQ(ground.messages.errors.size(), 1u);
}

TEST(SunPath, AYearInBins)
{
  // A wall south of a meadow, and all suns of a year beside those of bins.
  const auto hours = [](double width, int& lights)
  {
    auto path = pathAt(48.1, 11.6, 1.0, 2024, 1, 1);
    path->SetNumberOfDays(366);
    path->SetStep(20.0);
    path->SetBinWidth(width);
    Shadows meadow(level(-10, 10, -10, 10, 0, 12));
    meadow.filter->AddCasterData(
      polygons({ { -4, -3, 0 }, { 4, -3, 0 }, { 4, -3, 5 }, { -4, -3, 5 } }, { { 0, 1, 2, 3 } }));
    meadow.filter->WriteShadowOff();
    lights = path->AddLights(meadow.filter);
    double weights = 0.0;
    for (int i = 0; i < lights; ++i)
    {
      weights += meadow.filter->GetWeight(i);
    }
    std::vector<double> result{ weights };
    vtkDataArray* exposure = meadow.array("Exposure");
    for (vtkIdType i = 0; i < exposure->GetNumberOfTuples(); ++i)
    {
      result.push_back(exposure->GetComponent(i, 0));
    }
    meadow.expectQuiet();
    return result;
  };
  int all = 0;
  const std::vector<double> exact = hours(0.0, all);
  EXPECT_GT(all, 13000);
  for (const double width : { 0.5, 1.0, 2.0, 4.0 })
  {
    int lights = 0;
    const std::vector<double> binned = hours(width, lights);
    EXPECT_NEAR(binned[0], exact[0], 1e-6) << "no sun is lost";
    double most = 0.0, squares = 0.0;
    for (std::size_t i = 1; i < exact.size(); ++i)
    {
      const double off = std::abs(binned[i] - exact[i]);
      most = std::max(most, off);
      squares += off * off / static_cast<double>(exact.size() - 1);
    }
    std::cout << all << " suns, bins of " << width << " degrees: " << lights << " lights, off by "
              << std::sqrt(squares) << " h (root mean square), " << most << " h at most, of "
              << exact[0] << "\n";
    EXPECT_LT(lights, all / (width < 1.0 ? 1.2 : 3.0 * width * width / (1.0 + width)));
    EXPECT_LT(most, 0.01 * width * exact[0]);
  }
}

TEST(Sky, ALevelPlaceSeesAllOfIt)
{
  for (const int type : { 0, 1 })
  {
    for (const bool cosine : { false, true })
    {
      Shadows ground(level(-1, 1, -1, 1, 0));
      ground.filter->SetCosineWeighted(cosine);
      vtkNew<vtkSVOSky> sky;
      sky->SetType(type);
      EXPECT_EQ(sky->AddLights(ground.filter), 256);
      EXPECT_NEAR(ground.exposure(0), 1.0, 1e-12);
    }
  }
}

TEST(Sky, CosineWeightedMayBeSetLater)
{
  for (const int type : { 0, 1 })
  {
    Shadows ground(level(-1, 1, -1, 1, 0));
    vtkNew<vtkSVOSky> sky;
    sky->SetType(type);
    sky->AddLights(ground.filter);
    EXPECT_NEAR(ground.exposure(0), 1.0, 1e-12);
    ground.filter->CosineWeightedOn();
    EXPECT_NEAR(ground.exposure(0), 1.0, 1e-12);
    ground.filter->SetWeight(0, 7.0);
    EXPECT_EQ(ground.filter->GetWeight(0), 7.0);
    ground.expectQuiet();
  }
}

TEST(Sky, FootOfAWallAndMiddleOfAStreet)
{
  // View factors of infinite walls (height h, distance d): (1 + sin(atan(d / h))) / 2 ... of a
  // street, the cosine of the walls' elevation.
  const auto walls = [](double d, double h, bool both)
  {
    std::vector<Point> points = { { d, -1e3, 0 }, { d, 1e3, 0 }, { d, 1e3, h }, { d, -1e3, h } };
    std::vector<std::vector<vtkIdType>> cells = { { 0, 1, 2, 3 } };
    if (both)
    {
      points.insert(
        points.end(), { { -d, -1e3, 0 }, { -d, 1e3, 0 }, { -d, 1e3, h }, { -d, -1e3, h } });
      cells.push_back({ 4, 5, 6, 7 });
    }
    return polygons(points, cells);
  };
  for (const double h : { 0.5, 1.0, 3.0 })
  {
    Shadows wall(level(-0.01, 0.01, -0.01, 0.01, 0)), street(level(-0.01, 0.01, -0.01, 0.01, 0));
    for (Shadows* shadows : { &wall, &street })
    {
      shadows->filter->AddCasterData(walls(1.0, h, shadows == &street));
      shadows->filter->CosineWeightedOn();
      shadows->filter->SetSamplesPerCell(1);
      vtkNew<vtkSVOSky> sky;
      sky->SetNumberOfDirections(20000);
      sky->AddLights(shadows->filter);
    }
    const double elevation = std::atan(h);
    EXPECT_NEAR(wall.exposure(0), 0.5 * (1.0 + std::cos(elevation)), 1e-3) << h;
    EXPECT_NEAR(street.exposure(0), std::cos(elevation), 1e-3) << h;
  }
}

TEST(Sky, CIEHorizonIsAThirdOfTheZenith)
{
  EXPECT_EQ(svo::overcastSky(1.0), 1.0);
  EXPECT_NEAR(svo::overcastSky(0.0), 1.0 / 3.0, 1e-15);
  // A pit whose rim is at 45 degrees: of an overcast sky that is uniform in azimuth,
  // integral of (1 + 2 s) s ds from sin 45 to 1 by that from 0 to 1.
  const double s = std::sqrt(0.5);
  const double expected = (0.5 * (1.0 - s * s) + 2.0 / 3.0 * (1.0 - s * s * s)) / (0.5 + 2.0 / 3.0);
  std::vector<Point> rim;
  std::vector<std::vector<vtkIdType>> cells;
  const int n = 720;
  for (int i = 0; i < n; ++i)
  {
    const double a = 2.0 * Pi * i / n;
    rim.push_back({ std::cos(a), std::sin(a), 0 });
    rim.push_back({ std::cos(a), std::sin(a), 1 });
    const vtkIdType k = 2 * i, next = 2 * ((i + 1) % n);
    cells.push_back({ k, next, next + 1, k + 1 });
  }
  Shadows floor(level(-0.001, 0.001, -0.001, 0.001, 0));
  floor.filter->AddCasterData(polygons(rim, cells));
  floor.filter->CosineWeightedOn();
  vtkNew<vtkSVOSky> sky;
  sky->SetTypeToOvercast();
  sky->SetNumberOfDirections(20000);
  sky->AddLights(floor.filter);
  EXPECT_NEAR(floor.exposure(0), expected, 1e-3);
}

TEST(ExposureFilter, MakesTheLightsOfItsHelpers)
{
  vtkNew<vtkSVOExposureFilter> filter;
  svo::TestMessages messages(filter);
  MeshPointer ground = level(-1, 1, -1, 1, 0);
  filter->SetInputData(ground);
  const auto exposure = [&]
  {
    filter->Update();
    return filter->GetOutput()->GetCellData()->GetArray("Exposure")->GetComponent(0, 0);
  };
  filter->SetDate(2024, 3, 20);
  filter->SetStep(1.0);
  EXPECT_NEAR(exposure(), 12.07, 0.03);
  const vtkMTimeType before = filter->GetOutput()->GetMTime();
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetMTime(), before) << "its lights do not outdate it";
  filter->SetLatitude(80.0);
  filter->SetDate(2024, 12, 21);
  EXPECT_EQ(exposure(), 0.0) << "polar night";
  EXPECT_EQ(messages.all(), "");
  filter->SetLightSourceToSky();
  EXPECT_NEAR(exposure(), 1.0, 1e-12);
  filter->SetLightSourceToDirections();
  EXPECT_EQ(exposure(), 0.0);
  EXPECT_EQ(messages.warnings.size(), 1u);
  filter->AddDirection(0, 0, 1);
  filter->AddDirection(1, 0, 1);
  EXPECT_EQ(exposure(), 2.0);
  filter->SetLightSourceToPositions();
  filter->AddPosition(0, 0, 2);
  EXPECT_EQ(exposure(), 1.0);
  double p[3];
  filter->GetPosition(0, p);
  EXPECT_EQ(p[2], 2.0);
  EXPECT_EQ(messages.warnings.size(), 1u);
}
