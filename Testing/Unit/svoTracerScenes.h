// Scenes, views and executors that the tracer's unit tests share.
#ifndef svoTracerScenes_h
#define svoTracerScenes_h

#include "svoCPUTracer.h"
#include "svoIntersect.h"
#include "svoSceneVersions.h"
#include "svoTestScenes.h"

#include <string>
#include <thread>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace svotest
{
/// A square in the plane z = 0.
inline Mesh square(double half)
{
  Mesh mesh;
  mesh.points = { { -half, -half, 0 }, { half, -half, 0 }, { half, half, 0 }, { -half, half, 0 } };
  mesh.triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  return mesh;
}

inline svo::Instance instanceOf(const svo::Octree& octree, std::uint64_t id,
  const glm::dmat4& localToWorld = glm::dmat4(1.0),
  svo::LeafGeometry leafGeometry = svo::LeafGeometry::Triangle)
{
  svo::Instance instance;
  instance.body.own().octree = octree;
  instance.id = id;
  instance.localToWorld = localToWorld;
  instance.body.own().leafGeometry = leafGeometry;
  return instance;
}

inline glm::dmat4 movedTo(double x, double y, double z)
{
  return glm::translate(glm::dmat4(1.0), glm::dvec3(x, y, z));
}

/// A light at `position` that shines at the origin.
inline svo::Light lightOf(svo::Light::Kind kind, const glm::dvec3& position)
{
  svo::Light light;
  light.kind = kind;
  light.position = position;
  light.direction = -glm::normalize(position);
  light.coneAngle = kind == svo::Light::Kind::Spot ? 40.0 : 180.0;
  light.id = 77;
  return light;
}

/// Two bodies and a ground under a point light and a directional one.
inline svo::Scene ballRingAndGround(svo::LeafGeometry leafGeometry = svo::LeafGeometry::Automatic)
{
  static const svo::Octree ground = makeOctree(square(3.0), 7);
  static const svo::Octree ball = makeOctree(sphere(24, 40), 7);
  static const svo::Octree ring = makeOctree(torus(40, 24), 7);
  svo::Scene scene;
  scene.instances = { instanceOf(ground, 1, glm::dmat4(1.0), leafGeometry),
    instanceOf(ball, 2, movedTo(-0.8, 0.0, 1.0), leafGeometry),
    instanceOf(ring, 3, movedTo(1.2, 0.3, 0.8), leafGeometry) };
  scene.lights = { lightOf(svo::Light::Kind::Point, { 2, -3, 6 }),
    lightOf(svo::Light::Kind::Directional, { -4, -1, 5 }) };
  scene.lights[1].id = 78;
  scene.lights[1].color = glm::vec3(0.3f);
  return scene;
}

/// What the ray through a pixel's centre meets of an instance alone, by rays in double that end
/// where the view does: E' = M^-1 E, V' = M^-1 V of Huang and Cheng, 2017.
inline svo::Hit hitAlone(const svo::Instance& instance, const svo::View& view, int x, int y)
{
  const glm::dmat4 m = instance.body->octree.localToOctree() * glm::inverse(instance.localToWorld);
  svo::Ray ray;
  ray.origin = glm::dvec3(m * glm::dvec4(view.rayOrigin(x + 0.5, y + 0.5), 1.0));
  ray.direction = glm::dvec3(m * glm::dvec4(view.rayDirection(x + 0.5, y + 0.5), 0.0));
  ray.tMin = view.tNear;
  ray.tMax = view.tFar;
  return svo::intersect(
    instance.body->octree, ray, { instance.body->leafGeometry, svo::MaximumLevel });
}

/// A light with a name for messages.
struct LightCase
{
  std::string name;
  svo::Light light;
};

/// Every kind of light, above the origin.
inline std::vector<LightCase> everyLight()
{
  using Kind = svo::Light::Kind;
  return { { "directional", lightOf(Kind::Directional, { 2, -2, 5 }) },
    { "point, one map", lightOf(Kind::Point, { 2, -2, 9 }) },
    { "point, six faces", lightOf(Kind::Point, { 1.7, -1.2, 2.5 }) },
    { "spot", lightOf(Kind::Spot, { 2, -2, 6 }) } };
}

inline svo::View lookAt(const glm::dvec3& eye, int width, int height, double angle = 40.0,
  const glm::dvec3& at = glm::dvec3(0.0))
{
  svo::View view;
  svo::makeView(glm::lookAt(eye, at, glm::dvec3(0, 0, 1)),
    glm::perspective(glm::radians(angle), double(width) / height, 0.1, 100.0), width, height, view);
  return view;
}

inline svo::View lookAtParallel(const glm::dvec3& eye, int width, int height, double halfHeight)
{
  svo::View view;
  const double halfWidth = halfHeight * width / height;
  svo::makeView(glm::lookAt(eye, glm::dvec3(0.0), glm::dvec3(0, 0, 1)),
    glm::ortho(-halfWidth, halfWidth, -halfHeight, halfHeight, 0.1, 100.0), width, height, view);
  return view;
}

/// Cuts the range into uneven pieces and runs them on `threads` threads, last piece first.
inline svo::ParallelFor raggedFor(unsigned threads)
{
  return [threads](std::size_t begin, std::size_t end, std::size_t grain,
           const std::function<void(std::size_t, std::size_t)>& body)
  {
    std::vector<std::pair<std::size_t, std::size_t>> pieces;
    std::size_t size = 1;
    for (std::size_t i = begin; i < end;)
    {
      const std::size_t last = std::min(end, i + size);
      pieces.emplace_back(i, last);
      i = last;
      size = size % std::max<std::size_t>(grain, 1) + 1 + pieces.size() % 3;
    }
    std::vector<std::thread> workers;
    for (unsigned t = 0; t < threads; ++t)
    {
      workers.emplace_back(
        [&pieces, &body, t, threads]
        {
          for (std::size_t k = pieces.size(); k-- > 0;)
          {
            if (k % threads == t)
            {
              body(pieces[k].first, pieces[k].second);
            }
          }
        });
    }
    for (std::thread& worker : workers)
    {
      worker.join();
    }
  };
}

inline svo::Frame rendered(svo::Tracer& tracer, const svo::Scene& scene, const svo::View& view,
  const svo::FrameSettings& settings, const svo::ParallelFor& parallelFor = svo::serialFor)
{
  tracer.render(stamped(scene), view, settings, parallelFor);
  return tracer.frame();
}

inline svo::Frame rendered(
  const svo::Scene& scene, const svo::View& view, const svo::FrameSettings& settings)
{
  svo::CPUTracer tracer;
  return rendered(tracer, scene, view, settings);
}

inline bool identical(const svo::Frame& a, const svo::Frame& b)
{
  return a.width == b.width && a.height == b.height && a.color == b.color && a.depth == b.depth &&
    a.instance == b.instance && a.primitive == b.primitive && a.normals == b.normals &&
    a.slopes == b.slopes && a.covered.x0 == b.covered.x0 && a.covered.y0 == b.covered.y0 &&
    a.covered.x1 == b.covered.x1 && a.covered.y1 == b.covered.y1;
}
}

#endif
