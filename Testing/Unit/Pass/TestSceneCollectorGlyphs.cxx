// The same of glyphs.
#include "svoKeptProps.h"

#include <vector>

using namespace svotest;

TEST_F(KeptProps, EveryChangeOfGlyphsIsNoticed)
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

TEST_F(KeptProps, AMovedActorOfGlyphsComputesNoCopies)
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

TEST_F(KeptProps, CopiesShareOneBodyThatIsWrittenOnce)
{
  const auto copies = [this]
  {
    std::vector<const Instance*> found;
    for (std::size_t i = 0; i < scene.scene.instances.size(); ++i)
    {
      if (scene.meshes[i] == shape)
      {
        found.push_back(&scene.scene.instances[i]);
      }
    }
    return found;
  };
  const auto expectOneBody = [&](int level)
  {
    ASSERT_EQ(copies().size(), 5u);
    for (const Instance* one : copies())
    {
      EXPECT_TRUE(one->body.same(copies()[0]->body));
      EXPECT_EQ(one->body->octree.level(), level);
    }
  };
  options.level = 4; // as deep as they are needed
  collect(collector, scene);
  expectOneBody(4);
  const svo::Shared<svo::Body> first = copies()[0]->body;
  for (std::size_t i = 0; i < scene.scene.instances.size(); ++i)
  {
    EXPECT_EQ(scene.scene.instances[i].body.same(first), scene.meshes[i] == shape);
  }

  // What somebody has copied stays as it was.
  options.level = 3;
  collect(collector, scene);
  expectOneBody(3);
  EXPECT_EQ(first->octree.level(), 4);
  EXPECT_FALSE(first.same(copies()[0]->body));

  // Else all have another octree where the first one was.
  const svo::Body* const body = &*copies()[0]->body;
  options.level = 2;
  collect(collector, scene);
  expectOneBody(2);
  EXPECT_EQ(body, &*copies()[0]->body);
}
