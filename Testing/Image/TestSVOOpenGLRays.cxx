// With the OpenGL backend VTK draws all that is seen, and its shaders send a ray through the
// octrees to each light: the picture is VTK's own where light comes, and lit or dark as the CPU's
// exact rays say.
#include "svoTestStage.h"

#include "vtkCamera.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"
#include "vtkProperty.h"
#include "vtkTransform.h"

#include <cmath>
#include <functional>
#include <iostream>
#include <string>

using namespace svotest;

namespace
{
/// Pixels in which the two differ as light and shadow do: by far.
constexpr int Lit = 24; // of 255

struct Tally
{
  std::size_t pixels = 0, inShadow = 0, other = 0;
};

Tally compare(const Picture& lit, const Picture& expected, const Picture& found)
{
  Tally tally;
  for (std::size_t i = 0; i + 2 < found.rgb.size(); i += 3)
  {
    const auto away = [i](const Picture& a, const Picture& b)
    {
      int most = 0;
      for (std::size_t k = i; k < i + 3; ++k)
      {
        most = std::max(most, std::abs(int(a.rgb[k]) - int(b.rgb[k])));
      }
      return most;
    };
    ++tally.pixels;
    tally.inShadow += away(lit, expected) > Lit;
    tally.other += away(expected, found) > Lit;
  }
  return tally;
}

void compare(const std::string& name, Stage& stage, double mostOther, Checks& checks)
{
  stage.pass->SetBackendToCPU();
  const Picture lit = stage.unshadowed();
  const Picture expected = stage.shadowedByRays();
  stage.pass->SetBackendToOpenGL();
  const Picture found = stage.shadowedByRays();
  const Tally tally = compare(lit, expected, found);
  std::cout << name << ": " << tally.inShadow << " of " << tally.pixels << " pixels in shadow, "
            << tally.other << " others, " << stage.pass->GetGPUMemory() << " KiB\n";
  checks.expect(tally.inShadow > tally.pixels / 50, name + ": there are shadows");
  checks.expect(stage.pass->GetActiveBackend() == vtkSVORenderPass::BACKEND_OPENGL,
    name + ": OpenGL is at work");
  checks.expect(stage.pass->GetGPUMemory() > 0, name + ": octrees lie in the GPU's memory");
  checks.expect(stage.pass->GetNumberOfPrimaryRays() == 0, name + ": the CPU traces nothing");
  checks.expect(tally.other <= mostOther * tally.pixels, name + ": lit and dark as the CPU says");
}

/// Solids on a ground, moved and stretched.
void addSolids(Stage& stage)
{
  stage.addGround();
  stage.add(ball(0.5, 0.0, 0.0, 0.8), 0.9, 0.3, 0.2);
  vtkActor* boxActor = stage.add(box(0.6, 0.0, 0.0, 0.0), 0.2, 0.6, 0.3);
  boxActor->SetPosition(-1.1, 0.4, 0.5);
  boxActor->RotateWXYZ(33.0, 1.0, 2.0, 0.5);
  boxActor->SetScale(1.0, 0.5, 1.6);
  stage.add(ring(0.5, 1.0, -0.6, 0.6), 0.3, 0.4, 0.9);
  vtkActor* spikeActor = stage.add(spike(1.4, 0.0, 0.0, 0.7), 0.8, 0.8, 0.3);
  spikeActor->SetPosition(0.6, 1.2, 0.0);
}
}

int TestSVOOpenGLRays(int, char*[])
{
  Checks checks;
  {
    Stage stage;
    addSolids(stage);
    stage.addSun(3.0, -2.0, 4.0);
    compare("a sun", stage, 3e-4, checks);
  }
  {
    Stage stage;
    addSolids(stage);
    stage.addSun(3.0, -2.0, 4.0);
    stage.addBulb(-1.0, 0.6, 2.5);
    compare("a sun and a bulb", stage, 3e-4, checks);
  }
  return checks.exitCode();
}
