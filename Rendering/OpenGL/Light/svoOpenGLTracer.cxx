#include "svoOpenGLTracer.h"

#include "svoColorAlpha.h"
#include "svoDrawnMaps.h"
#include "svoLightCode.h"
#include "svoOctreeArena.h"
#include "svoOctreeWalk.h"
#include "svoRayWalk.h"
#include "svoSeenSurfaces.h"
#include "svoShaderCasters.h"
#include "svoShadowMask.h"
#include "svoTerminator.h"

#include <algorithm>
#include <cstddef>
#include <iomanip>
#include <locale>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace svo
{
namespace
{
/// Lights that a shader asks, whatever room it has for more.
constexpr std::ptrdiff_t MostLights = 64;

/// The constants of svoOctreeWalk.glsl. They may stand twice in a shader.
std::string constantsOf(bool planes, bool alphas)
{
  return std::string("#define svoHasPlanes ") + (planes ? "true" : "false") +
    "\n#define svoHasAlphas " + (alphas ? "true" : "false") + "\n";
}

/// Those of svoRayWalk.glsl.
std::string constantsOf(std::size_t lights)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::showpoint << std::setprecision(9) << "const int svoLightCount = " << lights << ";\n"
       << "const float svoDoubtfulSine = " << DoubtfulSine << ";\n";
  return text.str();
}

/// What the eye sees: indices.
std::vector<std::size_t> seenOf(const Scene& scene)
{
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
  {
    const Instance& instance = scene.instances[i];
    if (instance.visible && instance.body->octree && !instance.body->octree.empty())
    {
      seen.push_back(i);
    }
  }
  return seen;
}

class OpenGLTracer : public Tracer
{
public:
  explicit OpenGLTracer(std::unique_ptr<Tracer> other)
    : Other(std::move(other))
  {
  }

  std::vector<NeededLevels> neededLevels(
    const Scene& scene, const View& view, const FrameSettings& settings) const override;
  void render(const Scene& scene, const View& view, const FrameSettings& settings,
    const ParallelFor& parallelFor) override;
  Frame& frame() override { return this->Answers ? this->Nothing : this->Other->frame(); }
  bool shareShadows(const Scene& scene, const View& view, const FrameSettings& settings,
    const ParallelFor& parallelFor, Processes& processes) override
  {
    return !settings.lightCode &&
      this->Other->shareShadows(scene, view, settings, parallelFor, processes);
  }
  void divideEdges(const Scene& scene, const View& view, const std::vector<glm::vec2>& positions,
    const ParallelFor& parallelFor, Silhouettes& result) const override
  {
    if (!this->Answers)
    {
      this->Other->divideEdges(scene, view, positions, parallelFor, result);
    }
  }
  const FrameStatistics& statistics() const override
  {
    return this->Answers ? this->Statistics : this->Other->statistics();
  }
  const std::vector<ShadowMap>& shadowMaps() const override
  {
    return this->Answers ? this->Drawn.maps() : this->Other->shadowMaps();
  }
  unsigned int mapTexture() const override
  {
    return this->Answers ? this->Drawn.texture() : this->Other->mapTexture();
  }
  const LightCode& lightCode() const override { return this->Code; }
  const EyeCode& eyeCode() const override { return this->Eye; }
  void releaseLayers() override { this->Other->releaseLayers(); }
  void releaseGraphicsResources() override;

private:
  std::string prepare(
    const Scene& scene, const View& view, const FrameSettings& settings, bool maps);
  std::string hold(const Scene& scene, std::size_t limit);
  std::size_t bytesOfScene() const
  {
    return this->Octrees.bytes() + this->Casters.bytes() + this->Seen.bytes();
  }
  void describe(const Scene& scene, const View& view, const std::string& constants);

  std::unique_ptr<Tracer> Other;
  bool Answers = false; // the last frame's light
  Frame Nothing;
  FrameStatistics Statistics;
  LightCode Code;
  EyeCode Eye;
  OctreeArena Octrees;
  SeenSurfaces Seen;
  ShaderCasters Casters;
  DrawnMaps Drawn;

  std::uint64_t Version = 0; // of the scene whose octrees are there
  std::size_t Limit = 0;     // that they were to keep
  std::string WhyNot;        // they are not in OpenGL's memory; empty: they are
};

std::vector<NeededLevels> OpenGLTracer::neededLevels(
  const Scene& scene, const View& view, const FrameSettings& settings) const
{
  std::vector<NeededLevels> needed = this->Other->neededLevels(scene, view, settings);
  for (std::size_t i = 0; settings.lightCode && i < needed.size(); ++i)
  {
    // Triangles are met exactly at any level: at this one there are few in a brick.
    const Body& body = *scene.instances[i].body;
    if (body.detailLevel > 0)
    {
      needed[i].eye = std::min(body.detailLevel, body.deepestLevel);
    }
    needed[i].lights = 0; // they see the eye's
  }
  return needed;
}

void OpenGLTracer::render(const Scene& scene, const View& view, const FrameSettings& settings,
  const ParallelFor& parallelFor)
{
  this->Code.lights.clear();
  this->Code.complaint.clear();
  this->Eye = EyeCode();
  const auto lights = settings.shadowTechnique == ShadowTechnique::None
    ? 0
    : std::count_if(scene.lights.begin(), scene.lights.end(),
        [](const Light& light) { return light.castShadow; });
  const bool asked = settings.lightCode && (lights > 0 || !seenOf(scene).empty());
  const bool maps = asked && lights > 0 && settings.shadowTechnique == ShadowTechnique::Buffer;
  if (!maps)
  {
    this->Drawn.forget();
  }
  if (asked)
  {
    std::string whyNot = "OpenGL shaders have no room for rays to so many lights";
    if (maps || lights <= MostLights)
    {
      whyNot = this->prepare(scene, view, settings, maps);
      const std::size_t mask = lights > 0 && !maps
        ? ShadowMask::bytesOf(view.width, view.height, static_cast<int>(lights))
        : 0;
      if (this->Octrees.holdsOthers() &&
        (!whyNot.empty() || this->bytesOfScene() + mask > settings.gpuMemoryLimit))
      {
        this->Octrees.release();
        this->Version = 0;
        whyNot = this->prepare(scene, view, settings, maps);
      }
    }
    if (!whyNot.empty())
    {
      this->Code.complaint = whyNot +
        (lights > 0 ? "; shadow maps are traced on the CPU instead."
                    : "; octrees are traced on the CPU instead.");
    }
  }
  this->Answers = asked && this->Code.complaint.empty();
  if (!this->Answers)
  {
    FrameSettings others = settings;
    others.lightCode = false;
    this->Other->render(scene, view, others, parallelFor);
    return;
  }
  const std::string constants =
    constantsOf(this->Seen.any() || this->Casters.hasPlanes(), this->Casters.alphas().size() > 0);
  if (lights > 0 && !maps)
  {
    this->describe(scene, view, constants);
  }
  this->Seen.describe(scene, view, this->Octrees, constants, this->Eye);
  this->Other->releaseLayers();
  this->Nothing.width = view.width;
  this->Nothing.height = view.height;
  this->Nothing.version = 1;
  this->Statistics = FrameStatistics();
  this->Statistics.lightsWithRays = static_cast<int>(this->Code.lights.size());
  this->Statistics.lightsWithBuffers = maps ? static_cast<int>(lights) : 0;
  this->Statistics.retracedLayers = this->Drawn.drawn();
  this->Drawn.widths().tell(this->Statistics);
  this->Statistics.shadowMemory = this->Drawn.mapBytes();
  this->Statistics.gpuMemory = this->bytesOfScene() + this->Drawn.bytes();
  this->Statistics.largestGap = this->Casters.largestGap(view);
}

/// Has all that a frame's rays meet in OpenGL's memory, or with `maps` what lights see. Why not,
/// else empty.
std::string OpenGLTracer::prepare(
  const Scene& scene, const View& view, const FrameSettings& settings, bool maps)
{
  const bool known =
    scene.version != 0 && scene.version == this->Version && this->Limit == settings.gpuMemoryLimit;
  if (!known)
  {
    this->WhyNot = this->hold(scene, settings.gpuMemoryLimit);
    if (!this->WhyNot.empty())
    {
      this->Octrees.release();
      this->Casters.release();
      this->Seen.release();
    }
    this->Version = scene.version;
    this->Limit = settings.gpuMemoryLimit;
  }
  if (this->WhyNot.empty() && !maps)
  {
    this->Casters.aim(view);
  }
  return this->WhyNot.empty() && maps
    ? this->Drawn.draw(scene, this->Casters.known(), this->Octrees, this->Casters.alphas(), view,
        settings, settings.gpuMemoryLimit - this->bytesOfScene())
    : this->WhyNot;
}

/// Has a scene's casters there, but for where the eye sees them. Why not, else empty.
std::string OpenGLTracer::hold(const Scene& scene, std::size_t limit)
{
  std::vector<const Octree*> octrees;
  for (const std::size_t index : castersOf(scene))
  {
    const Octree& octree = scene.instances[index].body->octree;
    if (!octree.surface() && !octree.hasPlanes())
    {
      return "OpenGL shaders meet no octrees without triangles or planes";
    }
    octrees.push_back(&octree);
  }
  const std::vector<std::size_t> seen = seenOf(scene);
  for (const std::size_t index : seen)
  {
    const Octree& octree = scene.instances[index].body->octree;
    if (!octree.hasPlanes())
    {
      return "OpenGL shaders trace nothing but planes";
    }
    octrees.push_back(&octree);
  }
  for (int once = 0; once < 2; ++once)
  {
    const bool held = this->Octrees.hold(octrees, limit);
    if (held && !(this->Casters.place(scene, this->Octrees) && this->Seen.place(scene, seen)))
    {
      return "OpenGL has no room for so many casters";
    }
    if (held && this->bytesOfScene() <= limit)
    {
      return {};
    }
    if (!this->Octrees.holdsOthers())
    {
      break;
    }
    this->Octrees.release();
  }
  return "The octrees do not fit into OpenGL's memory, or into GPUMemoryLimit";
}

/// Says what VTK's shaders need for a frame.
void OpenGLTracer::describe(const Scene& scene, const View& view, const std::string& constants)
{
  const glm::dmat3 turned(view.worldToView);
  LightCode::Floats sources{ "svoLights", 4, {} };
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
  {
    const Light& light = scene.lights[i];
    if (light.castShadow)
    {
      const glm::vec3 at(
        turned * (light.atInfinity() ? -light.direction : light.position - view.eye));
      sources.values.insert(
        sources.values.end(), { at.x, at.y, at.z, light.atInfinity() ? 0.0f : 1.0f });
      this->Code.lights.push_back(static_cast<int>(i));
    }
  }
  static const std::string Text = std::string(svoOctreeWalk) + svoColorAlpha + svoRayWalk;
  this->Code.constants = constants + constantsOf(this->Code.lights.size());
  this->Code.text = Text.c_str();
  this->Code.costly = true;
  this->Code.textures = { { "svoNodes", this->Octrees.nodes().name() },
    { "svoLists", this->Octrees.lists().name() },
    { "svoTriangles", this->Octrees.triangles().name() } };
  this->Code.integers.clear();
  this->Code.floats = { sources };
  this->Casters.describe(view, this->Code);
}

void OpenGLTracer::releaseGraphicsResources()
{
  this->Octrees.release();
  this->Casters.release();
  this->Seen.release();
  this->Drawn.release();
  this->Version = 0;
  this->Eye = EyeCode();
  this->Code.lights.clear();
  this->Code.textures.clear();
  this->Other->releaseGraphicsResources();
}
}

std::unique_ptr<Tracer> makeOpenGLTracer(std::unique_ptr<Tracer> other)
{
  return std::make_unique<OpenGLTracer>(std::move(other));
}
}
