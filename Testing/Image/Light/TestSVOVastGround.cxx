// A ball above a bumpy ground that casts, too, and is far wider than what is seen of it: its shadow
// is that of rays, on a traced ground and on a rasterised one, and where it cannot be, the pass
// says so.
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkCommand.h"
#include "vtkPlaneSource.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTrivialProducer.h"

#include <cmath>
#include <iostream>
#include <string>

namespace
{
using namespace svotest;

vtkSmartPointer<vtkAlgorithm> bumpyGround(double half, int cells)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-half, -half, 0.0);
  plane->SetPoint1(half, -half, 0.0);
  plane->SetPoint2(-half, half, 0.0);
  plane->SetResolution(cells, cells);
  plane->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  plane->Update();
  vtkNew<vtkPolyData> ground;
  ground->DeepCopy(plane->GetOutput());
  ground->GetPointData()->Initialize();
  vtkPoints* points = ground->GetPoints();
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    double p[3];
    points->GetPoint(i, p);
    points->SetPoint(i, p[0], p[1], 0.05 * (std::sin(0.7 * p[0]) * std::cos(0.9 * p[1]) - 1.0));
  }
  auto source = vtkSmartPointer<vtkTrivialProducer>::New();
  source->SetOutput(ground);
  return source;
}

struct Grounded
{
  Stage stage{ 400, 300 };
  vtkActor* ground;

  explicit Grounded(double half, int cells = 60)
  {
    this->ground = this->stage.add(bumpyGround(half, cells), 0.8, 0.8, 0.75);
    this->stage.add(ball(0.5, 0.0, 0.0, 0.8), 0.9, 0.5, 0.3);
    this->stage.addSun(3.0, -2.0, 5.0);
  }
};

std::size_t apart(const Picture& a, const Picture& b)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    count += std::abs(a.grey(i) - b.grey(i)) > 8.0;
  }
  return count;
}

class Warnings : public vtkCommand
{
public:
  static Warnings* New() { return new Warnings; }
  void Execute(vtkObject*, unsigned long, void* text) override
  {
    this->text += static_cast<const char*>(text);
    ++this->count;
  }
  std::string text;
  int count = 0;
};
}

int TestSVOVastGround(int, char*[])
{
  Checks checks;
  for (const double half : { 200.0, 600.0, 1e4, 1e5 })
  {
    Grounded scene(half);
    vtkNew<Warnings> none;
    scene.stage.pass->AddObserver(vtkCommand::WarningEvent, none);
    const Picture lit = scene.stage.unshadowed();
    const Picture rays = scene.stage.shadowedByRays();
    const Picture buffer = scene.stage.shadowedByBuffers();
    const std::size_t dark = apart(lit, rays);
    const std::size_t wrong = apart(buffer, rays);
    vtkSVORenderPass::SetUseSVO(false, scene.ground);
    const std::size_t wrongOnRaster = apart(scene.stage.shadowedByBuffers(), rays);
    const std::string name = "half width " + std::to_string(static_cast<int>(half));
    std::cout << name << ": " << dark << " dark pixels, " << wrong << " wrong, " << wrongOnRaster
              << " on a rasterised ground\n";
    checks.expect(dark > 1000, name + ": there is a shadow");
    // Floats in the cube of the last one resolve 0.024, two pixels: so wide is the shadow's border.
    const std::size_t border = half > 1e4 ? dark / 10 : dark / 20;
    checks.expect(wrong < border, name + ": the shadow is that of rays");
    checks.expect(none->count == 0, name + ": nothing is said");
    checks.expect(wrongOnRaster < border, name + ": rasterised grounds have it");
  }

  vtkNew<Warnings> warnings;
  Grounded endless(1e7);
  endless.stage.pass->AddObserver(vtkCommand::WarningEvent, warnings);
  endless.stage.shadowed();
  endless.stage.shadowed();
  checks.expect(warnings->count == 1 && warnings->text.find("vast") != std::string::npos,
    "shadows that are lost are said to be, once");
  endless.stage.renderer->GetActiveCamera()->Yaw(180.0);
  endless.ground->SetPosition(0.0, 2e7, 0.0);
  vtkNew<Warnings> unseen;
  vtkNew<vtkSVORenderPass> another;
  chooseBackend(another);
  another->AddObserver(vtkCommand::WarningEvent, unseen);
  endless.stage.renderer->SetPass(another);
  capture(endless.stage.window);
  checks.expect(unseen->text.find("vast") == std::string::npos, "but where they are not seen");
  vtkNew<Warnings> coarse;
  Grounded rough(1e5);
  rough.stage.pass->AddObserver(vtkCommand::WarningEvent, coarse);
  rough.stage.pass->SetShadowBufferResolution(16);
  rough.stage.shadowedByBuffers();
  rough.stage.renderer->GetActiveCamera()->Azimuth(1.0);
  rough.stage.shadowedByBuffers();
  checks.expect(coarse->count == 1 && coarse->text.find("texels") != std::string::npos,
    "maps that stay coarse are said to be, once");
  // Two maps of 2048 x 2048 texels, at 12 bytes each, OpenGL's at 4, hold casters nearly
  // everywhere.
  vtkNew<Warnings> fewer;
  Grounded fine(3.0);
  fine.stage.pass->AddObserver(vtkCommand::WarningEvent, fewer);
  fine.stage.addSun(-3.0, -2.0, 5.0);
  fine.stage.shadowedByBuffers();
  checks.expect(fewer->count == 0, "of maps that there is room for nothing is said");
  fine.stage.pass->SetShadowMemoryLimit(24 * 1024);
  fine.stage.shadowedByBuffers();
  fine.stage.shadowedByBuffers();
  checks.expect(fewer->count == 1 && fewer->text.find("24 MiB") != std::string::npos,
    "maps that have fewer texels than were asked for are said to, once");
  return checks.exitCode();
}
