#include "accuracyStage.h"

#include "svoMeshOctree.h"

#include <algorithm>
#include <ctime>
#include <limits>
#include <stdexcept>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace accuracy
{
double processorSeconds()
{
  std::timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

svo::View Camera::view() const
{
  svo::View view;
  svo::makeView(glm::lookAt(this->eye, this->focus, glm::dvec3(0.0, 0.0, 1.0)),
    glm::perspective(
      glm::radians(this->angle), double(this->width) / this->height, this->near, this->far),
    this->width, this->height, view);
  return view;
}

void fitClippingPlanes(Stage& stage)
{
  Camera& camera = stage.camera;
  const glm::dvec3 axis = glm::normalize(camera.focus - camera.eye);
  double nearest = std::numeric_limits<double>::infinity();
  double farthest = 0.0;
  for (const Object& object : stage.objects)
  {
    for (const glm::dvec3& p : object.shape->mesh.points)
    {
      const glm::dvec3 world(object.toWorld * glm::dvec4(p, 1.0));
      const double depth = glm::dot(world - camera.eye, axis);
      nearest = std::min(nearest, depth);
      farthest = std::max(farthest, depth);
    }
  }
  const double distance = glm::length(camera.focus - camera.eye);
  camera.near = std::max(0.99 * nearest - 1e-3 * distance, 0.1 * distance);
  camera.far = 1.01 * farthest + 1e-3 * distance;
}

void fillWindow(Stage& stage, const Object& object)
{
  Camera& camera = stage.camera;
  const glm::dvec3 axis = glm::normalize(camera.focus - camera.eye);
  double distance = 0.0;
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high = -low;
  for (const glm::dvec3& p : object.shape->mesh.points)
  {
    const glm::dvec3 world(object.toWorld * glm::dvec4(p, 1.0));
    low = glm::min(low, world);
    high = glm::max(high, world);
  }
  camera.focus = 0.5 * (low + high);
  // Every point inside the cone of the smaller half angle, with a margin.
  const double aspect = std::min(1.0, double(camera.width) / camera.height);
  const double slope = 0.98 * aspect * std::tan(0.5 * glm::radians(camera.angle));
  const glm::dvec3 side = glm::normalize(glm::cross(axis, glm::dvec3(0.0, 0.0, 1.0)));
  const glm::dvec3 up = glm::cross(side, axis);
  for (const glm::dvec3& p : object.shape->mesh.points)
  {
    const glm::dvec3 v = glm::dvec3(object.toWorld * glm::dvec4(p, 1.0)) - camera.focus;
    const double across = std::max(std::abs(glm::dot(v, side)), std::abs(glm::dot(v, up)));
    distance = std::max(distance, across / slope - glm::dot(v, axis));
  }
  camera.eye = camera.focus - distance * axis;
}

const OctreeShelf::Entry& OctreeShelf::get(const Shape& shape, int level)
{
  const auto inserted = this->Entries.try_emplace({ &shape, level });
  Entry& entry = inserted.first->second;
  if (inserted.second)
  {
    svo::MeshOctreeOptions options;
    options.level = level;
    std::string message;
    const double begin = processorSeconds();
    if (svo::buildMeshOctree(shape.data, options, entry.octree, message) != svo::BuildStatus::Built)
    {
      throw std::runtime_error(shape.mesh.name + ": " + message);
    }
    entry.buildSeconds = processorSeconds() - begin;
  }
  return entry;
}

void OctreeShelf::keepLevel(int level)
{
  for (auto entry = this->Entries.begin(); entry != this->Entries.end();)
  {
    entry = entry->first.second == level ? std::next(entry) : this->Entries.erase(entry);
  }
}

svo::Scene sceneOf(const Stage& stage, OctreeShelf& shelf, int level, svo::LeafGeometry leaves)
{
  svo::Scene scene;
  for (const Object& object : stage.objects)
  {
    svo::Instance instance;
    instance.body.own().octree = shelf.get(*object.shape, level).octree;
    instance.localToWorld = object.toWorld;
    instance.body.own().leafGeometry = leaves;
    instance.material.flat = true;
    instance.id = scene.instances.size() + 1;
    scene.instances.push_back(instance);
  }
  scene.lights = stage.lights;
  return scene;
}
}
