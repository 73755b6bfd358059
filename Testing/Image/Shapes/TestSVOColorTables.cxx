// Scalars that are interpolated before they are mapped: tables of a few colours and of many, with
// colours beyond their range, on a logarithmic scale, and points without a value.
#include "svoTestStage.h"

#include "vtkColorTransferFunction.h"
#include "vtkElevationFilter.h"
#include "vtkFloatArray.h"
#include "vtkLookupTable.h"
#include "vtkMath.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTrivialProducer.h"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <iostream>

namespace
{
vtkSmartPointer<vtkLookupTable> tableOf(int colors)
{
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(colors);
  table->UseAboveRangeColorOn();
  table->SetAboveRangeColor(1.0, 0.0, 1.0, 1.0);
  table->Build();
  return table;
}

vtkSmartPointer<vtkPolyData> ballWithHeights()
{
  const auto source = svotest::ball(1.2, 0.0, 0.0, 1.0);
  vtkNew<vtkElevationFilter> heights;
  heights->SetInputConnection(source->GetOutputPort());
  heights->SetLowPoint(-1.2, 0.0, 0.4);
  heights->SetHighPoint(1.2, 0.0, 1.6);
  heights->Update();
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->DeepCopy(heights->GetOutput());
  return mesh;
}

std::size_t pixelsBeyond(
  const svotest::Picture& a, const svotest::Picture& b, int levels, const svotest::Mask& mask)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    int most = 0;
    for (int k = 0; k < 3; ++k)
    {
      most = std::max(most, std::abs(int(a.rgb[3 * i + k]) - int(b.rgb[3 * i + k])));
    }
    count += mask[i] && most > levels;
  }
  return count;
}
}

int TestSVOColorTables(int, char*[])
{
  using namespace svotest;
  Checks checks;
  struct Case
  {
    const char* name;
    std::function<void(vtkMapper*, vtkPolyData*)> color;
  };
  const auto colors = [](int count)
  { return [count](vtkMapper* mapper, vtkPolyData*) { mapper->SetLookupTable(tableOf(count)); }; };
  const Case cases[] = { { "3 colours", colors(3) }, { "6 colours", colors(6) },
    { "16 colours", colors(16) }, { "256 colours", colors(256) },
    { "a transfer function",
      [](vtkMapper* mapper, vtkPolyData*)
      {
        vtkNew<vtkColorTransferFunction> function;
        function->AddRGBPoint(0.0, 1.0, 0.0, 0.0);
        function->AddRGBPoint(1.0, 0.0, 0.0, 1.0);
        mapper->SetLookupTable(function);
      } },
    { "a logarithmic scale",
      [](vtkMapper* mapper, vtkPolyData*)
      {
        const auto table = tableOf(7);
        table->SetScaleToLog10();
        mapper->SetLookupTable(table);
      } },
    { "points without a value",
      [](vtkMapper* mapper, vtkPolyData* mesh)
      {
        const auto table = tableOf(6);
        table->SetNanColor(1.0, 1.0, 1.0, 1.0);
        mapper->SetLookupTable(table);
        vtkDataArray* values = mesh->GetPointData()->GetScalars();
        for (vtkIdType i = 0; i < values->GetNumberOfTuples(); i += 17)
        {
          values->SetTuple1(i, vtkMath::Nan());
        }
      } } };
  for (const Case& one : cases)
  {
    Stage stage;
    stage.addGround();
    const auto mesh = ballWithHeights();
    vtkNew<vtkTrivialProducer> source;
    source->SetOutput(mesh);
    vtkMapper* mapper = stage.add(source, 1.0, 1.0, 1.0)->GetMapper();
    mapper->ScalarVisibilityOn();
    mapper->InterpolateScalarsBeforeMappingOn();
    mapper->SetScalarRange(0.1, 0.9);
    one.color(mapper, mesh);
    stage.addSun(2.0, -1.5, 4.0);
    const Picture traced = stage.unshadowed();
    stage.expectTraced(checks, 2, "both actors are traced");
    stage.usePass(false);
    const Picture raster = capture(stage.window);
    // Of everything but silhouettes: borders between colours are the point here.
    Mask inner(raster.size(), 1);
    for (std::size_t i = 0; i < raster.size(); ++i)
    {
      inner[i] = raster.depth[i] < 1.0f && traced.depth[i] < 1.0f;
    }
    const std::size_t wrong = pixelsBeyond(raster, traced, 10, inner);
    std::cout << one.name << ": " << wrong << " pixels differ by more than 10 of 255\n";
    checks.expect(wrong <= 8, std::string(one.name) + ": VTK's own colours but for 8 pixels");
  }
  return checks.exitCode();
}
