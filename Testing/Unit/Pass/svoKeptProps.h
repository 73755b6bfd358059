// A renderer with a prop of each kind, and a collector that keeps what does not change of them.
#ifndef svoKeptProps_h
#define svoKeptProps_h

#include "svoCameraView.h"
#include "svoPropKeys.h"
#include "svoSceneCollector.h"
#include "svoSceneVersions.h"

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

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace svotest
{
using svo::CollectedScene;
using svo::Instance;

/// With point scalars.
inline vtkSmartPointer<vtkPolyData> ball(double x)
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

inline vtkSmartPointer<vtkPolyData> copyOf(vtkPolyData* mesh)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->DeepCopy(mesh);
  return copy;
}

/// Points with what glyphs need.
inline vtkSmartPointer<vtkPolyData> places(int count)
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
class KeptProps : public ::testing::Test
{
protected:
  KeptProps()
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
    this->settings.levels.tracer = this->tracer.get();
    ASSERT_TRUE(svo::viewOfCamera(this->renderer, 300, 200, this->settings.levels.eye));
    const Versions before(scene);
    collector.collect(this->renderer, this->store, this->options, this->settings, scene);
    this->store.endFrame(std::size_t(1) << 30);
    this->changed = Versions(scene).changesSince(before);
  }

  /// What a scene said of its instances, and what they were.
  struct Versions
  {
    explicit Versions(const CollectedScene& collected)
      : scene(collected.scene.version)
    {
      for (const Instance& instance : collected.scene.instances)
      {
        this->instances.emplace_back(instance.version, bytesOf(instance));
      }
    }
    /// How many instances have another version, or are no more. Where one differs it has to have.
    std::size_t changesSince(const Versions& before) const
    {
      const std::size_t both = std::min(this->instances.size(), before.instances.size());
      std::size_t changes = std::max(this->instances.size(), before.instances.size()) - both;
      for (std::size_t i = 0; i < both; ++i)
      {
        const bool another = this->instances[i].first != before.instances[i].first;
        EXPECT_NE(this->instances[i].first, 0u);
        EXPECT_TRUE(another || this->instances[i].second == before.instances[i].second) << i;
        changes += another;
      }
      EXPECT_TRUE(changes == 0 || this->scene != before.scene);
      return changes;
    }
    std::uint64_t scene;
    std::vector<std::pair<std::uint64_t, std::vector<unsigned char>>> instances;
  };

  /// Both have the same, at the same places or with the same values.
  static void expectSame(const CollectedScene& a, const CollectedScene& b, const std::string& what)
  {
    ASSERT_EQ(a.scene.instances.size(), b.scene.instances.size()) << what;
    EXPECT_EQ(a.replaced, b.replaced) << what;
    EXPECT_EQ(a.meshes.size(), b.meshes.size()) << what;
    EXPECT_EQ(a.rasterizedReceivers, b.rasterizedReceivers) << what;
    EXPECT_EQ(a.tracedActors, b.tracedActors) << what;
    EXPECT_EQ(a.rasterizedActors, b.rasterizedActors) << what;
    EXPECT_EQ(a.shadowCatchers, b.shadowCatchers) << what;
    EXPECT_EQ(a.reasons, b.reasons) << what;
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
        return std::make_tuple(n.body->octree.key(), n.body->casterOctree.key(),
          n.body->leafGeometry, n.body->neededLevel, n.body->box.low, n.body->box.high,
          n.body->triangles, n.body->deepestLevel, n.body->detailLevel);
      };
      const auto places = [](const Instance& n)
      {
        return std::make_tuple(
          n.localToWorld, n.id, n.depthOffset.units, n.depthOffset.factor, n.coincidentOrder);
      };
      const auto ways = [](const Instance& n)
      {
        return std::make_tuple(
          n.visible, n.castShadow, n.receiveShadow, n.pixelError, n.opacity, n.mappedOpacity);
      };
      const auto looks = [](const Instance& n)
      {
        const svo::Material& m = n.material;
        const svo::Attributes& at = n.body->attributes;
        return std::make_tuple(m.ambientColor, m.diffuseColor, m.specularColor, m.ambient,
          m.diffuse, m.specular, m.specularPower, m.lighting, m.flat, m.flatPlanes,
          at.normalAssociation, at.colorAssociation, at.colorTextureSize, n.body->points.count);
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
      const svo::Attributes &p = x.body->attributes, &q = y.body->attributes;
      EXPECT_TRUE(same(x.body->points.floats, y.body->points.floats, svo::Association::Point, 3))
        << which;
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
    EXPECT_EQ(this->changed, 0u) << what;
    expectSame(this->scene, other, what + ", once more");
  }

  std::unique_ptr<svo::Tracer> tracer;
  svo::OctreeStore store;
  svo::StoreOptions options;
  svo::CollectSettings settings;
  svo::SceneCollector collector;
  CollectedScene scene;
  std::size_t changed = 0; // instances that the last collect() said to be others

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

#endif
