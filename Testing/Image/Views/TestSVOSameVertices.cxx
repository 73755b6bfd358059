// Of surfaces with the same vertices the one that is drawn last is seen, as in VTK: cells once more
// in another actor, in the same mesh, rasterised over traced and traced over rasterised.
#include "svoTestStage.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCleanPolyData.h"
#include "vtkIdList.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkTrivialProducer.h"
#include "vtkUnsignedCharArray.h"

#include <cmath>
#include <functional>
#include <iostream>
#include <string>

namespace
{
using namespace svotest;

vtkSmartPointer<vtkSphereSource> sphere(int resolution, double radius = 0.5)
{
  auto source = vtkSmartPointer<vtkSphereSource>::New();
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->SetRadius(radius);
  source->SetCenter(0.0, 0.0, 0.6);
  return source;
}

/// The source's cells on one side of a plane, with points of their own.
vtkSmartPointer<vtkAlgorithm> partOf(vtkPolyDataAlgorithm* source)
{
  source->Update();
  vtkPolyData* all = source->GetOutput();
  vtkNew<vtkPolyData> part;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < all->GetNumberOfCells(); ++c)
  {
    all->GetCellPoints(c, ids);
    const double* p = all->GetPoint(ids->GetId(0));
    if (p[0] + 0.5 * p[1] - 0.5 * (p[2] - 0.6) < 0.0)
    {
      cells->InsertNextCell(ids);
    }
  }
  part->SetPoints(all->GetPoints());
  part->SetPolys(cells);
  part->GetPointData()->SetNormals(all->GetPointData()->GetNormals());
  auto clean = vtkSmartPointer<vtkCleanPolyData>::New();
  clean->PointMergingOff();
  clean->SetInputData(part);
  return clean;
}

/// Each cell twice, grey and then red.
vtkSmartPointer<vtkAlgorithm> doubled(vtkPolyDataAlgorithm* source)
{
  source->Update();
  vtkPolyData* once = source->GetOutput();
  vtkNew<vtkPolyData> twice;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colors;
  vtkNew<vtkIdList> ids;
  colors->SetNumberOfComponents(3);
  for (int copy = 0; copy < 2; ++copy)
  {
    for (vtkIdType c = 0; c < once->GetNumberOfCells(); ++c)
    {
      once->GetCellPoints(c, ids);
      cells->InsertNextCell(ids);
      const double other = copy == 0 ? 230.0 : 0.0;
      colors->InsertNextTuple3(230.0, other, other);
    }
  }
  twice->SetPoints(once->GetPoints());
  twice->SetPolys(cells);
  twice->GetPointData()->SetNormals(once->GetPointData()->GetNormals());
  twice->GetCellData()->SetScalars(colors);
  auto producer = vtkSmartPointer<vtkTrivialProducer>::New();
  producer->SetOutput(twice);
  return producer;
}

vtkActor* addGrey(Stage& stage, vtkAlgorithm* source)
{
  return stage.add(source, 0.9, 0.9, 0.9);
}

vtkActor* addRed(Stage& stage, vtkAlgorithm* source)
{
  return stage.add(source, 0.9, 0.0, 0.0);
}

struct Case
{
  const char* name;
  int traced;       // actors, beside the ground
  std::size_t most; // pixels that may differ
  std::function<void(Stage&)> fill;
};

std::size_t different(const Picture& a, const Picture& b)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    count += std::abs(a.grey(i) - b.grey(i)) > 10.0;
  }
  return count;
}
}

int TestSVOSameVertices(int, char*[])
{
  Checks checks;
  const auto again = [](int resolution)
  {
    return [resolution](Stage& stage)
    {
      const auto all = sphere(resolution);
      addGrey(stage, all);
      addRed(stage, partOf(all));
    };
  };
  const Case cases[] = {
    { "the same mesh twice", 2, 20,
      [](Stage& stage)
      {
        const auto all = sphere(24);
        addGrey(stage, all);
        addRed(stage, all);
      } },
    { "some of the cells again", 2, 20, again(24) },
    { "some of the cells first", 2, 20,
      [](Stage& stage)
      {
        const auto all = sphere(24);
        addRed(stage, partOf(all));
        addGrey(stage, all);
      } },
    { "some cells of a fine mesh again", 2, 20, again(200) },
    { "samples of a pixel", 2, 20,
      [&](Stage& stage)
      {
        again(24)(stage);
        stage.window->SetMultiSamples(4);
      } },
    { "each cell twice", 1, 20,
      [](Stage& stage)
      { addGrey(stage, doubled(sphere(24)))->GetMapper()->ScalarVisibilityOn(); } },
    { "rasterised over traced", 1, 60,
      [](Stage& stage)
      {
        const auto all = sphere(24);
        addGrey(stage, all);
        addRed(stage, all)->GetProperty()->SetInterpolationToPBR();
      } },
    { "traced over rasterised", 1, 60,
      [](Stage& stage)
      {
        const auto all = sphere(24);
        addGrey(stage, all)->GetProperty()->SetInterpolationToPBR();
        addRed(stage, all);
      } },
    { "translucent over traced", 1, 60,
      [](Stage& stage)
      {
        const auto all = sphere(24);
        addRed(stage, all)->GetProperty()->SetOpacity(0.6);
        addGrey(stage, all);
      } },
    { "hidden by a ten-thousandth", 2, 20,
      [](Stage& stage)
      {
        addGrey(stage, sphere(24));
        addRed(stage, sphere(24, 0.4999));
      } },
    { "rasterised, hidden by a ten-thousandth", 1, 20,
      [](Stage& stage)
      {
        addGrey(stage, sphere(24));
        addRed(stage, sphere(24, 0.4999))->GetProperty()->SetInterpolationToPBR();
      } },
  };
  for (const Case& c : cases)
  {
    Stage stage;
    c.fill(stage);
    stage.addGround();
    stage.addSun(2.0, -1.5, 4.0);
    stage.pass->SetShadowTechniqueToNone();
    stage.usePass(false);
    const Picture raster = capture(stage.window);
    stage.usePass(true);
    const Picture traced = capture(stage.window);
    const std::string name = c.name;
    std::cout << name << ": " << different(raster, traced) << " pixels differ\n";
    stage.expectTraced(checks, c.traced + 1, name + ": traced as it should be");
    checks.expect(different(raster, traced) < c.most, name + ": as VTK draws it");
    // Kept layers are merged in another order.
    checks.expect(
      different(traced, capture(stage.window)) == 0, name + ": the same the second time");
    stage.pass->FrameCoherenceOff();
    checks.expect(different(traced, capture(stage.window)) == 0, name + ": and without layers");
  }
  return checks.exitCode();
}
