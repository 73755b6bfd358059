// What vtkSVOShadowFilter is given: casters of all kinds, time steps, bad input, threads, aborting.
#include "svoShadowMeshes.h"

#include "svoMeshOctree.h"
#include "vtkImplicitFunctionToSVO.h"
#include "vtkPolyDataToSVO.h"

#include "vtkCallbackCommand.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkObjectFactory.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkSMPTools.h"
#include "vtkSphere.h"
#include "vtkSphereSource.h"
#include "vtkStreamingDemandDrivenPipeline.h"

using namespace svotest;

namespace
{
/// Ground under a sun at the zenith, with samples enough.
struct Ground : Shadows
{
  Ground()
    : Shadows(level(-2, 2, -2, 2, 0))
  {
    this->filter->SetSamplesPerCell(4096);
    this->filter->AddLight(sun(0, 0, 1));
  }
};

/// A board that is as wide as the time step says.
class Growing : public vtkPolyDataAlgorithm
{
public:
  static Growing* New();
  vtkTypeMacro(Growing, vtkPolyDataAlgorithm);
  int Executions = 0;

protected:
  Growing() { this->SetNumberOfInputPorts(0); }
  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* out) override
  {
    const double steps[] = { 1.0, 2.0 }, range[] = { 1.0, 2.0 };
    vtkInformation* info = out->GetInformationObject(0);
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), steps, 2);
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
    return 1;
  }
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* out) override
  {
    ++this->Executions;
    const double t =
      out->GetInformationObject(0)->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP());
    vtkPolyData::GetData(out)->ShallowCopy(level(-0.5 * t, 0.5 * t, -0.5 * t, 0.5 * t, 1));
    return 1;
  }
};
vtkStandardNewMacro(Growing);
}

TEST(SVOShadowFilterInput, OctreesOfPlanesCast)
{
  vtkNew<vtkSphere> function;
  function->SetCenter(0, 0, 1);
  function->SetRadius(0.8);
  vtkNew<vtkImplicitFunctionToSVO> source;
  source->SetImplicitFunction(function);
  source->SetModelBounds(-1, 1, -1, 1, 0, 2);
  source->SetMaximumLevel(8);
  Ground ground;
  ground.filter->AddCasterConnection(source->GetOutputPort());
  EXPECT_NEAR(ground.shadow(0), 3.14159265 * 0.64 / 16.0, 2e-3);
  ground.expectQuiet();
}

TEST(SVOShadowFilterInput, CarriedOctreesOfAnyLeavesAreMetAtTriangles)
{
  vtkNew<vtkSphereSource> ball;
  ball->SetCenter(0, 0, 1);
  ball->SetThetaResolution(100);
  ball->SetPhiResolution(100);
  double first = -1.0;
  for (const int leaves : { 0, 1, 2, 3 })
  {
    vtkNew<vtkPolyDataToSVO> octree;
    octree->SetInputConnection(ball->GetOutputPort());
    octree->SetLeafGeometry(leaves);
    octree->SetMaximumLevel(4);
    Ground ground;
    ground.filter->AddCasterConnection(octree->GetOutputPort());
    const double share = ground.shadow(0);
    EXPECT_NEAR(share, 3.14159265 * 0.25 / 16.0, 1e-3);
    first = leaves == 0 ? share : first;
    EXPECT_EQ(share, first);
  }
}

TEST(SVOShadowFilterInput, OctreesOfOtherMeshesAreNotUsed)
{
  vtkNew<vtkPolyDataToSVO> octree;
  octree->SetInputData(level(-2, 2, -2, 2, 1));
  octree->Update();
  MeshPointer board = level(-0.5, 0.5, -0.5, 0.5, 1);
  board->GetFieldData()->ShallowCopy(octree->GetOutput()->GetFieldData());
  Ground ground;
  ground.filter->AddCasterData(board);
  EXPECT_NEAR(ground.shadow(0), 1.0 / 16.0, 2e-3);
  ground.expectQuiet();
}

TEST(SVOShadowFilterInput, CompositeCasters)
{
  vtkNew<vtkMultiBlockDataSet> inner, blocks;
  inner->SetBlock(1, level(0.5, 1.5, -0.5, 0.5, 1));
  blocks->SetBlock(0, level(-1.5, -0.5, -0.5, 0.5, 1));
  blocks->SetBlock(2, inner);
  blocks->SetBlock(3, MeshPointer::New());
  Ground ground;
  ground.filter->AddCasterData(blocks);
  ground.filter->SetCasterMatrix(0, matrix({ 1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 }));
  EXPECT_NEAR(ground.shadow(0), 4.0 / 16.0, 3e-3);
  ground.expectQuiet();
}

TEST(SVOShadowFilterInput, TimeStepsOfCasters)
{
  vtkNew<Growing> board;
  Ground ground;
  ground.filter->AddCasterConnection(board->GetOutputPort());
  for (const double t : { 1.0, 2.0, 1.0 })
  {
    ground.filter->UpdateTimeStep(t);
    EXPECT_NEAR(ground.filter->GetOutput()->GetCellData()->GetArray("Shadow")->GetComponent(0, 0),
      t * t / 16.0, 2e-3);
  }
  vtkInformation* info = ground.filter->GetOutputInformation(0);
  EXPECT_EQ(info->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()), 2);
  EXPECT_EQ(board->Executions, 3);
  ground.expectQuiet();
}

TEST(SVOShadowFilterInput, ThreadsChangeNoByte)
{
  // VTK's other backends have no more threads than there are processors.
  const std::string backend = vtkSMPTools::GetBackend();
  ASSERT_TRUE(vtkSMPTools::SetBackend("STDThread"));
  for (const bool byPoint : { false, true })
  {
    std::vector<std::vector<char>> bytes;
    for (const int threads : { 1, 2, 7 })
    {
      vtkSMPTools::Initialize(threads);
      Shadows shadows(hills(50), byPoint);
      shadows.filter->AddLight(sun(0.5, 0.3, 0.4));
      shadows.filter->AddLight(lamp(0.2, 0.1, 0.4));
      shadows.filter->AddLight(lamp(-0.4, 0.1, 0.5, 35.0));
      shadows.filter->CosineWeightedOn();
      bytes.emplace_back();
      for (const char* name : { "Shadow", "Exposure" })
      {
        vtkDataArray* array = shadows.array(name);
        const auto* data = static_cast<const char*>(array->GetVoidPointer(0));
        bytes.back().insert(
          bytes.back().end(), data, data + array->GetNumberOfValues() * array->GetDataTypeSize());
      }
    }
    EXPECT_EQ(bytes[0], bytes[1]);
    EXPECT_EQ(bytes[0], bytes[2]);
  }
  vtkSMPTools::Initialize();
  vtkSMPTools::SetBackend(backend.c_str());
}

TEST(SVOShadowFilterInput, NoLights)
{
  Shadows shadows(level(-1, 1, -1, 1, 0));
  EXPECT_EQ(shadows.exposure(0), 0.0);
  EXPECT_EQ(shadows.array("Shadow"), nullptr);
  EXPECT_EQ(shadows.messages.warnings.size(), 1u);
  EXPECT_TRUE(shadows.messages.errors.empty());
}

TEST(SVOShadowFilterInput, EmptyMeshes)
{
  for (const bool byPoint : { false, true })
  {
    Shadows shadows(MeshPointer::New(), byPoint);
    shadows.filter->AddLight(sun(0, 0, 1));
    vtkDataArray* shadow = shadows.array("Shadow");
    ASSERT_NE(shadow, nullptr);
    EXPECT_EQ(shadow->GetNumberOfTuples(), 0);
    shadows.expectQuiet();
  }
  Ground ground; // a caster without points
  ground.filter->AddCasterData(MeshPointer::New());
  EXPECT_EQ(ground.shadow(0), 0.0);
  ground.expectQuiet();
}

TEST(SVOShadowFilterInput, PointsThatAreNotFinite)
{
  const double nan = std::nan("");
  MeshPointer mesh = polygons(
    { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { nan, 1, 0 } }, { { 0, 1, 2 }, { 0, 1, 3 } });
  for (const bool byPoint : { false, true })
  {
    Shadows shadows(mesh, byPoint);
    shadows.filter->AddLight(sun(0, 0, 1));
    EXPECT_EQ(shadows.shadow(0), 0.0);
    EXPECT_TRUE(std::isnan(shadows.shadow(byPoint ? 3 : 1)));
    EXPECT_TRUE(std::isnan(shadows.exposure(byPoint ? 3 : 1)));
    EXPECT_EQ(shadows.messages.warnings.size(), 1u);
    EXPECT_TRUE(shadows.messages.errors.empty());
  }
}

TEST(SVOShadowFilterInput, CastersWithPointsThatAreNotFinite)
{
  MeshPointer board = level(-0.5, 0.5, -0.5, 0.5, 1, 2);
  board->GetPoints()->SetPoint(0, std::nan(""), 0, 0);
  Ground ground;
  ground.filter->AddCasterData(board);
  EXPECT_NEAR(ground.shadow(0), 0.75 / 16.0, 2e-3) << "three of four quads are whole";
  ASSERT_EQ(ground.messages.warnings.size(), 1u);
  EXPECT_NE(
    ground.messages.all().find("Of a caster: The octree is not complete: 2 of"), std::string::npos)
    << ground.messages.all();
}

TEST(SVOShadowFilterInput, CellsWithoutArea)
{
  MeshPointer mesh = level(-1, 1, -1, 1, 0);
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell({ 0 });
  mesh->SetVerts(vertices);
  Shadows shadows(mesh);
  shadows.filter->AddLight(sun(0, 0, 1));
  EXPECT_TRUE(std::isnan(shadows.shadow(0))) << "a vertex";
  EXPECT_EQ(shadows.shadow(1), 0.0);
  shadows.expectQuiet();
  Shadows degenerate(polygons({ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } }, { { 0, 1, 2 } }));
  degenerate.filter->AddLight(sun(0, 0, 1));
  EXPECT_TRUE(std::isnan(degenerate.shadow(0)));
  EXPECT_EQ(degenerate.messages.warnings.size(), 1u);
}

TEST(SVOShadowFilterInput, MatricesWithoutInverse)
{
  Ground ground;
  ground.filter->AddCasterData(level(-1, 1, -1, 1, 1));
  auto flat = matrix({ 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 });
  ground.filter->SetCasterMatrix(0, flat);
  EXPECT_EQ(ground.shadow(0), 0.0);
  EXPECT_EQ(ground.messages.warnings.size(), 1u);
  ground.filter->SetMeshMatrix(flat);
  EXPECT_EQ(ground.array("Shadow"), nullptr);
  EXPECT_EQ(ground.messages.errors.size(), 1u);
  EXPECT_EQ(ground.filter->GetOutput()->GetNumberOfCells(), 1) << "the mesh passes";
}

TEST(SVOShadowFilterInput, LightsWithoutAPlace)
{
  Ground ground;
  auto headlight = sun(0, 0, 1), camera = sun(0, 0, 1), nowhere = sun(0, 0, 0);
  headlight->SetLightTypeToHeadlight();
  camera->SetLightTypeToCameraLight();
  for (const auto& light : { headlight, camera, nowhere })
  {
    ground.filter->AddLight(light);
  }
  EXPECT_EQ(ground.shadow(0, 0), 0.0);
  EXPECT_EQ(ground.shadow(0, 1), 1.0);
  EXPECT_EQ(ground.exposure(0), 1.0);
  EXPECT_EQ(ground.messages.warnings.size(), 2u) << ground.messages.all();
  EXPECT_NE(ground.messages.all().find("light 1, 2 "), std::string::npos) << ground.messages.all();
}

TEST(SVOShadowFilterInput, NothingFacesTheSun)
{
  for (const bool byPoint : { false, true })
  {
    Shadows shadows(level(-1, 1, -1, 1, 0, 3), byPoint);
    shadows.filter->AddLight(sun(0, 0, -1));
    shadows.filter->AddLight(sun(0.3, 0, -1));
    EXPECT_EQ(shadows.exposure(0), 0.0);
    ASSERT_EQ(shadows.messages.warnings.size(), 1u);
    EXPECT_NE(shadows.messages.all().find("faces any of the lights"), std::string::npos);
    shadows.filter->TwoSidedOn();
    EXPECT_EQ(shadows.exposure(0), 2.0);
    EXPECT_EQ(shadows.messages.warnings.size(), 1u);
    shadows.filter->TwoSidedOff();
    shadows.filter->AddLight(sun(0, 0, 1));
    EXPECT_EQ(shadows.exposure(0), 1.0);
    EXPECT_EQ(shadows.messages.all().find("faces"), shadows.messages.all().rfind("faces"));
  }
}

TEST(SVOShadowFilterInput, IndicesThatDoNotExist)
{
  Ground ground;
  ground.filter->SetWeight(1, 2.0);
  EXPECT_EQ(ground.filter->GetWeight(-1), 0.0);
  EXPECT_EQ(ground.filter->AddLight(nullptr), -1);
  EXPECT_EQ(ground.messages.errors.size(), 3u);
  EXPECT_EQ(ground.filter->GetLight(1), nullptr);
  ground.filter->RemoveLight(nullptr);
  EXPECT_EQ(ground.filter->GetNumberOfLights(), 1);
}

TEST(SVOShadowFilterInput, ProgressAndAbort)
{
  struct Watch
  {
    double last = 0.0, stop = 2.0;
    bool back = false;
    double reached =
      0.0; // before the 1 that since VTK 9.3 the executive says of what was aborted, too
  } watch;
  vtkNew<vtkCallbackCommand> watcher;
  watcher->SetClientData(&watch);
  watcher->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void* call)
    {
      auto* w = static_cast<Watch*>(data);
      const double now = *static_cast<double*>(call);
      w->back = w->back || now < w->last;
      w->last = now;
      w->reached = now < 1.0 ? now : w->reached;
      if (now > w->stop)
      {
        static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
      }
    });
  for (const double stop : { 2.0, 0.01, 0.5 })
  {
    watch = { 0.0, stop, false, 0.0 };
    Shadows shadows(hills(60));
    shadows.filter->AddObserver(vtkCommand::ProgressEvent, watcher);
    for (int i = 0; i < 60; ++i)
    {
      shadows.filter->AddLight(sun(0.01 * i, 0.3, 0.4));
    }
    vtkDataArray* shadow = shadows.array("Shadow");
    EXPECT_EQ(shadow != nullptr, stop > 1.0);
    EXPECT_FALSE(watch.back);
    shadows.expectQuiet();
    if (stop < 1.0)
    {
      EXPECT_LT(watch.reached, 0.9);
      watch.stop = 2.0;
      shadows.filter->SetAbortExecute(0);
      shadows.filter->Modified();
      EXPECT_NE(shadows.array("Shadow"), nullptr) << "it can be tried again";
    }
  }
}
