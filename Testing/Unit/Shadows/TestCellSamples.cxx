// Where a cell's samples lie: straight edges of shadows at all angles and places against the exact
// share of the area, beside those of a grid of as many points; how many there are.
#include "svoShadowMeshes.h"

#include <algorithm>
#include <array>
#include <random>

using namespace svotest;

namespace
{
using Flat = std::array<double, 2>;
using Shape = std::vector<Flat>; // counterclockwise

const Shape Square = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
const Shape Triangle = { { 0, 0 }, { 1, 0 }, { 0.5, 0.866025403784438647 } };
const Shape Pentagon = { { 0, 0 }, { 1, 0 }, { 1.3, 0.8 }, { 0.5, 1.4 }, { -0.2, 0.9 } };

double areaOf(const Shape& shape)
{
  double twice = 0.0;
  for (std::size_t i = 0; i < shape.size(); ++i)
  {
    const Flat &a = shape[i], &b = shape[(i + 1) % shape.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return 0.5 * twice;
}

/// What is left of an edge: where x < 0.
Shape clipped(const Shape& shape)
{
  Shape result;
  for (std::size_t i = 0; i < shape.size(); ++i)
  {
    const Flat &a = shape[i], &b = shape[(i + 1) % shape.size()];
    if (a[0] < 0.0)
    {
      result.push_back(a);
    }
    if ((a[0] < 0.0) != (b[0] < 0.0))
    {
      const double t = a[0] / (a[0] - b[0]);
      result.push_back({ 0.0, a[1] + t * (b[1] - a[1]) });
    }
  }
  return result;
}

/// Shapes as x = 0 may pass them.
std::vector<Shape> passed(const Shape& shape, bool alongEdges)
{
  std::mt19937 random(11);
  const auto uniform = [&random] { return (static_cast<double>(random()) + 0.5) / 4294967296.0; };
  std::vector<Shape> result;
  while (result.size() < 6000)
  {
    const double angle = alongEdges ? 0.0 : 6.28318530717958648 * uniform(), at = 4.0 * uniform();
    Shape turned;
    double low = 1e9, high = -1e9;
    for (const Flat& p : shape)
    {
      // Edge 0 is along x; by a quarter it is along the edge of the shadow.
      const double x = alongEdges ? -p[1] : std::cos(angle) * p[0] - std::sin(angle) * p[1];
      const double y = alongEdges ? p[0] : std::sin(angle) * p[0] + std::cos(angle) * p[1];
      turned.push_back({ x + 2.0 - at, y });
      low = std::min(low, turned.back()[0]);
      high = std::max(high, turned.back()[0]);
    }
    if (low < 0.0 && high > 0.0) // lines are met as often as the shape is wide
    {
      result.push_back(turned);
    }
  }
  return result;
}

double rootMeanSquare(const std::vector<double>& errors)
{
  double sum = 0.0;
  for (const double e : errors)
  {
    sum += e * e;
  }
  return std::sqrt(sum / static_cast<double>(errors.size()));
}

/// Of the filter: a cell of each shape, one upon the other, and a sheet above x < 0.
double errorOfFilter(const std::vector<Shape>& shapes, int samples)
{
  std::vector<Point> points;
  std::vector<std::vector<vtkIdType>> cells;
  for (const Shape& shape : shapes)
  {
    cells.emplace_back();
    for (const Flat& p : shape)
    {
      cells.back().push_back(static_cast<vtkIdType>(points.size()));
      points.push_back({ p[0], p[1], 0.0 });
    }
  }
  Shadows shadows(polygons(points, cells));
  shadows.filter->AddCasterData(level(-9.0, 0.0, -9.0, 9.0, 1.0));
  shadows.filter->MeshCastsOff();
  shadows.filter->SetSamplesPerCell(samples);
  shadows.filter->AddLight(sun(0, 0, 1));
  vtkDataArray* shadow = shadows.array("Shadow");
  std::vector<double> errors;
  for (std::size_t i = 0; i < shapes.size(); ++i)
  {
    errors.push_back(shadow->GetComponent(static_cast<vtkIdType>(i), 0) -
      areaOf(clipped(shapes[i])) / areaOf(shapes[i]));
  }
  shadows.expectQuiet();
  return rootMeanSquare(errors);
}

/// Of n x n points: the middles of a square's squares, or of a triangle's triangles.
double errorOfGrid(const std::vector<Shape>& shapes, int n)
{
  std::vector<Flat> grid; // along the first edge, and along that from the first corner to the last
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < n; ++j)
    {
      if (shapes[0].size() == 4)
      {
        grid.push_back({ (i + 0.5) / n, (j + 0.5) / n });
      }
      else
      {
        const bool folded = i + j >= n;
        const int a = folded ? n - 1 - i : i, b = folded ? n - 1 - j : j;
        const double third = folded ? 2.0 / 3.0 : 1.0 / 3.0;
        grid.push_back({ (a + third) / n, (b + third) / n });
      }
    }
  }
  std::vector<double> errors;
  for (const Shape& s : shapes)
  {
    int dark = 0;
    for (const Flat& g : grid)
    {
      dark += s[0][0] + g[0] * (s[1][0] - s[0][0]) + g[1] * (s.back()[0] - s[0][0]) < 0.0;
    }
    errors.push_back(static_cast<double>(dark) / static_cast<double>(grid.size()) -
      areaOf(clipped(s)) / areaOf(s));
  }
  return rootMeanSquare(errors);
}
}

TEST(CellSamples, NoGridIsBetter)
{
  for (const Shape& shape : { Square, Triangle })
  {
    const std::vector<Shape> anywhere = passed(shape, false), along = passed(shape, true);
    double last = 1.0;
    for (const int n : { 1, 2, 3, 4, 5, 6, 8, 11, 16 })
    {
      const double own = errorOfFilter(anywhere, n * n), grid = errorOfGrid(anywhere, n);
      const double ownAlong = errorOfFilter(along, n * n), gridAlong = errorOfGrid(along, n);
      std::cout << shape.size() << " corners, " << n * n << " samples: " << own << ", grid " << grid
                << "; along edges: " << ownAlong << ", grid " << gridAlong << "\n";
      // 6000 edges tell a root mean square within a hundredth.
      EXPECT_LE(own, 1.03 * grid) << shape.size() << " corners, " << n * n << " samples";
      EXPECT_LE(ownAlong, 1.03 * gridAlong) << shape.size() << " corners, " << n * n << " samples";
      EXPECT_LT(own, last);
      last = own;
    }
  }
}

TEST(CellSamples, ALatticeOfManyHasNoRows)
{
  for (const Shape& shape : { Square, Triangle })
  {
    const std::vector<Shape> anywhere = passed(shape, false), along = passed(shape, true);
    EXPECT_LE(errorOfFilter(anywhere, 1024), 1.2 * errorOfGrid(anywhere, 32)) << shape.size();
    EXPECT_LE(errorOfFilter(along, 1024), 0.3 * errorOfGrid(along, 32)) << shape.size();
  }
}

TEST(CellSamples, AsManyAsAreAskedFor)
{
  // A share is a whole number of samples where all stand for the same area.
  for (const Shape& shape : { Square, Triangle, Pentagon })
  {
    std::vector<Point> points;
    std::vector<vtkIdType> cell;
    for (const Flat& p : shape)
    {
      cell.push_back(static_cast<vtkIdType>(points.size()));
      points.push_back({ p[0], p[1], 0.0 });
    }
    Shadows shadows(polygons(points, { cell }));
    shadows.filter->MeshCastsOff();
    shadows.filter->AddLight(sun(0, 0, 1));
    for (const int samples : { 1, 3, 8 })
    {
      shadows.filter->SetSamplesPerCell(samples);
      std::vector<double> steps; // of the share, while a shadow goes over the cell
      for (double x = -0.5; x < 1.6; x += 0.01)
      {
        shadows.filter->RemoveAllCasters();
        shadows.filter->AddCasterData(level(-9, x, -9, 9, 1));
        const double share = shadows.shadow(0);
        if (steps.empty() || share != steps.back())
        {
          steps.push_back(share);
        }
      }
      EXPECT_EQ(steps.back(), 1.0);
      EXPECT_LE(steps.size(), samples + 1u) << shape.size() << " corners";
      EXPECT_TRUE(std::is_sorted(steps.begin(), steps.end()));
    }
    shadows.expectQuiet();
  }
}

TEST(CellSamples, QuadsOfUnequalHalvesCountByArea)
{
  Shadows kite(
    polygons({ { 0, 0, 0 }, { 3, 0, 0 }, { 3, 2, 0 }, { 0, 1, 0 } }, { { 0, 1, 2, 3 } }));
  Shadows spike(
    polygons({ { 0, 0, 0 }, { 3, 0, 0 }, { 3, 3, 0 }, { 1.4, 1.6, 0 } }, { { 0, 1, 2, 3 } }));
  for (Shadows* shadows : { &kite, &spike })
  {
    shadows->filter->SetSamplesPerCell(256);
    shadows->filter->MeshCastsOff();
    shadows->filter->AddCasterData(level(-9, 1.0, -9, 9, 1));
    shadows->filter->AddLight(sun(0, 0, 1));
  }
  EXPECT_NEAR(kite.shadow(0), (0.5 * (1.0 + 4.0 / 3.0)) / 4.5, 5e-3);
  EXPECT_NEAR(spike.shadow(0), (0.5 * 1.6 / 1.4) / (4.5 + 0.3), 1e-2);
}
