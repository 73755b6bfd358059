// The same of splats, tubes, spheres and impostors.
#include "svoKeptProps.h"
#include "svoSplats.h"

#include "vtkCellArray.h"
#include "vtkColorTransferFunction.h"
#include "vtkMath.h"
#include "vtkOpenGLSphereMapper.h"
#include "vtkPiecewiseFunction.h"
#include "vtkPointGaussianMapper.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

using namespace svotest;

namespace
{
const char Disc[] = "float d = dot(offsetVCVSOutput.xy, offsetVCVSOutput.xy);\n"
                    "if (d > 1.0) { discard; }\n";

/// A line of five points, a point, and a triangle.
vtkSmartPointer<vtkPolyData> mixture()
{
  auto mesh = places(5);
  mesh->GetPoints()->InsertNextPoint(1.0, 6.0, 1.0);
  mesh->GetPointData()->GetScalars()->InsertComponent(5, 0, 1.0);
  const vtkIdType line[] = { 0, 1, 2, 3, 4 };
  const vtkIdType alone[] = { 5 };
  const vtkIdType triangle[] = { 0, 1, 5 };
  vtkNew<vtkCellArray> verts, lines, polys;
  verts->InsertNextCell(1, alone);
  lines->InsertNextCell(5, line);
  polys->InsertNextCell(3, triangle);
  mesh->SetVerts(verts);
  mesh->SetLines(lines);
  mesh->SetPolys(polys);
  return mesh;
}
}

/// The fixture with tubes and splats in the place of some of its props.
class RoundProps : public KeptProps
{
protected:
  RoundProps()
  {
    this->renderer->RemoveAllViewProps();
    this->splats->SetInputData(this->points);
    this->splats->SetSplatShaderCode(Disc);
    this->splats->EmissiveOff();
    this->splats->SetScaleFactor(0.5);
    this->show(this->splatActor, this->splats);
    this->tubes->SetInputData(this->lines);
    this->tubes->ScalarVisibilityOff();
    this->show(this->tubeActor, this->tubes);
    vtkProperty* property = this->tubeActor->GetProperty();
    property->RenderLinesAsTubesOn();
    property->SetLineWidth(8.0);
    property->RenderPointsAsSpheresOn();
    property->SetPointSize(12.0);
    this->show(this->actor, this->plain);
  }

  /// So many pixels at a place, world. Without a window the picture is as wide as it is high.
  double length(double pixels, const glm::dvec3& at) const
  {
    const svo::View& eye = this->settings.levels.eye;
    const double depth = -(eye.worldToView * glm::dvec4(at, 1.0)).z;
    const double angle =
      vtkMath::RadiansFromDegrees(this->renderer->GetActiveCamera()->GetViewAngle());
    return pixels * (eye.parallel ? 1.0 : depth) * 2.0 * std::tan(0.5 * angle) / eye.width;
  }
  /// Of an instance: splats first, then rods, then balls, then the triangle and the ball.
  glm::dmat4 matrix(std::size_t i) const { return this->scene.scene.instances[i].localToWorld; }
  double radius(std::size_t i) const { return glm::length(glm::dvec3(this->matrix(i)[0])); }

  static constexpr std::size_t Splats = 5, Rods = 4;
  vtkNew<vtkActor> splatActor, tubeActor;
  vtkNew<vtkPointGaussianMapper> splats;
  vtkNew<vtkPolyDataMapper> tubes;
  vtkSmartPointer<vtkPolyData> lines = mixture();
};

TEST_F(RoundProps, AreWhereTheyAreSeen)
{
  collect(collector, scene);
  ASSERT_EQ(scene.scene.instances.size(), Splats + Rods + 1 + 1 + 1);
  for (std::size_t i = 0; i < Splats; ++i)
  {
    EXPECT_NEAR(radius(i), 0.5, 1e-12) << i;
    EXPECT_NEAR(glm::distance(glm::dvec3(matrix(i)[3]), glm::dvec3(2.0 * i, 5.0, 0.0)), 0.0, 1e-12);
  }
  for (std::size_t i = 0; i < Rods; ++i)
  {
    const glm::dvec3 from(2.0 * i, 5.0, 0.0), to(2.0 * i + 2.0, 5.0, 0.0);
    const glm::dmat4 rod = matrix(Splats + i);
    EXPECT_NEAR(glm::distance(glm::dvec3(rod[3]), from), 0.0, 1e-12) << i;
    EXPECT_NEAR(glm::distance(glm::dvec3(rod * glm::dvec4(0, 0, 1, 1)), to), 0.0, 1e-12) << i;
    const double expected = 0.5 * (length(4.0, from) + length(4.0, to));
    EXPECT_NEAR(radius(Splats + i), expected, 1e-4 * expected) << i;
    EXPECT_NEAR(glm::length(glm::dvec3(rod[1])), radius(Splats + i), 1e-12) << i;
    EXPECT_NEAR(glm::dot(glm::dvec3(rod[0]), glm::dvec3(rod[1])), 0.0, 1e-12) << i;
    EXPECT_NEAR(glm::dot(glm::dvec3(rod[0]), glm::dvec3(rod[2])), 0.0, 1e-12) << i;
  }
  const glm::dvec3 alone(1.0, 6.0, 1.0);
  EXPECT_NEAR(radius(Splats + Rods), length(6.0, alone), 1e-4 * length(6.0, alone));
  for (std::size_t i = 0; i < Splats + Rods + 1; ++i)
  {
    const Instance& one = scene.scene.instances[i];
    EXPECT_TRUE(one.castShadow) << i;
    EXPECT_FALSE(one.visible) << i;
    const bool another = i == Splats || i == Splats + Rods; // shape, or number of facets
    EXPECT_EQ(i > 0 && one.body->octree.id() == scene.scene.instances[i - 1].body->octree.id(),
      i > 0 && !another)
      << i;
  }
  EXPECT_EQ(store.built(), 2) << "the triangle's and the ball's";
}

TEST_F(RoundProps, WidthsFollowTheEyeAndNothingIsBuilt)
{
  collect(collector, scene);
  const std::uint64_t ofRod = scene.scene.instances[Splats].body->octree.id();
  const double splat = radius(0), rod = radius(Splats);
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->Zoom(2.0);
  collect(collector, scene);
  EXPECT_EQ(collector.collectedAnew(), 0);
  EXPECT_EQ(radius(0), splat);
  // The tangent of half the angle is not quite half as large.
  EXPECT_NEAR(radius(Splats),
    rod * std::tan(vtkMath::RadiansFromDegrees(7.5)) / std::tan(vtkMath::RadiansFromDegrees(15.0)),
    1e-9);
  EXPECT_EQ(scene.scene.instances[Splats].body->octree.id(), ofRod);
  camera->ParallelProjectionOn();
  camera->SetParallelScale(10.0);
  collect(collector, scene);
  EXPECT_NEAR(radius(Splats), 4.0 * 20.0 / 300.0, 1e-4);
  EXPECT_EQ(collector.collectedAnew(), 0);
  svo::SceneCollector fresh;
  CollectedScene other;
  collect(fresh, other);
  expectSame(scene, other, "after the eye has moved");
}

TEST_F(RoundProps, NothingIsPlacedAgainWhereNothingMoves)
{
  collect(collector, scene);
  collect(collector, scene);
  // What is written by hand stays, as long as nobody writes it again.
  scene.scene.instances[Splats].localToWorld[3][0] = 77.0;
  collect(collector, scene);
  EXPECT_EQ(matrix(Splats)[3][0], 77.0);
  renderer->GetActiveCamera()->Azimuth(1.0);
  collect(collector, scene);
  EXPECT_NE(matrix(Splats)[3][0], 77.0);
}

TEST_F(RoundProps, AnActorMovesThemAndScalesOnlyPlaces)
{
  collect(collector, scene);
  collect(collector, scene);
  expectNoticed("tubes elsewhere", 0, [&] { tubeActor->SetPosition(0.0, 3.0, 0.0); });
  EXPECT_NEAR(matrix(Splats)[3][1], 8.0, 1e-12);
  expectNoticed("splats elsewhere", 0, [&] { splatActor->SetPosition(0.0, 0.0, 2.0); });
  expectNoticed("larger", 0, [&] { splatActor->SetScale(2.0, 1.0, 1.0); });
  EXPECT_NEAR(matrix(1)[3][0], 4.0, 1e-12);
  // Up to VTK 9.3 a splat's size is one of the view.
  const bool scales = svo::actorsScaleSplats();
  EXPECT_NEAR(glm::length(glm::dvec3(matrix(1)[0])), scales ? 1.0 : 0.5, 1e-12);
  EXPECT_NEAR(glm::length(glm::dvec3(matrix(1)[1])), 0.5, 1e-12);
}

TEST_F(RoundProps, EveryChangeIsNoticed)
{
  collect(collector, scene);
  collect(collector, scene);
  expectNoticed("a line width", 1, [&] { tubeActor->GetProperty()->SetLineWidth(4.0); });
  expectNoticed("a point size", 1, [&] { tubeActor->GetProperty()->SetPointSize(4.0); });
  expectNoticed("a factor", 1, [&] { splats->SetScaleFactor(0.7); });
  EXPECT_NEAR(radius(0), 0.7, 1e-12);
  expectNoticed("sizes", 1, [&] { splats->SetScaleArray("size"); });
  EXPECT_NEAR(radius(2), 0.7 * 0.7, 1e-6);
  vtkNew<vtkPiecewiseFunction> function;
  function->AddPoint(0.0, 1.0);
  function->AddPoint(1.0, 2.0);
  expectNoticed("a function of sizes", 1, [&] { splats->SetScaleFunction(function); });
  EXPECT_NEAR(radius(2), 0.7 * 1.7, 1e-5);
  expectNoticed("which changes", 1, [&] { function->AddPoint(1.0, 3.0); });
  EXPECT_NEAR(radius(2), 0.7 * 2.4, 1e-5);
  expectNoticed("a shader", 1,
    [&] {
      splats->SetSplatShaderCode("float d = length(offsetVCVSOutput.xy); if (d > 0.5) discard;");
    });
  EXPECT_NEAR(radius(2), 0.35 * 2.4, 1e-5);
  expectNoticed(
    "which draws who knows what", 1, [&] { splats->SetSplatShaderCode("opacity = 0.5;"); });
  EXPECT_EQ(scene.scene.instances.size(), Rods + 3);
  settings.onlyMarked = settings.unmarkedToo = true;
  collect(collector, scene);
  const auto reasons = scene.reasons;
  splats->SetSplatShaderCode(nullptr);
  collect(collector, scene);
  EXPECT_NE(scene.reasons, reasons) << "another reason for the same";
  settings.onlyMarked = settings.unmarkedToo = false;
  collect(collector, scene);
  expectNoticed("lines", 1, [&] { tubeActor->GetProperty()->RenderLinesAsTubesOff(); });
  EXPECT_EQ(scene.scene.instances.size(), 3u);
}

TEST_F(RoundProps, TheTranslucentCastNothing)
{
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(2);
  table->SetTableValue(0, 1.0, 1.0, 1.0, 1.0);
  table->SetTableValue(1, 1.0, 1.0, 1.0, 0.5);
  table->SetRange(0.5, 1.0);
  tubes->SetLookupTable(table);
  tubes->UseLookupTableScalarRangeOn();
  tubes->ScalarVisibilityOn(); // 0.5, 0.6, 0.7 | 0.8, 0.9, and 1.0 of the point
  splats->SetLookupTable(table);
  splats->UseLookupTableScalarRangeOn();
  collect(collector, scene);
  // Three splats, two segments, neither the point nor the triangle; and the ball.
  EXPECT_EQ(scene.scene.instances.size(), 3u + 2u + 1u);
  tubeActor->GetProperty()->SetOpacity(0.5);
  splatActor->GetProperty()->SetOpacity(0.5);
  collect(collector, scene);
  EXPECT_EQ(scene.scene.instances.size(), 1u);
}

TEST_F(RoundProps, OfColoursBetweenPointsOnlyTheTranslucentCastNothing)
{
  vtkNew<vtkColorTransferFunction> opaque; // what it answers for NaN nobody is asked
  opaque->AddRGBPoint(0.5, 0.2, 0.3, 0.8);
  opaque->AddRGBPoint(1.0, 0.8, 0.3, 0.2);
  tubes->SetLookupTable(opaque);
  tubes->InterpolateScalarsBeforeMappingOn();
  tubes->ScalarVisibilityOn();
  collect(collector, scene);
  EXPECT_EQ(scene.scene.instances.size(), Splats + Rods + 1 + 1 + 1);
  EXPECT_EQ(collector.judge(tubeActor).castsNone, nullptr);
  vtkProperty* property = tubeActor->GetProperty();
  property->SetRepresentationToWireframe();
  collect(collector, scene);
  EXPECT_EQ(scene.scene.instances.size(), Splats + Rods + 3 + 1 + 1) << "edges of the triangle";
  property->SetRepresentationToSurface();

  vtkNew<vtkLookupTable> table; // clear but for its ends
  table->SetNumberOfTableValues(8);
  for (int i = 0; i < 8; ++i)
  {
    table->SetTableValue(i, 1.0, 1.0, 1.0, i == 0 || i == 7 ? 1.0 : 0.5);
  }
  table->SetRange(0.5, 0.9);
  tubes->SetLookupTable(table);
  tubes->UseLookupTableScalarRangeOn();
  const auto rods = [this]
  {
    const auto& instances = scene.scene.instances;
    return std::count_if(instances.begin() + Splats, instances.end(),
      [](const Instance& one) { return one.localToWorld[3].y == 5.0; });
  };
  // From 0.5 to 0.6 and from 0.8 to 0.9 colours between the points are clear.
  collect(collector, scene);
  EXPECT_EQ(rods(), 0);
  table->SetTableValue(1, 1.0, 1.0, 1.0, 1.0);
  table->SetTableValue(2, 1.0, 1.0, 1.0, 1.0);
  tubes->Modified();
  collect(collector, scene);
  EXPECT_EQ(rods(), 1) << "one is opaque all along";
  EXPECT_NE(collector.judge(tubeActor).castsNone, nullptr);
}

TEST_F(RoundProps, RepresentationsAndBadInput)
{
  const double nan = std::nan("");
  vtkProperty* property = tubeActor->GetProperty();
  property->SetRepresentationToWireframe();
  collect(collector, scene);
  EXPECT_EQ(scene.scene.instances.size(), Splats + Rods + 3 + 1 + 1) << "edges of the triangle";
  property->SetRepresentationToPoints();
  collect(collector, scene);
  EXPECT_EQ(scene.scene.instances.size(), Splats + 6 + 1) << "each point once";
  property->SetRepresentationToSurface();
  lines->GetPoints()->SetPoint(2, nan, 0.0, 0.0);
  lines->GetPoints()->SetPoint(1, lines->GetPoints()->GetPoint(0));
  lines->GetPoints()->Modified();
  points->GetPoints()->SetPoint(1, 0.0, nan, 0.0);
  points->GetPoints()->Modified();
  collect(collector, scene);
  // Segments 0-1 has no length, 1-2 and 2-3 no place; the triangle is a line now.
  EXPECT_EQ(scene.scene.instances.size(), Splats - 1 + 1 + 1 + 1 + 1);
  property->SetLineWidth(1.0); // VTK draws no tubes then
  collect(collector, scene);
  EXPECT_EQ(scene.scene.instances.size(), Splats - 1 + 1 + 1 + 1);
}

TEST_F(RoundProps, AtTheEyeAndBehindIt)
{
  lines->GetPoints()->SetPoint(0, 0.0, -20.0, 10.0); // at the eye
  lines->GetPoints()->SetPoint(1, 0.0, -40.0, 20.0); // behind it
  lines->GetPoints()->Modified();
  collect(collector, scene);
  EXPECT_GT(scene.scene.instances.size(), Splats + Rods + 3) << "in pieces";
  for (const Instance& one : scene.scene.instances)
  {
    const double size = std::abs(glm::determinant(glm::dmat3(one.localToWorld)));
    EXPECT_TRUE(std::isfinite(size) && size > 0.0);
  }
}

TEST_F(RoundProps, LongLinesAreAsWideAsTheyLookAllAlong)
{
  renderer->RemoveAllViewProps();
  renderer->AddActor(tubeActor);
  vtkNew<vtkPolyData> line;
  vtkNew<vtkPoints> ends;
  const glm::dvec3 from(0.5, -16.0, 7.0), to(-3.0, 40.0, -20.0);
  ends->SetDataTypeToDouble();
  ends->InsertNextPoint(&from.x);
  ends->InsertNextPoint(&to.x);
  vtkNew<vtkCellArray> cells;
  const vtkIdType segment[] = { 0, 1 };
  cells->InsertNextCell(2, segment);
  line->SetPoints(ends);
  line->SetLines(cells);
  tubes->SetInputData(line);
  const auto check = [&]
  {
    glm::dvec3 at = from;
    for (std::size_t i = 0; i < scene.scene.instances.size(); ++i)
    {
      EXPECT_NEAR(glm::distance(glm::dvec3(matrix(i)[3]), at), 0.0, 1e-9) << "no gap";
      EXPECT_NEAR(radius(i) / length(4.0, at), 1.0, 0.126) << i;
      at = glm::dvec3(matrix(i) * glm::dvec4(0, 0, 1, 1));
      EXPECT_NEAR(radius(i) / length(4.0, at), 1.0, 0.126) << i;
    }
    EXPECT_NEAR(glm::distance(at, to), 0.0, 1e-9);
  };
  collect(collector, scene);
  const std::size_t many = scene.scene.instances.size();
  EXPECT_GT(many, 5u);
  check();
  renderer->GetActiveCamera()->Dolly(0.3);
  collect(collector, scene);
  EXPECT_EQ(collector.collectedAnew(), 0);
  EXPECT_LT(scene.scene.instances.size(), many);
  check();
  svo::SceneCollector fresh;
  CollectedScene other;
  collect(fresh, other);
  expectSame(scene, other, "with fewer pieces");
  renderer->GetActiveCamera()->Dolly(1.0 / 0.3);
  collect(collector, scene);
  EXPECT_EQ(scene.scene.instances.size(), many);
  check();
}
