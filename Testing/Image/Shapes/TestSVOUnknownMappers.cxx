// Mappers other than vtkPolyDataMapper: older ones that draw blocks are traced, and a class that is
// not known is named once, where somebody may miss a shadow.
#include "svoTestStage.h"

#include "../../Unit/svoTestMessages.h"

#include "vtkCompositePolyDataMapper.h"
#include "vtkElevationFilter.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLActor.h"
#include "vtkOpenGLPolyDataMapper.h"
#include "vtkPointGaussianMapper.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkVersion.h"

#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 0)
#include "vtkHierarchicalPolyDataMapper.h"
#endif

#include <iostream>
#include <string>

namespace
{
using namespace svotest;

/// May draw anything.
class StrangeMapper : public vtkOpenGLPolyDataMapper
{
public:
  static StrangeMapper* New();
  vtkTypeMacro(StrangeMapper, vtkOpenGLPolyDataMapper);
};
vtkStandardNewMacro(StrangeMapper);

class OddMapper : public vtkOpenGLPolyDataMapper
{
public:
  static OddMapper* New();
  vtkTypeMacro(OddMapper, vtkOpenGLPolyDataMapper);
};
vtkStandardNewMacro(OddMapper);

class StrangeActor : public vtkOpenGLActor
{
public:
  static StrangeActor* New();
  vtkTypeMacro(StrangeActor, vtkOpenGLActor);
};
vtkStandardNewMacro(StrangeActor);

vtkSmartPointer<vtkMultiBlockDataSet> coloredBlocks()
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  unsigned int index = 0;
  for (const auto& source : { ball(0.6, -0.9, -0.2, 0.9), box(0.7, 0.8, 0.5, 0.7) })
  {
    vtkNew<vtkElevationFilter> colors;
    colors->SetInputConnection(source->GetOutputPort());
    colors->SetLowPoint(0.0, 0.0, 0.3);
    colors->SetHighPoint(0.0, 0.0, 1.5);
    colors->Update();
    blocks->SetBlock(index++, colors->GetOutput());
  }
  return blocks;
}

// A tree of blocks, or a single mesh.
void expectTraced(Checks& checks, vtkMapper* mapper, vtkDataObject* input, int instances)
{
  Stage stage;
  stage.addGround();
  stage.addSun(2.0, -1.5, 4.0);
  const svo::TestMessages messages(stage.pass);
  mapper->SetInputDataObject(input);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  stage.renderer->AddActor(actor);
  stage.usePass(false);
  const Picture raster = capture(stage.window);
  stage.usePass(true);
  const Picture traced = stage.unshadowed();
  const std::string name = std::string(mapper->GetClassName()) + " of a " + input->GetClassName();
  stage.expectInstances(checks, instances, name + " is traced");
  const Difference look = difference(raster, traced, awayFromEdges(raster, 2));
  std::cout << name << ": mean difference " << look.mean << ", most " << look.p99 << '\n';
  checks.expect(look.mean <= 1.0 && look.p99 <= 4, name + ": VTK's own picture");
  stage.shadowed();
  checks.expect(messages.warnings.empty(), name + ": nothing is said");
  checks.expect(vtkSVORenderPass::GetCastShadow(actor), name + " casts");
}

vtkSmartPointer<vtkActor> actorOf(vtkMapper* mapper)
{
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  return actor;
}

void expectNames(Checks& checks)
{
  const auto points = ball(0.5, 0.0, 0.0, 1.0);
  vtkNew<OddMapper> odd;
  odd->SetInputConnection(points->GetOutputPort());
  vtkNew<StrangeMapper> strange;
  strange->SetInputConnection(points->GetOutputPort());
  vtkNew<vtkPointGaussianMapper> splats;
  splats->SetInputConnection(points->GetOutputPort());
  vtkNew<StrangeActor> unknown;
  unknown->SetMapper(odd);

  Stage stage;
  stage.addGround();
  vtkLight* sun = stage.addSun(2.0, -1.5, 4.0);
  stage.usePass(true);
  const svo::TestMessages messages(stage.pass);
  const auto expect = [&](std::size_t count, const std::string& what)
  {
    capture(stage.window);
    checks.expect(messages.warnings.size() == count, what);
  };
  stage.renderer->AddActor(actorOf(splats));
  stage.renderer->AddActor(unknown);
  const auto quiet = actorOf(odd);
  vtkSVORenderPass::SetCastShadow(false, quiet);
  const auto hidden = actorOf(odd);
  hidden->VisibilityOff();
  const auto glass = actorOf(odd);
  glass->GetProperty()->SetOpacity(0.5);
  const auto wires = actorOf(odd);
  wires->GetProperty()->SetRepresentationToWireframe();
  for (const auto& actor : { quiet, hidden, glass, wires })
  {
    stage.renderer->AddActor(actor);
  }
  expect(0, "nobody misses a shadow of these");
  stage.renderer->AddActor(actorOf(odd));
  stage.pass->SetShadowTechniqueToNone();
  expect(0, "without shadows none is missed");
  stage.pass->SetShadowTechniqueToShadowBuffer();
  vtkSVORenderPass::SetCastShadow(false, sun);
  expect(0, "nor is one while no light casts");
  vtkSVORenderPass::SetCastShadow(true, sun);
  stage.renderer->AddActor(actorOf(odd));
  expect(1, "a class is named once, not for each actor");
  checks.expect(
    messages.all().find(odd->GetClassName()) != std::string::npos, "it is named indeed");
  stage.renderer->AddActor(actorOf(strange));
  expect(2, "another class is another message");
  expect(2, "nor is it named in every frame");

  Stage other(stage, 0.5, 0.5, 1.0, 1.0);
  other.addGround();
  other.addSun(2.0, -1.5, 4.0);
  other.renderer->AddActor(actorOf(odd));
  other.renderer->SetPass(stage.pass);
  expect(2, "nor for each renderer");
}
}

int TestSVOUnknownMappers(int, char*[])
{
  Checks checks;
  const auto blocks = coloredBlocks();
  expectTraced(checks, vtkNew<vtkCompositePolyDataMapper>(), blocks, 3);
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 3, 0)
  expectTraced(checks, vtkNew<vtkHierarchicalPolyDataMapper>(), blocks, 3);
  expectTraced(checks, vtkNew<vtkCompositePolyDataMapper>(), blocks->GetBlock(0), 2);
#endif
  expectNames(checks);
  return checks.exitCode();
}
