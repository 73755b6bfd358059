// Rays of vtkSVOShadowFilter against those of VTK's static cell locator: they disagree only where a
// ray passes an edge, or ends at a surface, within the tolerance that the filter states.
// SVO_TEST_RAYS: how many rays, at least.
#include "svoShadowMeshes.h"

#include "vtkAppendPolyData.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkParametricTorus.h"
#include "vtkSphereSource.h"
#include "vtkStaticCellLocator.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"

#include <algorithm>
#include <cstdlib>
#include <random>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

using namespace svotest;

namespace
{
using Vec = glm::dvec3;

/// Of the longest side of a caster: what the filter's documentation says.
constexpr double Tolerance = 2e-6;

struct Triangle
{
  Vec a, b, c;
};

Vec pointOf(vtkPolyData* mesh, vtkIdType id)
{
  Vec p;
  mesh->GetPoint(id, &p.x);
  return p;
}

Triangle triangleOf(vtkPolyData* mesh, vtkIdType cell)
{
  vtkNew<vtkIdList> ids;
  mesh->GetCellPoints(cell, ids);
  return { pointOf(mesh, ids->GetId(0)), pointOf(mesh, ids->GetId(1)),
    pointOf(mesh, ids->GetId(2)) };
}

/// Distance of two segments (C. Ericson, Real-Time Collision Detection, 5.1.9).
double distance(const Vec& p1, const Vec& q1, const Vec& p2, const Vec& q2)
{
  const Vec d1 = q1 - p1, d2 = q2 - p2, r = p1 - p2;
  const double a = glm::dot(d1, d1), e = glm::dot(d2, d2), f = glm::dot(d2, r);
  const double c = glm::dot(d1, r), b = glm::dot(d1, d2), denominator = a * e - b * b;
  double s = denominator > 0.0 ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0.0;
  double t = (b * s + f) / e;
  if (t < 0.0 || t > 1.0)
  {
    t = std::clamp(t, 0.0, 1.0);
    s = std::clamp((b * t - c) / a, 0.0, 1.0);
  }
  return glm::length(p1 + s * d1 - (p2 + t * d2));
}

/// True if a segment passes a triangle's edge, or ends at it, at most `reach` away.
bool isClose(const Triangle& t, const Vec& from, const Vec& to, double reach)
{
  if (distance(from, to, t.a, t.b) <= reach || distance(from, to, t.b, t.c) <= reach ||
    distance(from, to, t.c, t.a) <= reach)
  {
    return true;
  }
  const Vec normal = glm::normalize(glm::cross(t.b - t.a, t.c - t.a));
  for (const Vec& end : { from, to })
  {
    const double height = glm::dot(end - t.a, normal);
    const Vec foot = end - height * normal;
    const bool inside = glm::dot(glm::cross(t.b - t.a, foot - t.a), normal) >= 0.0 &&
      glm::dot(glm::cross(t.c - t.b, foot - t.b), normal) >= 0.0 &&
      glm::dot(glm::cross(t.a - t.c, foot - t.c), normal) >= 0.0;
    if (std::abs(height) <= reach && inside)
    {
      return true;
    }
  }
  return false;
}

MeshPointer placed(vtkPolyData* mesh, vtkMatrix4x4* place)
{
  vtkNew<vtkTransform> transform;
  transform->SetMatrix(place);
  vtkNew<vtkTransformPolyDataFilter> filter;
  filter->SetTransform(transform);
  filter->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  filter->SetInputData(mesh);
  filter->Update();
  return filter->GetOutput();
}

MeshPointer ball(int resolution)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->SetRadius(0.15);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  return source->GetOutput();
}

struct Counts
{
  std::size_t rays = 0, dark = 0, disagree = 0, beyond = 0;
};

/// Asks both for one ray from the middle of each cell to each light.
struct Contest
{
  MeshPointer mesh;
  Shadows shadows{ this->mesh };
  vtkNew<vtkAppendPolyData> all; // in the world
  double reach = 0.0;

  explicit Contest(MeshPointer asking)
    : mesh(std::move(asking))
  {
    this->shadows.filter->SetSamplesPerCell(1);
    this->add(this->mesh);
  }
  void add(vtkPolyData* world)
  {
    double b[6];
    world->GetBounds(b);
    this->reach =
      std::max(this->reach, Tolerance * std::max({ b[1] - b[0], b[3] - b[2], b[5] - b[4] }));
    this->all->AddInputData(world);
  }
  void addCaster(vtkPolyData* caster, vtkMatrix4x4* place)
  {
    const int index = this->shadows.filter->GetNumberOfInputConnections(1);
    this->shadows.filter->AddCasterData(caster);
    this->shadows.filter->SetCasterMatrix(index, place);
    this->add(placed(caster, place));
  }

  Counts compare()
  {
    vtkDataArray* shadow = this->shadows.array("Shadow");
    this->all->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    this->all->Update();
    vtkPolyData* world = this->all->GetOutput();
    vtkNew<vtkStaticCellLocator> locator;
    locator->SetDataSet(world);
    locator->BuildLocator();
    vtkNew<vtkGenericCell> cell;
    Counts counts;
    for (vtkIdType i = 0; i < this->mesh->GetNumberOfCells(); ++i)
    {
      const Triangle own = triangleOf(this->mesh, i);
      const Vec middle = (own.a + own.b + own.c) / 3.0;
      const Vec normal = glm::normalize(glm::cross(own.b - own.a, own.c - own.a));
      for (int l = 0; l < this->shadows.filter->GetNumberOfLights(); ++l)
      {
        vtkLight* light = this->shadows.filter->GetLight(l);
        Vec to;
        light->GetPosition(&to.x);
        const bool far = !light->GetPositional();
        const Vec way = far ? 100.0 * glm::normalize(to) : to - middle;
        if (glm::dot(normal, way) <= 0.0)
        {
          ++counts.rays;
          counts.beyond += shadow->GetComponent(i, l) != 1.0;
          continue;
        }
        const double cone = std::cos(light->GetConeAngle() * 3.14159265358979 / 180.0);
        const bool outside =
          !far && light->GetConeAngle() < 90.0 && way.z / glm::length(way) < cone;
        const Vec from = middle + 0.5 * this->reach * normal;
        const Vec end = far ? from + way : to;
        double t, x[3], weights[3];
        int sub = 0;
        vtkIdType hit = -1;
        const bool dark = outside ||
          locator->IntersectWithLine(&from.x, &end.x, 0.0, t, x, weights, sub, hit, cell);
        const bool ours = shadow->GetComponent(i, l) == 1.0;
        ++counts.rays;
        counts.dark += dark;
        if (ours != dark)
        {
          ++counts.disagree;
          bool close = false;
          for (vtkIdType k = 0; k < world->GetNumberOfCells() && !close; ++k)
          {
            close = isClose(triangleOf(world, k), from, end, this->reach);
          }
          counts.beyond += !close;
        }
      }
    }
    return counts;
  }
};

/// Hills, with a mirrored torus of balls, sheared and squeezed, above them.
void fill(Contest& contest, std::size_t rays)
{
  std::mt19937 random(7);
  const auto uniform = [&random](double low, double high)
  { return low + (high - low) * static_cast<double>(random()) / 4294967296.0; };
  MeshPointer round = ball(24);
  contest.addCaster(round, matrix({ -1, 0, 0, 0.3, 0, 1, 0, 0.2, 0, 0, 1, 0.5, 0, 0, 0, 1 }));
  contest.addCaster(
    round, matrix({ 1, 0.8, 0, -0.4, 0, 1, -0.3, 0.1, 0.2, 0, 0.5, 0.45, 0, 0, 0, 1 }));
  contest.addCaster(round, matrix({ 0.02, 0, 0, 0.1, 0, 3, 0, -0.4, 0, 0.5, -1, 0.6, 0, 0, 0, 1 }));
  const auto cells = static_cast<std::size_t>(contest.mesh->GetNumberOfCells());
  for (std::size_t l = 0; l * cells < rays; ++l)
  {
    const double x = uniform(-1, 1), y = uniform(-1, 1);
    contest.shadows.filter->AddLight(l % 3 == 0 ? sun(x, y, uniform(0.05, 1.0))
        : l % 3 == 1                            ? lamp(x, y, uniform(0.3, 1.5))
                                                : lamp(x, y, uniform(0.3, 1.5), 40.0));
  }
}

std::size_t askedRays()
{
  const char* asked = std::getenv("SVO_TEST_RAYS");
  return asked ? static_cast<std::size_t>(std::atoll(asked)) : 60000;
}
}

TEST(ShadowAgreement, WithTheStaticCellLocator)
{
  for (const bool single : { false, true })
  {
    Contest contest(hills(single ? 40 : 60));
    fill(contest, askedRays());
    contest.shadows.filter->SetSingleRays(single);
    const Counts counts = contest.compare();
    EXPECT_GE(counts.rays, askedRays());
    EXPECT_GT(counts.dark, counts.rays / 10);
    EXPECT_LT(counts.dark, counts.rays * 9 / 10);
    EXPECT_EQ(counts.beyond, 0u) << "of " << counts.rays << " rays";
    contest.shadows.expectQuiet();
    std::cout << (single ? "single rays: " : "blocks: ") << counts.rays << " rays, " << counts.dark
              << " dark, " << counts.disagree << " disagree, " << counts.beyond
              << " of them beyond the tolerance\n";
  }
}

TEST(ShadowAgreement, OnABodyWithManyHollows)
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(120);
  source->SetPhiResolution(120);
  source->SetRadius(1.0);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  MeshPointer body = source->GetOutput();
  for (vtkIdType i = 0; i < body->GetNumberOfPoints(); ++i)
  {
    Vec p = pointOf(body, i);
    p *= 1.0 + 0.15 * std::sin(17.0 * p.x) * std::sin(15.0 * p.y + 1.0) * std::cos(16.0 * p.z);
    body->GetPoints()->SetPoint(i, p.x, p.y, p.z);
  }
  Contest contest(body);
  const auto cells = static_cast<std::size_t>(body->GetNumberOfCells());
  for (std::size_t l = 0; l * cells < askedRays(); ++l)
  {
    const double turn = 2.4 * static_cast<double>(l), z = 0.3 * std::sin(static_cast<double>(l));
    contest.shadows.filter->AddLight(sun(std::cos(turn), std::sin(turn), z));
  }
  const Counts counts = contest.compare();
  EXPECT_GT(counts.dark, counts.rays / 20);
  EXPECT_EQ(counts.beyond, 0u) << "of " << counts.rays << " rays";
  std::cout << "body: " << counts.rays << " rays, " << counts.dark << " dark, " << counts.disagree
            << " disagree, " << counts.beyond << " of them beyond the tolerance\n";
}
