// The Mandelbulb against its formula written down plainly, its derivatives, and its octree.
#include "vtkMandelbulbFunction.h"

#include "svoConversion.h"
#include "svoOctreeCells.h"
#include "vtkImplicitFunctionToSVO.h"

#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <tuple>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace
{
/// White's and Nylander's power, Hart's estimate, word by word.
double plainEstimate(const glm::dvec3& c, double n, int iterations)
{
  glm::dvec3 z = c;
  double derivative = 1.0;
  for (int i = 0; i < iterations && glm::length(z) <= 1e3; ++i)
  {
    const double r = glm::length(z);
    const double theta = std::acos(z.z / r), phi = std::atan2(z.y, z.x);
    derivative = n * std::pow(r, n - 1.0) * derivative + 1.0;
    z = std::pow(r, n) *
        glm::dvec3(std::sin(n * theta) * std::cos(n * phi), std::sin(n * theta) * std::sin(n * phi),
          std::cos(n * theta)) +
      c;
  }
  const double r = glm::length(z);
  return 0.5 * std::log(r) / derivative * std::max(r, 1.0);
}

glm::dvec3 somewhere(std::mt19937& random)
{
  std::uniform_real_distribution<double> in(-1.3, 1.3);
  return { in(random), in(random), in(random) };
}

double valueAt(vtkMandelbulbFunction* f, glm::dvec3 at)
{
  return f->EvaluateFunction(&at.x);
}
}

TEST(MandelbulbFunction, IsTheFormula)
{
  std::mt19937 random(1);
  vtkNew<vtkMandelbulbFunction> f;
  for (const double power : { 2.0, 3.0, 5.5, 8.0, 9.0, 15.3 })
  {
    f->SetPower(power);
    for (const int iterations : { 1, 2, 4 })
    {
      f->SetNumberOfIterations(iterations);
      for (int i = 0; i < 2000; ++i)
      {
        const glm::dvec3 c = somewhere(random);
        const double expected = plainEstimate(c, power, iterations);
        // Each iteration multiplies rounding errors by the derivative.
        const double amplified = std::pow(power * 1.3, iterations) * 1e-12;
        ASSERT_NEAR(valueAt(f, c), expected, (std::abs(expected) + 1e-3) * (1e-9 + amplified))
          << power << " " << iterations << " " << c.x << " " << c.y << " " << c.z;
      }
    }
  }
}

TEST(MandelbulbFunction, KnowsItsGradient)
{
  std::mt19937 random(2);
  vtkNew<vtkMandelbulbFunction> f;
  f->SetNumberOfIterations(3);
  int steep = 0;
  constexpr int Points = 2000;
  for (const double power : { 2.0, 4.5, 8.0 })
  {
    f->SetPower(power);
    for (int i = 0; i < Points; ++i)
    {
      glm::dvec3 c = somewhere(random);
      glm::dvec3 g, differences;
      f->EvaluateGradient(&c.x, &g.x);
      constexpr double Step = 1e-7;
      for (int axis = 0; axis < 3; ++axis)
      {
        glm::dvec3 step(0.0);
        step[axis] = Step;
        differences[axis] = (valueAt(f, c + step) - valueAt(f, c - step)) / (2.0 * Step);
      }
      steep += glm::length(g - differences) > 1e-3 * (1.0 + glm::length(g));
    }
  }
  // Where an iteration more or less begins, the difference crosses a step.
  EXPECT_LE(steep, 3 * Points / 200);
}

TEST(MandelbulbFunction, IsNegativeInsideAndNotANumberNowhereNear)
{
  vtkNew<vtkMandelbulbFunction> f;
  EXPECT_LT(valueAt(f, glm::dvec3(0.0)), -0.3);
  EXPECT_LT(valueAt(f, glm::dvec3(1e-3, 0.0, 1e-4)), -0.3);
  EXPECT_GT(valueAt(f, glm::dvec3(1.5, 0.0, 0.0)), 0.0);
  EXPECT_LT(valueAt(f, glm::dvec3(1e3, 0.0, 0.0)), 1e4);
  constexpr double None = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(valueAt(f, glm::dvec3(None, 0.0, 0.0))));
  f->SetNumberOfIterations(1000);
  std::mt19937 random(3);
  for (int i = 0; i < 1000; ++i)
  {
    const glm::dvec3 c = 0.9 * somewhere(random);
    ASSERT_TRUE(std::isfinite(valueAt(f, c)));
  }
}

TEST(MandelbulbFunction, ClampsItsSettings)
{
  vtkNew<vtkMandelbulbFunction> f;
  EXPECT_EQ(f->GetPower(), 8.0);
  f->SetPower(0.5);
  EXPECT_EQ(f->GetPower(), 2.0);
  f->SetNumberOfIterations(0);
  EXPECT_EQ(f->GetNumberOfIterations(), 1);
}

// Every voxel whose corners see both signs has to be there, and none far from the surface.
TEST(MandelbulbFunction, BecomesAnOctree)
{
  vtkNew<vtkMandelbulbFunction> f;
  f->SetNumberOfIterations(3);
  vtkNew<vtkImplicitFunctionToSVO> filter;
  filter->SetImplicitFunction(f);
  filter->SetModelBounds(-1.25, 1.25, -1.25, 1.25, -1.25, 1.25);
  constexpr int Level = 6;
  filter->SetMaximumLevel(Level);
  filter->Update();
  const svo::Octree octree = octreeOf(filter->GetOutput());
  ASSERT_TRUE(octree);
  const double voxel = octree.header().voxelSize;
  const double* o = octree.header().origin;
  constexpr int Edge = 1 << Level;
  const auto at = [&](int x, int y, int z)
  { return glm::dvec3(o[0] + x * voxel, o[1] + y * voxel, o[2] + z * voxel); };
  std::set<std::tuple<int, int, int>> occupied;
  svo::forEachCell(octree, Level,
    [&](const svo::OctreeCell& c)
    {
      occupied.insert({ c.cell.x, c.cell.y, c.cell.z });
      return true;
    });
  std::size_t crossed = 0, missed = 0;
  for (int z = 0; z < Edge; ++z)
  {
    for (int y = 0; y < Edge; ++y)
    {
      for (int x = 0; x < Edge; ++x)
      {
        int inside = 0;
        for (int i = 0; i < 8; ++i)
        {
          inside += valueAt(f, at(x + (i & 1), y + (i >> 1 & 1), z + (i >> 2))) < 0.0;
        }
        if (inside > 0 && inside < 8)
        {
          ++crossed;
          missed += occupied.count({ x, y, z }) == 0;
        }
      }
    }
  }
  EXPECT_GT(crossed, 10000u);
  EXPECT_EQ(missed, 0u);
  EXPECT_LT(octree.header().voxelCount, 2 * crossed);
}
