// Memory, the process's and the GPU's, stays what it is however long frames go on: while backends
// are switched, while an animation runs in a loop that there is no room to keep, and while each
// frame has another mesh.
#include "svoTestStage.h"

#include "vtkNew.h"
#include "vtkSphereSource.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iostream>
#include <string>

using namespace svotest;

namespace
{
/// From this frame on all caches are filled.
constexpr int Settled = 200;

/// What the GPU's memory is to stay within, KiB: the limit, where there is one. Of the loop five
/// poses are kept; as many may be gone, and one comes, of 320 KiB each. Half of that is spare, and
/// there is a mask: 5.5 MiB.
constexpr int MostOfGPU = 8000;

/// What the process may grow by once caches are filled, KiB. With software OpenGL the GPU's memory
/// lies in it, twice while a buffer grows, and allocators keep as much of what is freed. 0 to 10
/// MiB were seen. 40 KiB that each switch leaves behind are found, or 160 of each pose, whose
/// octree has 370.
constexpr long MostGrowth = 4 * MostOfGPU;

/// KiB of the process that lie in memory; 0 where that is not known, or says nothing: sanitizers
/// keep what is freed.
long resident()
{
  long pages = 0;
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  long all = 0;
  std::ifstream("/proc/self/statm") >> all >> pages;
#endif
  return pages * (sysconf(_SC_PAGESIZE) / 1024);
}

/// A ball of any radius on a ground.
struct Animation : Stage
{
  explicit Animation(bool rays)
    : Stage(120, 90)
  {
    this->addGround();
    this->ball->SetCenter(0.0, 0.0, 0.8);
    this->ball->SetThetaResolution(40);
    this->ball->SetPhiResolution(40);
    this->add(this->ball, 0.9, 0.3, 0.2);
    this->addSun(2.0, -1.5, 4.0);
    this->pass->SetMaximumLevel(7);
    this->pass->SetShadowBufferResolution(256);
    this->pass->SetBackendToOpenGL();
    rays ? this->pass->SetShadowTechniqueToShadowRays()
         : this->pass->SetShadowTechniqueToShadowBuffer();
  }

  /// Draws frames, each after a change.
  void play(
    const std::string& name, int frames, const std::function<void(int)>& change, Checks& checks)
  {
    vtkIdType most = 0;
    long before = 0, after = 0;
    for (int i = 0; i < frames; ++i)
    {
      change(i);
      this->window->Render();
      most = std::max(most, this->pass->GetGPUMemory());
      long& largest = i < Settled ? before : after;
      largest = std::max(largest, resident());
    }
    std::cout << name << ": at most " << most << " KiB of the GPU's, of the process's " << before
              << " in the first frames and " << after << " in the others\n";
    checks.expect(most > 0, name + ": OpenGL is at work");
    checks.expect(most <= MostOfGPU, name + ": within the GPU's limit");
    checks.expect(after <= before + MostGrowth, name + ": the process has what it had");
  }

  vtkNew<vtkSphereSource> ball;
};
}

int TestSVOGrowth(int, char*[])
{
  Checks checks;
  for (const bool rays : { true, false })
  {
    Animation stage(rays);
    stage.play(
      rays ? "switches, rays" : "switches, maps", 1000,
      [&](int i) {
        stage.pass->SetBackend(i % 2 == 0 ? stage.pass->BACKEND_OPENGL : stage.pass->BACKEND_CPU);
      },
      checks);
  }
  {
    Animation stage(true);
    stage.pass->SetOctreeMemoryLimit(2000);
    stage.play(
      "a loop", 400, [&](int i) { stage.ball->SetRadius(0.5 + 1e-3 * (i % 50)); }, checks);
  }
  {
    Animation stage(false);
    stage.pass->SetOctreeMemoryLimit(4000);
    stage.pass->SetGPUMemoryLimit(MostOfGPU);
    stage.play(
      "poses", 400, [&](int i) { stage.ball->SetRadius(0.5 + 1e-4 * i); }, checks);
  }
  return checks.exitCode();
}
