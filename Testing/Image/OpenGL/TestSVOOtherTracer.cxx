// Other tracers than ours behind the pass: they know the tracer's face (svoTracer.h), and whatever
// pictures and shadow maps they give are what the window shows, be they in arrays or on the GPU.
#include "../../Unit/svoTestMessages.h"
#include "svoImageCases.h"
#include "svoTestStage.h"

#include "svoEyeCode.h"
#include "svoLightCode.h"
#include "svoOpenGL.h"
#include "svoOpenGLTracer.h"
#include "svoStateGuard.h"
#include "svoTextures.h"
#include "svoTracer.h"

#include "vtkImageToSVO.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkProperty.h"
#include "vtkSphereSource.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <iostream>
#include <vector>

#include <glm/vec4.hpp>

using namespace svotest;

namespace
{
/// One that knows no other processes and no edges.
class Other : public svo::Tracer
{
public:
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
  const std::vector<svo::ShadowMap>& shadowMaps() const override { return this->Maps; }

protected:
  svo::Frame Picture;
  std::vector<svo::ShadowMap> Maps;
};

/// Sees a green wall in front of everything in the left half, wherever there is something to be
/// seen.
class Wall : public Other
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
  const svo::FrameStatistics& statistics() const override { return this->Statistics; }
  void releaseLayers() override {}

  static int Frames, Asked, Level;

private:
  svo::FrameStatistics Statistics;
};
int Wall::Frames = 0;
int Wall::Asked = 0;
int Wall::Level = 0;

/// Sees the same wall, and has it on textures: there is no array anywhere.
class DrawnWall : public Other
{
public:
  std::vector<svo::NeededLevels> neededLevels(
    const svo::Scene& scene, const svo::View&, const svo::FrameSettings&) const override
  {
    return std::vector<svo::NeededLevels>(scene.instances.size(), { 3, 0 });
  }
  void render(const svo::Scene&, const svo::View& view, const svo::FrameSettings&,
    const svo::ParallelFor&) override
  {
    this->releaseGraphicsResources();
    this->Picture.width = view.width;
    this->Picture.height = view.height;
    this->Picture.covered = { 0, 0, view.width, view.height };
    this->Picture.images.color = draw(view, GL_RGBA8, { 0, 0, 0, 0 }, { 0, 1, 0, 1 });
    this->Picture.images.depth = draw(view, GL_R32F, { 1, 0, 0, 0 }, { 0.25f, 0, 0, 0 });
  }
  const svo::FrameStatistics& statistics() const override { return this->Statistics; }
  void releaseLayers() override {}
  void releaseGraphicsResources() override
  {
    const GLuint textures[] = { this->Picture.images.color, this->Picture.images.depth };
    glDeleteTextures(2, textures);
    this->Picture = svo::Frame();
  }

private:
  /// A texture that has `left` in its left half, and `right` elsewhere.
  static GLuint draw(
    const svo::View& view, GLenum format, const glm::vec4& right, const glm::vec4& left)
  {
    const svo::StateGuard guard;
    const GLuint texture = svo::makeTexture(format, view.width, view.height);
    GLuint framebuffer = 0;
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDisable(GL_SCISSOR_TEST);
    glClearBufferfv(GL_COLOR, 0, &right.x);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, view.width / 2, view.height);
    glClearBufferfv(GL_COLOR, 0, &left.x);
    glDeleteFramebuffers(1, &framebuffer);
    return texture;
  }

  svo::FrameStatistics Statistics;
};

/// One of ours, which hands out other things.
class Altered : public Other
{
public:
  explicit Altered(std::unique_ptr<svo::Tracer> ours)
    : Ours(std::move(ours))
  {
  }
  std::vector<svo::NeededLevels> neededLevels(const svo::Scene& scene, const svo::View& view,
    const svo::FrameSettings& settings) const override
  {
    return this->Ours->neededLevels(scene, view, settings);
  }
  const svo::FrameStatistics& statistics() const override { return this->Ours->statistics(); }
  void releaseLayers() override { this->Ours->releaseLayers(); }

protected:
  std::unique_ptr<svo::Tracer> Ours;
};

/// What it hands out, shadow maps as well, lies in the window's context, and nothing in arrays.
class OnGPU : public Altered
{
public:
  OnGPU()
    : Altered(svo::makeCPUTracer())
  {
  }
  void render(const svo::Scene& scene, const svo::View& view, const svo::FrameSettings& settings,
    const svo::ParallelFor& parallelFor) override
  {
    this->Ours->render(scene, view, settings, parallelFor);
    const svo::Frame& frame = this->Ours->frame();
    this->Picture = svo::Frame();
    this->Picture.width = frame.width;
    this->Picture.height = frame.height;
    this->Picture.version = frame.version;
    this->Picture.covered = frame.covered;
    this->Picture.tiles = frame.tiles;
    const auto send = [&](vtkTextureObject* texture, int components, int type, const void* values)
    {
      texture->SetContext(Window);
      texture->Create2DFromRaw(
        frame.width, frame.height, components, type, const_cast<void*>(values));
      return texture->GetHandle();
    };
    this->Picture.images.color = send(this->Color, 4, VTK_UNSIGNED_CHAR, frame.color.data());
    this->Picture.images.depth = send(this->Depth, 1, VTK_FLOAT, frame.depth.data());
    this->Maps = this->Ours->shadowMaps();
    this->sendMaps();
  }
  unsigned int mapTexture() const override { return this->Texels; }
  void releaseGraphicsResources() override
  {
    Released += Window->IsCurrent() ? 1 : 100;
    for (vtkTextureObject* texture : { this->Color.Get(), this->Depth.Get() })
    {
      texture->ReleaseGraphicsResources(Window);
    }
    glDeleteTextures(1, &this->Texels);
    this->Texels = 0;
    this->Picture = svo::Frame();
    this->Maps.clear();
  }

  static vtkOpenGLRenderWindow* Window;
  static int Released;
  static std::size_t Sent; // maps

private:
  /// A layer for each map.
  void sendMaps()
  {
    const int size = this->Maps.empty() ? 1 : this->Maps[0].view.width;
    const auto texels = static_cast<std::size_t>(size) * size;
    std::vector<float> numbers;
    for (svo::ShadowMap& map : this->Maps)
    {
      map.layer = static_cast<int>(numbers.size() / (2 * texels));
      for (std::size_t i = 0; i < texels; ++i)
      {
        const int x = static_cast<int>(i % size), y = static_cast<int>(i / size);
        numbers.push_back(std::min(map.texels->depthAt(x, y), 3e38f));
        numbers.push_back(map.group > 0 ? map.texels->shareAt(x, y) : 0.0f);
      }
      map.texels = nullptr;
    }
    const auto layers = static_cast<GLsizei>(this->Maps.size());
    glDeleteTextures(1, &this->Texels);
    this->Texels = svo::makeTexture(GL_RG32F, size, size, std::max(layers, 1));
    GLint bound = 0;
    glGetIntegerv(GL_TEXTURE_BINDING_2D_ARRAY, &bound);
    glBindTexture(GL_TEXTURE_2D_ARRAY, this->Texels);
    glTexSubImage3D(
      GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, size, size, layers, GL_RG, GL_FLOAT, numbers.data());
    glBindTexture(GL_TEXTURE_2D_ARRAY, static_cast<GLuint>(bound));
    Sent = this->Maps.size();
  }

  vtkNew<vtkTextureObject> Color, Depth;
  GLuint Texels = 0;
};
vtkOpenGLRenderWindow* OnGPU::Window = nullptr;
int OnGPU::Released = 0;
std::size_t OnGPU::Sent = 0;

/// OpenGL's, with code that OpenGL does not compile.
class Misspelt : public Altered
{
public:
  Misspelt()
    : Altered(svo::makeOpenGLTracer(svo::makeCPUTracer()))
  {
  }
  void render(const svo::Scene& scene, const svo::View& view, const svo::FrameSettings& settings,
    const svo::ParallelFor& parallelFor) override
  {
    this->Ours->render(scene, view, settings, parallelFor);
    this->Picture = this->Ours->frame();
    this->Maps = this->Ours->shadowMaps();
    this->Code = this->Ours->lightCode();
    this->Eye = this->Ours->eyeCode();
    (InEye ? this->Eye.text : this->Code.text) = "float svoLeft(misspelt\n";
    Asked += !this->Code.empty();
  }
  const svo::LightCode& lightCode() const override { return this->Code; }
  const svo::EyeCode& eyeCode() const override { return this->Eye; }
  void releaseGraphicsResources() override { this->Ours->releaseGraphicsResources(); }

  static int Asked;
  static bool InEye; // that is misspelt

private:
  svo::LightCode Code;
  svo::EyeCode Eye;
};
int Misspelt::Asked = 0;
bool Misspelt::InEye = false;

template <class T>
class PassOf : public vtkSVORenderPass
{
public:
  static PassOf* New() { VTK_STANDARD_NEW_BODY(PassOf); }

protected:
  std::unique_ptr<svo::Tracer> MakeTracer() const override { return std::make_unique<T>(); }
};

/// What is traced, and what is rasterised and receives, look as they do from arrays.
void compareOnGPU(Checks& checks)
{
  Stage stage(200, 150);
  stage.add(ball(0.4, -0.5, 0.2, 0.6), 0.9, 0.3, 0.2);
  stage.add(ball(0.3, 0.5, 0.3, 0.7), 0.3, 0.4, 0.9)->GetProperty()->SetOpacity(0.5);
  vtkSVORenderPass::SetUseSVO(false, stage.addGround(2.0));
  stage.addSun(2.0, -1.5, 3.0);
  stage.addBulb(-1.0, 0.5, 2.5);
  const Picture lit = stage.unshadowed();
  const Picture expected = stage.shadowed();
  checks.expect(difference(lit, expected).largest > 30, "there are shadows");
  // VTK's own rasteriser rounds otherwise in a context that is made again.
  stage.window->Finalize();
  const Picture expectedAgain = capture(stage.window);
  stage.window->Finalize();

  OnGPU::Window = vtkOpenGLRenderWindow::SafeDownCast(stage.window);
  {
    vtkNew<PassOf<OnGPU>> pass;
    stage.renderer->SetPass(pass);
    checks.expect(
      capture(stage.window).rgb == expectedAgain.rgb, "pictures on the GPU are shown alike");
    std::cout << OnGPU::Sent << " shadow maps on the GPU\n";
    checks.expect(OnGPU::Sent > 2, "maps of both kinds of casters are there");
    checks.expect(OnGPU::Released == 0, "textures are left alone");
    stage.window->Finalize();
    checks.expect(OnGPU::Released == 1, "they are released before the context goes");
    checks.expect(capture(stage.window).rgb == expectedAgain.rgb, "and made in the next one");
    stage.renderer->SetPass(nullptr);
    capture(stage.window); // mappers hold passes until they draw without
  }
  checks.expect(OnGPU::Released == 2, "and with the pass");
}

/// Code that is refused, for lights or for the eye: the CPU takes its place, and that is said once.
void compareRefused(bool inEye, Checks& checks)
{
  Misspelt::Asked = 0;
  Misspelt::InEye = inEye;
  Stage stage(200, 150);
  stage.add(ball(0.4, -0.5, 0.2, 0.6), 0.9, 0.3, 0.2);
  stage.addGround(2.0);
  stage.addSun(2.0, -1.5, 3.0);
  if (inEye)
  {
    const ImageCase image = distanceCase();
    vtkNew<vtkImageToSVO> surface;
    surface->SetInputData(image.image);
    surface->SetValue(0, image.value);
    stage.add(surface, 0.9, 0.5, 0.3)->SetPosition(0.3, 0.0, 1.2);
  }
  stage.pass->SetBackendToOpenGL();
  const Picture lit = stage.unshadowed();
  const Picture expected = stage.shadowedByBuffers();
  vtkNew<PassOf<Misspelt>> pass;
  pass->SetMaximumLevel(9);
  pass->SetBackendToOpenGL();
  pass->SetShadowTechniqueToAutomatic();
  svo::TestMessages messages{ pass };
  stage.renderer->SetPass(pass);
  for (int frame = 0; frame < 3; ++frame)
  {
    const Picture found = capture(stage.window);
    checks.expect(difference(lit, found).largest > 30, "there are shadows where code is refused");
    checks.expect(difference(expected, found).mean < 0.1, "the CPU's maps are asked instead");
  }
  std::cout << messages.all();
  checks.expect(Misspelt::Asked == 1, "refused code is not made again");
  checks.expect(messages.errors.empty() && messages.warnings.size() == 1 &&
      messages.warnings[0].find("OpenGL refuses") != std::string::npos,
    "that is said once");
}
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
  vtkNew<PassOf<Wall>> pass;
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
  vtkNew<PassOf<DrawnWall>> drawn;
  stage.renderer->SetPass(drawn);
  checks.expect(
    capture(stage.window).rgb == picture.rgb, "a tracer without arrays shows the same wall");

  compareOnGPU(checks);
  compareRefused(false, checks);
  compareRefused(true, checks);
  return checks.exitCode();
}
