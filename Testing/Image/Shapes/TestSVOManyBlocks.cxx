// A thousand small balls as blocks: what their octrees take is in proportion to their triangles.
#include "svoCompositeMapper.h"
#include "svoTestStage.h"

#include "vtkMultiBlockDataSet.h"
#include "vtkPPolyDataToSVO.h"
#include "vtkPolyData.h"
#include "vtkSphereSource.h"

#include <chrono>
#include <iostream>
#include <string>

namespace
{
using namespace svotest;

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

constexpr int Edge = 10; // blocks along an edge of the cube that they fill

vtkSmartPointer<vtkMultiBlockDataSet> balls()
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (int i = 0; i < Edge * Edge * Edge; ++i)
  {
    vtkNew<vtkSphereSource> source;
    source->SetThetaResolution(16);
    source->SetPhiResolution(16);
    source->SetRadius(0.1 + 1e-5 * i); // no two alike
    source->SetCenter(
      0.3 * (i % Edge) - 1.35, 0.3 * (i / Edge % Edge) - 1.35, 0.3 * (i / Edge / Edge) - 0.6);
    source->Update();
    blocks->SetBlock(i, source->GetOutput());
  }
  return blocks;
}

Picture show(Stage& stage, vtkDataObject* blocks, double& seconds)
{
  vtkNew<CompositeMapper> mapper;
  mapper->SetInputDataObject(blocks);
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  stage.renderer->RemoveAllViewProps();
  stage.renderer->AddActor(actor);
  const auto start = Clock::now();
  const Picture picture = capture(stage.window);
  seconds = since(start);
  return picture;
}
}

int TestSVOManyBlocks(int, char*[])
{
  Checks checks;
  Stage stage(500, 500);
  stage.addSun(2.0, -1.5, 4.0);
  const auto blocks = balls();
  double seconds[3] = {};

  stage.usePass(false);
  const Picture raster = show(stage, blocks, seconds[0]);
  stage.usePass(true);
  stage.pass->SetShadowTechniqueToNone();
  const Picture unshadowed = show(stage, blocks, seconds[1]);
  const Difference look = difference(raster, unshadowed, awayFromEdges(raster, 2));
  checks.expect(look.mean <= 2.0 && look.p99 <= 8, "without shadows it is VTK's own picture");
  stage.pass->SetShadowTechniqueToShadowBuffer();
  capture(stage.window);
  checks.expect(stage.pass->GetNumberOfInstances() == Edge * Edge * Edge, "all of them are traced");
  const vtkIdType kibibytes = stage.pass->GetOctreeMemorySize();
  checks.expect(kibibytes < 150 * 1024, "the pass's octrees take " + std::to_string(kibibytes));

  // As ParaView's representation converts them.
  vtkNew<vtkPPolyDataToSVO> filter;
  filter->AdaptLevelOn();
  filter->SetInputDataObject(blocks);
  const auto start = Clock::now();
  filter->Update();
  const double conversion = since(start);
  const unsigned long cached = filter->GetCacheMemorySize();
  checks.expect(cached < 150 * 1024, "the filter's octrees take " + std::to_string(cached));
  stage.pass->SetShadowTechniqueToNone();
  const Picture converted = show(stage, filter->GetOutputDataObject(0), seconds[2]);
  const Difference same = difference(raster, converted, awayFromEdges(raster, 2));
  checks.expect(same.mean <= 2.0 && same.p99 <= 8, "converted before, it is VTK's own picture");
  std::cout << "first picture: rasteriser " << seconds[0] << " s, pass " << seconds[1] << " s, "
            << kibibytes / 1024 << " MiB of octrees; converted in " << conversion << " s, "
            << seconds[2] << " s, " << cached / 1024 << " MiB\n";
  return checks.exitCode();
}
