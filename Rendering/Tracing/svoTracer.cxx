#include "svoTracer.h"

#include "svoLayeredView.h"
#include "svoSelect.h"
#include "svoShading.h"
#include "svoShadowBuffer.h"
#include "svoShadowRays.h"
#include "svoSurfacePoint.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <unordered_map>

namespace svo
{
namespace
{
double now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// What shading needs of a pixel.
struct ShadePoint
{
  SurfacePoint surface;
  std::uint32_t instance;
};

std::uint8_t toByte(float v)
{
  // NaN compares false and becomes 0.
  return v > 0.0f ? static_cast<std::uint8_t>(std::min(v, 1.0f) * 255.0f + 0.5f) : 0;
}
}

struct Tracer::Internals
{
  FrameStatistics Statistics;
  std::vector<ShadowMap> Maps;
  LayeredView Eye;
  std::unordered_map<std::uint64_t, std::unique_ptr<ShadowBuffer>> Buffers; // by Light::id

  std::vector<std::uint32_t> HitTiles;
  std::vector<ShadePoint> Points; // 64 per hit tile

  // What the last frame left in the caller's Frame, so that only that is wiped.
  std::vector<std::uint8_t> WrittenTiles;
  const std::uint8_t* WrittenTo = nullptr;

  void prepareFrame(const View& view, const FrameSettings& settings, Frame& frame);
  void findHitTiles(Frame& frame);
};

void Tracer::Internals::prepareFrame(const View& view, const FrameSettings& settings, Frame& frame)
{
  const std::size_t pixels = static_cast<std::size_t>(view.width) * view.height;
  const bool same = frame.width == view.width && frame.height == view.height &&
    this->WrittenTo == frame.color.data() && frame.color.size() == 4 * pixels;
  frame.width = view.width;
  frame.height = view.height;
  if (!same)
  {
    frame.color.assign(4 * pixels, 0);
    frame.depth.assign(pixels, 1.0f);
    frame.instance.assign(pixels, NoInstance);
    frame.primitive.assign(pixels, NoPrimitive);
    this->WrittenTiles.clear();
  }
  if (!settings.writeNormals)
  {
    frame.normals.clear();
  }
  else if (frame.normals.size() != 3 * pixels)
  {
    frame.normals.assign(3 * pixels, 0.0f);
  }
  this->WrittenTo = frame.color.data();
  frame.covered = PixelRect();
}

void Tracer::Internals::findHitTiles(Frame& frame)
{
  const DepthBuffer& depth = this->Eye.depthBuffer();
  this->HitTiles.clear();
  PixelRect covered{ frame.width, frame.height, 0, 0 };
  this->WrittenTiles.resize(depth.tiles(), 0);
  for (std::size_t tile = 0; tile < depth.tiles(); ++tile)
  {
    const int x = 8 * static_cast<int>(tile % depth.tilesX);
    const int y = 8 * static_cast<int>(tile / depth.tilesX);
    if (depth.hit[tile])
    {
      this->HitTiles.push_back(static_cast<std::uint32_t>(tile));
      covered = { std::min(covered.x0, x), std::min(covered.y0, y), std::max(covered.x1, x + 8),
        std::max(covered.y1, y + 8) };
      this->WrittenTiles[tile] = 1;
    }
    else if (this->WrittenTiles[tile])
    {
      this->WrittenTiles[tile] = 0;
      for (int j = y; j < std::min(y + 8, frame.height); ++j)
      {
        const std::size_t row = static_cast<std::size_t>(j) * frame.width;
        const std::size_t a = row + x;
        const std::size_t b = row + std::min(x + 8, frame.width);
        std::fill(frame.color.begin() + 4 * a, frame.color.begin() + 4 * b, std::uint8_t(0));
        std::fill(frame.depth.begin() + a, frame.depth.begin() + b, 1.0f);
        std::fill(frame.instance.begin() + a, frame.instance.begin() + b, NoInstance);
        std::fill(frame.primitive.begin() + a, frame.primitive.begin() + b, NoPrimitive);
      }
    }
  }
  if (!covered.empty())
  {
    frame.covered = { covered.x0, covered.y0, std::min(covered.x1, frame.width),
      std::min(covered.y1, frame.height) };
  }
}

Tracer::Tracer()
  : Impl(new Internals)
{
}

Tracer::~Tracer() = default;

void Tracer::render(const Scene& scene, const View& view, const FrameSettings& settings,
  const ParallelFor& parallelFor, Frame& frame)
{
  Internals& self = *this->Impl;
  const double start = now();
  double shadowTime = 0.0;
  self.Statistics = FrameStatistics();
  self.Maps.clear();
  self.prepareFrame(view, settings, frame);

  // Depth layers of the eye, merged.
  self.Eye.begin(
    scene, view, [](const Instance& i) { return i.visible; },
    [&](const Instance& i, const LocalView& local)
    { return selectLevel(i, local, view, settings.pixelError); },
    settings.frameCoherence, settings.layerMemoryLimit);
  self.Eye.trace(parallelFor, nullptr);
  self.findHitTiles(frame);
  const DepthBuffer& depth = self.Eye.depthBuffer();

  // Lights, and the shadow buffers of those that cast.
  std::vector<ViewLight> lights;
  std::vector<ShadowBuffer*> buffers(scene.lights.size(), nullptr);
  std::unordered_map<std::uint64_t, std::unique_ptr<ShadowBuffer>> kept;
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
  {
    const Light& light = scene.lights[i];
    lights.push_back(makeViewLight(light, view));
    if (settings.shadowTechnique != ShadowTechnique::Buffer || !light.castShadow ||
      kept.count(light.id))
    {
      continue;
    }
    auto& buffer = kept[light.id];
    buffer = std::move(self.Buffers[light.id]);
    if (!buffer)
    {
      buffer = std::make_unique<ShadowBuffer>();
    }
    buffer->begin(scene, light, settings);
    buffers[i] = buffer.get();
    if (settings.wholeShadowBuffers)
    {
      buffer->markAll();
    }
  }
  self.Buffers = std::move(kept);
  const bool rays = settings.shadowTechnique == ShadowTechnique::Rays;
  const bool onlyHeadlight = scene.lights.size() == 1 && scene.lights[0].headlight;

  std::vector<SurfaceFrame> frames;
  std::vector<double> offsets; // of shadow rays
  frames.reserve(scene.instances.size());
  for (std::size_t i = 0; i < scene.instances.size(); ++i)
  {
    const Instance& instance = scene.instances[i];
    frames.emplace_back(instance);
    const int level = std::max(self.Eye.level(static_cast<std::uint32_t>(i)), 1);
    const double voxel = std::ldexp(worldVoxel(instance), instance.octree.level() - level);
    offsets.push_back(voxel * std::max(1.2 * leafError(instance, level), 0.01));
  }

  // Visible points: what they are, and which light tiles they look up.
  if (self.Points.size() < 64 * self.HitTiles.size())
  {
    self.Points.resize(64 * self.HitTiles.size());
  }
  const auto eachPoint = [&](const std::function<void(int, int, std::size_t, ShadePoint&)>& body)
  {
    parallelFor(0, self.HitTiles.size(), 32,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t k = first; k < last; ++k)
        {
          const std::size_t tile = self.HitTiles[k];
          const int x0 = 8 * static_cast<int>(tile % depth.tilesX);
          const int y0 = 8 * static_cast<int>(tile / depth.tilesX);
          for (int i = 0; i < 64; ++i)
          {
            if (x0 + (i & 7) < view.width && y0 + (i >> 3) < view.height)
            {
              body(x0 + (i & 7), y0 + (i >> 3), 64 * tile + i, self.Points[64 * k + i]);
            }
          }
        }
      });
  };
  eachPoint(
    [&](int x, int y, std::size_t at, ShadePoint& point)
    {
      point.instance = depth.instance[at];
      if (point.instance == NoInstance)
      {
        return;
      }
      point.surface = surfacePoint(frames[point.instance], view, x + 0.5, y + 0.5,
        self.Eye.base(point.instance) + depth.t[at], depth.primitive[at]);
      const Instance& instance = scene.instances[point.instance];
      if (!instance.receiveShadow || !instance.material.lighting)
      {
        return;
      }
      for (std::size_t l = 0; l < lights.size(); ++l)
      {
        if (buffers[l] && !settings.wholeShadowBuffers)
        {
          const Light& light = scene.lights[l];
          const glm::dvec3 towards = light.kind == Light::Kind::Directional
            ? -light.direction
            : light.position - point.surface.position;
          if (glm::dot(glm::dvec3(point.surface.normal), towards) > 0.0)
          {
            buffers[l]->mark(point.surface.position);
          }
        }
      }
    });

  // Shadow layers, merged likewise.
  const double shadowStart = now();
  for (ShadowBuffer* buffer : buffers)
  {
    if (buffer)
    {
      buffer->trace(parallelFor);
      self.Statistics.shadowRays += buffer->rays();
      self.Statistics.retracedLayers += buffer->retracedLayers();
      self.Statistics.layerMemory += buffer->layerMemory();
    }
  }
  if (settings.wholeShadowBuffers)
  {
    for (std::size_t l = 0; l < lights.size(); ++l)
    {
      if (buffers[l])
      {
        buffers[l]->copyMaps(static_cast<int>(l), self.Maps);
      }
    }
  }
  shadowTime += now() - shadowStart;

  // Shade and test.
  const ShadowRays shadowRays(scene);
  const glm::dmat3 rotation(view.worldToView);
  std::atomic<std::uint64_t> raysCast{ 0 };
  eachPoint(
    [&](int x, int y, std::size_t at, ShadePoint& point)
    {
      const std::size_t pixel = static_cast<std::size_t>(y) * view.width + x;
      std::uint8_t* rgba = frame.color.data() + 4 * pixel;
      frame.instance[pixel] = point.instance;
      frame.primitive[pixel] = depth.primitive[at];
      if (point.instance == NoInstance)
      {
        std::fill(rgba, rgba + 4, std::uint8_t(0));
        frame.depth[pixel] = 1.0f;
        frame.primitive[pixel] = NoPrimitive;
        return;
      }
      const Instance& instance = scene.instances[point.instance];
      const Material& material = instance.material;
      const SurfacePoint& surface = point.surface;
      const glm::vec3 normal(rotation * glm::dvec3(surface.normal));
      const glm::vec3 position(view.worldToView * glm::dvec4(surface.position, 1.0));
      const glm::vec3 ambientColor =
        material.ambient * (surface.hasColor ? surface.color : material.ambientColor);
      const glm::vec3 diffuseColor =
        material.diffuse * (surface.hasColor ? surface.color : material.diffuseColor);
      glm::vec3 sum = ambientColor;
      if (!material.lighting || lights.empty())
      {
        sum += diffuseColor;
      }
      else
      {
        glm::vec3 diffuse(0.0f);
        glm::vec3 specular(0.0f);
        for (std::size_t l = 0; l < lights.size(); ++l)
        {
          Arriving light = arriving(lights[l], normal, position, material, onlyHeadlight);
          const bool lit = light.diffuse != glm::vec3(0.0f) || light.specular > 0.0f;
          float share = 1.0f;
          if (lit && instance.receiveShadow && scene.lights[l].castShadow)
          {
            bool dark = false;
            if (buffers[l])
            {
              dark = buffers[l]->shadows(surface.position, surface.facet);
            }
            else if (rays)
            {
              raysCast.fetch_add(1, std::memory_order_relaxed);
              dark = shadowRays.shadows(
                scene.lights[l], surface.position, surface.facet, offsets[point.instance]);
            }
            share = dark ? static_cast<float>(1.0 - settings.shadowIntensity) : 1.0f;
          }
          diffuse += share * light.diffuse;
          specular += share * light.specular * scene.lights[l].color;
        }
        sum += diffuse * diffuseColor + specular * material.specular * material.specularColor;
      }
      rgba[0] = toByte(sum.r);
      rgba[1] = toByte(sum.g);
      rgba[2] = toByte(sum.b);
      rgba[3] = 255;
      const double t = self.Eye.base(point.instance) + depth.t[at];
      double window = view.windowDepth(t);
      if (instance.depthOffsetFactor != 0.0f || instance.depthOffsetUnits != 0.0f)
      {
        // glPolygonOffset: the steepest change of window depth over a pixel, times the factor, plus
        // units of the least resolvable difference (24 bits).
        const glm::dvec3 n(surface.facet);
        const auto depthAt = [&](double px, double py)
        {
          const glm::dvec3 d = view.rayDirection(px, py);
          const double along = glm::dot(n, d);
          const double other = glm::dot(n, surface.position - view.rayOrigin(px, py)) / along;
          return std::isfinite(other) ? view.windowDepth(other) : window;
        };
        const double slope = std::max(std::abs(depthAt(x + 1.5, y + 0.5) - window),
          std::abs(depthAt(x + 0.5, y + 1.5) - window));
        window +=
          instance.depthOffsetFactor * std::min(slope, 1.0) + instance.depthOffsetUnits * 0x1p-24;
      }
      frame.depth[pixel] = static_cast<float>(std::clamp(window, 0.0, 1.0));
      if (settings.writeNormals)
      {
        std::copy(&normal[0], &normal[0] + 3, frame.normals.data() + 3 * pixel);
      }
    });

  self.Statistics.primaryRays = self.Eye.rays();
  self.Statistics.shadowRays += raysCast;
  self.Statistics.retracedLayers += self.Eye.retracedLayers();
  self.Statistics.layerMemory += self.Eye.layerMemory();
  self.Statistics.shadowTime = shadowTime;
  self.Statistics.traceTime = now() - start - shadowTime;
}

const FrameStatistics& Tracer::statistics() const
{
  return this->Impl->Statistics;
}

const std::vector<ShadowMap>& Tracer::shadowMaps() const
{
  return this->Impl->Maps;
}

void Tracer::releaseLayers()
{
  this->Impl->Eye.release();
  this->Impl->Buffers.clear();
}
}
