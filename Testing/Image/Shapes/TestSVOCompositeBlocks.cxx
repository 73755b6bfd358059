// A composite mapper: blocks with colours of their own, one of them invisible.
#include "svoCompositeMapper.h"
#include "svoShadowOracle.h"
#include "svoTestStage.h"

#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"

int TestSVOCompositeBlocks(int argc, char* argv[])
{
  using namespace svotest;
  Checks checks;
  Stage stage;
  vtkNew<vtkMultiBlockDataSet> blocks;
  const vtkSmartPointer<vtkAlgorithm> sources[3] = { ball(0.6, -1.0, -0.2, 1.0),
    box(0.7, 0.2, 1.0, 0.7), spike(1.0, 1.2, -0.6, 0.5) };
  for (unsigned int i = 0; i < 3; ++i)
  {
    sources[i]->Update();
    blocks->SetBlock(i, sources[i]->GetOutputDataObject(0));
  }
  vtkNew<CompositeMapper> mapper;
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  mapper->SetInputDataObject(blocks);
  mapper->SetCompositeDataDisplayAttributes(attributes);
  mapper->ScalarVisibilityOff();
  const double red[3] = { 0.9, 0.3, 0.2 };
  const double blue[3] = { 0.3, 0.5, 0.9 };
  attributes->SetBlockColor(blocks->GetBlock(0), red);
  attributes->SetBlockColor(blocks->GetBlock(2), blue);
  attributes->SetBlockVisibility(blocks->GetBlock(1), false);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  stage.renderer->AddActor(actor);

  ShadowOracle oracle;
  oracle.add(stage.addGround());
  oracle.add(vtkPolyData::SafeDownCast(blocks->GetBlock(0)), actor->GetMatrix());
  oracle.add(vtkPolyData::SafeDownCast(blocks->GetBlock(2)), actor->GetMatrix());
  oracle.add(stage.addSun(2.0, -1.5, 4.0));

  const Picture unshadowed = stage.unshadowed();
  const Picture shadowed = stage.shadowed();
  checks.expect(stage.pass->GetNumberOfInstances() == 3, "two visible blocks and the ground");
  expectShadows(checks, oracle.judge(stage.renderer, shadowed, unshadowed), "composite blocks");

  stage.usePass(false);
  const Picture raster = capture(stage.window);
  const Difference look = difference(raster, unshadowed, awayFromEdges(raster, 2));
  checks.expect(look.mean <= 2.0 && look.p99 <= 8, "without shadows it is VTK's own picture");

  stage.usePass(true);
  checks.expect(matchesBaseline(stage.window, argc, argv), "the baseline");
  return checks.exitCode();
}
