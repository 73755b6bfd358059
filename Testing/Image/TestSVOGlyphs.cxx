// Copies of glyphs, in every mode of their mapper: VTK's own picture, and their shadows.
#include "svoGlyphStage.h"
#include "svoShadowOracle.h"

#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkLightCollection.h"
#include "vtkLookupTable.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPolyDataNormals.h"
#include "vtkProperty.h"
#include "vtkTransform.h"

#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace
{
using namespace svotest;

struct Case
{
  std::string name;
  int copies; // that are traced
  std::function<void(GlyphStage&)> set;
};

/// Pixels that only one of two pictures covers, of those that any does.
double outlineShare(const Picture& a, const Picture& b)
{
  std::size_t any = 0, one = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const bool inA = a.depth[i] < 1.0f, inB = b.depth[i] < 1.0f;
    any += inA || inB;
    one += inA != inB;
  }
  return any > 0 ? static_cast<double>(one) / static_cast<double>(any) : 1.0;
}

void expectRaster(const Case& one, Checks& checks)
{
  GlyphStage stage(500, 500);
  one.set(stage);
  stage.usePass(false);
  const Picture raster = capture(stage.window);
  stage.usePass(true);
  const Picture traced = stage.unshadowed();
  Mask inside(raster.size(), 0); // with all edges: the same triangles are drawn
  for (std::size_t i = 0; i < inside.size(); ++i)
  {
    inside[i] = raster.depth[i] < 1.0f && traced.depth[i] < 1.0f;
  }
  const Difference look = difference(raster, traced, inside);
  const double outline = outlineShare(raster, traced);
  std::cout << one.name << ": " << stage.pass->GetNumberOfInstances() << " copies, mean difference "
            << look.mean << ", most " << look.p99 << " of " << look.pixels << " pixels, outline "
            << 100.0 * outline << " %\n";
  checks.expect(stage.pass->GetNumberOfInstances() == one.copies, one.name + ": all are traced");
  checks.expect(vtkSVORenderPass::GetReason(stage.actor).empty(), one.name + ": no reason not to");
  checks.expect(look.pixels > 5000, one.name + ": enough to compare");
  checks.expect(look.mean <= 2.0 && look.p99 <= 8, one.name + ": VTK's own colours");
  checks.expect(outline <= 0.005, one.name + ": VTK's own outlines");
}

void scaleBy(GlyphStage& stage, const char* array, bool components)
{
  stage.mapper->SetScaleArray(array);
  stage.mapper->SetScaleMode(
    components ? vtkGlyph3DMapper::SCALE_BY_COMPONENTS : vtkGlyph3DMapper::SCALE_BY_MAGNITUDE);
}

void orientBy(GlyphStage& stage, const char* array, int mode)
{
  stage.mapper->OrientOn();
  stage.mapper->SetOrientationArray(array);
  stage.mapper->SetOrientationMode(mode);
}

void colorBy(GlyphStage& stage, const char* array, int mode)
{
  stage.mapper->ScalarVisibilityOn();
  stage.mapper->SetScalarModeToUsePointFieldData();
  stage.mapper->SelectColorArray(array);
  stage.mapper->SetColorMode(mode);
}

/// The sources of a table: an odd shape, a ball, a ring.
vtkSmartPointer<vtkPolyData> shapeOf(int index)
{
  if (index == 0)
  {
    return oddShape();
  }
  const auto source = index == 1 ? ball(0.2, 0.0, 0.0, 0.0) : ring(0.2, 0.0, 0.0, 0.0);
  source->Update();
  return vtkPolyData::SafeDownCast(source->GetOutputDataObject(0));
}

vtkSmartPointer<vtkMultiBlockDataSet> shapeTree()
{
  vtkNew<vtkMultiBlockDataSet> pair;
  pair->SetBlock(0, shapeOf(1));
  const auto above = box(0.15, 0.0, 0.0, 0.3);
  above->Update();
  pair->SetBlock(2, above->GetOutputDataObject(0)); // none in between
  auto tree = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  tree->SetBlock(0, shapeOf(0));
  tree->SetBlock(1, pair);
  tree->SetBlock(2, shapeOf(2));
  return tree;
}

/// Half of the points in a block, the others in a tree below.
vtkSmartPointer<vtkMultiBlockDataSet> pointTree(vtkPolyData* points)
{
  const auto part = [&](int first)
  {
    auto mesh = vtkSmartPointer<vtkPolyData>::New();
    vtkNew<vtkPoints> places;
    mesh->GetPointData()->CopyAllocate(points->GetPointData());
    for (vtkIdType i = first; i < points->GetNumberOfPoints(); i += 2)
    {
      mesh->GetPointData()->CopyData(
        points->GetPointData(), i, places->InsertNextPoint(points->GetPoint(i)));
    }
    mesh->SetPoints(places);
    return mesh;
  };
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(1, part(1));
  auto tree = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  tree->SetBlock(0, part(0));
  tree->SetBlock(3, inner);
  return tree;
}

vtkSmartPointer<vtkMultiBlockDataSet> useTree(GlyphStage& stage)
{
  const auto tree = pointTree(stage.points);
  stage.mapper->SetInputDataObject(tree);
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  stage.mapper->SetBlockAttributes(attributes);
  return tree;
}

void useTable(GlyphStage& stage)
{
  for (int i = 0; i < 3; ++i)
  {
    stage.mapper->SetSourceData(i, shapeOf(i));
  }
}

void indexSources(GlyphStage& stage)
{
  stage.mapper->SourceIndexingOn();
  stage.mapper->SetSourceIndexArray("shape");
}

std::vector<Case> cases()
{
  using Mapper = vtkGlyph3DMapper;
  return {
    { "as they are", 20, [](GlyphStage&) {} },
    { "scale factor", 20, [](GlyphStage& s) { s.mapper->SetScaleFactor(1.4); } },
    { "mirrored", 20, [](GlyphStage& s) { s.mapper->SetScaleFactor(-1.2); } },
    { "scaling off", 20,
      [](GlyphStage& s)
      {
        scaleBy(s, "size", false);
        s.mapper->SetScaleFactor(3.0);
        s.mapper->ScalingOff();
      } },
    { "scale by magnitude", 20, [](GlyphStage& s) { scaleBy(s, "size", false); } },
    { "scale by magnitude of vectors", 20, [](GlyphStage& s) { scaleBy(s, "sizes", false); } },
    { "scale by components, some mirrored", 20, [](GlyphStage& s) { scaleBy(s, "sizes", true); } },
    { "scale without an array", 20, [](GlyphStage& s) { scaleBy(s, "nothing", false); } },
    { "clamped", 20,
      [](GlyphStage& s)
      {
        scaleBy(s, "size", false);
        s.mapper->ClampingOn();
        s.mapper->SetRange(0.3, 1.0);
      } },
    { "clamped without data", 20,
      [](GlyphStage& s)
      {
        s.mapper->ClampingOn();
        s.mapper->SetRange(0.3, 0.5);
      } },
    { "directions", 20, [](GlyphStage& s) { orientBy(s, "way", Mapper::DIRECTION); } },
    { "rotations", 20, [](GlyphStage& s) { orientBy(s, "angles", Mapper::ROTATION); } },
    { "quaternions", 20, [](GlyphStage& s) { orientBy(s, "turn", Mapper::QUATERNION); } },
    { "orientation off", 20,
      [](GlyphStage& s)
      {
        orientBy(s, "angles", Mapper::ROTATION);
        s.mapper->OrientOff();
      } },
    { "rotated and scaled by components", 20,
      [](GlyphStage& s)
      {
        orientBy(s, "angles", Mapper::ROTATION);
        scaleBy(s, "sizes", true);
      } },
    { "mask", 15,
      [](GlyphStage& s)
      {
        s.mapper->MaskingOn();
        s.mapper->SetMaskArray("shown");
      } },
    { "a mask that is no array of bits", 20,
      [](GlyphStage& s)
      {
        s.mapper->MaskingOn();
        s.mapper->SetMaskArray("shape"); // VTK ignores it
      } },
    { "table, not indexed", 20, [](GlyphStage& s) { useTable(s); } },
    { "table by index", 20,
      [](GlyphStage& s)
      {
        useTable(s);
        indexSources(s);
      } },
    { "tree by index", 28,
      [](GlyphStage& s)
      {
        s.mapper->UseSourceTableTreeOn();
        s.mapper->SetSourceTableTree(shapeTree());
        indexSources(s);
      } },
    { "colours by a table", 20,
      [](GlyphStage& s)
      {
        colorBy(s, "value", VTK_COLOR_MODE_MAP_SCALARS);
        vtkNew<vtkLookupTable> table;
        table->SetHueRange(0.0, 0.7);
        table->Build();
        s.mapper->SetLookupTable(table);
        s.mapper->SetScalarRange(0.2, 0.9);
      } },
    { "active scalars", 20,
      [](GlyphStage& s)
      {
        s.mapper->ScalarVisibilityOn();
        s.mapper->SetScalarRange(0.0, 1.0);
      } },
    { "colours as they are", 20,
      [](GlyphStage& s) { colorBy(s, "rgb", VTK_COLOR_MODE_DIRECT_SCALARS); } },
    { "interpolated before mapping", 20,
      [](GlyphStage& s)
      {
        colorBy(s, "value", VTK_COLOR_MODE_MAP_SCALARS);
        s.mapper->InterpolateScalarsBeforeMappingOn(); // then VTK maps none
      } },
    { "highlights, ambient light", 20,
      [](GlyphStage& s)
      {
        colorBy(s, "value", VTK_COLOR_MODE_MAP_SCALARS);
        vtkProperty* property = s.actor->GetProperty();
        property->SetInterpolationToPhong();
        property->SetAmbient(0.3);
        property->SetDiffuse(0.6);
        property->SetSpecular(0.5);
        property->SetSpecularPower(12.0);
        property->SetSpecularColor(0.6, 0.9, 1.0);
      } },
    { "colours that differ", 20,
      [](GlyphStage& s)
      {
        vtkProperty* property = s.actor->GetProperty();
        property->SetAmbient(0.4);
        property->SetAmbientColor(0.1, 0.2, 0.9);
        property->SetDiffuseColor(0.9, 0.3, 0.2); // their mean is shown
      } },
    { "flat", 20, [](GlyphStage& s) { s.actor->GetProperty()->SetInterpolationToFlat(); } },
    { "the actor's matrix", 20,
      [](GlyphStage& s)
      {
        orientBy(s, "angles", Mapper::ROTATION);
        scaleBy(s, "sizes", true);
        s.actor->SetScale(0.9, 1.1, -1.0);
        s.actor->SetPosition(0.1, 0.2, 1.4);
        vtkNew<vtkMatrix4x4> shear;
        shear->SetElement(0, 2, 0.3);
        s.actor->SetUserMatrix(shear);
      } },
    { "blocks of points", 20,
      [](GlyphStage& s)
      {
        useTree(s);
        colorBy(s, "value", VTK_COLOR_MODE_MAP_SCALARS);
      } },
    { "colours of blocks", 20,
      [](GlyphStage& s)
      {
        const auto tree = useTree(s);
        s.actor->GetProperty()->SetSpecular(0.4);
        s.actor->GetProperty()->SetSpecularPower(9.0);
        s.actor->GetProperty()->SetSpecularColor(1.0, 1.0, 1.0);
        const double blue[3] = { 0.2, 0.4, 0.9 };
        s.mapper->GetBlockAttributes()->SetBlockColor(tree->GetBlock(0), blue);
        const double green[3] = { 0.2, 0.9, 0.3 };
        s.mapper->GetBlockAttributes()->SetBlockColor(tree->GetBlock(3), green); // not a leaf
      } },
    { "hidden blocks", 10,
      [](GlyphStage& s)
      {
        const auto tree = useTree(s);
        s.mapper->GetBlockAttributes()->SetBlockVisibility(tree->GetBlock(0), false);
      } },
  };
}

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
    { "translucent copies", "is translucent", 16,
      [](GlyphStage& s) { colorBy(s, "rgba", VTK_COLOR_MODE_DIRECT_SCALARS); } },
    { "translucent copies that were told to", "is translucent", 20,
      [](GlyphStage& s)
      {
        colorBy(s, "rgba", VTK_COLOR_MODE_DIRECT_SCALARS);
        vtkSVORenderPass::SetCastShadow(true, s.actor);
      } },
    { "a translucent property", "is translucent", 0,
      [](GlyphStage& s) { s.actor->GetProperty()->SetOpacity(0.5); } },
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
  checks.expect(
    stage.pass->GetNumberOfInstances() == one.casters + 1, one.name + ": so many copies cast");
  const std::string reason = vtkSVORenderPass::GetReason(stage.actor);
  std::cout << one.name << ": " << reason << '\n';
  checks.expect(reason.find(one.reason) != std::string::npos, one.name + ": the reason is told");
}

/// Points, sizes and turns that are no numbers: those copies are not there, the others are.
void expectOthersThan(GlyphStage& stage, int copies, const std::string& name, Checks& checks)
{
  stage.unshadowed();
  checks.expect(stage.pass->GetNumberOfInstances() == copies, name);
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
  expectShadows(
    checks, oracle.judge(stage.renderer, stage.shadowed(), unshadowed), "copies, shadow buffer");
  expectShadows(
    checks, oracle.judge(stage.renderer, stage.shadowedByRays(), unshadowed), "copies, rays");
  checks.expect(
    stage.pass->GetNumberOfOctreesBuilt() > 0 && stage.pass->GetNumberOfOctreesBuilt() <= 4,
    "copies share their octree");
}
}

int TestSVOGlyphs(int, char*[])
{
  Checks checks;
  for (const Case& one : cases())
  {
    expectRaster(one, checks);
  }
  for (const Left& one : left())
  {
    expectLeft(one, checks);
  }
  expectBadInput(checks);
  expectShadowsOfCopies(checks);
  return checks.exitCode();
}
