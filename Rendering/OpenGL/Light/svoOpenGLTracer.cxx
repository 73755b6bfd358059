#include "svoOpenGLTracer.h"

#include "svoAroundValues.h"
#include "svoBufferTexture.h"
#include "svoColorAlpha.h"
#include "svoDrawnMaps.h"
#include "svoFrameInputs.h"
#include "svoHeldScene.h"
#include "svoHemisphereRays.h"
#include "svoLightCode.h"
#include "svoLightFilter.h"
#include "svoOctreeWalk.h"
#include "svoRayWalk.h"
#include "svoSampleCount.h"
#include "svoSampleSequence.h"
#include "svoSceneChanges.h"
#include "svoShadowMask.h"
#include "svoShadowVolumes.h"
#include "svoSkyPicture.h"
#include "svoTerminator.h"
#include "svoUnfold.h"

#include <algorithm>
#include <cstddef>
#include <iomanip>
#include <locale>
#include <memory>
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

/// Those of svoRayWalk.glsl, and where there are samples of svoSkyShader.glsl and
/// svoSampleMeans.glsl.
std::string constantsOf(const LightCode& code, const FrameSettings& settings)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::showpoint << std::setprecision(9) << "const int svoLightCount = " << code.count()
       << ";\n"
       << "const float svoDoubtfulSine = " << DoubtfulSine << ";\n";
  if (!code.sampled.empty())
  {
    std::vector<int> sums(static_cast<std::size_t>(code.count()), LightCode::None);
    for (std::size_t layer = 0; layer < code.sampled.size(); ++layer)
    {
      const int number = code.sampled[layer].number;
      for (int part = 0; part < (number == code.sky ? 3 : 1); ++part)
      {
        sums[static_cast<std::size_t>(number + part)] = 4 * static_cast<int>(layer) + part;
      }
    }
    text << sampleConstants(code, sums, settings);
  }
  return text.str();
}

/// What of a scene's light has no shadow that one ray a pixel could tell.
int sampledOf(const Scene& scene, const FrameSettings& settings)
{
  const auto soft = settings.shadowTechnique != ShadowTechnique::Rays
    ? 0
    : std::count_if(scene.lights.begin(), scene.lights.end(),
        [](const Light& light) { return light.castShadow && light.soft(); });
  return static_cast<int>(soft) + settings.ambientOcclusion + settings.skyLight;
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
  const ReceiverShares& receiverShares() const override
  {
    return this->Answers ? Tracer::receiverShares() : this->Other->receiverShares();
  }
  void sampleReceivers(const Scene& scene, const View& view, const ReceiverPlaces& places,
    bool same, const ParallelFor& parallelFor) override
  {
    if (!this->Answers)
    {
      this->Other->sampleReceivers(scene, view, places, same, parallelFor);
    }
  }
  const LightCode& lightCode() const override { return this->Code; }
  const EyeCode& eyeCode() const override { return this->Eye; }
  void releaseLayers() override { this->Other->releaseLayers(); }
  void releaseGraphicsResources() override;

private:
  std::string prepare(
    const Scene& scene, const View& view, const FrameSettings& settings, bool maps);
  void describe(const Scene& scene, const View& view, const FrameSettings& settings,
    const std::string& constants);
  void describeSamples(const Scene& scene, const View& view, const FrameSettings& settings);

  std::unique_ptr<Tracer> Other;
  bool Answers = false; // the last frame's light
  Frame Nothing;
  FrameStatistics Statistics;
  LightCode Code;
  EyeCode Eye;
  HeldScene Held;
  DrawnMaps Drawn;
  ShadowVolumes Volumes;
  BufferTexture Sky{ BufferTexture::Texel::Float }; // the picture's table
  std::uint64_t SkyOf = 0;                          // its version

  SceneFollower Instances; // while something is sampled
  FrameInputs Inputs;      // likewise
  UsualOcclusionDistance UsualDistance;
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
  LightCode code;
  code.samples = this->Code.samples;
  code.picture = this->Code.picture;
  this->Code = std::move(code);
  this->Eye = EyeCode();
  const auto lights = settings.shadowTechnique == ShadowTechnique::None
    ? 0
    : std::count_if(scene.lights.begin(), scene.lights.end(),
        [](const Light& light) { return light.castShadow; });
  const int sampled = settings.lightCode ? sampledOf(scene, settings) : 0;
  const bool asked = settings.lightCode &&
    (lights > 0 || sampled > 0 || !instancesOf(scene, &Instance::visible).empty());
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
      const std::size_t mask = (lights > 0 && !maps) || sampled > 0
        ? ShadowMask::bytesOf(view.width, view.height,
            static_cast<int>(lights) + settings.ambientOcclusion + 3 * settings.skyLight, sampled,
            false, settings.shadowVolumes)
        : 0;
      const bool fits = whyNot.empty() && this->Held.bytes() + mask <= settings.gpuMemoryLimit;
      if (!fits && this->Held.releaseOthers())
      {
        whyNot = this->prepare(scene, view, settings, maps);
      }
    }
    if (!whyNot.empty())
    {
      this->Code.complaint = whyNot +
        (lights > 0 ? "; shadow maps are traced on the CPU instead."
                    : "; octrees are traced on the CPU instead.") +
        (settings.asksHemispheres() ? " There is neither a sky's light nor ambient occlusion."
                                    : "");
    }
  }
  this->Answers = asked && this->Code.complaint.empty();
  if (!this->Answers)
  {
    this->Volumes.release();
    FrameSettings others = settings;
    others.lightCode = false;
    this->Other->render(scene, view, others, parallelFor);
    return;
  }
  const std::string constants = constantsOf(this->Held.seen.any() || this->Held.casters.hasPlanes(),
    this->Held.casters.alphas().size() > 0);
  int samples = 0;
  if ((lights > 0 && !maps) || sampled > 0)
  {
    this->describe(scene, view, settings, constants);
    samples = this->Code.samples;
  }
  if (settings.shadowVolumes && !maps && lights > 0)
  {
    const std::size_t others = this->Held.bytes() +
      ShadowMask::bytesOf(view.width, view.height, this->Code.count(), 0, false, true);
    this->Code.remark = this->Volumes.describe(scene, this->Held.casters.known(),
      this->Held.octrees(), view, settings,
      settings.gpuMemoryLimit - std::min(others, settings.gpuMemoryLimit), parallelFor, this->Code);
    if (this->Volumes.lacksRoom() && this->Held.releaseOthers())
    {
      this->render(scene, view, settings, parallelFor);
      return;
    }
  }
  if (!this->Code.volumes)
  {
    this->Volumes.release();
  }
  this->Held.seen.describe(scene, view, this->Held.octrees(), constants, this->Eye);
  this->Other->releaseLayers();
  this->Nothing.width = view.width;
  this->Nothing.height = view.height;
  this->Nothing.version = 1;
  this->Statistics = FrameStatistics();
  this->Statistics.lightSamples = samples;
  this->Statistics.lightNoise = samples > 0 ? -1.0 : 0.0; // nothing is read back
  this->Statistics.lightsWithRays = static_cast<int>(this->Code.lights.size());
  this->Statistics.lightsWithBuffers = maps ? static_cast<int>(lights) : 0;
  this->Statistics.shadowVolumes = this->Volumes.volumes();
  this->Statistics.contourEdges = this->Volumes.contourEdges();
  this->Statistics.sparedCasters = this->Volumes.spared();
  this->Statistics.retracedLayers = this->Drawn.drawn();
  this->Drawn.widths().tell(this->Statistics);
  this->Statistics.shadowMemory = this->Drawn.mapBytes();
  this->Statistics.gpuMemory = this->Held.bytes() + this->Volumes.bytes() + this->Drawn.bytes();
  this->Statistics.largestGap = this->Held.casters.largestGap(view);
}

/// Has all that a frame's rays meet in OpenGL's memory, or with `maps` what lights see. Why not,
/// else empty.
std::string OpenGLTracer::prepare(
  const Scene& scene, const View& view, const FrameSettings& settings, bool maps)
{
  const std::string& whyNot = this->Held.hold(scene, settings);
  if (!whyNot.empty())
  {
    return whyNot;
  }
  if (!maps)
  {
    this->Held.casters.aim(view);
    return {};
  }
  return this->Drawn.draw(scene, this->Held.casters.known(), this->Held.octrees(),
    this->Held.casters.alphas(), view, settings,
    settings.gpuMemoryLimit - std::min(this->Held.bytes(), settings.gpuMemoryLimit));
}

/// Says what VTK's shaders need for a frame.
void OpenGLTracer::describe(
  const Scene& scene, const View& view, const FrameSettings& settings, const std::string& constants)
{
  const glm::dmat3 turned(view.worldToView);
  LightCode::Floats sources{ "svoLights", 4, {} };
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
  {
    const Light& light = scene.lights[i];
    if (light.castShadow && settings.shadowTechnique != ShadowTechnique::None)
    {
      const glm::vec3 at(
        turned * (light.atInfinity() ? -light.direction : light.position - view.eye));
      sources.values.insert(
        sources.values.end(), { at.x, at.y, at.z, light.atInfinity() ? 0.0f : 1.0f });
      if (light.soft())
      {
        this->Code.sampled.push_back(
          { static_cast<int>(this->Code.lights.size()), static_cast<unsigned>(i),
            static_cast<float>(light.atInfinity() ? light.spread() : light.radius()) });
      }
      this->Code.lights.push_back(static_cast<int>(i));
    }
  }
  static const std::string Text =
    std::string(svoUnfold) + svoOctreeWalk + svoColorAlpha + svoRayWalk;
  this->Code.text = Text.c_str();
  this->Code.costly = true;
  this->Code.textures = { { "svoNodes", this->Held.octrees().nodes().name() },
    { "svoLists", this->Held.octrees().lists().name() },
    { "svoTriangles", this->Held.octrees().triangles().name() } };
  this->describeSamples(scene, view, settings);
  this->Code.constants = constants + constantsOf(this->Code, settings);
  sources.values.resize(4 * static_cast<std::size_t>(this->Code.count()));
  this->Code.floats.push_back(sources);
  this->Held.casters.describe(view, this->Code);
}

/// Adds what is all around, and says how many samples there are.
void OpenGLTracer::describeSamples(
  const Scene& scene, const View& view, const FrameSettings& settings)
{
  LightCode& code = this->Code;
  code.unlit = scene.lights.empty();
  if (settings.ambientOcclusion)
  {
    code.occlusion = code.count();
    const double distance = settings.ambientOcclusionDistance;
    code.sampled.push_back({ code.occlusion, HemisphereRays::OcclusionStream,
      static_cast<float>(
        std::min(distance > 0.0 ? distance : this->UsualDistance.of(scene), 1e30)) });
  }
  if (settings.skyLight)
  {
    code.sky = code.count();
    code.sampled.push_back({ code.sky, HemisphereRays::SkyStream, 1e30f });
  }
  const glm::ivec2 shift = noiseShift(view);
  code.integers.push_back({ "svoNoiseShift", { shift.x, shift.y } });
  addAroundValues(settings, view, code);
  if (settings.skyLight && settings.skyPicture)
  {
    const SkyPicture& picture = *settings.skyPicture;
    const std::vector<float>& table = picture.table();
    if (this->SkyOf != picture.version() && this->Sky.allocate(table.size()))
    {
      this->Sky.send(0, table.data(), table.size());
      this->SkyOf = picture.version();
    }
    code.textures.push_back({ "svoSkyTable", this->Sky.name() });
    code.integers.push_back({ "svoSkySize", { picture.columns(), picture.rows() } });
  }
  if (code.sampled.empty())
  {
    this->Inputs.forget();
    code.samples = 0;
    return;
  }
  const FrameChanges changes{ this->Inputs.differ(scene, view, settings),
    this->Instances.follow(scene).instances };
  const SampleCount samples(scene, settings, changes, code.samples);
  code.samples = samples.count;
  code.picture += !changes.none();
  const double edge = std::max(
    2.0 / (view.viewToClip[0][0] * view.width), 2.0 / (view.viewToClip[1][1] * view.height));
  code.floats.push_back({ "svoFilter", 4,
    { static_cast<float>(view.parallel ? 0.0 : edge),
      static_cast<float>(view.parallel ? edge : 0.0), static_cast<float>(code.samples),
      settings.filterLightSamples ? 1.0f : 0.0f } });
}

void OpenGLTracer::releaseGraphicsResources()
{
  this->Held.release();
  this->Drawn.release();
  this->Volumes.forget();
  this->Sky.release();
  this->SkyOf = 0;
  this->Eye = EyeCode();
  const std::uint64_t picture = this->Code.picture;
  this->Code = LightCode();
  this->Code.picture = picture;
  this->Inputs.forget();
  this->Other->releaseGraphicsResources();
}
}

std::unique_ptr<Tracer> makeOpenGLTracer(std::unique_ptr<Tracer> other)
{
  return std::make_unique<OpenGLTracer>(std::move(other));
}
}
