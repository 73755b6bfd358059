// Backend Auto: software takes the CPU, a GPU takes OpenGL where that is not slower. What is chosen
// is the picture of the backend itself.
#include "../../Unit/svoTestMessages.h"
#include "svoImageCases.h"
#include "svoTestStage.h"

#include "svoBackendChoice.h"
#include "svoSMPParallel.h"

#include "vtkAssembly.h"
#include "vtkImageToSVO.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"

#include <chrono>
#include <iostream>
#include <string>

using namespace svotest;

namespace
{
/// One that takes its window for a GPU.
class OnGPU : public vtkSVORenderPass
{
public:
  static OnGPU* New();
  vtkTypeMacro(OnGPU, vtkSVORenderPass);

  svo::RayRates Rates{ 2.0, 1.0, "" };
  mutable int Measured = 0;

protected:
  bool PrefersOpenGL(
    vtkOpenGLRenderWindow* window, bool rays, std::string& complaint) const override
  {
    const svo::BackendChoice choice = svo::chooseBackend(window, "A GPU", rays,
      [this, window]
      {
        ++this->Measured;
        const svo::RayRates rates = svo::measureRays(window, svo::smpParallelFor());
        return rates.complaint.empty() ? this->Rates : rates;
      });
    complaint = choice.complaint;
    return choice.openGL;
  }
};
vtkStandardNewMacro(OnGPU);

struct GPUStage : Stage
{
  GPUStage() { this->renderer->SetPass(this->gpu); }

  Picture draw(int backend)
  {
    this->gpu->SetBackend(backend);
    return capture(this->window);
  }
  /// That Auto makes the picture of a backend. `technique`: of shadows.
  void expect(
    int backend, const std::string& name, Checks& checks, int technique = OnGPU::SHADOW_RAYS)
  {
    this->gpu->SetShadowTechnique(technique);
    const Picture found = this->draw(OnGPU::BACKEND_AUTO);
    checks.expect(this->gpu->GetActiveBackend() == backend, name + ": it is the backend");
    const Picture expected = this->draw(backend);
    checks.expect(found.rgb == expected.rgb, name + ": its picture");
    checks.expect(
      expected.rgb != this->draw(OnGPU::BACKEND_CPU + OnGPU::BACKEND_OPENGL - backend).rgb,
      name + ": the other's differs");
  }

  vtkNew<OnGPU> gpu;
};

void addSolids(Stage& stage)
{
  stage.addGround();
  stage.add(ball(0.5, 0.0, 0.0, 0.8), 0.9, 0.3, 0.2);
  stage.add(ring(0.5, 1.0, -0.6, 0.6), 0.3, 0.4, 0.9);
  stage.addSun(3.0, -2.0, 4.0);
}

void choose(Checks& checks)
{
  GPUStage stage;
  svo::TestMessages messages{ stage.gpu };
  addSolids(stage);
  checks.expect(stage.gpu->GetActiveBackend() == OnGPU::BACKEND_CPU, "the CPU before a frame");
  const auto automatic = [&]
  {
    stage.gpu->SetShadowTechniqueToAutomatic();
    stage.draw(OnGPU::BACKEND_AUTO);
    checks.expect(stage.gpu->GetActiveBackend() == OnGPU::BACKEND_OPENGL, "Automatic has OpenGL");
    return stage.gpu->GetNumberOfLightsWithShadowRays();
  };
  stage.expect(OnGPU::BACKEND_OPENGL, "a fast GPU", checks);
  stage.expect(OnGPU::BACKEND_OPENGL, "once more", checks);
  checks.expect(automatic() == 1, "Automatic takes rays");
  stage.gpu->SetAmbientOcclusion(true);
  stage.expect(OnGPU::BACKEND_OPENGL, "a fast GPU, occlusion", checks, OnGPU::SHADOW_BUFFER);
  stage.gpu->SetAmbientOcclusion(false);
  checks.expect(stage.gpu->Measured == 1, "measured once");
  stage.gpu->Rates = { 1.0, 2.0, "" };
  stage.window->Finalize();
  stage.expect(OnGPU::BACKEND_OPENGL, "a slow GPU, maps", checks, OnGPU::SHADOW_BUFFER);
  checks.expect(stage.gpu->Measured == 1, "not measured for maps");
  stage.expect(OnGPU::BACKEND_CPU, "a slow GPU", checks);
  checks.expect(stage.gpu->Measured == 2, "measured in a new context");
  checks.expect(automatic() == 0, "and maps where rays are slow");
  stage.gpu->SetSkyLight(true);
  stage.expect(OnGPU::BACKEND_CPU, "a slow GPU, a sky", checks, OnGPU::SHADOW_BUFFER);
  stage.gpu->SetSkyLight(false);
  checks.expect(messages.all().empty(), "nothing is said: " + messages.all());
  stage.gpu->Rates = { 2.0, 1.0, "no shaders." };
  stage.window->Finalize();
  stage.expect(OnGPU::BACKEND_CPU, "a GPU that cannot", checks);
  stage.expect(OnGPU::BACKEND_CPU, "still", checks);
  checks.expect(messages.errors.empty() && messages.warnings.size() == 1 &&
      messages.warnings[0].find("no shaders.") != std::string::npos,
    "said once, and why: " + messages.all());
}

/// Surfaces that OpenGL would show a contour of are traced, whatever came before: those that share
/// their prop with a mesh.
void traceWithoutTriangles(Checks& checks)
{
  GPUStage stage;
  addSolids(stage);
  const ImageCase image = distanceCase();
  vtkNew<vtkImageToSVO> surface;
  surface->SetInputData(image.image);
  surface->SetValue(0, image.value);
  stage.expect(OnGPU::BACKEND_OPENGL, "triangles", checks);
  vtkSmartPointer<vtkActor> actor = stage.add(surface, 0.9, 0.5, 0.3);
  actor->SetPosition(0.0, 0.0, 1.2);
  stage.expect(OnGPU::BACKEND_OPENGL, "an image's surface", checks);
  stage.renderer->RemoveActor(actor);
  vtkNew<vtkAssembly> assembly;
  assembly->AddPart(actor);
  assembly->AddPart(stage.add(ball(0.2, 1.0, 1.0, 1.5), 0.2, 0.8, 0.3)); // drawn by itself, too
  stage.renderer->AddActor(assembly);
  stage.expect(OnGPU::BACKEND_CPU, "an image's surface in an assembly", checks);
  stage.gpu->SetBackendToAuto();
  stage.gpu->SetShadowTechniqueToNone();
  capture(stage.window);
  checks.expect(
    stage.gpu->GetActiveBackend() == OnGPU::BACKEND_CPU, "an image's surface without shadows");
  vtkSVORenderPass::SetUseSVO(false, assembly);
  capture(stage.window);
  checks.expect(
    stage.gpu->GetActiveBackend() == OnGPU::BACKEND_OPENGL, "left to VTK without shadows");
  stage.expect(OnGPU::BACKEND_OPENGL, "left to VTK", checks);
  vtkSVORenderPass::SetUseSVO(true, assembly);
  stage.expect(OnGPU::BACKEND_CPU, "traced again", checks);
  assembly->VisibilityOff();
  stage.expect(OnGPU::BACKEND_OPENGL, "without it", checks);
}

/// The measurement itself, which software OpenGL is not asked for.
void measure(Checks& checks)
{
  Stage stage;
  addSolids(stage);
  const Picture before = stage.shadowed();
  checks.expect(stage.pass->GetActiveBackend() == vtkSVORenderPass::BACKEND_CPU || drawnByOpenGL(),
    "software takes the CPU");
  stage.window->MakeCurrent();
  const auto start = std::chrono::steady_clock::now();
  const svo::RayRates rates =
    svo::measureRays(vtkOpenGLRenderWindow::SafeDownCast(stage.window), svo::smpParallelFor());
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  std::cout << "OpenGL " << 1e-6 * rates.openGL << ", the CPU " << 1e-6 * rates.cpu
            << " million pixels a second; measured in " << 1e3 * took.count() << " ms\n";
  checks.expect(rates.complaint.empty() && rates.openGL > 0.0 && rates.cpu > 0.0, "rates");
  checks.expect(before.rgb == stage.shadowed().rgb, "the picture is as it was");
}
}

int TestSVOBackendChoice(int, char*[])
{
  Checks checks;
  for (const char* name : { "llvmpipe (LLVM 15.0.6, 256 bits)", "softpipe",
         "Mesa X11 Software Rasterizer", "Software Rasterizer", "SWR (LLVM 11.0, 256 bits)",
         "GDI Generic", "Microsoft Basic Render Driver", "D3D12 (Microsoft Basic Render Driver)",
         "Apple Software Renderer", "Google SwiftShader" })
  {
    checks.expect(svo::isSoftwareRenderer(name), std::string(name) + " is software");
  }
  for (const char* name : { "NVIDIA H200/PCIe/SSE2", "NVIDIA GeForce RTX 4070/PCIe/SSE2",
         "AMD Radeon RX 6600 (navi23, LLVM 15.0.6, DRM 3.49, 6.1.0-18-amd64)",
         "Mesa Intel(R) UHD Graphics 620 (KBL GT2)", "Apple M2", "D3D12 (NVIDIA GeForce RTX 3060)",
         "zink Vulkan 1.3 (AMD Radeon RX 6600)", "SVGA3D; build: RELEASE;  LLVM;" })
  {
    checks.expect(!svo::isSoftwareRenderer(name), std::string(name) + " is a GPU");
  }
  measure(checks);
  choose(checks);
  traceWithoutTriangles(checks);
  return checks.exitCode();
}
