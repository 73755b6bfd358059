// What is kept of unchanged props: after any change a scene is what a fresh collection makes of it,
// and where nothing changes nothing is looked at.
#include "svoCameraView.h"
#include "svoPropKeys.h"
#include "svoSceneCollector.h"

#include "vtkActor.h"
#include "vtkAssembly.h"
#include "vtkBitArray.h"
#include "vtkCamera.h"
#include "vtkCellData.h"
#include "vtkCompositeDataDisplayAttributes.h"
#include "vtkCubeSource.h"
#include "vtkDataSetMapper.h"
#include "vtkDoubleArray.h"
#include "vtkElevationFilter.h"
#include "vtkFloatArray.h"
#include "vtkGlyph3DMapper.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLookupTable.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkTexture.h"
#include "vtkVersion.h"

#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
#include "vtkCompositePolyDataMapper.h"
using CompositeMapper = vtkCompositePolyDataMapper;
#else
#include "vtkCompositePolyDataMapper2.h"
using CompositeMapper = vtkCompositePolyDataMapper2;
#endif

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace
{
using svo::CollectedScene;
using svo::Instance;

vtkSmartPointer<vtkPolyData> ball(double x)
{
  vtkNew<vtkSphereSource> source;
  source->SetCenter(x, 0.0, 0.0);
  vtkNew<vtkElevationFilter> colors;
  colors->SetInputConnection(source->GetOutputPort());
  colors->Update();
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->DeepCopy(colors->GetOutput());
  return mesh;
}

vtkSmartPointer<vtkPolyData> copyOf(vtkPolyData* mesh)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->DeepCopy(mesh);
  return copy;
}

/// Points with what glyphs need.
vtkSmartPointer<vtkPolyData> places(int count)
{
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> size;
  size->SetName("size");
  for (int i = 0; i < count; ++i)
  {
    points->InsertNextPoint(2.0 * i, 5.0, 0.0);
    size->InsertNextValue(0.5f + 0.1f * static_cast<float>(i));
  }
  mesh->SetPoints(points);
  mesh->GetPointData()->SetScalars(size);
  return mesh;
}

/// A renderer with a prop of each kind, and a collector that sees it change.
class Kept : public ::testing::Test
{
protected:
  Kept()
    : tracer(svo::makeCPUTracer())
  {
    this->options.level = 6;
    this->light->SetLightTypeToSceneLight();
    this->light->SetPosition(3.0, 4.0, 5.0);
    this->renderer->AddLight(this->light);
    this->renderer->GetActiveCamera()->SetPosition(0.0, -20.0, 10.0);
    this->renderer->GetActiveCamera()->SetClippingRange(1.0, 100.0);

    this->plain->SetInputData(ball(0.0));
    this->plain->SetScalarRange(0.0, 1.0);
    this->show(this->actor, this->plain);

    // Normals that are no floats.
    vtkNew<vtkDoubleArray> normals;
    normals->DeepCopy(this->smooth->GetPointData()->GetNormals());
    this->smooth->GetPointData()->SetNormals(normals);
    this->smoothMapper->SetInputData(this->smooth);
    this->smoothMapper->ScalarVisibilityOff();
    this->show(this->smoothActor, this->smoothMapper);

    vtkNew<vtkPolyDataMapper> ofSource;
    ofSource->SetInputConnection(this->source->GetOutputPort());
    this->show(this->filtered, ofSource);

    this->blocks->SetBlock(0, ball(6.0));
    vtkNew<vtkMultiBlockDataSet> inner;
    inner->SetBlock(0, ball(8.0));
    this->blocks->SetBlock(1, inner);
    this->composite->SetInputDataObject(this->blocks);
    this->composite->SetCompositeDataDisplayAttributes(this->attributes);
    this->show(this->blockActor, this->composite);

    this->image->SetDimensions(3, 3, 3);
    this->image->AllocateScalars(VTK_FLOAT, 1);
    this->image->GetPointData()->GetScalars()->Fill(0.3);
    this->grid->SetInputData(this->image);
    this->show(this->gridActor, this->grid);

    this->glyphs->SetInputData(this->points);
    this->glyphs->SetSourceData(this->shape);
    this->show(this->glyphActor, this->glyphs);

    vtkNew<vtkPolyDataMapper> ofPart;
    ofPart->SetInputData(ball(12.0));
    this->part->SetMapper(ofPart);
    this->assembly->AddPart(this->part);
    this->renderer->AddViewProp(this->assembly);

    vtkNew<vtkPolyDataMapper> ofWires;
    ofWires->SetInputData(ball(14.0));
    this->show(this->wires, ofWires);
    this->wires->GetProperty()->SetRepresentationToWireframe();

    this->texels->SetDimensions(2, 2, 1);
    this->texels->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
    this->texels->GetPointData()->GetScalars()->Fill(255);
    this->texture->SetInputData(this->texels);
    this->plane->Update();
    vtkNew<vtkPolyDataMapper> ofPlane;
    ofPlane->SetInputConnection(this->plane->GetOutputPort());
    this->show(this->textured, ofPlane);
    this->textured->SetTexture(this->texture);
  }

  void show(vtkActor* one, vtkMapper* mapper)
  {
    one->SetMapper(mapper);
    this->renderer->AddActor(one);
  }

  void collect(svo::SceneCollector& collector, CollectedScene& scene)
  {
    svo::CollectSettings settings;
    settings.levels.tracer = this->tracer.get();
    ASSERT_TRUE(svo::viewOfCamera(this->renderer, 300, 200, settings.levels.eye));
    collector.collect(this->renderer, this->store, this->options, settings, scene);
    this->store.endFrame(std::size_t(1) << 30);
  }

  /// Both have the same, at the same places or with the same values.
  static void expectSame(const CollectedScene& a, const CollectedScene& b, const std::string& what)
  {
    ASSERT_EQ(a.scene.instances.size(), b.scene.instances.size()) << what;
    EXPECT_EQ(a.replaced, b.replaced) << what;
    EXPECT_EQ(a.meshes.size(), b.meshes.size()) << what;
    EXPECT_EQ(a.rasterizedReceivers, b.rasterizedReceivers) << what;
    EXPECT_EQ(a.tracedActors, b.tracedActors) << what;
    EXPECT_EQ(a.rasterizedActors, b.rasterizedActors) << what;
    ASSERT_EQ(a.scene.receivers.size(), b.scene.receivers.size()) << what;
    for (std::size_t i = 0; i < a.scene.receivers.size(); ++i)
    {
      EXPECT_EQ(a.scene.receivers[i].low, b.scene.receivers[i].low) << what;
      EXPECT_EQ(a.scene.receivers[i].high, b.scene.receivers[i].high) << what;
    }
    for (std::size_t i = 0; i < a.scene.instances.size(); ++i)
    {
      const std::string which = what + ", instance " + std::to_string(i);
      const Instance &x = a.scene.instances[i], &y = b.scene.instances[i];
      const auto octrees = [](const Instance& n)
      {
        return std::make_tuple(n.octree.key(), n.casterOctree.key(), n.leafGeometry, n.neededLevel,
          n.box.low, n.box.high, n.triangles, n.deepestLevel, n.detailLevel);
      };
      const auto places = [](const Instance& n)
      { return std::make_tuple(n.localToWorld, n.id, n.depthOffsetUnits, n.givesWay); };
      const auto ways = [](const Instance& n)
      { return std::make_tuple(n.visible, n.castShadow, n.receiveShadow, n.pixelError); };
      const auto looks = [](const Instance& n)
      {
        const svo::Material& m = n.material;
        const svo::Attributes& at = n.attributes;
        return std::make_tuple(m.ambientColor, m.diffuseColor, m.specularColor, m.ambient,
          m.diffuse, m.specular, m.specularPower, m.lighting, m.flat, m.flatPlanes,
          at.normalAssociation, at.colorAssociation, at.colorTextureSize, n.points.count);
      };
      EXPECT_TRUE(octrees(x) == octrees(y)) << which;
      EXPECT_TRUE(places(x) == places(y)) << which;
      EXPECT_TRUE(ways(x) == ways(y)) << which;
      EXPECT_TRUE(looks(x) == looks(y)) << which;
      vtkPolyData* mesh = b.meshes[i];
      const auto same = [&](const auto* p, const auto* q, svo::Association of, int components)
      {
        const auto count = static_cast<std::size_t>(
          of == svo::Association::Cell ? mesh->GetNumberOfCells() : mesh->GetNumberOfPoints());
        return (!p && !q) || (p && q && std::memcmp(p, q, sizeof(*p) * count * components) == 0);
      };
      const svo::Attributes &p = x.attributes, &q = y.attributes;
      EXPECT_TRUE(same(x.points.floats, y.points.floats, svo::Association::Point, 3)) << which;
      EXPECT_TRUE(same(p.normals, q.normals, q.normalAssociation, 3)) << which;
      EXPECT_TRUE(same(p.colors, q.colors, q.colorAssociation, 4)) << which;
    }
  }

  /// After a change, which `anew` props or more have to be looked at for.
  void expectNoticed(const std::string& what, int anew, const std::function<void()>& change)
  {
    change();
    this->collect(this->collector, this->scene);
    EXPECT_GE(this->collector.collectedAnew(), anew) << what;
    EXPECT_LE(this->collector.collectedAnew(), anew + 1) << what;
    svo::SceneCollector fresh;
    CollectedScene other;
    this->collect(fresh, other);
    expectSame(this->scene, other, what);
    // What is mapped anew may change a lookup table once.
    this->collect(this->collector, this->scene);
    this->collect(this->collector, this->scene);
    EXPECT_EQ(this->collector.collectedAnew(), 0) << what;
    expectSame(this->scene, other, what + ", once more");
  }

  std::unique_ptr<svo::Tracer> tracer;
  svo::OctreeStore store;
  svo::StoreOptions options;
  svo::SceneCollector collector;
  CollectedScene scene;

  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkLight> light;
  vtkNew<vtkActor> actor, smoothActor, filtered, blockActor, gridActor, glyphActor, part, wires,
    textured;
  vtkNew<vtkPolyDataMapper> plain, smoothMapper;
  vtkNew<CompositeMapper> composite;
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  vtkNew<vtkDataSetMapper> grid;
  vtkNew<vtkGlyph3DMapper> glyphs;
  vtkSmartPointer<vtkPolyData> smooth = ball(2.0);
  vtkSmartPointer<vtkPolyData> points = places(5), shape = ball(0.0);
  vtkNew<vtkMultiBlockDataSet> blocks;
  vtkNew<vtkImageData> image, texels;
  vtkNew<vtkTexture> texture;
  vtkNew<vtkSphereSource> source;
  vtkNew<vtkPlaneSource> plane;
  vtkNew<vtkAssembly> assembly;
};
}

TEST_F(Kept, EveryChangeIsNoticed)
{
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
  expectNoticed("pixel error", 1, [&] { svo::setPixelError(actor, 3.0); });
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

TEST_F(Kept, EveryChangeOfGlyphsIsNoticed)
{
  collect(collector, scene);
  collect(collector, scene);
  expectNoticed("the actor's place", 0, [&] { glyphActor->SetPosition(0.0, 1.0, 0.0); });
  expectNoticed("factor", 1, [&] { glyphs->SetScaleFactor(0.8); });
  expectNoticed("sizes", 1, [&] { glyphs->SetScaleModeToScaleByMagnitude(); });
  expectNoticed("a size", 1,
    [&]
    {
      points->GetPointData()->GetScalars()->SetComponent(1, 0, 2.0);
      points->GetPointData()->GetScalars()->Modified();
    });
  expectNoticed("a point", 1,
    [&]
    {
      points->GetPoints()->SetPoint(2, 1.0, 1.0, 1.0);
      points->GetPoints()->Modified();
    });
  expectNoticed("one more point", 1,
    [&]
    {
      points->GetPoints()->InsertNextPoint(3.0, 3.0, 3.0);
      points->GetPointData()->GetScalars()->InsertComponent(5, 0, 1.0);
      points->GetPoints()->Modified();
      points->Modified();
    });
  expectNoticed("a range of colours", 1, [&] { glyphs->SetScalarRange(0.0, 3.0); });
  expectNoticed("no colours", 1, [&] { glyphs->ScalarVisibilityOff(); });
  expectNoticed("a colour", 1, [&] { glyphActor->GetProperty()->SetColor(0.1, 0.5, 0.9); });
  expectNoticed("points of the source", 1,
    [&]
    {
      shape->GetPoints()->SetPoint(3, 0.0, 0.0, 1.5);
      shape->GetPoints()->Modified();
    });
  expectNoticed("another source", 1, [&] { glyphs->SetSourceData(ball(0.4)); });
  expectNoticed(
    "a source from a pipeline", 1, [&] { glyphs->SetSourceConnection(source->GetOutputPort()); });
  expectNoticed("which changes, as an actor's does", 2, [&] { source->SetRadius(0.4); });
  vtkNew<vtkMultiBlockDataSet> table;
  vtkNew<vtkMultiBlockDataSet> pair;
  pair->SetBlock(0, ball(0.1));
  table->SetBlock(0, pair);
  expectNoticed("a tree of sources", 1,
    [&]
    {
      glyphs->SetSourceTableTree(table);
      glyphs->UseSourceTableTreeOn();
    });
  expectNoticed("one more in it", 1, [&] { pair->SetBlock(1, ball(0.9)); });
  vtkNew<vtkMultiBlockDataSet> inputs;
  inputs->SetBlock(0, places(3));
  expectNoticed("blocks", 1, [&] { glyphs->SetInputDataObject(inputs); });
  expectNoticed("one more block", 1, [&] { inputs->SetBlock(1, places(4)); });
  vtkNew<vtkCompositeDataDisplayAttributes> ofBlocks;
  glyphs->SetBlockAttributes(ofBlocks);
  expectNoticed("a hidden block", 1,
    [&]
    {
      ofBlocks->SetBlockVisibility(inputs->GetBlock(0), false);
      ofBlocks->Modified();
    });
}

TEST_F(Kept, WhatIsAroundThePropsIsNoticed)
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

/// VTK's convention has it that arrays are modified; what crashes otherwise must not.
TEST_F(Kept, ArraysThatHaveMovedAreNotRead)
{
  collect(collector, scene);
  collect(collector, scene);
  auto* normals = plain->GetInput()->GetPointData()->GetNormals();
  const vtkMTimeType before = plain->GetInput()->GetMTime();
  normals->Resize(100000);
  ASSERT_EQ(plain->GetInput()->GetMTime(), before);
  expectNoticed("an array that lies elsewhere", 1, [] {});
}

TEST_F(Kept, AMovedActorOfGlyphsComputesNoCopies)
{
  collect(collector, scene);
  collect(collector, scene);
  glyphActor->SetPosition(0.0, 0.0, 4.0);
  const std::vector<Instance> before = scene.scene.instances;
  collect(collector, scene);
  EXPECT_EQ(collector.collectedAnew(), 0);
  int moved = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
  {
    moved += before[i].localToWorld != scene.scene.instances[i].localToWorld;
  }
  EXPECT_EQ(moved, 5);
}

/// The allocator gives a place at once to what asks for as much next.
TEST_F(Kept, AnotherPropInTheSamePlaceIsAnotherProp)
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
