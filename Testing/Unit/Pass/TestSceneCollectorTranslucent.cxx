// What translucent surfaces become: instances that only cast, as opaque as the surface is.
#include "svoKeptProps.h"

#include "vtkCell.h"
#include "vtkUnsignedCharArray.h"

using namespace svotest;

namespace
{
/// Three colours with these alphas, for the values that a ball has.
vtkSmartPointer<vtkLookupTable> tableOf(double low, double middle, double high)
{
  auto table = vtkSmartPointer<vtkLookupTable>::New();
  table->SetNumberOfTableValues(3);
  table->SetTableValue(0, 1.0, 0.0, 0.0, low);
  table->SetTableValue(1, 0.0, 1.0, 0.0, middle);
  table->SetTableValue(2, 0.0, 0.0, 1.0, high);
  table->SetTableRange(0.0, 0.5);
  return table;
}

class Translucent : public KeptProps
{
protected:
  Translucent() { this->settings.translucentShadows = true; }

  /// The instances that `actor` has, whose mesh is a ball around the origin.
  std::vector<const Instance*> instances(std::vector<vtkPolyData*>* meshes = nullptr)
  {
    this->collect(this->collector, this->scene);
    std::vector<const Instance*> found;
    for (std::size_t i = 0; i < this->scene.scene.instances.size(); ++i)
    {
      const Instance& one = this->scene.scene.instances[i];
      vtkPolyData* mesh = this->scene.meshes[i];
      if (mesh->GetPoints() == this->plain->GetInput()->GetPoints())
      {
        found.push_back(&one);
        if (meshes)
        {
          meshes->push_back(mesh);
        }
      }
    }
    return found;
  }
};
}

TEST_F(Translucent, AnOpacityIsTheInstances)
{
  actor->GetProperty()->SetOpacity(0.4);
  std::vector<const Instance*> found = instances();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FLOAT_EQ(found[0]->opacity, 0.4f);
  EXPECT_FALSE(found[0]->mappedOpacity);
  EXPECT_TRUE(found[0]->translucent() && found[0]->castShadow && !found[0]->visible);
  const std::uint64_t id = found[0]->id;
  expectNoticed("another opacity", 1, [&] { actor->GetProperty()->SetOpacity(0.5); });
  found = instances();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FLOAT_EQ(found[0]->opacity, 0.5f);
  EXPECT_EQ(found[0]->id, id); // its layers can be kept
  expectNoticed("opaque", 1, [&] { actor->GetProperty()->SetOpacity(1.0); });
  found = instances();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(found[0]->translucent());
  EXPECT_TRUE(found[0]->visible);
  expectNoticed("forced to be translucent", 1, [&] { actor->ForceTranslucentOn(); });
  found = instances();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(!found[0]->translucent() && found[0]->castShadow && !found[0]->visible);
  expectNoticed("invisible", 1, [&] { actor->GetProperty()->SetOpacity(0.0); });
  EXPECT_TRUE(instances().empty());
}

TEST_F(Translucent, ColoursWithAlphaCastBesideTheOpaqueCells)
{
  plain->SetLookupTable(tableOf(0.5, 0.5, 0.5));
  plain->UseLookupTableScalarRangeOn();
  std::vector<vtkPolyData*> meshes;
  std::vector<const Instance*> found = instances(&meshes);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0]->mappedOpacity && found[0]->opacity == 1.0f);
  EXPECT_EQ(meshes[0], plain->GetInput()); // one octree for all looks of it

  // Some cells of each kind.
  expectNoticed("three kinds", 1, [&] { plain->SetLookupTable(tableOf(0.0, 0.5, 1.0)); });
  meshes.clear();
  found = instances(&meshes);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NE(found[0]->id, found[1]->id);
  EXPECT_FALSE(found[0]->translucent());
  EXPECT_TRUE(found[1]->mappedOpacity);
  const vtkIdType cells = plain->GetInput()->GetNumberOfCells();
  EXPECT_LT(meshes[0]->GetNumberOfCells(), cells);
  ASSERT_EQ(meshes[1]->GetNumberOfCells(), cells); // numbers are those of the colours
  EXPECT_NE(found[1]->body->attributes.colors, nullptr);
  vtkIdType invisible = 0;
  for (vtkIdType i = 0; i < cells; ++i)
  {
    const double* b = meshes[1]->GetCell(i)->GetBounds();
    invisible += b[0] == b[1] && b[2] == b[3] && b[4] == b[5] ? 1 : 0;
  }
  EXPECT_GT(invisible, 0);
  EXPECT_LT(invisible, cells - meshes[0]->GetNumberOfCells());

  expectNoticed("an opacity besides", 1, [&] { actor->GetProperty()->SetOpacity(0.3); });
  found = instances();
  ASSERT_EQ(found.size(), 1u); // nothing is opaque
  EXPECT_TRUE(found[0]->mappedOpacity);
  EXPECT_FLOAT_EQ(found[0]->opacity, 0.3f);

  expectNoticed("one opacity for all", 9, [&] { settings.meanOpacity = true; });
  found = instances();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(found[0]->mappedOpacity);
  EXPECT_GT(found[0]->opacity, 0.3f * 0.5f);
  EXPECT_LT(found[0]->opacity, 0.3f);

  expectNoticed("switched off", 9, [&] { settings.translucentShadows = false; });
  EXPECT_TRUE(instances().empty());
  expectNoticed("and the opacity", 1, [&] { actor->GetProperty()->SetOpacity(1.0); });
  found = instances();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(found[0]->translucent());
}

TEST_F(Translucent, WhoIsToldToCastsLikeAnOpaqueOne)
{
  actor->GetProperty()->SetOpacity(0.4);
  svo::setFlag(actor, svo::castShadowKey(), true);
  std::vector<const Instance*> found = instances();
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(found[0]->translucent());
  svo::setFlag(actor, svo::castShadowKey(), false);
  EXPECT_TRUE(instances().empty());
}

TEST_F(Translucent, CopiesHaveTheAlphaOfTheirColours)
{
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(4);
  for (const int alpha : { 0, 51, 255, 102, 255 })
  {
    colors->InsertNextTuple4(200, 100, 50, alpha);
  }
  points->GetPointData()->SetScalars(colors);
  glyphs->SetColorModeToDirectScalars();
  glyphs->ScalingOff();
  collect(collector, scene);
  std::vector<float> opacities;
  for (std::size_t i = 0; i < scene.scene.instances.size(); ++i)
  {
    if (scene.meshes[i] == shape)
    {
      opacities.push_back(scene.scene.instances[i].opacity);
    }
  }
  EXPECT_EQ(opacities, (std::vector<float>{ 1.0f, 1.0f, 0.2f, 0.4f }));
}
