// What is kept of unchanged props: after any change a scene is what a fresh collection makes of it,
// and where nothing changes nothing is looked at.
#include "svoKeptProps.h"

#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"

using namespace svotest;

namespace
{
/// Writes something of somebody else's to the keys of a prop, or takes it off.
void touchKeys(vtkProp* prop, bool has)
{
  static auto* key = vtkInformationIntegerKey::MakeKey("TOUCH", "TestSceneCollector");
  if (!prop->GetPropertyKeys())
  {
    prop->SetPropertyKeys(vtkNew<vtkInformation>());
  }
  has ? prop->GetPropertyKeys()->Set(key, 1) : prop->GetPropertyKeys()->Remove(key);
}
}

/// `settings.openGL`.
class KeptBy
  : public KeptProps
  , public testing::WithParamInterface<bool>
{
};

TEST_P(KeptBy, EveryChangeIsNoticed)
{
  settings.openGL = GetParam();
  collect(collector, scene);
  EXPECT_EQ(collector.collectedAnew(), 9);
  EXPECT_EQ(scene.scene.instances.size(), 13u); // wires are none
  collect(collector, scene);
  collect(collector, scene);
  ASSERT_EQ(collector.collectedAnew(), 0);

  const auto property = [&] { return actor->GetProperty(); };
  expectNoticed("a position", 0, [&] { actor->SetPosition(0.0, 1.0, 0.0); });
  expectNoticed("a scale", 0, [&] { actor->SetScale(1.0, -2.0, 1.0); });
  vtkNew<vtkMatrix4x4> matrix;
  expectNoticed("a user matrix", 0, [&] { actor->SetUserMatrix(matrix); });
  expectNoticed("its element", 0, [&] { matrix->SetElement(0, 1, 0.5); });
  expectNoticed("a flat matrix", 1, [&] { actor->SetScale(1.0, 0.0, 1.0); });
  expectNoticed("a matrix again", 1, [&] { actor->SetScale(1.0); });
  expectNoticed("a colour", 1, [&] { smoothActor->GetProperty()->SetColor(1.0, 0.0, 0.0); });
  expectNoticed("another property", 1, [&] { actor->SetProperty(vtkNew<vtkProperty>()); });
  expectNoticed("interpolation", 1, [&] { property()->SetInterpolationToFlat(); });
  expectNoticed("opacity", 1, [&] { property()->SetOpacity(0.5); });
  expectNoticed("no opacity", 1, [&] { property()->SetOpacity(1.0); });
  expectNoticed("forced translucency", 1, [&] { actor->ForceTranslucentOn(); });
  expectNoticed("none", 1, [&] { actor->ForceTranslucentOff(); });
  expectNoticed("a key", 1, [&] { svo::setFlag(actor, svo::castShadowKey(), false); });
  expectNoticed("its value", 1, [&] { svo::setFlag(actor, svo::castShadowKey(), true); });
  expectNoticed("pixel error", 1, [&] { svo::keysOf(actor)->Set(svo::pixelErrorKey(), 3.0); });
  expectNoticed("edges", 1, [&] { property()->EdgeVisibilityOn(); });
  expectNoticed("no edges", 1, [&] { property()->EdgeVisibilityOff(); });

  expectNoticed("no scalars", 1, [&] { plain->ScalarVisibilityOff(); });
  expectNoticed("scalars", 1, [&] { plain->ScalarVisibilityOn(); });
  expectNoticed("their range", 1, [&] { plain->SetScalarRange(0.0, 0.5); });
  expectNoticed("the table", 1,
    [&]
    {
      vtkNew<vtkLookupTable> table;
      table->SetHueRange(0.1, 0.2);
      plain->SetLookupTable(table);
    });
  expectNoticed("its entry", 1,
    [&]
    {
      auto* table = vtkLookupTable::SafeDownCast(plain->GetLookupTable());
      table->SetTableValue(100, 0.0, 0.0, 0.0, 1.0);
      table->Modified();
    });
  expectNoticed("the mesh", 1, [&] { plain->SetInputData(ball(0.5)); });
  expectNoticed("its points", 1,
    [&]
    {
      plain->GetInput()->GetPoints()->SetPoint(7, 0.9, 0.1, 0.2);
      plain->GetInput()->GetPoints()->Modified();
    });
  expectNoticed("its scalars", 1,
    [&]
    {
      plain->GetInput()->GetPointData()->GetScalars()->SetComponent(3, 0, 0.1);
      plain->GetInput()->GetPointData()->GetScalars()->Modified();
    });
  expectNoticed("the mapper", 1,
    [&]
    {
      vtkNew<vtkPolyDataMapper> mapper;
      mapper->SetInputData(copyOf(plain->GetInput()));
      actor->SetMapper(mapper);
    });
  expectNoticed("normals that are converted", 1,
    [&]
    {
      smooth->GetPointData()->GetNormals()->SetComponent(2, 0, 0.7);
      smooth->GetPointData()->GetNormals()->Modified();
    });
  expectNoticed("a source's parameter", 1, [&] { source->SetRadius(0.7); });
  expectNoticed("a source's resolution", 1, [&] { source->SetThetaResolution(20); });

  expectNoticed("a block", 1, [&] { blocks->SetBlock(0, ball(6.5)); });
  auto* inner = vtkMultiBlockDataSet::SafeDownCast(blocks->GetBlock(1));
  expectNoticed("a block below", 1, [&] { inner->SetBlock(0, ball(8.5)); });
  expectNoticed("one more", 1, [&] { inner->SetBlock(1, ball(9.5)); });
  expectNoticed("points of a block", 1,
    [&]
    {
      auto* mesh = vtkPolyData::SafeDownCast(inner->GetBlock(1));
      mesh->GetPoints()->SetPoint(1, 9.0, 0.0, 0.3);
      mesh->GetPoints()->Modified();
    });
  expectNoticed("a block's colour", 1,
    [&]
    {
      const double red[3] = { 1.0, 0.0, 0.0 };
      attributes->SetBlockColor(inner->GetBlock(0), red);
      attributes->Modified();
    });
  expectNoticed("a hidden block", 1,
    [&]
    {
      attributes->SetBlockVisibility(inner->GetBlock(1), false);
      attributes->Modified();
    });

  expectNoticed("a grid", 1, [&] { image->SetSpacing(1.0, 2.0, 1.0); });
  expectNoticed("its scalars", 1,
    [&]
    {
      image->GetPointData()->GetScalars()->Fill(0.9);
      image->GetPointData()->GetScalars()->Modified();
    });

  expectNoticed("a part of an assembly", 1, [&] { part->SetPosition(0.0, 0.0, 2.0); });
  expectNoticed("an assembly", 1, [&] { assembly->RotateZ(20.0); });
  expectNoticed("a hidden part", 1, [&] { part->VisibilityOff(); });
  expectNoticed("a part again", 1, [&] { part->VisibilityOn(); });
  expectNoticed("its look", 1, [&] { part->GetProperty()->SetSpecular(0.4); });
  expectNoticed("another part", 1,
    [&]
    {
      vtkNew<vtkActor> other;
      other->SetMapper(smoothMapper);
      other->SetPosition(0.0, 3.0, 3.0);
      assembly->AddPart(other);
    });
  expectNoticed("a rasterised receiver's place", 1, [&] { wires->SetPosition(1.0, 0.0, 0.0); });
  expectNoticed("a texture's alpha", 1,
    [&]
    {
      texels->GetPointData()->GetScalars()->SetComponent(1, 3, 90);
      texels->GetPointData()->GetScalars()->Modified();
      texels->Modified();
    });
  expectNoticed("no texture", 1, [&] { textured->SetTexture(nullptr); });
}

INSTANTIATE_TEST_SUITE_P(Backends, KeptBy, testing::Bool());

TEST_F(KeptProps, WhatIsAroundThePropsIsNoticed)
{
  collect(collector, scene);
  collect(collector, scene);
  expectNoticed("the camera", 0, [&] { renderer->GetActiveCamera()->SetPosition(0.0, -3.0, 1.0); });
  expectNoticed("a light", 0, [&] { light->SetPosition(-3.0, 0.0, 9.0); });
  expectNoticed("no light", 9, [&] { light->SwitchOff(); });
  expectNoticed("a light again", 9, [&] { light->SwitchOn(); });
  expectNoticed("a level", 0, [&] { options.level = 7; });
  expectNoticed("no conversion", 0, [&] { options.convert = false; });
  expectNoticed("conversion", 0, [&] { options.convert = true; });
  expectNoticed("a hidden prop", 0, [&] { smoothActor->VisibilityOff(); });
  expectNoticed("a prop again", 1, [&] { smoothActor->VisibilityOn(); });
  expectNoticed("a prop that is gone", 0, [&] { renderer->RemoveActor(actor); });
  expectNoticed("and back, as the last", 1, [&] { renderer->AddActor(actor); });
  store.release();
  expectNoticed("octrees that were freed", 0, [] {});
  collector.forget();
  scene = CollectedScene();
  expectNoticed("what was forgotten", 9, [] {});
}

TEST_F(KeptProps, AnEyeThatNeedsNoOtherOctreesLeavesTheInstances)
{
  collect(collector, scene);
  collect(collector, scene);
  const std::uint64_t version = scene.scene.version;
  for (int i = 0; i < 5; ++i)
  {
    renderer->GetActiveCamera()->Azimuth(1e-3);
    collect(collector, scene);
    EXPECT_EQ(changed, 0u);
    EXPECT_EQ(scene.scene.version, version);
  }
  actor->SetPosition(0.0, 0.5, 0.0);
  collect(collector, scene);
  EXPECT_EQ(changed, 1u); // and no other
  EXPECT_NE(scene.scene.version, version);
}

TEST_F(KeptProps, WhatIsMadeOfPropsThatWereNotChosenIsNoticed)
{
  collect(collector, scene);
  collect(collector, scene);
  expectNoticed("only chosen props", 9, [&] { settings.onlyMarked = true; });
  EXPECT_TRUE(scene.scene.instances.empty());
  EXPECT_FALSE(scene.reasons.empty());
  expectNoticed("others cast", 9, [&] { settings.unmarkedToo = true; });
  EXPECT_FALSE(scene.scene.instances.empty());
  expectNoticed("in other words", 9, [&] { settings.notMarked = "is somebody else's"; });
  const std::size_t before = scene.reasons.size();
  expectNoticed("one is chosen", 1, [&] { svo::setFlag(wires, svo::useSVOKey(), true); });
  EXPECT_EQ(scene.reasons.size(), before); // of wires there is one as before
  EXPECT_FALSE(scene.shadowCatchers);
  expectNoticed("a catcher", 1, [&] { svo::setFlag(actor, svo::shadowCatcherKey(), true); });
  EXPECT_TRUE(scene.shadowCatchers);
  expectNoticed("none", 1, [&] { svo::setFlag(actor, svo::shadowCatcherKey(), false); });
  EXPECT_FALSE(scene.shadowCatchers);
  expectNoticed("all props", 9, [&] { settings.onlyMarked = false; });
  EXPECT_TRUE(scene.reasons.empty());
}

/// VTK's convention has it that arrays are modified; what crashes otherwise must not.
TEST_F(KeptProps, ArraysThatHaveMovedAreNotRead)
{
  collect(collector, scene);
  collect(collector, scene);
  auto* normals = plain->GetInput()->GetPointData()->GetNormals();
  const vtkMTimeType before = plain->GetInput()->GetMTime();
  normals->Resize(100000);
  ASSERT_EQ(plain->GetInput()->GetMTime(), before);
  expectNoticed("an array that lies elsewhere", 1, [] {});
}

/// The allocator gives a place at once to what asks for as much next.
TEST_F(KeptProps, AnotherPropInTheSamePlaceIsAnotherProp)
{
  collect(collector, scene);
  for (int i = 0; i < 20; ++i)
  {
    renderer->RemoveAllViewProps();
    vtkSmartPointer<vtkProp> one;
    if (i % 2 == 0)
    {
      auto ball = vtkSmartPointer<vtkActor>::New();
      ball->SetMapper(smoothMapper);
      one = ball;
    }
    else
    {
      one = vtkSmartPointer<vtkAssembly>::New();
    }
    renderer->AddViewProp(one);
    one = nullptr;
    collect(collector, scene);
    EXPECT_EQ(scene.scene.instances.size(), i % 2 == 0 ? 1u : 0u);
  }
}

TEST_F(KeptProps, WhatSaysNothingNewIsNoChange)
{
  const std::string reason = "was not chosen", sameReason = reason;
  settings.notMarked = reason.c_str();
  touchKeys(actor, true);
  collect(collector, scene);
  collect(collector, scene);
  settings.notMarked = sameReason.c_str();
  touchKeys(actor, false); // as VTK's render passes do in every frame
  touchKeys(glyphActor, true);
  touchKeys(assembly, true);
  collect(collector, scene);
  EXPECT_EQ(collector.collectedAnew(), 0);
  svo::setFlag(assembly, svo::receiveShadowKey(), false);
  svo::keysOf(actor)->Set(svo::pixelErrorKey(), 3.0);
  collect(collector, scene);
  EXPECT_EQ(collector.collectedAnew(), 2);
}
