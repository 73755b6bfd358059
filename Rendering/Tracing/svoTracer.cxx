#include "svoTracer.h"

#include "svoIntersect.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace svo
{
struct Tracer::Internals
{
  FrameStatistics Statistics;
  std::vector<ShadowMap> Maps;
};

Tracer::Tracer()
  : Impl(new Internals)
{
}

Tracer::~Tracer() = default;

void Tracer::render(const Scene& scene, const View& view, const FrameSettings& settings,
  const ParallelFor& parallelFor, Frame& frame)
{
  this->Impl->Statistics = {};
  this->Impl->Maps.clear();
  frame.width = view.width;
  frame.height = view.height;
  const std::size_t pixels = std::size_t(view.width) * view.height;
  frame.covered = { 0, 0, view.width, view.height };
  frame.color.assign(4 * pixels, 0);
  frame.depth.assign(pixels, 1.0f);
  frame.normals.assign(settings.writeNormals ? 3 * pixels : 0, 0.0f);
  frame.instance.assign(pixels, ~0u);
  frame.primitive.assign(pixels, NoPrimitive);
  std::vector<glm::dmat4> toOctree;
  for (const Instance& i : scene.instances)
  {
    toOctree.push_back(i.octree.localToOctree() * glm::inverse(i.localToWorld));
  }
  const auto trace = [&](glm::dvec3 o, glm::dvec3 d, double t0, double t1, bool eye, bool any) {
    Hit best;
    std::uint32_t who = ~0u;
    best.t = t1;
    for (std::uint32_t k = 0; k < scene.instances.size(); ++k)
    {
      const Instance& i = scene.instances[k];
      if (eye ? !i.visible : !i.castShadow)
      {
        continue;
      }
      const Ray ray{ glm::dvec3(toOctree[k] * glm::dvec4(o, 1.0)),
        glm::dvec3(toOctree[k] * glm::dvec4(d, 0.0)), t0, best.t };
      const Hit hit = intersect(i.octree, ray, { i.leafGeometry, MaximumLevel });
      if (hit && hit.t < best.t)
      {
        best = hit;
        who = k;
        if (any)
        {
          break;
        }
      }
    }
    return std::make_pair(who, best);
  };
  parallelFor(0, view.height, 8, [&](std::size_t first, std::size_t last) {
    for (std::size_t y = first; y < last; ++y)
    {
      for (int x = 0; x < view.width; ++x)
      {
        const std::size_t p = y * view.width + x;
        const glm::dvec3 o = view.rayOrigin(x + 0.5, y + 0.5);
        const glm::dvec3 d = view.rayDirection(x + 0.5, y + 0.5);
        const auto [who, hit] = trace(o, d, view.tNear, view.tFar, true, false);
        if (who == ~0u)
        {
          continue;
        }
        const Instance& i = scene.instances[who];
        const Surface& surface = *i.octree.surface();
        const glm::uvec3 tri = surface.triangles[hit.primitive];
        const glm::dmat3 linear(i.localToWorld);
        const glm::dvec3 e1 = linear * glm::dvec3(surface.points[tri.y] - surface.points[tri.x]);
        const glm::dvec3 e2 = linear * glm::dvec3(surface.points[tri.z] - surface.points[tri.x]);
        glm::dvec3 n = glm::normalize(glm::cross(e1, e2));
        n = glm::dot(n, d) > 0.0 ? -n : n;
        const glm::dvec3 position = o + hit.t * d;
        const double step = 2e-3 * i.octree.rootEdge();
        glm::vec3 sum = i.material.ambient * i.material.ambientColor;
        for (const Light& light : scene.lights)
        {
          const bool far = light.kind == Light::Kind::Directional;
          const glm::dvec3 toLight = far ? -light.direction : light.position - position;
          double lit = std::max(0.0, glm::dot(n, glm::normalize(toLight)));
          if (lit > 0.0 && light.castShadow && i.receiveShadow &&
            settings.shadowTechnique != ShadowTechnique::None &&
            trace(position + n * step, toLight, 0.0, far ? 1e30 : 1.0, false, true).first != ~0u)
          {
            lit *= 1.0 - settings.shadowIntensity;
          }
          sum += static_cast<float>(lit) * light.color * i.material.diffuse *
            i.material.diffuseColor;
        }
        for (int c = 0; c < 3; ++c)
        {
          frame.color[4 * p + c] =
            static_cast<std::uint8_t>(std::lround(255.0f * std::min(1.0f, sum[c])));
        }
        frame.color[4 * p + 3] = 255;
        frame.depth[p] = static_cast<float>(view.windowDepth(hit.t));
        frame.instance[p] = who;
        frame.primitive[p] = hit.primitive;
      }
    }
  });
  this->Impl->Statistics.primaryRays = pixels;
}

const FrameStatistics& Tracer::statistics() const
{
  return this->Impl->Statistics;
}

const std::vector<ShadowMap>& Tracer::shadowMaps() const
{
  return this->Impl->Maps;
}

void Tracer::releaseLayers() {}
}
