// Glyphs that the rasteriser draws, bad input, the shadows of copies, and their selection.
#include "svoGlyphStage.h"
#include "svoShadowOracle.h"

#include "vtkHardwareSelector.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkLightCollection.h"
#include "vtkPointData.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkTransform.h"

#include <cmath>
#include <functional>
#include <iostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace
{
using namespace svotest;

/// What is left to the rasteriser, why, and how many copies cast all the same.
struct Left
{
  std::string name, reason;
  int casters; // instances
  std::function<void(GlyphStage&)> set;
};

std::vector<Left> left()
{
  return {
    { "translucent copies", "is translucent", 20,
      [](GlyphStage& s) { colorBy(s, "rgba", VTK_COLOR_MODE_DIRECT_SCALARS); } },
    { "translucent copies that were told to", "is translucent", 20,
      [](GlyphStage& s)
      {
        colorBy(s, "rgba", VTK_COLOR_MODE_DIRECT_SCALARS);
        vtkSVORenderPass::SetCastShadow(true, s.actor);
      } },
    { "translucent copies, where these cast nothing", "is translucent", 16,
      [](GlyphStage& s)
      {
        colorBy(s, "rgba", VTK_COLOR_MODE_DIRECT_SCALARS);
        s.pass->TranslucentShadowsOff();
      } },
    { "a translucent property", "is translucent", 20,
      [](GlyphStage& s) { s.actor->GetProperty()->SetOpacity(0.5); } },
    { "a translucent property, where that casts nothing", "is translucent", 0,
      [](GlyphStage& s)
      {
        s.actor->GetProperty()->SetOpacity(0.5);
        s.pass->TranslucentShadowsOff();
      } },
    { "culling and levels of detail", "shows coarser copies far away", 20,
      [](GlyphStage& s) { s.mapper->SetCullingAndLOD(true); } },
    { "edges", "shows its edges or vertices", 20,
      [](GlyphStage& s) { s.actor->GetProperty()->EdgeVisibilityOn(); } },
    { "wireframe", "is shown as wireframe or points", 0,
      [](GlyphStage& s) { s.actor->GetProperty()->SetRepresentationToWireframe(); } },
    { "no source", "has lines or vertices", 0,
      [](GlyphStage& s) { s.mapper->RemoveAllInputConnections(1); } },
    { "normals of cells", "has sources with normals of cells", 20,
      [](GlyphStage& s)
      {
        vtkNew<vtkPolyDataNormals> normals;
        normals->SetInputData(oddShape());
        normals->ComputePointNormalsOff();
        normals->ComputeCellNormalsOn();
        normals->Update();
        vtkNew<vtkPolyData> source;
        source->ShallowCopy(normals->GetOutput());
        source->GetPointData()->SetNormals(nullptr);
        s.mapper->SetSourceData(source);
      } },
    { "copies that are flattened", "has copies that are flattened", 15,
      [](GlyphStage& s)
      {
        scaleBy(s, "sizes", true);
        vtkDataArray* sizes = s.points->GetPointData()->GetArray("sizes");
        for (int i = 0; i < 20; i += 4)
        {
          sizes->SetComponent(i, 2, 1e-14);
        }
      } },
    { "told so", "was told so", 20,
      [](GlyphStage& s) { vtkSVORenderPass::SetUseSVO(false, s.actor); } },
  };
}

void expectLeft(const Left& one, Checks& checks)
{
  GlyphStage stage;
  stage.addGround(0.1); // hidden; so that there is something to trace
  one.set(stage);
  stage.usePass(false);
  const Picture raster = capture(stage.window);
  stage.usePass(true);
  const Picture traced = stage.unshadowed();
  checks.expect(difference(raster, traced).p99 == 0, one.name + ": VTK's own picture");
  stage.shadowed();
  stage.expectInstances(checks, one.casters + 1, one.name + ": so many copies cast");
  const std::string reason = vtkSVORenderPass::GetReason(stage.actor);
  std::cout << one.name << ": " << reason << '\n';
  checks.expect(reason.find(one.reason) != std::string::npos, one.name + ": the reason is told");
}

/// Points, sizes and turns that are no numbers: those copies are not there, the others are.
void expectOthersThan(GlyphStage& stage, int copies, const std::string& name, Checks& checks)
{
  stage.unshadowed();
  stage.expectInstances(checks, copies, name);
}

void expectBadInput(Checks& checks)
{
  const double nan = std::nan("");
  {
    GlyphStage stage;
    stage.points->GetPoints()->SetPoint(3, nan, 0.0, 0.0);
    scaleBy(stage, "size", false);
    stage.points->GetPointData()->GetArray("size")->SetComponent(5, 0, nan);
    orientBy(stage, "turn", vtkGlyph3DMapper::QUATERNION);
    stage.points->GetPointData()->GetArray("turn")->SetTuple4(7, 0.0, 0.0, 0.0, 0.0);
    expectOthersThan(stage, 17, "NaN hides copies", checks);
  }
  {
    GlyphStage stage;
    scaleBy(stage, "size", false);
    stage.points->GetPointData()->GetArray("size")->SetComponent(5, 0, 0.0);
    expectOthersThan(stage, 20, "a size of 0 is a speck", checks);
  }
  {
    GlyphStage stage;
    vtkNew<vtkPolyData> none;
    stage.mapper->SetInputData(none);
    expectOthersThan(stage, 0, "no points", checks);
    stage.mapper->SetInputData(stage.points);
    stage.mapper->SetSourceData(none);
    expectOthersThan(stage, 0, "an empty source", checks);
  }
}

/// The same solids one by one, for the judge of shadows.
void addCopies(GlyphStage& stage, vtkPolyData* shape, ShadowOracle& oracle)
{
  vtkDataArray* angles = stage.points->GetPointData()->GetArray("angles");
  vtkDataArray* sizes = stage.points->GetPointData()->GetArray("sizes");
  for (vtkIdType i = 0; i < stage.points->GetNumberOfPoints(); ++i)
  {
    vtkNew<vtkTransform> place;
    place->Translate(stage.points->GetPoint(i));
    place->RotateZ(angles->GetComponent(i, 2));
    place->RotateX(angles->GetComponent(i, 0));
    place->RotateY(angles->GetComponent(i, 1));
    place->Scale(sizes->GetTuple3(i));
    oracle.add(shape, place->GetMatrix());
  }
}

void expectShadowsOfCopies(Checks& checks)
{
  GlyphStage stage(500, 500);
  orientBy(stage, "angles", vtkGlyph3DMapper::ROTATION);
  scaleBy(stage, "sizes", true);
  ShadowOracle oracle;
  oracle.add(stage.addGround());
  addCopies(stage, stage.mapper->GetSource(), oracle);
  vtkLight* sun = stage.addSun(-1.0, -2.0, 1.0); // low: they shadow each other
  oracle.add(sun);
  vtkSVORenderPass::SetCastShadow(
    false, vtkLight::SafeDownCast(stage.renderer->GetLights()->GetItemAsObject(0)));
  const Picture unshadowed = stage.unshadowed();
  expectShadows(checks, oracle.judge(stage.renderer, stage.shadowedByBuffers(), unshadowed),
    "copies, shadow buffer");
  expectShadows(
    checks, oracle.judge(stage.renderer, stage.shadowedByRays(), unshadowed), "copies, rays");
  checks.expect(
    stage.pass->GetNumberOfOctreesBuilt() > 0 && stage.pass->GetNumberOfOctreesBuilt() <= 4,
    "copies share their octree");
}

/// The copies that a selection names: block and point, or selection id.
std::set<std::pair<int, vtkIdType>> selectedCopies(GlyphStage& stage)
{
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(stage.renderer);
  selector->SetArea(0, 0, 299, 299);
  selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_CELLS);
  const auto selection = vtkSmartPointer<vtkSelection>::Take(selector->Select());
  std::set<std::pair<int, vtkIdType>> copies;
  for (unsigned int i = 0; selection && i < selection->GetNumberOfNodes(); ++i)
  {
    vtkSelectionNode* node = selection->GetNode(i);
    vtkInformation* about = node->GetProperties();
    auto* ids = vtkIdTypeArray::SafeDownCast(node->GetSelectionList());
    const int block = about->Has(vtkSelectionNode::COMPOSITE_INDEX())
      ? about->Get(vtkSelectionNode::COMPOSITE_INDEX())
      : -1;
    for (vtkIdType k = 0; ids && k < ids->GetNumberOfValues(); ++k)
    {
      if (about->Get(vtkSelectionNode::PROP()) == stage.actor)
      {
        copies.emplace(block, ids->GetValue(k));
      }
    }
  }
  return copies;
}

/// VTK draws the frames of a selection, with the pass as without it.
void expectSelection(Checks& checks)
{
  const std::vector<std::pair<std::string, std::function<void(GlyphStage&)>>> inputs = {
    { "points", [](GlyphStage&) {} },
    { "selection ids",
      [](GlyphStage& stage)
      {
        vtkNew<vtkIntArray> ids;
        ids->SetName("ids");
        for (int i = 0; i < 20; ++i)
        {
          ids->InsertNextValue(100 + i);
        }
        stage.points->GetPointData()->AddArray(ids);
        stage.mapper->SetSelectionIdArray("ids");
        stage.mapper->UseSelectionIdsOn();
      } },
    { "blocks", [](GlyphStage& stage) { useTree(stage); } },
  };
  for (const auto& [name, set] : inputs)
  {
    GlyphStage stage;
    stage.addGround();
    set(stage);
    const Picture before = stage.shadowed();
    const auto traced = selectedCopies(stage);
    checks.expect(difference(before, stage.shadowed()).largest == 0, name + ": no trace is left");
    stage.usePass(false);
    capture(stage.window);
    std::cout << "selection by " << name << ": " << traced.size() << " copies\n";
    checks.expect(traced.size() == 20, name + ": every copy is named");
    checks.expect(traced == selectedCopies(stage), name + ": as without the pass");
    const vtkIdType first = traced.empty() ? -1 : traced.begin()->second;
    checks.expect(first == (name == "selection ids" ? 100 : 0), name + ": by its number");
  }
}
}

int TestSVOGlyphShadows(int, char*[])
{
  Checks checks;
  for (const Left& one : left())
  {
    expectLeft(one, checks);
  }
  expectBadInput(checks);
  expectShadowsOfCopies(checks);
  expectSelection(checks);
  return checks.exitCode();
}
