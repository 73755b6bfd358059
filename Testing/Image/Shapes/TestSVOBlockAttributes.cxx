// Blocks with arrays, lookup tables, ranges and modes of their own, and with a texture, look as VTK
// draws them.
#include "svoCompositeMapper.h"
#include "svoTestStage.h"

#include "vtkCellData.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkElevationFilter.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkLookupTable.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTexture.h"

#include <functional>
#include <iostream>

namespace
{
using Attributes = vtkCompositeDataDisplayAttributes;

vtkSmartPointer<vtkLookupTable> table(double low, double high)
{
  auto colors = vtkSmartPointer<vtkLookupTable>::New();
  colors->SetHueRange(low, high);
  colors->SetTableRange(0.0, 1.0);
  colors->Build();
  return colors;
}

// Three rings with heights and halves at their points and numbers at their cells, two of them in a
// tree.
vtkSmartPointer<vtkMultiBlockDataSet> rings()
{
  auto root = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  vtkNew<vtkMultiBlockDataSet> pair;
  for (int i = 0; i < 3; ++i)
  {
    vtkNew<vtkElevationFilter> height;
    height->SetInputConnection(svotest::ring(0.7, 1.4 * (i - 1), 0.0, 1.0)->GetOutputPort());
    height->SetLowPoint(0.0, -0.7, 0.0);
    height->SetHighPoint(0.0, 0.7, 0.0);
    height->Update();
    vtkNew<vtkPolyData> mesh;
    mesh->DeepCopy(height->GetOutput());
    vtkNew<vtkFloatArray> halves;
    halves->SetName("Halves");
    for (vtkIdType p = 0; p < mesh->GetNumberOfPoints(); ++p)
    {
      halves->InsertNextValue(mesh->GetPoint(p)[1] > 0.0 ? 0.9f : 0.2f);
    }
    mesh->GetPointData()->AddArray(halves);
    vtkNew<vtkFloatArray> stripes;
    stripes->SetName("Stripes");
    for (vtkIdType c = 0; c < mesh->GetNumberOfCells(); ++c)
    {
      stripes->InsertNextValue(static_cast<float>((c / 40) % 5) / 4.0f);
    }
    mesh->GetCellData()->AddArray(stripes);
    i == 0 ? root->SetBlock(0, mesh) : pair->SetBlock(i - 1, mesh);
  }
  root->SetBlock(1, pair);
  return root;
}

struct Case
{
  const char* name;
  std::function<void(Attributes*, vtkMultiBlockDataSet* root, vtkDataObject* pair)> set;
  bool traced = true;
};
}

int TestSVOBlockAttributes(int, char*[])
{
  using namespace svotest;
  Checks checks;
  const Case cases[] = {
    { "another array",
      [](Attributes* own, vtkMultiBlockDataSet* root, vtkDataObject*)
      { own->SetBlockArrayName(root->GetBlock(0), "Halves"); } },
    { "an array of the tree around",
      [](Attributes* own, vtkMultiBlockDataSet*, vtkDataObject* pair)
      { own->SetBlockArrayName(pair, "Halves"); } },
    { "another association",
      [](Attributes* own, vtkMultiBlockDataSet* root, vtkDataObject*)
      {
        own->SetBlockArrayName(root->GetBlock(0), "Stripes");
        own->SetBlockScalarMode(root->GetBlock(0), VTK_SCALAR_MODE_USE_CELL_FIELD_DATA);
      } },
    { "another table",
      [](Attributes* own, vtkMultiBlockDataSet* root, vtkDataObject*)
      { own->SetBlockLookupTable(root->GetBlock(0), table(0.1, 0.2)); } },
    { "another range",
      [](Attributes* own, vtkMultiBlockDataSet* root, vtkDataObject*)
      {
        own->SetBlockLookupTable(root->GetBlock(0), table(0.5, 0.9));
        own->SetBlockScalarRange(root->GetBlock(0), { 0.3, 0.5 });
      } },
    { "no scalars, and a colour",
      [](Attributes* own, vtkMultiBlockDataSet* root, vtkDataObject*)
      {
        const double red[3] = { 0.9, 0.2, 0.1 };
        own->SetBlockScalarVisibility(root->GetBlock(0), false);
        own->SetBlockColor(root->GetBlock(0), red);
      } },
    { "a colour beside scalars",
      [](Attributes* own, vtkMultiBlockDataSet* root, vtkDataObject* pair)
      {
        const double red[3] = { 0.9, 0.2, 0.1 };
        own->SetBlockColor(root->GetBlock(0), red);
        own->SetBlockColor(pair, red);
      } },
    { "a missing array, in the colour of NaN",
      [](Attributes* own, vtkMultiBlockDataSet* root, vtkDataObject*)
      { own->SetBlockArrayName(root->GetBlock(0), "Nothing"); } },
    { "interpolated before mapping",
      [](Attributes* own, vtkMultiBlockDataSet* root, vtkDataObject*)
      { own->SetBlockInterpolateScalarsBeforeMapping(root->GetBlock(0), true); } },
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 6, 0)
    { "a texture",
      [](Attributes* own, vtkMultiBlockDataSet* root, vtkDataObject*)
      {
        vtkNew<vtkImageData> image;
        image->SetDimensions(2, 2, 1);
        image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
        image->GetPointData()->GetScalars()->Fill(200.0);
        vtkNew<vtkTexture> texture;
        texture->SetInputData(image);
        own->SetBlockTexture(root->GetBlock(0), texture);
      },
      false },
#endif
  };

  Picture plain;
  for (const Case& test : cases)
  {
    Stage stage;
    stage.addGround();
    const auto root = rings();
    vtkNew<CompositeMapper> mapper;
    vtkNew<Attributes> attributes;
    mapper->SetInputDataObject(root);
    mapper->SetCompositeDataDisplayAttributes(attributes);
    mapper->SetColorMissingArraysWithNanColor(true);
    const auto colors = table(0.0, 0.67);
    colors->SetNanColor(1.0, 0.0, 1.0, 1.0);
    mapper->SetLookupTable(colors);
    mapper->SetScalarRange(0.0, 1.0);
    mapper->SetScalarModeToUsePointFieldData();
    mapper->SelectColorArray("Elevation");
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    stage.renderer->AddActor(actor);
    stage.addSun(2.0, -1.5, 4.0);
    if (plain.size() == 0)
    {
      plain = stage.unshadowed();
    }

    // After a frame without them, so that a change is seen as well.
    stage.unshadowed();
    test.set(attributes, root, root->GetBlock(1));
    const Picture traced = stage.unshadowed();
    stage.expectRasterized(checks, test.traced ? 0 : 1,
      std::string(test.name) + ": traced or rasterised as it should be");
    stage.usePass(false);
    const Picture raster = capture(stage.window);
    const Difference change = difference(raster, plain);
    const Difference look = difference(traced, raster, awayFromEdges(raster, 2));
    std::cout << test.name << ": " << look.pixels << " pixels, mean " << look.mean << ", p99 "
              << look.p99 << ", largest " << look.largest << "; from the mapper's own look "
              << change.largest << "\n";
    checks.expect(
      look.mean <= 0.5 && look.p99 <= 4, std::string(test.name) + ": VTK's own picture");
  }
  return checks.exitCode();
}
