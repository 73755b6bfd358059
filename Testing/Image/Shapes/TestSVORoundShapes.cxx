// What VTK draws for points and lines without polygons casts as the bodies do that it looks like,
// and does not shade itself.
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkCellArray.h"
#include "vtkColorTransferFunction.h"
#include "vtkFloatArray.h"
#include "vtkMath.h"
#include "vtkOpenGLSphereMapper.h"
#include "vtkPointData.h"
#include "vtkPointGaussianMapper.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkTubeFilter.h"
#include "vtkVersion.h"

#include <cmath>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace
{
using namespace svotest;

constexpr int Width = 500, Height = 400;
const char Disc[] = "//VTK::Color::Impl\n"
                    "float dist = dot(offsetVCVSOutput.xy,offsetVCVSOutput.xy);\n"
                    "if (dist > 1.0) {\n  discard;\n}\n";

/// A polyline of many segments, its points as vertices, and an array "size".
vtkSmartPointer<vtkPolyData> wave(int count, bool line)
{
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkFloatArray> size;
  size->SetName("size");
  if (line)
  {
    cells->InsertNextCell(count);
  }
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double s = static_cast<double>(i) / (count - 1);
    points->InsertNextPoint(4.0 * s - 2.0, 1.2 * std::sin(7.0 * s), 0.7 + 0.4 * std::cos(11.0 * s));
    size->InsertNextValue(static_cast<float>(0.5 + s));
    if (line)
    {
      cells->InsertCellPoint(i);
    }
    else
    {
      cells->InsertNextCell(1, &i);
    }
  }
  mesh->SetPoints(points);
  mesh->GetPointData()->AddArray(size);
  line ? mesh->SetLines(cells) : mesh->SetVerts(cells);
  return mesh;
}

/// Of a place of the stage, world units.
double pixelAt(vtkRenderer* renderer, const double place[3])
{
  vtkCamera* camera = renderer->GetActiveCamera();
  if (camera->GetParallelProjection())
  {
    return 2.0 * camera->GetParallelScale() / Height;
  }
  double axis[3], eye[3], away[3];
  camera->GetDirectionOfProjection(axis);
  camera->GetPosition(eye);
  vtkMath::Subtract(place, eye, away);
  const double half = vtkMath::RadiansFromDegrees(0.5 * camera->GetViewAngle());
  return 2.0 * vtkMath::Dot(axis, away) * std::tan(half) / Height;
}

/// The reference: balls of the points, of a radius each.
void addBalls(Stage& stage, vtkPolyData* points, const std::function<double(vtkIdType)>& radius)
{
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    vtkNew<vtkSphereSource> source;
    source->SetCenter(points->GetPoint(i));
    source->SetRadius(radius(i));
    source->SetThetaResolution(64);
    source->SetPhiResolution(33);
    stage.add(source, 0.9, 0.5, 0.2);
  }
}

/// The reference: a tube that gets wider where the line is farther away.
void addTube(Stage& stage, vtkPolyData* line, double pixels)
{
  vtkNew<vtkPolyData> input;
  input->ShallowCopy(line);
  vtkNew<vtkFloatArray> radii;
  for (vtkIdType i = 0; i < line->GetNumberOfPoints(); ++i)
  {
    radii->InsertNextValue(
      static_cast<float>(0.5 * pixels * pixelAt(stage.renderer, line->GetPoint(i))));
  }
  input->GetPointData()->SetScalars(radii);
  auto tube = vtkSmartPointer<vtkTubeFilter>::New();
  tube->SetInputData(input);
  tube->SetNumberOfSides(32);
  tube->CappingOn();
  tube->SetVaryRadiusToVaryRadiusByAbsoluteScalar();
  stage.add(tube, 0.9, 0.5, 0.2);
}

struct Case
{
  std::string name;
  std::function<void(Stage&, vtkActor*)> draw; // by VTK's own means
  std::function<void(Stage&)> reference;       // the same bodies as meshes
  bool receives = true;
  double otherShare = 0.0; // of the shadow's pixels
};

vtkSmartPointer<vtkPolyData> points()
{
  return wave(14, false);
}

vtkSmartPointer<vtkPolyData> line()
{
  return wave(150, true);
}

void setSplats(vtkActor* actor, const char* sizes)
{
  vtkNew<vtkPointGaussianMapper> mapper;
  mapper->SetInputData(points());
  mapper->ScalarVisibilityOff();
  mapper->EmissiveOff();
  mapper->SetSplatShaderCode(Disc);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0)
  mapper->SetBoundScale(1.0f);
#else
  mapper->SetTriangleScale(1.0f);
#endif
  mapper->SetScaleFactor(0.16);
  mapper->SetScaleArray(sizes);
  actor->SetMapper(mapper);
}

void setMesh(vtkActor* actor, vtkPolyData* mesh)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  actor->SetMapper(mapper);
}

std::vector<Case> cases()
{
  const auto tubes = [](Stage&, vtkActor* actor)
  {
    setMesh(actor, line());
    actor->GetProperty()->RenderLinesAsTubesOn();
    actor->GetProperty()->SetLineWidth(12.0);
  };
  const auto coloredTubes = [=](Stage& s, vtkActor* actor)
  {
    tubes(s, actor);
    vtkNew<vtkColorTransferFunction> colors;
    colors->AddRGBPoint(0.5, 0.9, 0.5, 0.2);
    colors->AddRGBPoint(1.5, 0.9, 0.9, 0.2);
    vtkMapper* mapper = actor->GetMapper();
    mapper->SetLookupTable(colors);
    mapper->InterpolateScalarsBeforeMappingOn();
    mapper->SetScalarModeToUsePointFieldData();
    mapper->SelectColorArray("size");
  };
  const auto spheres = [](Stage&, vtkActor* actor)
  {
    setMesh(actor, points());
    actor->GetProperty()->RenderPointsAsSpheresOn();
    actor->GetProperty()->SetPointSize(24.0);
  };
  const auto ofPixels = [](Stage& s)
  {
    const auto at = points();
    addBalls(s, at, [&](vtkIdType i) { return 12.0 * pixelAt(s.renderer, at->GetPoint(i)); });
  };
  const auto parallel = [](Stage& s)
  {
    s.renderer->GetActiveCamera()->ParallelProjectionOn();
    s.renderer->GetActiveCamera()->SetParallelScale(2.6);
  };
  return {
    { "splats", [](Stage&, vtkActor* a) { setSplats(a, nullptr); },
      [](Stage& s) { addBalls(s, points(), [](vtkIdType) { return 0.16; }); }, false, 0.01 },
    { "splats with sizes", [](Stage&, vtkActor* a) { setSplats(a, "size"); },
      [](Stage& s) { addBalls(s, points(), [](vtkIdType i) { return 0.16 * (0.5 + i / 13.0); }); },
      false, 0.01 },
    { "spheres of a sphere mapper",
      [](Stage&, vtkActor* actor)
      {
        vtkNew<vtkOpenGLSphereMapper> mapper;
        mapper->SetInputData(points());
        mapper->SetRadius(0.16f);
        actor->SetMapper(mapper);
      },
      [](Stage& s) { addBalls(s, points(), [](vtkIdType) { return 0.16; }); }, true, 0.01 },
    { "points as spheres", spheres, ofPixels, true, 0.01 },
    { "points as spheres, parallel",
      [=](Stage& s, vtkActor* a)
      {
        parallel(s);
        spheres(s, a);
      },
      [=](Stage& s)
      {
        parallel(s);
        ofPixels(s);
      },
      true, 0.01 },
    { "lines as tubes", tubes, [](Stage& s) { addTube(s, line(), 12.0); }, true, 0.02 },
    { "lines as tubes, colours between points", coloredTubes,
      [](Stage& s) { addTube(s, line(), 12.0); }, true, 0.02 },
    { "lines as tubes, parallel",
      [=](Stage& s, vtkActor* a)
      {
        parallel(s);
        tubes(s, a);
      },
      [=](Stage& s)
      {
        parallel(s);
        addTube(s, line(), 12.0);
      },
      true, 0.02 },
  };
}

struct Pictures
{
  Picture unshadowed, shadowed;
  bool dark(std::size_t i) const
  {
    return this->shadowed.grey(i) < this->unshadowed.grey(i) - 20.0;
  }
};

Pictures shadowsOf(Stage& stage)
{
  stage.addGround();
  stage.addSun(2.0, -1.5, 4.0);
  return { stage.unshadowed(), stage.shadowed() };
}

void expectAsMeshes(const Case& one, Checks& checks)
{
  Stage empty(Width, Height), stage(Width, Height), meshes(Width, Height);
  vtkNew<vtkActor> actor;
  actor->GetProperty()->SetColor(0.9, 0.5, 0.2);
  stage.renderer->AddActor(actor);
  one.draw(stage, actor);
  empty.renderer->GetActiveCamera()->DeepCopy(stage.renderer->GetActiveCamera());
  one.reference(meshes);
  const Pictures ground = shadowsOf(empty), own = shadowsOf(stage), real = shadowsOf(meshes);
  stage.usePass(false);
  const Picture raster = capture(stage.window);
  checks.expect(difference(raster, own.unshadowed).p99 == 0, one.name + ": VTK's own picture");
  const std::string reason = vtkSVORenderPass::GetReason(actor);
  checks.expect(vtkSVORenderPass::GetCastShadow(actor), one.name + " casts: " + reason);

  // On the ground where both show it.
  std::size_t dark = 0, other = 0, body = 0, shaded = 0;
  for (std::size_t i = 0; i < ground.unshadowed.size(); ++i)
  {
    const auto shows = [&](const Pictures& p)
    { return std::abs(p.unshadowed.depth[i] - ground.unshadowed.depth[i]) < 1e-6; };
    if (shows(own) && shows(real))
    {
      dark += real.dark(i) ? 1 : 0;
      other += real.dark(i) != own.dark(i) ? 1 : 0;
    }
    else if (!shows(own))
    {
      ++body;
      shaded += own.dark(i) && !real.dark(i) ? 1 : 0;
    }
  }
  std::cout << one.name << ": " << other << " of " << dark
            << " pixels of the shadow are others; of " << body << " on bodies " << shaded
            << " are dark that should not be\n";
  checks.expect(dark > 2500, one.name + ": there is a shadow");
  checks.expect(static_cast<double>(other) <= one.otherShare * static_cast<double>(dark),
    one.name + ": as the same bodies as meshes");
  checks.expect(static_cast<double>(shaded) <= 0.01 * static_cast<double>(body),
    one.name + ": they do not shade themselves");
  if (!one.receives)
  {
    std::size_t changed = 0;
    for (std::size_t i = 0; i < ground.unshadowed.size(); ++i)
    {
      const bool onBody = own.unshadowed.depth[i] != ground.unshadowed.depth[i];
      changed += onBody && own.unshadowed.grey(i) != own.shadowed.grey(i) ? 1 : 0;
    }
    checks.expect(changed == 0, one.name + ": VTK lights no splats, so no shadow falls on them");
  }
}

/// On bodies that shadows of others fall on.
void expectReceived(Checks& checks)
{
  for (const Case& one : cases())
  {
    if (!one.receives)
    {
      continue;
    }
    Stage stage(Width, Height);
    vtkNew<vtkActor> actor;
    stage.renderer->AddActor(actor);
    one.draw(stage, actor);
    stage.add(box(6.0, 0.0, 0.0, 9.0), 1.0, 1.0, 1.0); // between them and the sun, out of sight
    stage.addGround();
    stage.addSun(0.0, 0.0, 4.0);
    const Picture lit = stage.unshadowed(), dark = stage.shadowed();
    std::size_t body = 0, left = 0;
    for (std::size_t i = 0; i < lit.size(); ++i)
    {
      const unsigned char* color = lit.rgb.data() + 3 * i;
      const bool drawn = lit.depth[i] < 1.0f && color[0] > 40 && color[1] > 40;
      body += drawn ? 1 : 0;
      left += drawn && dark.grey(i) > 1.0 ? 1 : 0;
    }
    std::cout << one.name << " in the shadow: " << left << " of " << body << " are lit\n";
    checks.expect(body > 5000 && left * 1000 < body, one.name + ": shadows fall on them");
  }
}

/// One wide line, which no other shadow can fall on. It is near the eye at one end.
void expectNoOwnShadow(Checks& checks)
{
  for (const double half : { 1.5, 3.0 })
  {
    Stage stage(Width, Height);
    vtkNew<vtkPoints> points;
    points->InsertNextPoint(-half, 0.0, 0.5);
    points->InsertNextPoint(half, 0.0, 0.5);
    vtkNew<vtkCellArray> lines;
    lines->InsertNextCell({ 0, 1 });
    vtkNew<vtkPolyData> line;
    line->SetPoints(points);
    line->SetLines(lines);
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(line);
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetLineWidth(20.0f);
    actor->GetProperty()->RenderLinesAsTubesOn();
    stage.renderer->AddActor(actor);
    stage.addGround();
    stage.addSun(4.0, -1.0, 3.0);
    vtkCamera* camera = stage.renderer->GetActiveCamera();
    camera->SetPosition(-2.0, -5.0, 4.0);
    camera->SetFocalPoint(0.0, 0.0, 0.0);
    camera->SetViewUp(0.0, 0.0, 1.0);
    stage.renderer->ResetCameraClippingRange();
    Stage ground(Width, Height);
    ground.addGround();
    ground.renderer->SetActiveCamera(camera);
    ground.addSun(4.0, -1.0, 3.0);
    const Picture without = ground.unshadowed(), lit = stage.unshadowed();
    for (const bool rays : { false, true })
    {
      const Picture dark = rays ? stage.shadowedByRays() : stage.shadowedByBuffers();
      std::size_t body = 0, own = 0, cast = 0;
      for (std::size_t i = 0; i < lit.size(); ++i)
      {
        const bool drawn = lit.depth[i] != without.depth[i];
        const bool darker = lit.grey(i) > dark.grey(i) + 8.0;
        body += drawn ? 1 : 0;
        own += drawn && darker ? 1 : 0;
        cast += !drawn && darker ? 1 : 0;
      }
      std::cout << "a line of " << 2.0 * half << (rays ? ", rays: " : ", buffers: ") << own
                << " of " << body << " pixels are in its own shadow\n";
      checks.expect(body > 3000 && cast > 500, "a line is seen, and its shadow");
      checks.expect(own == 0, "a line does not lie in its own shadow");
    }
  }
}
}

int TestSVORoundShapes(int, char*[])
{
  Checks checks;
  for (const Case& one : cases())
  {
    expectAsMeshes(one, checks);
  }
  expectReceived(checks);
  expectNoOwnShadow(checks);
  return checks.exitCode();
}
