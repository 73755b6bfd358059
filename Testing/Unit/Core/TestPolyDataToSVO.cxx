// The conversion filter in a pipeline: the mesh passes through, poses are built once.
#include "svoAbort.h"
#include "svoConversion.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCompositeDataPipeline.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace
{
/// An animated sphere: time steps 0, 1, 2, 3, a radius each. A new object every time, like a
/// reader.
class PosesSource : public vtkPolyDataAlgorithm
{
public:
  static PosesSource* New() { VTK_STANDARD_NEW_BODY(PosesSource); }
  vtkTypeMacro(PosesSource, vtkPolyDataAlgorithm);

protected:
  PosesSource() { this->SetNumberOfInputPorts(0); }
  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override
  {
    const double steps[4] = { 0, 1, 2, 3 };
    const double range[2] = { 0, 3 };
    vtkInformation* info = outputVector->GetInformationObject(0);
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), steps, 4);
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
    return 1;
  }
  int RequestData(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector) override
  {
    vtkInformation* info = outputVector->GetInformationObject(0);
    const double time = info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
    vtkPolyData* output = vtkPolyData::GetData(outputVector);
    output->ShallowCopy(sphere(1.0 + time));
    output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
    return 1;
  }
};
}

TEST(PolyDataToSVO, HasDocumentedDefaultsAndClampsItsSettings)
{
  vtkNew<vtkPolyDataToSVO> filter;
  EXPECT_EQ(filter->GetMaximumLevel(), 10);
  EXPECT_STREQ(filter->GetLeafGeometryAsString(), "Automatic");
  EXPECT_TRUE(filter->GetBuildOctrees());
  EXPECT_TRUE(filter->GetCacheTimeSteps());
  EXPECT_EQ(filter->GetCacheMemoryLimit(), 1048576u);
  EXPECT_EQ(filter->GetMemoryLimit(), 0u);
  filter->SetMaximumLevel(0);
  EXPECT_EQ(filter->GetMaximumLevel(), 1);
  filter->SetMaximumLevel(99);
  EXPECT_EQ(filter->GetMaximumLevel(), 20);
  filter->SetLeafGeometryToPlane();
  EXPECT_STREQ(filter->GetLeafGeometryAsString(), "Plane");
  std::ostringstream text;
  filter->Print(text);
  EXPECT_NE(text.str().find("LeafGeometry: Plane"), std::string::npos);
}

TEST(PolyDataToSVO, TheMeshPassesThroughWithAnOctree)
{
  const auto mesh = sphere();
  const vtkMTimeType time = mesh->GetMTime();
  const Conversion conversion(mesh, 6);
  vtkPolyData* output = conversion.filter->GetOutput();
  EXPECT_EQ(output->GetPoints(), mesh->GetPoints());
  EXPECT_EQ(output->GetPolys(), mesh->GetPolys());
  EXPECT_EQ(output->GetPointData()->GetNormals(), mesh->GetPointData()->GetNormals());
  EXPECT_EQ(mesh->GetMTime(), time);
  EXPECT_EQ(mesh->GetFieldData()->GetNumberOfArrays(), 0);
  const svo::Octree octree = conversion.octree();
  ASSERT_TRUE(octree);
  EXPECT_EQ(octree.level(), 6);
  EXPECT_EQ(
    conversion.filter->GetNumberOfVoxels(), static_cast<vtkIdType>(octree.header().voxelCount));
  EXPECT_EQ(conversion.filter->GetNumberOfBuilds(), 1);
  EXPECT_GT(conversion.filter->GetBuildTime(), 0.0);
  EXPECT_EQ(conversion.messages.all(), "");
}

TEST(PolyDataToSVO, TheLeafGeometryThatWasAskedForIsInTheOctree)
{
  vtkNew<vtkPolyDataToSVO> filter;
  filter->SetInputData(sphere());
  filter->SetMaximumLevel(3);
  for (int geometry = vtkPolyDataToSVO::VOXEL; geometry <= vtkPolyDataToSVO::AUTOMATIC; ++geometry)
  {
    filter->SetLeafGeometry(geometry);
    filter->Update();
    EXPECT_EQ(
      octreeOf(filter->GetOutput()).header().leafGeometry, static_cast<std::uint32_t>(geometry));
  }
}

TEST(PolyDataToSVO, AnInputThatCarriesAFittingOctreeKeepsIt)
{
  const Conversion first(sphere(), 5);
  const Conversion same(first.filter->GetOutput(), 5);
  EXPECT_EQ(same.filter->GetNumberOfBuilds(), 0);
  EXPECT_EQ(same.octree().key(), first.octree().key());
  EXPECT_EQ(same.filter->GetNumberOfVoxels(), first.filter->GetNumberOfVoxels());
  const Conversion finer(first.filter->GetOutput(), 6);
  EXPECT_EQ(finer.filter->GetNumberOfBuilds(), 1);
  EXPECT_EQ(finer.octree().level(), 6);
  EXPECT_EQ(first.octree().level(), 5);
}

TEST(PolyDataToSVO, EachTimeStepIsBuiltOnce)
{
  vtkNew<PosesSource> source;
  vtkNew<vtkPolyDataToSVO> filter;
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetMaximumLevel(5);
  filter->UpdateInformation();
  EXPECT_EQ(
    filter->GetOutputInformation(0)->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()), 4);
  const void* keys[4] = {};
  for (int loop = 0; loop < 2; ++loop)
  {
    for (int step = 0; step < 4; ++step)
    {
      ASSERT_TRUE(filter->UpdateTimeStep(step));
      EXPECT_EQ(filter->GetOutput()->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), step);
      const svo::Octree octree = octreeOf(filter->GetOutput());
      ASSERT_TRUE(octree);
      EXPECT_EQ(filter->GetBuildTime() > 0.0, loop == 0);
      if (loop == 0)
      {
        keys[step] = octree.key();
      }
      EXPECT_EQ(octree.key(), keys[step]);
    }
    EXPECT_EQ(filter->GetNumberOfBuilds(), 4);
  }
  EXPECT_EQ(filter->GetNumberOfCachedOctrees(), 4);
  EXPECT_GT(filter->GetCacheMemorySize(), 0u);
  filter->ReleaseCache();
  EXPECT_EQ(filter->GetCacheMemorySize(), 0u);
  EXPECT_TRUE(octreeOf(filter->GetOutput())); // outputs keep theirs
}

TEST(PolyDataToSVO, WithoutTheCacheEveryStepIsBuiltAgain)
{
  vtkNew<PosesSource> source;
  vtkNew<vtkPolyDataToSVO> filter;
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetMaximumLevel(4);
  filter->CacheTimeStepsOff();
  for (int step : { 0, 1, 0, 1 })
  {
    filter->UpdateTimeStep(step);
  }
  EXPECT_EQ(filter->GetNumberOfBuilds(), 4);
  EXPECT_EQ(filter->GetNumberOfCachedOctrees(), 0);
}

TEST(PolyDataToSVO, TheLeastRecentlyUsedPoseGoesFirst)
{
  vtkNew<PosesSource> source;
  vtkNew<vtkPolyDataToSVO> filter;
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetMaximumLevel(5);
  filter->UpdateTimeStep(0);
  filter->UpdateTimeStep(1);
  // Room for two poses of this size, not for three.
  const unsigned long two = filter->GetCacheMemorySize();
  filter->SetCacheMemoryLimit(two + two / 4);
  filter->UpdateTimeStep(0); // now 1 is the older one
  EXPECT_EQ(filter->GetNumberOfBuilds(), 2);
  filter->UpdateTimeStep(2);
  EXPECT_EQ(filter->GetNumberOfBuilds(), 3);
  EXPECT_EQ(filter->GetNumberOfCachedOctrees(), 2);
  EXPECT_LE(filter->GetCacheMemorySize(), filter->GetCacheMemoryLimit());
  filter->UpdateTimeStep(0);
  EXPECT_EQ(filter->GetNumberOfBuilds(), 3);
  filter->UpdateTimeStep(1);
  EXPECT_EQ(filter->GetNumberOfBuilds(), 4);
  filter->SetCacheMemoryLimit(1);
  EXPECT_EQ(filter->GetNumberOfCachedOctrees(), 0);
}

TEST(PolyDataToSVO, OfALoopThatIsTooLongAsManyPosesAreKeptAsThereIsRoomFor)
{
  constexpr int Poses = 60;
  vtkNew<vtkPolyDataToSVO> filter;
  filter->SetMaximumLevel(4);
  const auto show = [&filter](int pose)
  {
    filter->SetInputData(sphere(1.0 + 0.01 * pose));
    filter->Update();
  };
  show(0);
  filter->SetCacheMemoryLimit(20 * filter->GetCacheMemorySize());
  for (int loop = 0; loop < 4; ++loop)
  {
    const vtkIdType before = loop == 0 ? 0 : filter->GetNumberOfBuilds();
    for (int pose = 0; pose < Poses; ++pose)
    {
      show(pose);
      EXPECT_LE(filter->GetCacheMemorySize(), filter->GetCacheMemoryLimit());
    }
    EXPECT_LE(filter->GetNumberOfBuilds() - before, loop == 0 ? Poses : Poses - 15) << loop;
  }
}

TEST(PolyDataToSVO, FiltersShareTheirOctrees)
{
  const Conversion first(sphere(), 6);
  const Conversion second(sphere(), 6);
  EXPECT_EQ(first.filter->GetNumberOfBuilds(), 1);
  EXPECT_EQ(second.filter->GetNumberOfBuilds(), 0);
  EXPECT_EQ(second.octree().key(), first.octree().key());
  EXPECT_EQ(second.filter->GetCacheMemorySize(), first.filter->GetCacheMemorySize());
  EXPECT_EQ(second.filter->GetNumberOfVoxels(), first.filter->GetNumberOfVoxels());
}

TEST(PolyDataToSVO, WithoutBuildsAMeshGoesOutWithTheOctreeThatItHadLast)
{
  const auto mesh = sphere();
  vtkNew<vtkPolyDataToSVO> filter;
  filter->SetInputData(mesh);
  for (const int level : { 4, 6, 5 })
  {
    filter->SetMaximumLevel(level);
    filter->Update();
  }
  filter->BuildOctreesOff();
  filter->SetMaximumLevel(7);
  filter->SetLeafGeometryToPlane();
  filter->Update();
  EXPECT_EQ(octreeOf(filter->GetOutput()).level(), 5);
  EXPECT_EQ(filter->GetNumberOfVoxels(),
    static_cast<vtkIdType>(octreeOf(filter->GetOutput()).header().voxelCount));
  EXPECT_EQ(filter->GetNumberOfBuilds(), 3);
  filter->SetLeafGeometryToAutomatic();
  filter->SetMaximumLevel(6); // is kept
  filter->Update();
  EXPECT_EQ(octreeOf(filter->GetOutput()).level(), 6);

  filter->SetMaximumLevel(7);
  filter->SetInputData(sphere(0.7)); // another mesh's octree is no substitute
  filter->Update();
  EXPECT_FALSE(filter->GetOutput()->GetFieldData()->HasArray(svo::OctreeArrayName));
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), mesh->GetNumberOfPolys());

  filter->BuildOctreesOn();
  filter->Update();
  EXPECT_EQ(octreeOf(filter->GetOutput()).level(), 7);
  EXPECT_EQ(filter->GetNumberOfBuilds(), 4);
}

TEST(PolyDataToSVO, WithoutBuildsAMeshKeepsTheOctreeThatItBrings)
{
  vtkNew<vtkPolyDataToSVO> upstream;
  upstream->SetInputData(sphere());
  upstream->SetMaximumLevel(3);
  upstream->Update();
  vtkNew<vtkPolyDataToSVO> filter;
  filter->SetInputData(upstream->GetOutput());
  filter->SetMaximumLevel(6);
  filter->BuildOctreesOff();
  filter->Update();
  EXPECT_EQ(octreeOf(filter->GetOutput()).level(), 3);
  filter->BuildOctreesOn();
  filter->Update();
  EXPECT_EQ(octreeOf(filter->GetOutput()).level(), 6);
}

TEST(PolyDataToSVO, SwitchingBuildsMakesNothingOutdatedThatIsComplete)
{
  vtkNew<vtkPolyDataToSVO> filter;
  filter->SetInputData(sphere());
  filter->SetMaximumLevel(4);
  filter->Update();
  const auto time = filter->GetMTime();
  filter->BuildOctreesOff();
  filter->BuildOctreesOn();
  EXPECT_EQ(filter->GetMTime(), time);
}

TEST(PolyDataToSVO, AMeshThatChangedIsBuiltAgain)
{
  vtkNew<vtkPolyData> mesh;
  mesh->DeepCopy(sphere());
  vtkNew<vtkPolyDataToSVO> filter;
  filter->SetInputData(mesh);
  filter->SetMaximumLevel(4);
  filter->Update();
  mesh->GetPoints()->SetPoint(0, 0.0, 0.0, 3.0);
  mesh->GetPoints()->Modified();
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfBuilds(), 2);
  EXPECT_TRUE(octreeOf(filter->GetOutput()));
  // New colours are no change of the surface.
  vtkNew<vtkFloatArray> scalars;
  scalars->SetNumberOfValues(mesh->GetNumberOfPoints());
  scalars->FillValue(0.5f);
  mesh->GetPointData()->SetScalars(scalars);
  filter->Update();
  EXPECT_EQ(filter->GetNumberOfBuilds(), 2);
  EXPECT_TRUE(octreeOf(filter->GetOutput()));
}

TEST(PolyDataToSVO, EveryBlockOfACompositeGetsItsOctree)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, sphere(1.0));
  blocks->SetBlock(1, sphere(2.0));
  blocks->SetBlock(2, sphere(1.0));
  vtkNew<vtkPolyDataToSVO> filter;
  vtkNew<vtkCompositeDataPipeline> executive;
  filter->SetExecutive(executive);
  filter->SetInputDataObject(blocks);
  filter->SetMaximumLevel(4);
  filter->Update();
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_NE(output, nullptr);
  for (unsigned int i = 0; i < 3; ++i)
  {
    EXPECT_TRUE(octreeOf(vtkPolyData::SafeDownCast(output->GetBlock(i)))) << i;
  }
  EXPECT_EQ(filter->GetNumberOfBuilds(), 2); // two blocks are alike
}

TEST(PolyDataToSVO, ReportsProgressThatGrows)
{
  vtkNew<vtkPolyDataToSVO> filter;
  filter->SetInputData(sphere());
  filter->SetMaximumLevel(7);
  std::vector<double> seen;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&seen);
  observer->SetCallback([](vtkObject*, unsigned long, void* client, void* progress)
    { static_cast<std::vector<double>*>(client)->push_back(*static_cast<double*>(progress)); });
  filter->AddObserver(vtkCommand::ProgressEvent, observer);
  filter->Update();
  ASSERT_GE(seen.size(), 2u);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(seen.back(), 1.0);
}

TEST(PolyDataToSVO, AnAbortedBuildLeavesNoOctree)
{
  vtkNew<vtkPolyDataToSVO> filter;
  const svo::TestMessages messages(filter);
  const auto mesh = sphere();
  filter->SetInputData(mesh);
  filter->SetMaximumLevel(8);
  vtkNew<vtkCallbackCommand> observer;
  observer->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1); });
  const unsigned long tag = filter->AddObserver(vtkCommand::ProgressEvent, observer);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(),
    svo::ExecutiveEmptiesAbortedOutput ? 0 : mesh->GetNumberOfPolys());
  EXPECT_FALSE(filter->GetOutput()->GetFieldData()->HasArray(svo::OctreeArrayName));
  EXPECT_EQ(filter->GetNumberOfBuilds(), 0);
  EXPECT_EQ(messages.all(), "");
  filter->RemoveObserver(tag);
  filter->SetAbortExecute(0);
  filter->Modified();
  filter->Update();
  EXPECT_TRUE(octreeOf(filter->GetOutput()));
}

TEST(PolyDataToSVO, AForeignOctreeOnTheInputIsReplaced)
{
  const Conversion first(sphere(1.0), 4);
  vtkNew<vtkPolyData> other;
  other->ShallowCopy(sphere(2.0));
  other->GetFieldData()->ShallowCopy(first.filter->GetOutput()->GetFieldData());
  ASSERT_FALSE(octreeOf(other));
  const Conversion second(other, 4);
  EXPECT_EQ(second.messages.all(), "");
  EXPECT_TRUE(second.octree());
  EXPECT_EQ(second.filter->GetNumberOfBuilds(), 1);
}
