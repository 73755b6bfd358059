// Translucent surfaces cast shadows as light as they are, on traced and on rasterised surfaces,
// from buffers and by rays: while one fades, and where the alpha of its colours changes over it.
#include "svoTestStage.h"

#include "vtkContourFilter.h"
#include "vtkElevationFilter.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkLookupTable.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderWindow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <string>

namespace
{
using namespace svotest;

/// How the ground gets its shadows.
struct Variant
{
  const char* name;
  bool rays, rasterised, smooth;
};
constexpr Variant Ways[] = { { "buffer", false, false, false }, { "rays", true, false, false },
  { "rasterised", false, true, false }, { "filtered", false, false, true },
  { "rasterised, filtered", false, true, true } };

void set(Stage& stage, vtkActor* ground, const Variant& way)
{
  vtkSVORenderPass::SetUseSVO(!way.rasterised, ground);
  stage.pass->SetShadowTechnique(
    way.rays ? vtkSVORenderPass::SHADOW_RAYS : vtkSVORenderPass::SHADOW_BUFFER);
  stage.pass->SetAntiAliasing(way.smooth);
}

double mean(const Picture& picture, const Mask& mask)
{
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < mask.size(); ++i)
  {
    sum += mask[i] ? picture.grey(i) : 0.0;
    count += mask[i] ? 1 : 0;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

/// The ground's pixels that an opaque caster darkens and does not hide, away from all edges.
Mask shadowOf(const Picture& opaque, const Picture& unshadowed, const Picture& empty)
{
  const int w = opaque.width;
  const auto inside = [&](int x, int y)
  {
    const std::size_t i = static_cast<std::size_t>(y) * w + x;
    return opaque.depth[i] == empty.depth[i] && opaque.grey(i) < unshadowed.grey(i) - 60.0;
  };
  Mask mask(opaque.size(), 0);
  constexpr int Away = 2;
  for (int y = Away; y < opaque.height - Away; ++y)
  {
    for (int x = Away; x < w - Away; ++x)
    {
      bool all = true;
      for (int j = -Away; j <= Away && all; ++j)
      {
        for (int i = -Away; i <= Away && all; ++i)
        {
          all = inside(x + i, y + j);
        }
      }
      mask[static_cast<std::size_t>(y) * w + x] = all ? 1 : 0;
    }
  }
  return mask;
}

/// A ring over the ground that fades in.
void fade(const Variant& way, Checks& checks)
{
  const std::string name = std::string("a fade, ") + way.name;
  Stage stage;
  vtkActor* ground = stage.addGround();
  stage.addSun(3.5, 1.0, 4.0);
  set(stage, ground, way);
  const Picture empty = capture(stage.window);
  vtkActor* caster = stage.add(ring(0.9, 0.0, 0.0, 1.5), 0.3, 0.5, 1.0);
  const Picture opaque = capture(stage.window);
  vtkSVORenderPass::SetCastShadow(false, caster);
  const Picture unshadowed = capture(stage.window);
  caster->GetPropertyKeys()->Remove(vtkSVORenderPass::CAST_SHADOW());
  const Mask mask = shadowOf(opaque, unshadowed, empty);
  const auto pixels = std::count(mask.begin(), mask.end(), 1);
  checks.expect(pixels > 1000, name + ": the shadow is seen");
  const double lit = mean(unshadowed, mask), dark = mean(opaque, mask);
  std::cout << name << ": " << pixels << " pixels, lit " << lit << ", dark " << dark << ':';
  for (const double opacity : { 0.0, 0.2, 0.4, 0.6, 0.8, 0.999, 1.0 })
  {
    caster->GetProperty()->SetOpacity(opacity);
    const Picture faded = capture(stage.window);
    const double found = mean(faded, mask);
    const double expected = lit + opacity * (dark - lit);
    std::cout << ' ' << found;
    // Half a level of rounding, on either side.
    checks.expect(std::abs(found - expected) <= 1.0,
      name + ": at opacity " + std::to_string(opacity) + " the shadow is as light");
    if (opacity > 0.99)
    {
      checks.expect(difference(faded, opaque, mask).largest <= 2,
        name + ": at the end it is the opaque one's, pixel by pixel");
    }
  }
  std::cout << '\n';
  stage.pass->TranslucentShadowsOff();
  caster->GetProperty()->SetOpacity(0.8);
  checks.expect(std::abs(mean(capture(stage.window), mask) - lit) <= 0.5,
    name + ": switched off it casts nothing");
}

vtkSmartPointer<vtkLookupTable> ramp()
{
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(256);
  for (int i = 0; i < 256; ++i)
  {
    const double x = i / 255.0;
    table->SetTableValue(i, 0.9 * x + 0.1, 0.4, 0.9 - 0.8 * x, x);
  }
  table->SetTableRange(0.0, 1.0);
  return table;
}

/// Where a pixel's surface is.
std::array<double, 3> placeOf(vtkRenderer* renderer, const Picture& picture, std::size_t pixel)
{
  const auto width = static_cast<std::size_t>(picture.width);
  renderer->SetDisplayPoint(static_cast<double>(pixel % width) + 0.5,
    static_cast<double>(pixel / width) + 0.5, picture.depth[pixel]);
  renderer->DisplayToWorld();
  const double* p = renderer->GetWorldPoint();
  return { p[0] / p[3], p[1] / p[3], p[2] / p[3] };
}

/// A box whose alpha grows from one side to the other, below the sun, and so does its shadow.
void colorMap(const Variant& way, bool interpolated, Checks& checks)
{
  const std::string name =
    std::string(interpolated ? "scalars first, " : "a colour map, ") + way.name;
  Stage stage;
  vtkActor* ground = stage.addGround();
  stage.addSun(0.0, 0.0, 4.0);
  set(stage, ground, way);
  const Picture empty = capture(stage.window);
  vtkNew<vtkElevationFilter> values;
  values->SetInputConnection(box(1.0, 0.0, 0.0, 1.8)->GetOutputPort());
  values->SetLowPoint(-0.5, 0.0, 0.0);
  values->SetHighPoint(0.5, 0.0, 0.0);
  vtkActor* caster = stage.add(values, 1.0, 1.0, 1.0);
  caster->GetMapper()->ScalarVisibilityOn();
  caster->GetMapper()->SetLookupTable(ramp());
  caster->GetMapper()->UseLookupTableScalarRangeOn();
  caster->GetMapper()->SetInterpolateScalarsBeforeMapping(interpolated);
  const Picture shadowed = capture(stage.window);
  stage.pass->TranslucentShadowsOff();
  const Picture without = capture(stage.window);
  std::size_t asked = 0, lit = 0, wrong = 0;
  for (std::size_t i = 0; i < empty.size(); ++i)
  {
    // The ground where nothing is drawn over it.
    if (empty.depth[i] == 1.0f || without.grey(i) != empty.grey(i))
    {
      continue;
    }
    const std::array<double, 3> p = placeOf(stage.renderer, empty, i);
    const double off = std::max(std::abs(p[0]), std::abs(p[1]));
    const double expected = off < 0.47 ? 1.0 - (p[0] + 0.5) : 1.0;
    if (off < 0.47 || off > 0.53)
    {
      asked += off < 0.47;
      lit += off > 0.53;
      wrong += std::abs(shadowed.grey(i) / empty.grey(i) - expected) > 0.03;
    }
  }
  std::cout << name << ": " << asked << " pixels in the shadow, " << lit << " beside it, " << wrong
            << " wrong\n";
  checks.expect(asked > 500 && lit > 5000, name + ": the shadow is seen");
  checks.expect(wrong == 0, name + ": everywhere it is as light as the caster");
}

/// A contour of which one side cannot be seen and the other is opaque.
vtkActor* addContour(Stage& stage)
{
  constexpr int Size = 33;
  vtkNew<vtkImageData> field;
  field->SetDimensions(Size, Size, Size);
  field->SetOrigin(-8.0, -8.0, -8.0);
  field->SetSpacing(0.5, 0.5, 0.5);
  field->AllocateScalars(VTK_FLOAT, 1);
  for (vtkIdType i = 0; i < field->GetNumberOfPoints(); ++i)
  {
    const double* p = field->GetPoint(i);
    const double squared = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
    field->GetPointData()->GetScalars()->SetComponent(i, 0,
      squared + 12.0 * std::sin(1.3 * p[0]) * std::sin(1.1 * p[1]) + 9.0 * std::cos(1.7 * p[2]));
  }
  vtkNew<vtkContourFilter> contour;
  contour->SetInputData(field);
  contour->SetValue(0, 40.0);
  vtkNew<vtkElevationFilter> values;
  values->SetInputConnection(contour->GetOutputPort());
  values->SetLowPoint(-8.0, 0.0, 0.0);
  values->SetHighPoint(8.0, 0.0, 0.0);
  vtkActor* actor = stage.add(values, 1.0, 1.0, 1.0);
  actor->SetScale(0.12);
  actor->SetPosition(0.0, 0.3, 1.6);
  actor->GetMapper()->ScalarVisibilityOn();
  actor->GetMapper()->SetLookupTable(ramp());
  actor->GetMapper()->UseLookupTableScalarRangeOn();
  return actor;
}
}

int TestSVOTranslucentShadows(int argc, char* argv[])
{
  Checks checks;
  for (const Variant& way : Ways)
  {
    fade(way, checks);
    colorMap(way, false, checks);
    colorMap(way, true, checks);
  }

  Stage stage;
  vtkActor* ground = stage.addGround();
  stage.addSun(2.0, -1.5, 4.0);
  addContour(stage);
  vtkActor* veil = stage.add(ring(0.5, 0.0, 0.0, 0.0), 0.2, 0.8, 0.4);
  veil->SetPosition(-0.7, -0.2, 0.7);
  veil->GetProperty()->SetOpacity(0.6);
  stage.add(ball(0.25, 0.9, -0.9, 0.4), 0.9, 0.8, 0.3);
  stage.pass->SetShadowIntensity(0.8);
  stage.window->SetAlphaBitPlanes(1);
  stage.renderer->UseDepthPeelingOn();
  Picture first;
  for (const Variant& way : Ways)
  {
    set(stage, ground, way);
    const Picture picture = capture(stage.window);
    first = first.rgb.empty() ? picture : first;
    const Difference found = difference(first, picture);
    std::cout << "several casters, " << way.name << ": mean " << found.mean << ", p99 " << found.p99
              << " from buffers\n";
    // Filtered edges are wider than others by a pixel or two.
    checks.expect(found.mean <= 0.5 && found.p99 <= (way.smooth ? 40 : 12),
      std::string("several casters: the same, ") + way.name);
  }
  set(stage, ground, Ways[3]);
  checks.expect(matchesBaseline(stage.window, argc, argv), "the baseline");
  return checks.exitCode();
}
