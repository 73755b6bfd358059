#include "svoDrawnMaps.h"

#include "svoColorAlpha.h"
#include "svoLeafError.h"
#include "svoLocalView.h"
#include "svoMapCasters.h"
#include "svoOctreeArena.h"
#include "svoOctreeWalk.h"
#include "svoOpenGL.h"
#include "svoProgram.h"
#include "svoSurface.h"
#include "svoTextures.h"
#include "svoTranslucentGroups.h"
#include "svoWorldToOctree.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

namespace svo
{
namespace
{
enum Shape // as svoMapCasters.glsl
{
  Triangles,
  BallShape,
  Planes
};
constexpr int CornersOfBox = 36;

struct CopyRecord // in a shader's memory
{
  glm::vec4 rows[4];
  glm::vec4 source;
  glm::vec4 octree, low, high;
};
constexpr std::size_t TexelsOfCopy = 8;
static_assert(sizeof(CopyRecord) == TexelsOfCopy * sizeof(glm::vec4), "as svoMapCasters.glsl");

Shape shapeOf(const Instance& instance)
{
  return instance.body->octree.hasPlanes()           ? Planes
    : instance.body->ball && !instance.mappedOpacity ? BallShape
                                                     : Triangles;
}

/// Of a caster in a map.
CopyRecord recordOf(const Instance& instance, const CasterInMemory& caster, const ShadowMap& map)
{
  const View& view = map.view;
  const Octree& octree = instance.body->octree;
  const Shape shape = shapeOf(instance);
  const auto& corner = octree.header().origin;
  const glm::dvec3 origin(corner[0], corner[1], corner[2]);
  glm::dmat4 toView = view.worldToView * instance.localToWorld;
  if (shape != BallShape)
  {
    toView[3] = toView * glm::dvec4(origin + 0.5 * octree.rootEdge(), 1.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      toView[axis] *= octree.rootEdge();
    }
  }
  const glm::dmat4 toClip = view.viewToClip * toView;
  CopyRecord record{ {}, {}, caster.octree, caster.low, caster.high };
  for (int column = 0; column < 4; ++column)
  {
    const double base = column == 3 ? map.base : 0.0;
    record.rows[0][column] = static_cast<float>(toClip[column][0]);
    record.rows[1][column] = static_cast<float>(toClip[column][1]);
    record.rows[2][column] = static_cast<float>(-toView[column][2] - base);
    record.rows[3][column] = static_cast<float>(toClip[column][3]);
  }
  if (shape != Triangles)
  {
    const WorldToOctree toOctree(octree, instance.localToWorld);
    const bool ball = shape == BallShape;
    const glm::dvec3 x = view.parallel ? view.axis : view.eye - toOctree.translation;
    const glm::dvec3 local = toOctree.inverse * x;
    const glm::dvec3 middle = origin + 0.5 * octree.rootEdge();
    record.source = view.parallel
      ? glm::vec4(ball ? local : local * toOctree.scale, 0.0f)
      : glm::vec4(ball ? local : (local - middle) * toOctree.scale, 1.0f);
  }
  return record;
}

/// The error that a test against the map allows for.
double errorOf(const Instance& instance)
{
  const Octree& octree = instance.body->octree;
  const bool cubes = instance.body->leafGeometry == LeafGeometry::Voxel;
  return worldMapError(instance,
    !octree.hasPlanes() ? LeafGeometry::Triangle
      : cubes           ? LeafGeometry::Voxel
                        : LeafGeometry::Plane,
    octree.level());
}

/// What is changed of OpenGL's state while maps are drawn, put back at the end: VTK knows it.
class KeptState
{
public:
  KeptState()
  {
    for (std::size_t i = 0; i < std::size(this->On); ++i)
    {
      this->On[i] = glIsEnabled(Switches[i]);
      glDisable(Switches[i]);
    }
    glGetIntegerv(GL_VIEWPORT, this->Viewport);
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &this->Framebuffer);
    glGetIntegerv(GL_CURRENT_PROGRAM, &this->Program);
    glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &this->Vertices);
    glGetIntegerv(GL_ACTIVE_TEXTURE, &this->Unit);
    glGetIntegerv(GL_DEPTH_FUNC, &this->Compared);
    glGetBooleanv(GL_DEPTH_WRITEMASK, &this->Deep);
    glGetBooleanv(GL_COLOR_WRITEMASK, this->Colors);
  }
  KeptState(const KeptState&) = delete;
  KeptState& operator=(const KeptState&) = delete;
  ~KeptState()
  {
    for (std::size_t i = 0; i < this->Bound.size(); ++i)
    {
      glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
      glBindTexture(GL_TEXTURE_BUFFER, static_cast<GLuint>(this->Bound[i]));
    }
    glActiveTexture(static_cast<GLenum>(this->Unit));
    glColorMask(this->Colors[0], this->Colors[1], this->Colors[2], this->Colors[3]);
    glDepthMask(this->Deep);
    glDepthFunc(static_cast<GLenum>(this->Compared));
    glBindVertexArray(static_cast<GLuint>(this->Vertices));
    glUseProgram(static_cast<GLuint>(this->Program));
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(this->Framebuffer));
    glViewport(this->Viewport[0], this->Viewport[1], this->Viewport[2], this->Viewport[3]);
    for (std::size_t i = 0; i < std::size(this->On); ++i)
    {
      if (this->On[i])
      {
        glEnable(Switches[i]);
      }
    }
  }

  /// Binds a buffer texture to the next unit, and returns that.
  int bind(GLuint texture)
  {
    const auto unit = static_cast<int>(this->Bound.size());
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    this->Bound.push_back(0);
    glGetIntegerv(GL_TEXTURE_BINDING_BUFFER, &this->Bound.back());
    glBindTexture(GL_TEXTURE_BUFFER, texture);
    return unit;
  }

private:
  static constexpr GLenum Switches[] = { GL_BLEND, GL_SCISSOR_TEST, GL_DEPTH_TEST, GL_CULL_FACE,
    GL_STENCIL_TEST };
  GLboolean On[std::size(Switches)];
  GLint Viewport[4];
  GLint Framebuffer, Program, Vertices, Unit, Compared;
  GLboolean Deep, Colors[4];
  std::vector<GLint> Bound; // by unit
};

bool sameMaps(const std::vector<ShadowMap>& a, const std::vector<ShadowMap>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](const ShadowMap& x, const ShadowMap& y)
    { return x.light == y.light && x.group == y.group && sameRays(x.view, y.view); });
}
}

/// A caster in a map.
struct DrawnMaps::Copy
{
  int map;
  Shape shape;
  const Octree* octree;
  CopyRecord record;

  /// True if both are drawn at once.
  bool joins(const Copy& o) const
  {
    return this->map == o.map && this->shape == o.shape &&
      (this->shape != Triangles || this->octree->id() == o.octree->id());
  }
  bool operator<(const Copy& o) const
  {
    return std::make_tuple(this->map, this->shape, this->octree->id()) <
      std::make_tuple(o.map, o.shape, o.octree->id());
  }
};

std::string DrawnMaps::draw(const Scene& scene, const std::vector<CasterInMemory>& casters,
  const OctreeArena& arena, const BufferTexture& alphas, const View& eye,
  const FrameSettings& settings, std::size_t room)
{
  std::vector<ShadowMap> before = std::move(this->Maps);
  const bool known = scene.version != 0 && scene.version == this->Version;
  this->fit(scene, eye, settings);
  this->Version = scene.version;
  if (known && this->Texels != 0 && sameMaps(this->Maps, before) && this->bytes() <= room)
  {
    this->Maps = std::move(before); // with where they lie
    return {};
  }
  std::vector<Copy> copies;
  const int layers = this->findCopies(scene, casters, copies);
  const bool translucent = std::any_of(
    this->Maps.begin(), this->Maps.end(), [](const ShadowMap& map) { return map.group > 0; });
  const int size = this->Maps.empty() ? 1 : this->Maps.front().view.width;
  std::string whyNot;
  if (!this->resize(size, std::max(layers, 1), translucent, room))
  {
    whyNot = "Shadow maps do not fit into OpenGL's memory, or into GPUMemoryLimit";
  }
  else if (!this->send(copies))
  {
    whyNot = "OpenGL has no room for so many casters";
  }
  else
  {
    const std::string& words = this->link(alphas.size() > 0);
    whyNot = words.empty() ? words : "OpenGL refuses the shaders of shadow maps (" + words + ")";
  }
  if (whyNot.empty())
  {
    this->drawAll(copies, arena, alphas);
  }
  else
  {
    this->forget();
  }
  return whyNot;
}

/// Which maps there are.
void DrawnMaps::fit(const Scene& scene, const View& eye, const FrameSettings& settings)
{
  const bool same = scene.version != 0 && scene.version == this->Version;
  this->Fitted = outlinesOf(scene, same ? std::move(this->Fitted) : std::vector<Outline>());
  this->Lights = mapsOfLights(this->Fitted, scene.lights, settings, eye);
  this->Maps.clear();
  this->Widths = TexelWidths();
  for (std::size_t light = 0; light < this->Lights.size(); ++light)
  {
    const LightMaps& fitted = this->Lights[light];
    this->Widths.add(fitted, settings);
    for (int group = 0; group <= fitted.translucentGroups; ++group)
    {
      for (const View& view : fitted.views)
      {
        ShadowMap map;
        map.light = static_cast<int>(light);
        map.group = group;
        map.view = view;
        map.base = std::max(view.tNear, 0.0);
        this->Maps.push_back(std::move(map));
      }
    }
  }
}

/// What is to be drawn into which map, map by map; of the maps where they lie, and what they allow
/// for. How many layers there are.
int DrawnMaps::findCopies(
  const Scene& scene, const std::vector<CasterInMemory>& casters, std::vector<Copy>& copies)
{
  int layers = 0;
  for (std::size_t m = 0; m < this->Maps.size(); ++m)
  {
    ShadowMap& map = this->Maps[m];
    const std::vector<std::uint8_t>& groups = this->Lights[map.light].casters;
    const std::size_t before = copies.size();
    for (const CasterInMemory& caster : casters)
    {
      const Instance& instance = scene.instances[caster.instance];
      const Octree& octree = instance.body->octree;
      if (groups[caster.instance] != OpaqueCasters + map.group)
      {
        continue;
      }
      map.worldBias = std::max(map.worldBias, errorOf(instance));
      map.casterVoxel = std::max(map.casterVoxel, worldVoxel(instance));
      if (!seeOctree(octree, instance.localToWorld, map.view).rect.empty())
      {
        copies.push_back(
          { static_cast<int>(m), shapeOf(instance), &octree, recordOf(instance, caster, map) });
      }
    }
    map.layer = copies.size() > before ? layers++ : -1;
  }
  std::stable_sort(copies.begin(), copies.end());
  return layers;
}

/// Has a texture for them. False if OpenGL refuses, or if it takes more than `room`.
bool DrawnMaps::resize(int size, int layers, bool translucent, std::size_t room)
{
  if (this->Texels != 0 && size == this->Size && translucent == this->Translucent &&
    layers <= this->Layers && this->Layers <= 2 * layers && this->bytes() <= room)
  {
    return true;
  }
  this->releaseTextures();
  this->Size = size;
  this->Layers = layers;
  this->Translucent = translucent;
  if (this->bytes() > room)
  {
    return false;
  }
  this->Texels = makeTexture(translucent ? GL_RG32F : GL_R32F, size, size, layers);
  this->Depths = makeTexture(GL_DEPTH_COMPONENT32F, size, size);
  if (this->Texels == 0 || this->Depths == 0)
  {
    return false;
  }
  GLint before = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &before);
  glGenVertexArrays(1, &this->Vertices);
  glGenFramebuffers(1, &this->Framebuffer);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, this->Framebuffer);
  glFramebufferTexture(GL_DRAW_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, this->Depths, 0);
  glFramebufferTextureLayer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, this->Texels, 0, 0);
  const bool complete = glCheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(before));
  return complete;
}

bool DrawnMaps::send(const std::vector<Copy>& copies)
{
  std::vector<CopyRecord> records;
  records.reserve(copies.size());
  for (const Copy& copy : copies)
  {
    records.push_back(copy.record);
  }
  const std::size_t texels = TexelsOfCopy * records.size();
  const bool fits = texels <= BufferTexture::most() &&
    (texels <= this->Copies.size() || this->Copies.allocate(texels + texels / 2));
  if (fits)
  {
    this->Copies.send(0, records.data(), texels);
  }
  return fits;
}

/// Has programs for all shapes. OpenGL's words if it refuses.
const std::string& DrawnMaps::link(bool alphas)
{
  if ((this->Programs[0] != 0 || !this->Refusal.empty()) && this->HasAlphas == alphas)
  {
    return this->Refusal;
  }
  this->HasAlphas = alphas;
  std::string& words = this->Refusal;
  words.clear();
  for (int shape = 0; shape < Shapes && words.empty(); ++shape)
  {
    const std::string constants = "#version 150\n#define svoShape " + std::to_string(shape) + "\n";
    glDeleteProgram(this->Programs[shape]);
    this->Programs[shape] = linkProgram(
      { { GL_VERTEX_SHADER, constants + "#define svoAtVertices\n" + svoMapCasters },
        { GL_FRAGMENT_SHADER,
          constants + "#define svoHasPlanes true\n#define svoHasAlphas " +
            (alphas ? "true\n" : "false\n") + svoOctreeWalk + svoColorAlpha + svoMapCasters } },
      words);
  }
  return words;
}

void DrawnMaps::drawAll(
  const std::vector<Copy>& copies, const OctreeArena& arena, const BufferTexture& alphas)
{
  KeptState state;
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glBindVertexArray(this->Vertices);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, this->Framebuffer);
  glViewport(0, 0, this->Size, this->Size);
  const std::pair<const char*, int> samplers[] = { { "svoCopies", state.bind(this->Copies.name()) },
    { "svoNodes", state.bind(arena.nodes().name()) },
    { "svoLists", state.bind(arena.lists().name()) },
    { "svoTriangles", state.bind(arena.triangles().name()) },
    { "svoAlphas", state.bind(alphas.name()) } };
  for (const GLuint program : this->Programs)
  {
    glUseProgram(program);
    for (const auto& [name, unit] : samplers)
    {
      glUniform1i(glGetUniformLocation(program, name), unit);
    }
  }
  int map = -1;
  std::size_t end = 0;
  for (std::size_t first = 0; first < copies.size(); first = end)
  {
    const Copy& copy = copies[first];
    for (end = first + 1; end < copies.size() && copy.joins(copies[end]); ++end)
    {
    }
    const ShadowMap& drawn = this->Maps[copy.map];
    if (copy.map != map)
    {
      map = copy.map;
      const float nothing[] = { 3e38f, 0.0f, 0.0f, 0.0f };
      const float farthest = 1.0f;
      glFramebufferTextureLayer(
        GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, this->Texels, 0, drawn.layer);
      glClearBufferfv(GL_COLOR, 0, nothing);
      glClearBufferfv(GL_DEPTH, 0, &farthest);
      glFlush();
    }
    const GLuint program = this->Programs[copy.shape];
    glUseProgram(program);
    glUniform1i(
      glGetUniformLocation(program, "svoFirstCopy"), static_cast<int>(TexelsOfCopy * first));
    glUniform2f(glGetUniformLocation(program, "svoReach"),
      static_cast<float>(drawn.view.tNear - drawn.base),
      static_cast<float>(drawn.view.tFar - drawn.base));
    int vertices = CornersOfBox;
    if (copy.shape == Triangles)
    {
      vertices = static_cast<int>(3 * copy.octree->surface()->triangles.size());
      glUniform1i(glGetUniformLocation(program, "svoFirstTriangle"),
        static_cast<int>(arena.firstOf(*copy.octree)));
    }
    glDrawArraysInstanced(GL_TRIANGLES, 0, vertices, static_cast<int>(end - first));
  }
}

std::size_t DrawnMaps::mapBytes() const
{
  return static_cast<std::size_t>(this->Size) * this->Size * this->Layers *
    (this->Translucent ? 8 : 4);
}

std::size_t DrawnMaps::bytes() const
{
  const std::size_t depths = static_cast<std::size_t>(this->Size) * this->Size * 4;
  return this->mapBytes() + depths + this->Copies.bytes();
}

void DrawnMaps::releaseTextures()
{
  if (this->Texels != 0 || this->Depths != 0) // else there may be no context
  {
    const GLuint textures[] = { this->Texels, this->Depths };
    glDeleteTextures(2, textures);
  }
  if (this->Framebuffer != 0)
  {
    glDeleteFramebuffers(1, &this->Framebuffer);
    glDeleteVertexArrays(1, &this->Vertices);
  }
  this->Texels = this->Depths = this->Framebuffer = this->Vertices = 0;
  this->Size = this->Layers = 0;
}

void DrawnMaps::forget()
{
  this->releaseTextures();
  this->Copies.release();
  this->Maps.clear();
  this->Widths = TexelWidths();
}

void DrawnMaps::release()
{
  this->forget();
  for (GLuint& program : this->Programs)
  {
    if (program != 0)
    {
      glDeleteProgram(program);
    }
    program = 0;
  }
  this->Refusal.clear();
}
}
