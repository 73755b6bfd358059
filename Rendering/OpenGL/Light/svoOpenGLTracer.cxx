#include "svoOpenGLTracer.h"

#include "svoCasterAlphas.h"
#include "svoCasterTree.h"
#include "svoColorAlpha.h"
#include "svoDrawnMaps.h"
#include "svoLeafError.h"
#include "svoLeafGeometry.h"
#include "svoLightCode.h"
#include "svoOctreeArena.h"
#include "svoOctreeWalk.h"
#include "svoRayWalk.h"
#include "svoSeenSurfaces.h"
#include "svoShadowMask.h"
#include "svoTerminator.h"
#include "svoUniforms.h"
#include "svoWalkReach.h"
#include "svoWorldToOctree.h"

#include <algorithm>
#include <cstddef>
#include <iomanip>
#include <locale>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace svo
{
namespace
{
/// Boxes of casters are wider than what they hold by so much of the scene: rays come to them in
/// floats.
constexpr double BoxMargin = 4e-7;

/// Lights that a shader asks, whatever room it has for more.
constexpr std::ptrdiff_t MostLights = 64;

struct CasterRecord // in a shader's memory
{
  glm::vec4 rows[3];
  glm::vec4 octree, low, high;
};
constexpr std::size_t CasterTexelCount = 6;
static_assert(sizeof(CasterRecord) == CasterTexelCount * sizeof(glm::vec4), "as svoRayWalk.glsl");

/// How far planes may lie over the contour of them that VTK draws, voxels.
constexpr auto AboveContour = static_cast<float>(CubeError);

/// Of the octree's mesh, in the world.
Box worldBox(const Instance& instance)
{
  const double* bounds = instance.body->octree.header().meshBounds;
  Box box;
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec4 at(
      bounds[corner & 1], bounds[2 + (corner >> 1 & 1)], bounds[4 + (corner >> 2)], 1.0);
    box.add(glm::dvec3(instance.localToWorld * at));
  }
  return box;
}

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

/// What casts.
std::vector<const Instance*> castersOf(const Scene& scene)
{
  std::vector<const Instance*> casters;
  for (const Instance& instance : scene.instances)
  {
    if (instance.castShadow && instance.body->octree && !instance.body->octree.empty())
    {
      casters.push_back(&instance);
    }
  }
  return casters;
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
    return this->Octrees.bytes() + this->CasterTexels.bytes() + this->Alphas.texels().bytes() +
      this->Seen.bytes();
  }
  bool place(const Scene& scene, const std::vector<const Instance*>& casters);
  void aim(const View& view);
  void describe(const Scene& scene, const View& view, const std::string& constants);
  double largestGap(const View& view) const;

  std::unique_ptr<Tracer> Other;
  bool Answers = false; // the last frame's light
  Frame Nothing;
  FrameStatistics Statistics;
  LightCode Code;
  EyeCode Eye;
  OctreeArena Octrees;
  SeenSurfaces Seen;
  DrawnMaps Drawn;

  /// What casts, of the scene of this version.
  struct Caster
  {
    WorldToOctree toOctree;
    Box box;    // of the mesh, octree coordinates
    double gap; // from its surface to where floats have a ray begin, world
  };
  std::uint64_t Version = 0;
  std::size_t Limit = 0; // that they were to keep
  std::string WhyNot;    // they are not in OpenGL's memory; empty: they are
  std::vector<Caster> Casters;
  std::vector<CasterInMemory> Records; // of them
  bool Planes = false;                 // some octrees are of planes
  glm::dvec3 Centre{ 0.0 };            // of the tree's frame, world
  std::vector<CasterNode> Tree;
  glm::dmat4 WorldToView{ 0.0 }; // that was sent
  BufferTexture CasterTexels{ BufferTexture::Texel::FourFloats };
  CasterAlphas Alphas;
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
  const std::string constants = constantsOf(this->Planes, this->Alphas.texels().size() > 0);
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
  this->Statistics.largestGap = this->largestGap(view);
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
      this->Alphas.release();
      this->Seen.release();
    }
    this->Version = scene.version;
    this->Limit = settings.gpuMemoryLimit;
    this->WorldToView = glm::dmat4(0.0);
  }
  if (this->WhyNot.empty() && !maps && this->WorldToView != view.worldToView)
  {
    this->aim(view);
  }
  return this->WhyNot.empty() && maps
    ? this->Drawn.draw(scene, this->Records, this->Octrees, this->Alphas.texels(), view, settings,
        settings.gpuMemoryLimit - this->bytesOfScene())
    : this->WhyNot;
}

/// Has a scene's casters there, but for where the eye sees them. Why not, else empty.
std::string OpenGLTracer::hold(const Scene& scene, std::size_t limit)
{
  const std::vector<const Instance*> casters = castersOf(scene);
  std::vector<const Octree*> octrees;
  for (const Instance* caster : casters)
  {
    const Octree& octree = caster->body->octree;
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
    this->Planes = !seen.empty();
    const bool held = this->Octrees.hold(octrees, limit);
    if (held && !(this->place(scene, casters) && this->Seen.place(scene, seen)))
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
  glm::dmat4 viewToTree(glm::transpose(turned)); // rigid
  viewToTree[3] = glm::dvec4(view.eye - this->Centre, 1.0);
  static const std::string Text = std::string(svoOctreeWalk) + svoColorAlpha + svoRayWalk;
  this->Code.constants = constants + constantsOf(this->Code.lights.size());
  this->Code.text = Text.c_str();
  this->Code.costly = true;
  this->Code.textures = { { "svoNodes", this->Octrees.nodes().name() },
    { "svoLists", this->Octrees.lists().name() },
    { "svoTriangles", this->Octrees.triangles().name() },
    { "svoCasters", this->CasterTexels.name() } };
  if (this->Alphas.texels().size() > 0)
  {
    this->Code.textures.push_back({ "svoAlphas", this->Alphas.texels().name() });
  }
  this->Code.integers = { { "svoTreeSize", { static_cast<int>(this->Tree.size()) } },
    { "svoFirstCaster", { static_cast<int>(2 * this->Tree.size()) } } };
  this->Code.floats = { matrixOf("svoViewToTree", viewToTree), sources };
}

/// FrameStatistics::largestGap: where casters look nearest, since rays from whatever lies there may
/// begin on the wrong side of their surfaces. 0 if that is nowhere a pixel.
double OpenGLTracer::largestGap(const View& view) const
{
  double largest = 0.0;
  for (const Caster& caster : this->Casters)
  {
    // What looks that coarse is so vast that nine rays meet it if it is seen.
    for (int i = 0; i < 9 && caster.gap > worldPixel(view, view.tNear); ++i)
    {
      const double x = 0.5 * (i % 3) * view.width;
      const double y = 0.5 * (i / 3) * view.height;
      const glm::dvec3 from = caster.toOctree.point(view.rayOrigin(x, y));
      const glm::dvec3 way = caster.toOctree.vector(view.rayDirection(x, y));
      const glm::dvec3 a = (caster.box.low - from) / way;
      const glm::dvec3 b = (caster.box.high - from) / way;
      const glm::dvec3 enters = glm::min(a, b);
      const glm::dvec3 leaves = glm::max(a, b);
      const double first = std::max({ enters.x, enters.y, enters.z, view.tNear });
      if (first <= std::min({ leaves.x, leaves.y, leaves.z, view.tFar }))
      {
        largest = std::max(largest, caster.gap / worldPixel(view, first));
      }
    }
  }
  return largest;
}

/// Makes the tree of the casters and sends it; their matrices follow. False if OpenGL refuses.
bool OpenGLTracer::place(const Scene& scene, const std::vector<const Instance*>& casters)
{
  this->Casters.clear();
  this->Records.clear();
  this->Alphas.clear();
  std::vector<Box> boxes;
  Box all;
  for (const Instance* caster : casters)
  {
    const Octree& octree = caster->body->octree;
    float opacity = caster->translucent() ? caster->opacity : 1.0f;
    if (caster->mappedOpacity)
    {
      opacity = -1.0f -
        static_cast<float>(this->Alphas.add(*caster, inFloats(this->Octrees.firstOf(octree))));
    }
    CasterInMemory record{};
    record.instance = static_cast<std::size_t>(caster - scene.instances.data());
    record.octree = glm::vec4(inFloats(this->Octrees.rootOf(octree)), octree.depthCount(), opacity);
    if (octree.hasPlanes())
    {
      const LeafQuery query(octree, { LeafGeometry::Plane, MaximumLevel });
      record.low = glm::vec4(glm::vec3(query.low), walkReach(*caster));
      record.high = glm::vec4(glm::vec3(query.high), AboveContour);
      this->Planes = true;
    }
    const double* bounds = octree.header().meshBounds;
    const WorldToOctree toOctree(octree, caster->localToWorld);
    const auto corner = [&](int side)
    {
      return 1.0 +
        (glm::dvec3(bounds[side], bounds[2 + side], bounds[4 + side]) - toOctree.origin) *
        toOctree.scale;
    };
    this->Casters.push_back({ toOctree, { corner(0), corner(1) },
      worldLeafError(*caster, LeafGeometry::Triangle, octree.level()) });
    this->Records.push_back(record);
    boxes.push_back(worldBox(*caster));
    all.add(boxes.back());
  }
  this->Centre = all.known() ? 0.5 * (all.low + all.high) : glm::dvec3(0.0);
  for (Box& box : boxes)
  {
    box.low -= this->Centre;
    box.high -= this->Centre;
  }
  this->Tree = makeCasterTree(boxes, BoxMargin);
  const std::size_t texels = 2 * this->Tree.size() + CasterTexelCount * this->Casters.size();
  if (texels > BufferTexture::most() ||
    ((texels > this->CasterTexels.size() || texels == 0) &&
      !this->CasterTexels.allocate(texels + texels / 2 + 64)))
  {
    return false;
  }
  this->CasterTexels.send(0, this->Tree.data(), 2 * this->Tree.size());
  return this->Alphas.send();
}

/// Sends the matrices that take view coordinates to those of the casters' octrees.
void OpenGLTracer::aim(const View& view)
{
  this->WorldToView = view.worldToView;
  const glm::dmat3 toWorld = glm::transpose(glm::dmat3(view.worldToView)); // rigid
  std::vector<CasterRecord> records;
  records.reserve(this->Casters.size());
  for (std::size_t i = 0; i < this->Casters.size(); ++i)
  {
    const Caster& caster = this->Casters[i];
    const glm::dmat3 linear = caster.toOctree.inverse * toWorld * caster.toOctree.scale;
    const glm::dvec3 at = caster.toOctree.point(view.eye);
    CasterRecord record{ {}, this->Records[i].octree, this->Records[i].low, this->Records[i].high };
    for (int row = 0; row < 3; ++row)
    {
      record.rows[row] =
        glm::vec4(glm::dvec4(linear[0][row], linear[1][row], linear[2][row], at[row]));
    }
    records.push_back(record);
  }
  this->CasterTexels.send(2 * this->Tree.size(), records.data(), CasterTexelCount * records.size());
}

void OpenGLTracer::releaseGraphicsResources()
{
  this->Octrees.release();
  this->CasterTexels.release();
  this->Alphas.release();
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
