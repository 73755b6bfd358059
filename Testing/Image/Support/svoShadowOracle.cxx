// Exact visibility of eye and lights, by VTK's cell locators in double precision.
#include "svoShadowOracle.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkGenericCell.h"
#include "vtkLight.h"
#include "vtkMapper.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkRenderer.h"
#include "vtkStaticCellLocator.h"
#include "vtkTriangleFilter.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

namespace svotest
{
namespace
{
using Point = std::array<double, 3>;

Point transformed(vtkMatrix4x4* matrix, const double p[3])
{
  const double in[4] = { p[0], p[1], p[2], 1.0 };
  double out[4];
  matrix->MultiplyPoint(in, out);
  return { out[0] / out[3], out[1] / out[3], out[2] / out[3] };
}

// A light or a view that grazes the surface is left out: shading normals differ from facets there.
constexpr double Grazing = 0.25;
}

double ShadowScore::wrongShare() const
{
  const std::size_t all = this->lit + this->dark;
  return all == 0 ? 1.0 : static_cast<double>(this->litWrong + this->darkWrong) / all;
}

void ShadowOracle::add(vtkActor* actor, bool casts, bool receives)
{
  actor->GetMapper()->Update();
  this->add(
    vtkPolyData::SafeDownCast(actor->GetMapper()->GetInput()), actor->GetMatrix(), casts, receives);
}

void ShadowOracle::add(vtkPolyData* mesh, vtkMatrix4x4* matrix, bool casts, bool receives)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(mesh);
  triangles->PassLinesOff();
  triangles->PassVertsOff();
  triangles->Update();
  Solid solid;
  solid.mesh = triangles->GetOutput();
  solid.locator = vtkSmartPointer<vtkStaticCellLocator>::New();
  solid.locator->SetDataSet(solid.mesh);
  solid.locator->BuildLocator();
  solid.toWorld = vtkSmartPointer<vtkMatrix4x4>::New();
  solid.toLocal = vtkSmartPointer<vtkMatrix4x4>::New();
  if (matrix)
  {
    solid.toWorld->DeepCopy(matrix);
  }
  vtkMatrix4x4::Invert(solid.toWorld, solid.toLocal);
  solid.casts = casts;
  solid.receives = receives;
  this->solids.push_back(solid);
}

void ShadowOracle::add(vtkLight* light)
{
  Lamp lamp;
  lamp.directional = !light->GetPositional();
  light->GetTransformedPosition(lamp.position.data());
  Point focus;
  light->GetTransformedFocalPoint(focus.data());
  vtkMath::Subtract(focus.data(), lamp.position.data(), lamp.direction.data());
  vtkMath::Normalize(lamp.direction.data());
  const bool cone = light->GetPositional() && light->GetConeAngle() < 90.0;
  lamp.coneCosine = cone ? std::cos(vtkMath::RadiansFromDegrees(light->GetConeAngle())) : -1.0;
  this->lamps.push_back(lamp);
}

ShadowOracle::Hit ShadowOracle::firstHit(const double from[3], const double to[3]) const
{
  Hit hit;
  vtkNew<vtkGenericCell> cell;
  for (std::size_t i = 0; i < this->solids.size(); ++i)
  {
    const Solid& solid = this->solids[i];
    const Point p1 = transformed(solid.toLocal, from);
    const Point p2 = transformed(solid.toLocal, to);
    double t;
    double x[3];
    double parametric[3];
    int subId;
    vtkIdType id;
    if (!solid.locator->IntersectWithLine(
          p1.data(), p2.data(), 0.0, t, x, parametric, subId, id, cell) ||
      t >= hit.t)
    {
      continue;
    }
    hit.solid = static_cast<int>(i);
    hit.t = t;
    hit.point = transformed(solid.toWorld, x);
    Point corner[3];
    for (int k = 0; k < 3; ++k)
    {
      double p[3];
      cell->GetPoints()->GetPoint(k, p);
      corner[k] = transformed(solid.toWorld, p);
    }
    double a[3];
    double b[3];
    double toEye[3];
    vtkMath::Subtract(corner[1].data(), corner[0].data(), a);
    vtkMath::Subtract(corner[2].data(), corner[0].data(), b);
    vtkMath::Cross(a, b, hit.normal.data());
    vtkMath::Normalize(hit.normal.data());
    vtkMath::Subtract(from, hit.point.data(), toEye);
    if (vtkMath::Dot(toEye, hit.normal.data()) < 0.0)
    {
      vtkMath::MultiplyScalar(hit.normal.data(), -1.0);
    }
  }
  return hit;
}

bool ShadowOracle::blocked(const double from[3], const double to[3]) const
{
  vtkNew<vtkGenericCell> cell;
  for (const Solid& solid : this->solids)
  {
    const Point p1 = transformed(solid.toLocal, from);
    const Point p2 = transformed(solid.toLocal, to);
    double t;
    double x[3];
    double parametric[3];
    int subId;
    vtkIdType id;
    if (solid.casts &&
      solid.locator->IntersectWithLine(
        p1.data(), p2.data(), 0.0, t, x, parametric, subId, id, cell))
    {
      return true;
    }
  }
  return false;
}

ShadowOracle::Verdict ShadowOracle::verdict(
  const double from[3], const double to[3], double sceneSize, int& solid) const
{
  const Hit hit = this->firstHit(from, to);
  solid = hit.solid;
  if (hit.solid < 0)
  {
    return Verdict::Background;
  }
  double view[3];
  vtkMath::Subtract(from, hit.point.data(), view);
  vtkMath::Normalize(view);
  if (vtkMath::Dot(view, hit.normal.data()) < Grazing)
  {
    return Verdict::Unclear;
  }
  bool dark = false;
  for (const Lamp& lamp : this->lamps)
  {
    double toLight[3];
    if (lamp.directional)
    {
      for (int k = 0; k < 3; ++k)
      {
        toLight[k] = -lamp.direction[k];
      }
    }
    else
    {
      vtkMath::Subtract(lamp.position.data(), hit.point.data(), toLight);
    }
    const double distance = lamp.directional ? 4.0 * sceneSize : vtkMath::Norm(toLight);
    vtkMath::Normalize(toLight);
    const double inCone = -vtkMath::Dot(toLight, lamp.direction.data());
    const double facing = vtkMath::Dot(toLight, hit.normal.data());
    if (lamp.coneCosine > -1.0 && std::abs(inCone - lamp.coneCosine) < 0.01)
    {
      return Verdict::Unclear;
    }
    if (inCone < lamp.coneCosine || facing < -Grazing)
    {
      continue; // this light adds nothing here, shadow or not
    }
    if (facing < Grazing)
    {
      return Verdict::Unclear;
    }
    Point start;
    Point end;
    for (int k = 0; k < 3; ++k)
    {
      start[k] = hit.point[k] + 1e-4 * sceneSize * toLight[k];
      end[k] = hit.point[k] + distance * toLight[k];
    }
    dark = dark || this->blocked(start.data(), end.data());
  }
  return dark && this->solids[hit.solid].receives ? Verdict::Dark : Verdict::Lit;
}

ShadowScore ShadowOracle::judge(
  vtkRenderer* renderer, const Picture& shadowed, const Picture& unshadowed, int margin) const
{
  int width;
  int height;
  int left;
  int low;
  renderer->GetTiledSizeAndOrigin(&width, &height, &left, &low);
  double bounds[6];
  renderer->ComputeVisiblePropBounds(bounds);
  double corner[2][3] = { { bounds[0], bounds[2], bounds[4] },
    { bounds[1], bounds[3], bounds[5] } };
  const double size = std::sqrt(vtkMath::Distance2BetweenPoints(corner[0], corner[1]));
  vtkNew<vtkMatrix4x4> toWorld;
  toWorld->DeepCopy(renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
    renderer->GetTiledAspectRatio(), -1.0, 1.0));
  toWorld->Invert();

  struct Judged
  {
    Verdict verdict;
    int solid;
  };
  std::vector<Judged> judged(static_cast<std::size_t>(width) * height);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const double ndc[2] = { 2.0 * (x + 0.5) / width - 1.0, 2.0 * (y + 0.5) / height - 1.0 };
      const double nearPoint[3] = { ndc[0], ndc[1], -1.0 };
      const double farPoint[3] = { ndc[0], ndc[1], 1.0 };
      const Point from = transformed(toWorld, nearPoint);
      const Point to = transformed(toWorld, farPoint);
      Judged& j = judged[static_cast<std::size_t>(y) * width + x];
      j.verdict = this->verdict(from.data(), to.data(), size, j.solid);
    }
  }

  auto clear = [&](int x, int y)
  {
    const Judged& here = judged[static_cast<std::size_t>(y) * width + x];
    for (int j = std::max(0, y - margin); j <= std::min(height - 1, y + margin); ++j)
    {
      for (int i = std::max(0, x - margin); i <= std::min(width - 1, x + margin); ++i)
      {
        const Judged& other = judged[static_cast<std::size_t>(j) * width + i];
        if (other.verdict != here.verdict || other.solid != here.solid)
        {
          return false;
        }
      }
    }
    return here.verdict == Verdict::Lit || here.verdict == Verdict::Dark;
  };
  ShadowScore score;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      if (!clear(x, y))
      {
        continue;
      }
      const double with = shadowed.grey(left + x, low + y);
      const double without = unshadowed.grey(left + x, low + y);
      if (judged[static_cast<std::size_t>(y) * width + x].verdict == Verdict::Lit)
      {
        ++score.lit;
        score.litWrong += std::abs(with - without) > 3.0;
      }
      else
      {
        ++score.dark;
        score.darkWrong += with > without - 5.0;
      }
    }
  }
  return score;
}

void expectShadows(Checks& checks, const ShadowScore& score, const char* scene, double share)
{
  std::cout << scene << ": " << score.lit << " lit pixels, " << score.litWrong << " wrong; "
            << score.dark << " dark pixels, " << score.darkWrong << " wrong\n";
  std::ostringstream sentence;
  sentence << scene << ": at most " << share << " of the clear pixels wrong (they are "
           << score.wrongShare() << ")";
  checks.expect(score.wrongShare() <= share, sentence.str());
  checks.expect(score.lit > 500 && score.dark > 100,
    std::string(scene) + ": enough lit and dark pixels to judge by");
}
}
