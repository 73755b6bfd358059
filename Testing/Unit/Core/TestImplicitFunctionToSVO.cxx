// Implicit functions to octrees: what the contour and the octree are, what other filters make of
// them, and what cannot be converted.
#include "vtkImplicitFunctionToSVO.h"

#include "svoConversion.h"
#include "vtkSVOToPolyData.h"
#include "vtkSparseVoxelOctree.h"

#include "vtkCallbackCommand.h"
#include "vtkCellData.h"
#include "vtkElevationFilter.h"
#include "vtkImplicitBoolean.h"
#include "vtkPlane.h"
#include "vtkSphere.h"
#include "vtkTransform.h"
#include "vtkTransformPolyDataFilter.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <cmath>
#include <limits>

namespace
{
/// A sphere beside the origin of a frame far away.
struct SphereConversion
{
  vtkNew<vtkSphere> function;
  vtkNew<vtkImplicitFunctionToSVO> filter;
  svo::TestMessages messages{ filter };

  explicit SphereConversion(int level = 6)
  {
    this->function->SetCenter(100.0, 0.2, -0.1);
    this->function->SetRadius(1.5);
    this->filter->SetImplicitFunction(this->function);
    this->filter->SetModelBounds(98.0, 102.0, -2.0, 2.0, -2.0, 2.0);
    this->filter->SetMaximumLevel(level);
  }
  vtkPolyData* output()
  {
    this->filter->Update();
    return this->filter->GetOutput();
  }
  void expectNothing(const std::string& error)
  {
    vtkPolyData* mesh = this->output();
    EXPECT_EQ(mesh->GetNumberOfCells(), 0);
    EXPECT_FALSE(octreeOf(mesh));
    ASSERT_EQ(this->messages.errors.size(), 1u);
    EXPECT_NE(this->messages.all().find(error), std::string::npos) << this->messages.all();
  }
};
}

TEST(ImplicitFunctionToSVO, AContourCarriesTheOctree)
{
  for (const int level : { 1, 2, 5, 6, 9 })
  {
    SphereConversion sphere(level);
    vtkPolyData* mesh = sphere.output();
    EXPECT_TRUE(sphere.messages.all().empty()) << sphere.messages.all();
    const svo::Octree octree = octreeOf(mesh);
    ASSERT_TRUE(octree);
    EXPECT_TRUE(octree.hasPlanes());
    EXPECT_EQ(octree.level(), level);
    EXPECT_EQ(sphere.filter->GetNumberOfVoxels(), vtkIdType(octree.header().voxelCount));
    EXPECT_LT(mesh->GetNumberOfCells(), 1000000);
    const double* b = mesh->GetBounds();
    const double c[3] = { 100.0, 0.2, -0.1 };
    for (int i = 0; i < 3; ++i)
    {
      const double voxel = std::ldexp(4.1, -level);
      EXPECT_NEAR(b[2 * i], c[i] - 1.5, (level < 5 ? 0.5 : 0.1) * voxel);
      EXPECT_NEAR(b[2 * i + 1], c[i] + 1.5, (level < 5 ? 0.5 : 0.1) * voxel);
    }
  }
}

TEST(ImplicitFunctionToSVO, LinesMeetTheSurface)
{
  SphereConversion sphere(8);
  vtkNew<vtkSparseVoxelOctree> octree;
  ASSERT_TRUE(octree->Initialize(sphere.output()));
  const double from[3] = { 103.0, 0.5, 0.3 }, to[3] = { 97.0, 0.1, -0.2 };
  double t = -1.0, x[3];
  vtkIdType cell = 7;
  ASSERT_EQ(octree->IntersectWithLine(from, to, t, x, cell), 1);
  EXPECT_EQ(cell, -1);
  // On a quantised tangent plane, at most a voxel along each axis from where it touches.
  const double h = octree->GetVoxelSize();
  const double error = 3.0 * h * h / (2.0 * 1.5) + std::sqrt(0.75) * (1.0 / 1023.0 + 2.5e-3) * h;
  EXPECT_NEAR(std::hypot(x[0] - 100.0, x[1] - 0.2, x[2] + 0.1), 1.5, error);
  EXPECT_GT(x[0], 100.0);
  EXPECT_NEAR(x[0], 103.0 - 6.0 * t, 1e-9);
}

TEST(ImplicitFunctionToSVO, ABoundFindsTheSameSurface)
{
  SphereConversion sampled(7), bounded(7);
  bounded.filter->SetGradientBound(2.0 * 4.0 * std::sqrt(3.0));
  const svo::Octree a = octreeOf(sampled.output()), b = octreeOf(bounded.output());
  EXPECT_EQ(a.header().voxelCount, b.header().voxelCount);
}

TEST(ImplicitFunctionToSVO, DifferencesAreAsTheirFirstFunctionWhereTheOthersAreFarAway)
{
  // VTK gives the gradient of a difference's first function with the opposite sign.
  SphereConversion sphere, difference;
  vtkNew<vtkSphere> small;
  small->SetCenter(98.4, 0.2, -0.1);
  small->SetRadius(0.3);
  vtkNew<vtkImplicitBoolean> boolean;
  boolean->SetOperationTypeToDifference();
  boolean->AddFunction(sphere.function);
  boolean->AddFunction(small);
  difference.filter->SetImplicitFunction(boolean);
  const svo::Octree whole = octreeOf(sphere.output()), cut = octreeOf(difference.output());
  ASSERT_TRUE(whole && cut);
  EXPECT_TRUE(difference.messages.all().empty()) << difference.messages.all();
  vtkNew<vtkSparseVoxelOctree> a, b;
  ASSERT_TRUE(a->Initialize(sphere.output()) && b->Initialize(difference.output()));
  int met = 0;
  for (int i = 0; i < 400; ++i)
  {
    const double angle = 0.1 + 0.031 * i, height = 0.9 * std::sin(0.37 * i);
    // Not from the side that is cut out.
    const double from[3] = { 100.0 + 5.0 * std::abs(std::cos(angle)), 0.2 + 5.0 * std::sin(angle),
      -0.1 + height };
    const double to[3] = { 100.0, 0.2, -0.1 + height };
    double t = 0.0, other = 1.0, x[3], y[3];
    vtkIdType cell;
    ASSERT_EQ(a->IntersectWithLine(from, to, t, x, cell), 1);
    ASSERT_EQ(b->IntersectWithLine(from, to, other, y, cell), 1) << i;
    ASSERT_NEAR(t, other, 1e-6) << i;
    ++met;
  }
  EXPECT_EQ(met, 400);
}

TEST(ImplicitFunctionToSVO, BooleansHaveNoHoles)
{
  // VTK 9.1 gives gradients of other functions than the one that counts.
  vtkNew<vtkSphere> a, b;
  a->SetCenter(-0.3, 0.0, 0.0);
  b->SetCenter(0.3, 0.0, 0.0);
  for (const int operation : { vtkImplicitBoolean::VTK_UNION, vtkImplicitBoolean::VTK_INTERSECTION,
         vtkImplicitBoolean::VTK_DIFFERENCE, vtkImplicitBoolean::VTK_UNION_OF_MAGNITUDES })
  {
    SCOPED_TRACE(testing::Message() << "operation " << operation);
    vtkNew<vtkImplicitBoolean> function;
    function->SetOperationType(operation);
    function->AddFunction(a);
    function->AddFunction(b);
    vtkNew<vtkImplicitFunctionToSVO> filter;
    filter->SetImplicitFunction(function);
    filter->SetMaximumLevel(8);
    // A union of magnitudes is 0 on either sphere, but larger on both sides.
    const double value = operation == vtkImplicitBoolean::VTK_UNION_OF_MAGNITUDES ? 0.05 : 0.0;
    filter->SetValue(value);
    filter->Update();
    vtkNew<vtkSparseVoxelOctree> octree;
    ASSERT_TRUE(octree->Initialize(filter->GetOutput()));
    int inside = 0, missed = 0;
    for (int i = 0; i < 4000 && inside < 400; ++i)
    {
      const auto spread = [i](double step) { return std::fmod(step * i, 1.0) - 0.5; };
      const double to[3] = { 1.6 * spread(0.618034), 1.6 * spread(0.754878),
        1.6 * spread(0.569840) };
      if (function->FunctionValue(to) > value - 0.02)
      {
        continue;
      }
      ++inside;
      const double angle = 2.4 * i, height = 1.9 * spread(0.324718);
      const double r = std::sqrt(1.0 - height * height);
      const double from[3] = { to[0] + 3.0 * r * std::cos(angle), to[1] + 3.0 * r * std::sin(angle),
        to[2] + 3.0 * height };
      double first = 0.0, x[3], t = 0.0;
      do
      {
        first += 1e-3;
        for (int k = 0; k < 3; ++k)
        {
          x[k] = from[k] + first * (to[k] - from[k]);
        }
      } while (first < 1.0 && function->FunctionValue(x) > value);
      vtkIdType cell = 0;
      const bool hit = octree->IntersectWithLine(from, to, t, x, cell) != 0;
      missed += !hit || t > first + 0.02;
    }
    EXPECT_GT(inside, 50);
    EXPECT_EQ(missed, 0) << "of " << inside;
  }
}

TEST(ImplicitFunctionToSVO, TransformsAndValuesCount)
{
  SphereConversion sphere(6);
  const vtkIdType before = (sphere.output(), sphere.filter->GetNumberOfVoxels());
  sphere.function->SetRadius(1.0); // the filter follows its function
  const vtkIdType smaller = (sphere.output(), sphere.filter->GetNumberOfVoxels());
  EXPECT_LT(smaller, before);
  sphere.filter->SetValue(1.25); // r^2 - 1 = 1.25
  EXPECT_EQ((sphere.output(), sphere.filter->GetNumberOfVoxels()), before);
  vtkNew<vtkTransform> transform;
  transform->Translate(-0.5, 0.0, 0.0);
  sphere.function->SetTransform(transform);
  const double* bounds = sphere.output()->GetBounds();
  EXPECT_NEAR(0.5 * (bounds[0] + bounds[1]), 100.5, 0.15);
}

TEST(ImplicitFunctionToSVO, ALargePlaneIsCutAtTheBox)
{
  vtkNew<vtkPlane> plane;
  plane->SetNormal(0.0, 0.6, 0.8);
  vtkNew<vtkImplicitFunctionToSVO> filter;
  filter->SetImplicitFunction(plane);
  filter->SetModelBounds(-1.0, 1.0, -0.5, 0.5, -1.0, 1.0);
  filter->SetMaximumLevel(6);
  filter->Update();
  const double* b = filter->GetOutput()->GetBounds();
  const double cell = 2.0 / 32.0 * 1.01;
  EXPECT_NEAR(b[0], -1.0, cell);
  EXPECT_NEAR(b[3], 0.5, cell);
  EXPECT_NEAR(b[5], 0.5 * 0.6 / 0.8, 2.0 * cell);
}

TEST(ImplicitFunctionToSVO, TheOctreeTravelsAndOtherFiltersKnowIt)
{
  SphereConversion sphere(6);
  vtkPolyData* mesh = sphere.output();

  vtkNew<vtkPolyDataToSVO> again;
  again->SetInputData(mesh);
  again->SetMaximumLevel(4);
  again->Update();
  EXPECT_EQ(again->GetNumberOfBuilds(), 0) << "the contour is made of the octree";
  EXPECT_TRUE(octreeOf(again->GetOutput()).hasPlanes());

  vtkNew<vtkSVOToPolyData> cells;
  cells->SetInputData(mesh);
  cells->Update();
  EXPECT_GT(cells->GetOutput()->GetNumberOfCells(), mesh->GetNumberOfCells());
  EXPECT_FALSE(cells->GetOutput()->GetCellData()->HasArray("CellId"));
  EXPECT_TRUE(cells->GetOutput()->GetCellData()->HasArray("Level"));

  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->WriteToOutputStringOn();
  writer->SetInputData(mesh);
  ASSERT_EQ(writer->Write(), 1);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(writer->GetOutputString());
  reader->Update();
  const svo::Octree read = octreeOf(reader->GetOutput());
  ASSERT_TRUE(read);
  EXPECT_EQ(read.header().voxelCount, octreeOf(mesh).header().voxelCount);
  EXPECT_EQ(octreeOf(reader->GetOutput()).id(), read.id()) << "opened once";

  vtkNew<vtkTransform> transform;
  transform->Scale(2.0, 2.0, 2.0);
  vtkNew<vtkTransformPolyDataFilter> moved;
  moved->SetTransform(transform);
  moved->SetInputData(mesh);
  moved->Update();
  EXPECT_FALSE(octreeOf(moved->GetOutput())) << "it is foreign";
}

TEST(ImplicitFunctionToSVO, OneMessageForWhatCannotBeConverted)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  {
    SphereConversion sphere;
    sphere.filter->SetImplicitFunction(nullptr);
    sphere.expectNothing("no implicit function");
  }
  for (const double high : { 90.0, nan, std::numeric_limits<double>::infinity() })
  {
    SphereConversion sphere;
    sphere.filter->SetModelBounds(98.0, high, -2.0, 2.0, -2.0, 2.0);
    sphere.expectNothing("empty, or not finite");
  }
  {
    SphereConversion sphere(20);
    sphere.filter->SetMemoryLimit(10000);
    sphere.expectNothing("level 20 would need about");
  }
  {
    SphereConversion sphere(20); // it never crosses
    sphere.function->SetRadius(20.0);
    EXPECT_EQ(sphere.output()->GetNumberOfCells(), 0);
    EXPECT_TRUE(octreeOf(sphere.output()).empty());
    EXPECT_TRUE(sphere.messages.errors.empty());
    EXPECT_EQ(sphere.messages.warnings.size(), 1u);
  }
}

TEST(ImplicitFunctionToSVO, ProgressAndAbort)
{
  SphereConversion sphere(9);
  struct Watch
  {
    double last = 0.0;
    int reports = 0;
    int abortAt = 0;
  } watch;
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&watch);
  observer->SetCallback(
    [](vtkObject* caller, unsigned long, void* client, void* data)
    {
      auto& w = *static_cast<Watch*>(client);
      const double progress = *static_cast<double*>(data);
      EXPECT_GE(progress, w.last);
      w.last = progress;
      if (++w.reports == w.abortAt)
      {
        static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
      }
    });
  sphere.filter->AddObserver(vtkCommand::ProgressEvent, observer);
  EXPECT_GT(sphere.output()->GetNumberOfCells(), 0);
  EXPECT_GT(watch.reports, 20);
  EXPECT_EQ(watch.last, 1.0);
  watch = { 0.0, 0, 10 };
  sphere.filter->Modified();
  EXPECT_EQ(sphere.output()->GetNumberOfCells(), 0);
  EXPECT_TRUE(sphere.messages.all().empty()) << sphere.messages.all();
}
