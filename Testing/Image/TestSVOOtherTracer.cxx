// Another tracer than ours behind the pass: it knows the tracer's face (svoTracer.h) and nothing
// else, and whatever picture it gives is what the window shows.
#include "svoTestStage.h"

#include "svoTracer.h"

#include "vtkObjectFactory.h"
#include "vtkSphereSource.h"

#include <iostream>

using namespace svotest;

namespace
{
/// Sees a green wall in front of everything, wherever there is something to be seen.
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
    const svo::ParallelFor&, svo::Frame& frame) override
  {
    const std::size_t pixels = static_cast<std::size_t>(view.width) * view.height;
    frame.width = view.width;
    frame.height = view.height;
    frame.covered = { 0, 0, view.width, view.height };
    frame.color.assign(4 * pixels, 255);
    for (std::size_t i = 0; i < pixels; ++i)
    {
      frame.color[4 * i] = frame.color[4 * i + 2] = 0;
    }
    frame.depth.assign(pixels, 0.25f);
    frame.instance.assign(pixels, 0);
    frame.primitive.assign(pixels, 0);
    Level = scene.instances.empty() ? 0 : scene.instances[0].body->octree.level();
    ++Frames;
  }
  bool shareShadows(const svo::Scene&, const svo::View&, const svo::FrameSettings&,
    const svo::ParallelFor&, svo::Processes&) override
  {
    return false;
  }
  void divideEdges(const svo::Scene&, const svo::View&, const svo::Frame&,
    const std::vector<glm::vec2>&, const svo::ParallelFor&, svo::Silhouettes&) const override
  {
  }
  const svo::FrameStatistics& statistics() const override { return this->Statistics; }
  const std::vector<svo::ShadowMap>& shadowMaps() const override { return this->Maps; }
  void releaseLayers() override {}

  static int Frames, Asked, Level;

private:
  svo::FrameStatistics Statistics;
  std::vector<svo::ShadowMap> Maps;
};
int Wall::Frames = 0;
int Wall::Asked = 0;
int Wall::Level = 0;

class WallPass : public vtkSVORenderPass
{
public:
  static WallPass* New();
  vtkTypeMacro(WallPass, vtkSVORenderPass);

protected:
  std::unique_ptr<svo::Tracer> MakeTracer() const override { return std::make_unique<Wall>(); }
};
vtkStandardNewMacro(WallPass);
}

int TestSVOOtherTracer(int, char*[])
{
  Checks checks;
  Stage stage(120, 90);
  vtkNew<vtkSphereSource> sphere;
  stage.add(sphere, 0.9, 0.2, 0.2);
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
  checks.expect(green == 120 * 90, "the window shows the other tracer's picture");
  checks.expect(Wall::Frames == 1, "it was asked for one frame");
  checks.expect(Wall::Asked > 0, "it was asked how deep octrees have to be");
  checks.expect(Wall::Level == 3, "the octree is as deep as it said");
  return checks.exitCode();
}
