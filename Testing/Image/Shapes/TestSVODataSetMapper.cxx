// Grids shown by vtkDataSetMapper are traced as their surface: with the rasteriser's look, with
// shadows, and anew when the grid changes.
#include "svoTestStage.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDataSetMapper.h"
#include "vtkElevationFilter.h"
#include "vtkPoints.h"
#include "vtkProperty.h"
#include "vtkUnstructuredGrid.h"

#include <iostream>

namespace
{
using namespace svotest;

/// Hexahedra that fill a cube from `low` to `high`, `count` along each edge.
vtkSmartPointer<vtkUnstructuredGrid> blocks(int count, double low, double high)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  const int row = count + 1;
  const double edge = (high - low) / count;
  for (int k = 0; k <= count; ++k)
  {
    for (int j = 0; j <= count; ++j)
    {
      for (int i = 0; i <= count; ++i)
      {
        points->InsertNextPoint(low + edge * i, low + edge * j, low + edge * k);
      }
    }
  }
  grid->SetPoints(points);
  grid->Allocate(count * count * count);
  for (int k = 0; k < count; ++k)
  {
    for (int j = 0; j < count; ++j)
    {
      for (int i = 0; i < count; ++i)
      {
        const vtkIdType a = (vtkIdType(k) * row + j) * row + i;
        const vtkIdType above = a + row * row;
        const vtkIdType ids[8] = { a, a + 1, a + row + 1, a + row, above, above + 1,
          above + row + 1, above + row };
        grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
      }
    }
  }
  return grid;
}

std::size_t darker(const Picture& than, const Picture& picture)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < picture.size(); ++i)
  {
    count += picture.grey(i) + 10.0 < than.grey(i);
  }
  return count;
}
}

int TestSVODataSetMapper(int, char*[])
{
  Checks checks;
  Stage stage;
  stage.addGround();
  stage.addSun(2.0, -1.5, 4.0);
  const vtkSmartPointer<vtkUnstructuredGrid> grid = blocks(4, -0.6, 0.6);
  vtkNew<vtkElevationFilter> height;
  height->SetInputData(grid);
  height->SetLowPoint(0.0, 0.0, -0.6);
  height->SetHighPoint(0.0, 0.0, 0.6);
  vtkNew<vtkDataSetMapper> mapper;
  mapper->SetInputConnection(height->GetOutputPort());
  mapper->SetScalarRange(0.0, 1.0);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->SetPosition(0.0, 0.0, 1.2);
  actor->RotateZ(30.0);
  stage.renderer->AddActor(actor);

  const auto compare = [&](const std::string& name)
  {
    stage.usePass(false);
    const Picture raster = capture(stage.window);
    stage.usePass(true);
    const Picture light = stage.unshadowed();
    stage.expectTraced(checks, 2, name + ": the grid is traced");
    const Difference d = difference(raster, light, awayFromEdges(raster, 2));
    std::cout << name << ": mean " << d.mean << ", p99 " << d.p99 << " of " << d.pixels
              << " pixels\n";
    checks.expect(d.mean <= 0.5 && d.p99 <= 2, name + ": the rasteriser's look");
    const std::size_t shadow = darker(light, stage.shadowed());
    std::cout << name << ": " << shadow << " pixels in shadow\n";
    checks.expect(shadow > 1000, name + ": a shadow on the ground");
    return raster;
  };
  const Picture first = compare("points");

  mapper->SetScalarVisibility(false);
  actor->GetProperty()->SetColor(0.3, 0.6, 0.9);
  const Picture plain = compare("no scalars");
  checks.expect(difference(first, plain).mean > 1.0, "colours follow the mapper");

  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    double x[3];
    grid->GetPoint(i, x);
    grid->GetPoints()->SetPoint(i, 0.6 * x[0], 1.4 * x[1], x[2]);
  }
  grid->GetPoints()->Modified();
  grid->Modified();
  const Picture moved = compare("moved points");
  checks.expect(difference(plain, moved).mean > 1.0, "the surface follows the grid");

  // What has a look of its own stays with the rasteriser, and casts.
  actor->GetProperty()->EdgeVisibilityOn();
  const Picture light = stage.unshadowed();
  stage.expectTraced(checks, 1, "edges are the rasteriser's");
  checks.expect(darker(light, stage.shadowed()) > 1000, "what shows edges casts all the same");
  return checks.exitCode();
}
