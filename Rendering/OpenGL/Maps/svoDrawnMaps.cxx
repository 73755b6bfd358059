#include "svoDrawnMaps.h"

#include "svoColorAlpha.h"
#include "svoMapCasters.h"
#include "svoOctreeArena.h"
#include "svoOctreeWalk.h"
#include "svoOpenGL.h"
#include "svoProgram.h"
#include "svoStateGuard.h"
#include "svoStrips.h"
#include "svoSurface.h"
#include "svoTextures.h"
#include "svoUnfold.h"

#include <algorithm>
#include <utility>

#include <glm/vec4.hpp>

namespace svo
{
namespace
{
// As svoMapCasters.glsl has them.
constexpr std::size_t TexelsOfCopy = 8;
static_assert(sizeof(MapCopy::Record) == TexelsOfCopy * sizeof(glm::vec4), "no gaps");
constexpr int CornersOfBox = 36;

bool sameMap(const ShadowMap& a, const ShadowMap& b)
{
  return a.light == b.light && a.group == b.group && sameRays(a.view, b.view);
}

bool sameCasters(const std::vector<LightMaps>& a, const std::vector<LightMaps>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](const LightMaps& x, const LightMaps& y) { return x.casters == y.casters; });
}

/// By map, of `size` texels along an edge: what has changed since the texture's layers were drawn.
std::vector<PixelRect> partsToDraw(const std::vector<ShadowMap>& before,
  const std::vector<MapCopy>& copiesBefore, const std::vector<ShadowMap>& now,
  const std::vector<MapCopy>& copies, int size)
{
  std::vector<PixelRect> parts =
    changedParts(copiesBefore, copies, std::max(before.size(), now.size()));
  parts.resize(now.size());
  for (std::size_t m = 0; m < now.size(); ++m)
  {
    if (m >= before.size() || !sameMap(before[m], now[m]) || before[m].layer != now[m].layer)
    {
      parts[m] = { 0, 0, size, size };
    }
  }
  return parts;
}
}

std::string DrawnMaps::draw(const Scene& scene, const std::vector<CasterInMemory>& casters,
  const OctreeArena& arena, const BufferTexture& alphas, const View& eye,
  const FrameSettings& settings, std::size_t room)
{
  this->Drawn = 0;
  std::vector<ShadowMap> before = std::move(this->Maps);
  const std::vector<LightMaps> lightsBefore = std::move(this->Lights);
  const bool known = scene.version != 0 && scene.version == this->Version;
  this->fit(scene, eye, settings);
  this->Version = scene.version;
  const bool same = this->Texels != 0 && this->bytes() <= room &&
    std::equal(this->Maps.begin(), this->Maps.end(), before.begin(), before.end(), sameMap);
  if (known && same && sameCasters(this->Lights, lightsBefore))
  {
    this->Maps = std::move(before); // with where they lie
    return {};
  }
  std::vector<MapCopy> copies = copiesIn(scene, casters, this->Lights, this->Maps);
  int layers = 1;
  for (const ShadowMap& map : this->Maps)
  {
    layers = std::max(layers, map.layer + 1);
  }
  const bool translucent = std::any_of(
    this->Maps.begin(), this->Maps.end(), [](const ShadowMap& map) { return map.group > 0; });
  const int size = this->Maps.empty() ? 1 : this->Maps.front().view.width;
  const bool fits = this->Texels != 0 && size == this->Size && translucent == this->Translucent &&
    layers <= this->Layers && this->Layers <= 2 * layers && this->bytes() <= room;
  if (!fits)
  {
    before.clear(); // what was drawn goes with the texture
    this->InMaps.clear();
    if (!this->resize(size, layers, translucent, room))
    {
      this->forget();
      return "Shadow maps do not fit into OpenGL's memory, or into GPUMemoryLimit";
    }
  }
  const std::string& words = this->link(alphas.size() > 0);
  std::string whyNot = words.empty()
    ? this->drawParts(
        partsToDraw(before, this->InMaps, this->Maps, copies, size), copies, arena, alphas)
    : "OpenGL refuses the shaders of shadow maps (" + words + ")";
  if (whyNot.empty())
  {
    this->InMaps = std::move(copies);
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
        map.view = cropped(view);
        map.base = std::max(view.tNear, 0.0);
        this->Maps.push_back(std::move(map));
      }
    }
  }
}

/// Makes a texture for them. False if OpenGL refuses, or if it takes more than `room`.
bool DrawnMaps::resize(int size, int layers, bool translucent, std::size_t room)
{
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
  for (int shape = 0; shape < MapCopy::Shapes && words.empty(); ++shape)
  {
    const std::string constants = "#version 150\n#define svoShape " + std::to_string(shape) + "\n";
    glDeleteProgram(this->Programs[shape]);
    this->Programs[shape] =
      linkProgram({ { GL_VERTEX_SHADER, constants + "#define svoAtVertices\n" + svoMapCasters },
                    { GL_FRAGMENT_SHADER,
                      constants + "#define svoHasPlanes true\n#define svoHasAlphas " +
                        (alphas ? "true\n" : "false\n") + svoUnfold + svoOctreeWalk +
                        svoColorAlpha + svoMapCasters } },
        words);
  }
  return words;
}

/// Draws parts of maps anew, by map. Why not, else empty.
std::string DrawnMaps::drawParts(const std::vector<PixelRect>& parts,
  const std::vector<MapCopy>& copies, const OctreeArena& arena, const BufferTexture& alphas)
{
  std::vector<const MapCopy*> drawn;
  std::vector<MapCopy::Record> records;
  for (const MapCopy& copy : copies)
  {
    if (copy.rect.overlaps(parts[copy.map]))
    {
      drawn.push_back(&copy);
      records.push_back(copy.record);
    }
  }
  const std::size_t texels = TexelsOfCopy * records.size();
  if (texels > BufferTexture::most() ||
    (texels > this->Copies.size() && !this->Copies.allocate(texels + texels / 2)))
  {
    return "OpenGL has no room for so many casters";
  }
  this->Copies.send(0, records.data(), texels);
  this->Drawn = drawn.size();
  StateGuard state;
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_SCISSOR_TEST);
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
  std::size_t next = 0;
  for (std::size_t m = 0; m < parts.size(); ++m)
  {
    const ShadowMap& map = this->Maps[m];
    const PixelRect& part = parts[m];
    if (map.layer < 0 || part.empty())
    {
      continue;
    }
    const float nothing[] = { 3e38f, 0.0f, 0.0f, 0.0f };
    const float farthest = 1.0f;
    glFramebufferTextureLayer(
      GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, this->Texels, 0, map.layer);
    glScissor(part.x0, part.y0, part.x1 - part.x0, part.y1 - part.y0);
    glClearBufferfv(GL_COLOR, 0, nothing);
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    while (next < drawn.size() && drawn[next]->map == static_cast<int>(m))
    {
      const std::size_t first = next;
      const MapCopy& copy = *drawn[first];
      while (next < drawn.size() && copy.joins(*drawn[next]))
      {
        ++next;
      }
      const GLuint program = this->Programs[copy.shape];
      glUseProgram(program);
      glUniform1i(
        glGetUniformLocation(program, "svoFirstCopy"), static_cast<int>(TexelsOfCopy * first));
      glUniform2f(glGetUniformLocation(program, "svoReach"),
        static_cast<float>(map.view.tNear - map.base),
        static_cast<float>(map.view.tFar - map.base));
      int vertices = CornersOfBox;
      if (copy.shape == MapCopy::Triangles)
      {
        vertices = static_cast<int>(3 * copy.octree->surface()->triangles.size());
        glUniform1i(glGetUniformLocation(program, "svoFirstTriangle"),
          static_cast<int>(arena.firstOf(*copy.octree)));
      }
      const auto draw = [&]
      { glDrawArraysInstanced(GL_TRIANGLES, 0, vertices, static_cast<int>(next - first)); };
      if (copy.shape != MapCopy::Planes)
      {
        draw();
        continue;
      }
      double share = 0.0; // their fragments ask; texels may be asked for by several
      for (std::size_t i = first; i < next; ++i)
      {
        share += common(drawn[i]->rect, part).pixels() / part.pixels();
      }
      eachStrip(part.y0, part.y1, share,
        [&](int row, int rows)
        {
          glScissor(part.x0, row, part.x1 - part.x0, rows);
          draw();
        });
      glScissor(part.x0, part.y0, part.x1 - part.x0, part.y1 - part.y0);
    }
    glFlush();
  }
  return {};
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
  this->Drawn = 0;
  this->releaseTextures();
  this->Copies.release();
  this->InMaps.clear();
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
