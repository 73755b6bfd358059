// Files of grids: which of theirs are read, files as time steps, progress.
#include "svoVDBTest.h"

#include "vtkCallbackCommand.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"

namespace
{
using namespace svotest;
const glm::dvec3 Centre(3.3, -8.4, 40.1); // index space
}

TEST(VDBFiles, GridsAreChosenByName)
{
  const TemporaryFile file("several.vdb");
  const auto small = sphereGrid(5.0, Centre), large = sphereGrid(9.0, Centre);
  small->setName("small");
  large->setName("large");
  large->insertMeta("note", openvdb::StringMetadata("hello"));
  file.write({ small, large, small });
  Reading reading(file.name());
  ASSERT_EQ(reading.reader->GetNumberOfGrids(), 3);
  EXPECT_STREQ(reading.reader->GetGridName(0), "large");
  EXPECT_STREQ(reading.reader->GetGridName(1), "small[0]");
  EXPECT_STREQ(reading.reader->GetGridName(2), "small[1]");
  EXPECT_EQ(reading.reader->GetGridName(3), nullptr);
  EXPECT_EQ(reading.reader->GetGridNames()->GetNumberOfValues(), 3);
  const std::uint64_t first = reading.octree().header().voxelCount;
  EXPECT_NE(std::string(reading.reader->GetMetaData()).find("note: hello"), std::string::npos);
  auto* metadata =
    vtkStringArray::SafeDownCast(reading.output()->GetFieldData()->GetAbstractArray("VDBMetadata"));
  ASSERT_TRUE(metadata);
  EXPECT_EQ(metadata->GetValue(0), "grid: large");
  for (const char* name : { "small[1]", "small[0]", "small" })
  {
    reading.reader->SetGridName(name);
    EXPECT_LT(reading.octree().header().voxelCount, first) << name;
  }
  EXPECT_EQ(reading.messages.all(), "");
  reading.reader->SetGridName("huge");
  reading.expectError("it has no grid \"huge\", but \"large\", \"small[0]\", \"small[1]\"");
}

TEST(VDBFiles, FilesAreTimeSteps)
{
  const TemporaryFile a("a.vdb"), b("b.vdb"), c("c.vdb");
  a.write({ sphereGrid(5.0, Centre) });
  b.write({ sphereGrid(8.0, Centre) });
  c.write({ sphereGrid(11.0, Centre) });
  vtkNew<vtkSVOVDBReader> reader;
  for (const TemporaryFile* file : { &a, &b, &c })
  {
    reader->AddFileName(file->name());
  }
  EXPECT_EQ(reader->GetNumberOfFileNames(), 3);
  EXPECT_STREQ(reader->GetFileName(1), b.name());
  reader->UpdateInformation();
  vtkInformation* info = reader->GetOutputInformation(0);
  ASSERT_EQ(info->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()), 3);
  const double times[] = { 0.0, 1.0, 1.7, 2.0, 99.0, -3.0 };
  const double radii[] = { 5.0, 8.0, 8.0, 11.0, 11.0, 5.0 };
  for (int i = 0; i < 6; ++i)
  {
    reader->UpdateTimeStep(times[i]);
    const svo::Octree octree = octreeOf(reader->GetOutput());
    ASSERT_TRUE(octree);
    const double far = glm::length(placeOf(octree, cellsOf(octree).front()) - Centre);
    EXPECT_NEAR(far, radii[i], 0.87) << times[i];
  }
  reader->SetFileName(b.name());
  reader->UpdateInformation();
  EXPECT_FALSE(
    reader->GetOutputInformation(0)->Has(vtkStreamingDemandDrivenPipeline::TIME_STEPS()));
}

TEST(VDBFiles, AFileThatComesBackIsReadAgain)
{
  const TemporaryFile file("back.vdb");
  file.write({ sphereGrid(5.0, Centre) });
  Reading reading(file.name());
  ASSERT_EQ(reading.reader->GetNumberOfGrids(), 1);
  reading.reader->RemoveAllFileNames();
  EXPECT_EQ(reading.reader->GetGridNames()->GetNumberOfValues(), 0);
  reading.reader->AddFileName(file.name());
  EXPECT_EQ(reading.reader->GetGridNames()->GetNumberOfValues(), 1);
  reading.reader->SetFileName(nullptr);
  EXPECT_EQ(reading.reader->GetNumberOfGrids(), 0);
  EXPECT_EQ(reading.messages.all(), "");
}

TEST(VDBFiles, ReportsProgressAndCanBeAborted)
{
  const TemporaryFile file("progress.vdb");
  file.write({ sphereGrid(40.0, Centre) });
  vtkNew<vtkSVOVDBReader> reader;
  reader->SetFileName(file.name());
  std::vector<double> progress;
  vtkNew<vtkCallbackCommand> note;
  note->SetClientData(&progress);
  note->SetCallback([](vtkObject*, unsigned long, void* to, void* share)
    { static_cast<std::vector<double>*>(to)->push_back(*static_cast<double*>(share)); });
  reader->AddObserver(vtkCommand::ProgressEvent, note);
  reader->Update();
  EXPECT_GT(progress.size(), 3u);
  EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
  reader->RemoveAllObservers();
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1); });
  reader->AddObserver(vtkCommand::ProgressEvent, stop);
  svo::TestMessages messages(reader);
  reader->Modified();
  reader->Update();
  EXPECT_EQ(messages.all(), "");
  EXPECT_FALSE(octreeOf(reader->GetOutput()));
}
