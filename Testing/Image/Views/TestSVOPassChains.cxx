// Chains of VTK's render passes around this one: what they make of traced surfaces is what they
// make of rasterised ones. Without a camera's pass in a chain vtkRenderStepsPass is compared with,
// which brings its own.
#include "svoTestStage.h"

#include "vtkCameraPass.h"
#include "vtkCullerCollection.h"
#include "vtkEDLShading.h"
#include "vtkGaussianBlurPass.h"
#include "vtkLightsPass.h"
#include "vtkObjectFactory.h"
#include "vtkOpaquePass.h"
#include "vtkOpenGLFXAAPass.h"
#include "vtkPanoramicProjectionPass.h"
#include "vtkProperty.h"
#include "vtkRenderPassCollection.h"
#include "vtkRenderState.h"
#include "vtkRenderStepsPass.h"
#include "vtkSSAAPass.h"
#include "vtkSSAOPass.h"
#include "vtkSequencePass.h"
#include "vtkToneMappingPass.h"

#include <cstdlib>
#include <functional>
#include <iostream>

namespace
{
using PassPointer = vtkSmartPointer<vtkRenderPass>;

// The camera's pass around another one.
PassPointer withCamera(vtkRenderPass* inner)
{
  auto camera = vtkSmartPointer<vtkCameraPass>::New();
  camera->SetDelegatePass(inner);
  return camera;
}

PassPointer withOcclusion(vtkRenderPass* inner)
{
  auto occlusion = vtkSmartPointer<vtkSSAOPass>::New();
  occlusion->SetRadius(0.5);
  occlusion->SetKernelSize(64);
  occlusion->BlurOn();
  occlusion->SetDelegatePass(inner);
  return occlusion;
}

PassPointer withToneMapping(vtkRenderPass* inner)
{
  auto tones = vtkSmartPointer<vtkToneMappingPass>::New();
  tones->SetDelegatePass(inner);
  return tones;
}

PassPointer withPanorama(vtkRenderPass* inner)
{
  auto panorama = vtkSmartPointer<vtkPanoramicProjectionPass>::New();
  panorama->SetCubeResolution(256);
  panorama->SetAngle(360.0);
  panorama->SetDelegatePass(inner);
  return panorama;
}

// A pass that draws into a framebuffer of its own.
template <class Pass>
PassPointer within(vtkRenderPass* inner)
{
  auto pass = vtkSmartPointer<Pass>::New();
  pass->SetDelegatePass(inner);
  return pass;
}

PassPointer inSequence(vtkRenderPass* inner)
{
  vtkNew<vtkRenderPassCollection> steps;
  vtkNew<vtkLightsPass> lights;
  steps->AddItem(lights);
  steps->AddItem(inner);
  auto sequence = vtkSmartPointer<vtkSequencePass>::New();
  sequence->SetPasses(steps);
  return sequence;
}

// Stands for whatever somebody has drawn before.
class Backdrop : public vtkRenderPass
{
public:
  static Backdrop* New();
  vtkTypeMacro(Backdrop, vtkRenderPass);
  void Render(const vtkRenderState* state) override
  {
    vtkRenderer* renderer = state->GetRenderer();
    double before[3];
    renderer->GetBackground(before);
    renderer->SetBackground(0.9, 0.2, 0.1);
    renderer->Clear();
    renderer->SetBackground(before);
  }
};
vtkStandardNewMacro(Backdrop);

PassPointer onBackdrop(vtkRenderPass* inner)
{
  vtkNew<vtkRenderPassCollection> steps;
  vtkNew<Backdrop> backdrop;
  steps->AddItem(backdrop);
  steps->AddItem(inner);
  auto sequence = vtkSmartPointer<vtkSequencePass>::New();
  sequence->SetPasses(steps);
  return sequence;
}

// What VTK draws of opaque surfaces.
PassPointer rasteriser()
{
  vtkNew<vtkRenderPassCollection> steps;
  vtkNew<vtkLightsPass> lights;
  vtkNew<vtkOpaquePass> opaque;
  steps->AddItem(lights);
  steps->AddItem(opaque);
  auto sequence = vtkSmartPointer<vtkSequencePass>::New();
  sequence->SetPasses(steps);
  return sequence;
}
}

int TestSVOPassChains(int, char*[])
{
  using namespace svotest;
  Checks checks;
  struct Chain
  {
    const char* name;
    double intensity; // of the light
    std::function<PassPointer(vtkRenderPass*)> around;
    bool steps = false; // no camera's pass: compared with vtkRenderStepsPass
    bool part = false;  // of the window, not all of it
    bool unlit = false; // one of the surfaces
  };
  const Chain chains[] = {
    { "camera", 1.0, [](vtkRenderPass* inner) { return withCamera(inner); } },
    { "occlusion around the camera", 1.0,
      [](vtkRenderPass* inner) { return withOcclusion(withCamera(inner)); } },
    { "occlusion inside the camera", 1.0,
      [](vtkRenderPass* inner) { return withCamera(withOcclusion(inner)); } },
    { "occlusion beside an unlit surface", 1.0,
      [](vtkRenderPass* inner) { return withOcclusion(withCamera(inner)); }, false, false, true },
    { "occlusion under bright light", 3.0,
      [](vtkRenderPass* inner) { return withOcclusion(withCamera(inner)); } },
    { "tone mapping", 1.0,
      [](vtkRenderPass* inner) { return withToneMapping(withCamera(inner)); } },
    { "tone mapping under bright light", 4.0,
      [](vtkRenderPass* inner) { return withToneMapping(withCamera(inner)); } },
    { "tone mapping around occlusion", 4.0,
      [](vtkRenderPass* inner) { return withToneMapping(withOcclusion(withCamera(inner))); } },
    { "a panorama", 1.0, [](vtkRenderPass* inner) { return withPanorama(withCamera(inner)); } },
    { "something drawn before", 1.0,
      [](vtkRenderPass* inner) { return withCamera(onBackdrop(inner)); } },
    { "something drawn before in a framebuffer", 1.0,
      [](vtkRenderPass* inner) { return withToneMapping(withCamera(onBackdrop(inner))); } },
    { "occlusion alone", 1.0, withOcclusion, true },
    { "tone mapping alone", 4.0, withToneMapping, true },
    { "a panorama alone", 1.0, withPanorama, true },
    { "supersampling alone", 1.0, within<vtkSSAAPass>, true },
    { "supersampled occlusion alone", 1.0,
      [](vtkRenderPass* inner) { return within<vtkSSAAPass>(withOcclusion(inner)); }, true },
    { "FXAA alone", 1.0, within<vtkOpenGLFXAAPass>, true },
    { "eye dome lighting alone", 1.0, within<vtkEDLShading>, true },
    { "eye dome lighting alone in a part of the window", 1.0, within<vtkEDLShading>, true, true },
    { "blur alone", 1.0, within<vtkGaussianBlurPass>, true },
    { "a sequence alone", 1.0, inSequence, true },
    { "a blurred sequence alone", 1.0,
      [](vtkRenderPass* inner) { return within<vtkGaussianBlurPass>(inSequence(inner)); }, true },
  };
  for (const Chain& chain : chains)
  {
    for (const bool smooth : { false, true })
    {
      Stage stage;
      if (chain.part)
      {
        stage.renderer->SetViewport(0.2, 0.1, 0.9, 1.0);
      }
      stage.renderer->GetCullers()->RemoveAllItems(); // panoramas see what lies behind
      stage.addGround();
      vtkProperty* shining = stage.add(ball(0.7, -0.6, 0.3, 0.8), 0.9, 0.5, 0.3)->GetProperty();
      shining->SetSpecular(0.6);
      shining->SetSpecularPower(20.0);
      stage.add(box(0.8, 0.5, 0.6, 0.4), 0.4, 0.7, 0.9)->GetProperty()->SetLighting(!chain.unlit);
      // One that stays with the rasteriser.
      stage.add(ring(0.5, 0.8, -0.9, 0.6), 0.5, 0.9, 0.4)->GetProperty()->EdgeVisibilityOn();
      stage.addSun(2.0, -1.5, 4.0)->SetIntensity(chain.intensity);
      stage.pass->SetShadowTechniqueToNone();
      stage.pass->SetAntiAliasing(smooth);

      const auto shownBy = [&](vtkRenderPass* inner)
      {
        const PassPointer pass = chain.around(inner);
        stage.renderer->SetPass(pass);
        const Picture picture = capture(stage.window);
        stage.renderer->SetPass(nullptr);
        pass->ReleaseGraphicsResources(stage.window);
        return picture;
      };
      vtkNew<vtkRenderStepsPass> steps;
      vtkRenderPass* const whole = steps;
      const PassPointer opaque = rasteriser();
      const Picture raster = shownBy(chain.steps ? whole : opaque.Get());
      const Picture traced = shownBy(stage.pass);
      stage.expectTraced(checks, 3, "three actors are traced");
      stage.expectRasterized(checks, 1, "one is not");
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < raster.rgb.size(); i += 3)
      {
        bool differs = false;
        for (int c = 0; c < 3; ++c)
        {
          differs = differs || std::abs(int(raster.rgb[i + c]) - int(traced.rgb[i + c])) > 10;
        }
        wrong += differs;
      }
      std::cout << chain.name << (smooth ? ", smooth edges: " : ": ") << wrong
                << " pixels differ by more than 10 of 255\n";
      // Smooth edges are unlike the rasteriser's: as many pixels as without any chain.
      // Behind unlit surfaces the rasteriser leaves the positions of what it drew before.
      const std::size_t allowed = smooth ? 400 : chain.unlit ? 50 : 8;
      checks.expect(wrong <= allowed, std::string(chain.name) + ": VTK's own picture");
    }
  }
  return checks.exitCode();
}
