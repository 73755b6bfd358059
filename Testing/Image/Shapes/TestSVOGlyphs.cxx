// Copies of glyphs, in every mode of their mapper: VTK's own picture.
#include "svoGlyphStage.h"

#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkLookupTable.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkProperty.h"

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
  stage.expectInstances(checks, one.copies, one.name + ": all are traced");
  checks.expect(vtkSVORenderPass::GetReason(stage.actor).empty(), one.name + ": no reason not to");
  checks.expect(look.pixels > 5000, one.name + ": enough to compare");
  checks.expect(look.mean <= 2.0 && look.p99 <= 8, one.name + ": VTK's own colours");
  checks.expect(outline <= 0.005, one.name + ": VTK's own outlines");
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
}

int TestSVOGlyphs(int, char*[])
{
  Checks checks;
  for (const Case& one : cases())
  {
    expectRaster(one, checks);
  }
  return checks.exitCode();
}
