#include "svoTraceInstances.h"

#include "svoEmbreeScene.h"
#include "svoTracer.h"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace svobench
{
namespace
{
svo::Scene crowd(const svo::Octree& octree, int count)
{
  const svo::Header& h = octree.header();
  const double edge = h.voxelSize * (1 << octree.level());
  const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
  svo::Scene scene;
  for (int i = 0; i < count; ++i)
  {
    const double x = i % columns - 0.5 * (columns - 1), y = i / columns - 0.5 * (columns - 1);
    svo::Instance instance;
    instance.body.own().octree = octree;
    instance.localToWorld =
      glm::rotate(glm::translate(glm::dmat4(1.0), 0.9 * edge * glm::dvec3(x, 0.0, y)), 0.6 * i,
        glm::dvec3(0.0, 1.0, 0.0)) *
      glm::translate(
        glm::dmat4(1.0), -glm::dvec3(h.origin[0], h.origin[1], h.origin[2]) - 0.5 * edge);
    instance.body.own().leafGeometry = svo::LeafGeometry::Triangle;
    instance.id = static_cast<std::uint64_t>(i) + 1;
    scene.instances.push_back(instance);
  }
  return scene;
}
}

void traceInstances(const Mesh& mesh, const svo::Octree& octree, int count, int width, int height,
  int repeat, TraceReport& report)
{
  const svo::Scene scene = crowd(octree, count);
  const double edge = octree.header().voxelSize * (1 << octree.level());
  const double size = 0.9 * edge * std::ceil(std::sqrt(count));
  svo::View view;
  svo::makeView(glm::lookAt(glm::dvec3(0.4, 0.9, 1.6) * size, glm::dvec3(0.0), glm::dvec3(0, 1, 0)),
    glm::perspective(0.5236, static_cast<double>(width) / height, 0.1 * size, 10.0 * size), width,
    height, view);
  const std::string camera = std::to_string(count) + " instances";
  const double rays = static_cast<double>(width) * height;

  svo::FrameSettings settings;
  settings.shadowTechnique = svo::ShadowTechnique::None;
  settings.frameCoherence = false;
  const std::unique_ptr<svo::Tracer> tracer = svo::makeCPUTracer();
  std::vector<double> seconds;
  for (int i = 0; i <= repeat; ++i) // one to warm up
  {
    tracer->render(scene, view, settings, svo::serialFor);
    if (i > 0)
    {
      seconds.push_back(tracer->statistics().eye.processor);
    }
  }
  std::nth_element(seconds.begin(), seconds.begin() + repeat / 2, seconds.end());
  report.add(mesh.name, mesh.triangles.size(), octree.level(), camera, "a frame's rays of the eye",
    rays / seconds[repeat / 2]);

  std::vector<glm::dmat4> instances;
  for (const svo::Instance& instance : scene.instances)
  {
    instances.push_back(instance.localToWorld);
  }
  const EmbreeScene embree(mesh, report.instructionSet(), instances);
  if (!embree.available())
  {
    return;
  }
  std::vector<svo::HitBlock> hits(((width + 7) / 8) * ((height + 7) / 8));
  for (const int packet : { 1, 8, 16 })
  {
    const double median = medianSeconds(repeat, [&] { embree.time(view, 0.0, packet, hits); });
    report.add(mesh.name, mesh.triangles.size(), octree.level(), camera,
      "Embree, " + std::to_string(packet) + (packet == 1 ? " ray" : " rays"), rays / median);
  }
  std::size_t different = 0;
  const std::vector<svo::HitBlock> exact = embree.trace(view, 0.0, 0);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const svo::HitBlock& block = exact[y / 8 * ((width + 7) / 8) + x / 8];
      const svo::Primitive primitive =
        tracer->frame().primitive[static_cast<std::size_t>(y) * width + x];
      different += block.primitive[y % 8 * 8 + x % 8] != primitive;
    }
  }
  // Triangles of an edge are as near as each other there; of a crowd seen small there are many.
  report.check(
    "instances against Embree's robust mode", different, static_cast<std::size_t>(rays), 5e-3);
}
}
