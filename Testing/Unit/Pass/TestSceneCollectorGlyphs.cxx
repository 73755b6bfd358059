// The same of glyphs.
#include "svoKeptProps.h"

using namespace svotest;

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
