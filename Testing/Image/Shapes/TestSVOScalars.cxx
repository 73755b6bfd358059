// Arrays through the mapper's lookup table: at points, at points and interpolated before mapping,
// at cells, and as colours. A new colour map rebuilds nothing.
#include "svoTestStage.h"

#include "vtkCellData.h"
#include "vtkElevationFilter.h"
#include "vtkFloatArray.h"
#include "vtkLookupTable.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTrivialProducer.h"
#include "vtkUnsignedCharArray.h"

#include <array>
#include <iostream>
#include <memory>

namespace
{
// A ring with heights at its points, numbers at its cells and colours at its points.
vtkSmartPointer<vtkTrivialProducer> withArrays()
{
  const auto source = svotest::ring(1.2, 0.0, 0.0, 1.2);
  vtkNew<vtkElevationFilter> height;
  height->SetInputConnection(source->GetOutputPort());
  height->SetLowPoint(-1.2, 0.0, 0.8);
  height->SetHighPoint(1.2, 0.0, 1.6);
  height->Update();
  vtkNew<vtkPolyData> mesh;
  mesh->DeepCopy(height->GetOutput());
  vtkNew<vtkFloatArray> stripes;
  stripes->SetName("Stripes");
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    stripes->InsertNextValue(static_cast<float>((i / 40) % 5) / 4.0f);
  }
  mesh->GetCellData()->AddArray(stripes);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("Colors");
  colors->SetNumberOfComponents(3);
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double p[3];
    mesh->GetPoint(i, p);
    colors->InsertNextTuple3(127.0 + 80.0 * p[0], 127.0 + 80.0 * p[1], 200.0);
  }
  mesh->GetPointData()->AddArray(colors);
  auto source2 = vtkSmartPointer<vtkTrivialProducer>::New();
  source2->SetOutput(mesh);
  return source2;
}
}

int TestSVOScalars(int argc, char* argv[])
{
  using namespace svotest;
  Checks checks;
  const char* const names[4] = { "points", "points, interpolated before mapping", "cells",
    "colours" };
  std::array<std::unique_ptr<Stage>, 4> stages;
  std::array<vtkMapper*, 4> mappers;
  for (int i = 0; i < 4; ++i)
  {
    const double x = 0.5 * (i % 2);
    const double y = 0.5 * (i / 2);
    stages[i] = i == 0 ? std::make_unique<Stage>(400, 400)
                       : std::make_unique<Stage>(*stages[0], x, y, x + 0.5, y + 0.5);
    Stage& stage = *stages[i];
    if (i == 0)
    {
      stage.renderer->SetViewport(0.0, 0.0, 0.5, 0.5);
    }
    stage.addGround();
    vtkMapper* mapper = stage.add(withArrays(), 1.0, 1.0, 1.0)->GetMapper();
    mapper->ScalarVisibilityOn();
    mapper->SetScalarRange(0.0, 1.0);
    mapper->SetInterpolateScalarsBeforeMapping(i == 1);
    if (i == 2)
    {
      mapper->SetScalarModeToUseCellFieldData();
      mapper->SelectColorArray("Stripes");
    }
    else
    {
      mapper->SetScalarModeToUsePointFieldData();
      mapper->SelectColorArray(i == 3 ? "Colors" : "Elevation");
    }
    stage.addSun(2.0, -1.5, 4.0);
    mappers[i] = mapper;
  }

  auto compare = [&](const char* when)
  {
    for (auto& stage : stages)
    {
      stage->usePass(true);
      stage->pass->SetShadowTechniqueToNone();
    }
    const Picture traced = capture(stages[0]->window);
    for (auto& stage : stages)
    {
      stage->expectTraced(checks, 2, "both actors are traced");
      stage->usePass(false);
    }
    const Picture raster = capture(stages[0]->window);
    const Mask inner = awayFromEdges(raster, 2);
    for (int i = 0; i < 4; ++i)
    {
      Mask quarter(inner.size(), 0);
      for (int y = 200 * (i / 2); y < 200 * (i / 2) + 200; ++y)
      {
        for (int x = 200 * (i % 2); x < 200 * (i % 2) + 200; ++x)
        {
          quarter[400 * y + x] = inner[400 * y + x];
        }
      }
      const Difference d = difference(raster, traced, quarter);
      std::cout << names[i] << when << ": mean " << d.mean << ", p99 " << d.p99 << ", largest "
                << d.largest << " of " << d.pixels << " pixels\n";
      checks.expect(d.mean <= 2.0 && d.p99 <= 8,
        std::string(names[i]) + when + ": mean 2 and p99 8 grey levels");
    }
  };
  compare("");

  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(6);
  table->SetHueRange(0.0, 0.3);
  table->Build();
  for (vtkMapper* mapper : mappers)
  {
    mapper->SetLookupTable(table);
  }
  compare(", another colour map");

  for (auto& stage : stages)
  {
    stage->usePass(true);
    stage->pass->SetShadowTechniqueToShadowBuffer();
  }
  checks.expect(matchesBaseline(stages[0]->window, argc, argv), "the baseline");
  return checks.exitCode();
}
