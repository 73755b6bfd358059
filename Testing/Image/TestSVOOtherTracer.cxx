// Other tracers than ours behind the pass: they know the tracer's face (svoTracer.h) and nothing
// else, and whatever picture they give is what the window shows, be it in arrays or on the GPU.
#include "svoTestStage.h"

#include "svoTracer.h"

#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkTextureObject.h"

#include <iostream>

using namespace svotest;

namespace
{
/// Sees a green wall in front of everything in the left half, wherever there is something to be
/// seen.
class Wall : public svo::Tracer
{
public:
  std::vector<svo::NeededLevels> neededLevels(
    const svo::Scene& scene, const svo::View&, const svo::FrameSettings&) const override
  {
    ++Asked;
    return std::vector<svo::NeededLevels>(scene.instances.size(), { 3, 0 });
  }
  void render(const svo::Scene& scene, const svo::View& view, const svo::FrameSettings&,
    const svo::ParallelFor&) override
  {
    svo::Frame& frame = this->Picture;
    const std::size_t pixels = static_cast<std::size_t>(view.width) * view.height;
    frame.width = view.width;
    frame.height = view.height;
    frame.covered = { 0, 0, view.width, view.height };
    frame.color.assign(4 * pixels, 0);
    frame.depth.assign(pixels, 1.0f);
    for (std::size_t i = 0; i < pixels; ++i)
    {
      if (static_cast<int>(i % view.width) < view.width / 2)
      {
        frame.color[4 * i + 1] = frame.color[4 * i + 3] = 255;
        frame.depth[i] = 0.25f;
      }
    }
    Level = scene.instances.empty() ? 0 : scene.instances[0].body->octree.level();
    ++Frames;
  }
  svo::Frame& frame() override { return this->Picture; }
  bool shareShadows(const svo::Scene&, const svo::View&, const svo::FrameSettings&,
    const svo::ParallelFor&, svo::Processes&) override
  {
    return false;
  }
  void divideEdges(const svo::Scene&, const svo::View&, const std::vector<glm::vec2>&,
    const svo::ParallelFor&, svo::Silhouettes&) const override
  {
  }
  const svo::FrameStatistics& statistics() const override { return this->Statistics; }
  const std::vector<svo::ShadowMap>& shadowMaps() const override { return this->Maps; }
  void releaseLayers() override {}

  static int Frames, Asked, Level;

protected:
  svo::Frame Picture;

private:
  svo::FrameStatistics Statistics;
  std::vector<svo::ShadowMap> Maps;
};
int Wall::Frames = 0;
int Wall::Asked = 0;
int Wall::Level = 0;

/// The same wall in textures of the window's context, and in no array.
class WallOnGPU : public Wall
{
public:
  void render(const svo::Scene& scene, const svo::View& view, const svo::FrameSettings& settings,
    const svo::ParallelFor& parallelFor) override
  {
    this->Wall::render(scene, view, settings, parallelFor);
    svo::Frame& frame = this->Picture;
    const auto width = static_cast<unsigned int>(frame.width);
    const auto height = static_cast<unsigned int>(frame.height);
    this->Color->SetContext(Window);
    this->Color->Create2DFromRaw(width, height, 4, VTK_UNSIGNED_CHAR, frame.color.data());
    this->Depth->SetContext(Window);
    this->Depth->Create2DFromRaw(width, height, 1, VTK_FLOAT, frame.depth.data());
    frame.images.color = this->Color->GetHandle();
    frame.images.depth = this->Depth->GetHandle();
    frame.color.clear();
    frame.depth.clear();
  }
  void releaseGraphicsResources() override
  {
    Released += this->Picture.onGPU() && Window->IsCurrent();
    this->Color->ReleaseGraphicsResources(Window);
    this->Depth->ReleaseGraphicsResources(Window);
    this->Picture = svo::Frame();
  }

  static vtkOpenGLRenderWindow* Window;
  static int Released;

private:
  vtkNew<vtkTextureObject> Color, Depth;
};
vtkOpenGLRenderWindow* WallOnGPU::Window = nullptr;
int WallOnGPU::Released = 0;

class WallPass : public vtkSVORenderPass
{
public:
  static WallPass* New();
  vtkTypeMacro(WallPass, vtkSVORenderPass);
  bool OnGPU = false;

protected:
  std::unique_ptr<svo::Tracer> MakeTracer() const override
  {
    if (this->OnGPU)
    {
      return std::make_unique<WallOnGPU>();
    }
    return std::make_unique<Wall>();
  }
};
vtkStandardNewMacro(WallPass);
}

int TestSVOOtherTracer(int, char*[])
{
  Checks checks;
  Stage stage(120, 90);
  vtkNew<vtkSphereSource> sphere;
  stage.add(sphere, 0.9, 0.2, 0.2);
  vtkNew<vtkSphereSource> larger; // beside the wall and behind it
  larger->SetRadius(0.9);
  stage.add(larger, 0.2, 0.3, 0.9)->GetProperty()->SetRepresentationToWireframe();
  stage.addSun(3.0, 0.5, 1.5);
  vtkNew<WallPass> pass;
  stage.renderer->SetPass(pass);
  const Picture picture = capture(stage.window);
  std::size_t green = 0;
  for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
  {
    green += picture.rgb[i] == 0 && picture.rgb[i + 1] == 255 && picture.rgb[i + 2] == 0;
  }
  std::cout << green << " green pixels, octree of level " << Wall::Level << "\n";
  checks.expect(green == 60 * 90, "the window shows the other tracer's picture");
  checks.expect(Wall::Frames == 1, "it was asked for one frame");
  checks.expect(Wall::Asked > 0, "it was asked how deep octrees have to be");
  checks.expect(Wall::Level == 3, "the octree is as deep as it said");

  WallOnGPU::Window = vtkOpenGLRenderWindow::SafeDownCast(stage.window);
  {
    vtkNew<WallPass> onGPU;
    onGPU->OnGPU = true;
    stage.renderer->SetPass(onGPU);
    checks.expect(capture(stage.window).rgb == picture.rgb, "a picture on the GPU is shown alike");
    checks.expect(WallOnGPU::Released == 0, "its textures are left alone");
    stage.window->Finalize();
    checks.expect(WallOnGPU::Released == 1, "they are released before the context goes");
    checks.expect(capture(stage.window).rgb == picture.rgb, "and made in the next one");
    stage.renderer->SetPass(nullptr);
  }
  checks.expect(WallOnGPU::Released == 2, "and with the pass");
  return checks.exitCode();
}
