#include "accuracyReference.h"

#include "svoEmbree.h"
#include "svoSMPParallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace accuracy
{
namespace
{
constexpr double Beside = 4e-6;
constexpr double StepInPixels = 3.0;

RTCRay rayOf(const glm::dvec3& origin, const glm::dvec3& direction, double tNear, double tFar)
{
  RTCRay ray{};
  ray.org_x = static_cast<float>(origin.x);
  ray.org_y = static_cast<float>(origin.y);
  ray.org_z = static_cast<float>(origin.z);
  ray.dir_x = static_cast<float>(direction.x);
  ray.dir_y = static_cast<float>(direction.y);
  ray.dir_z = static_cast<float>(direction.z);
  ray.tnear = static_cast<float>(tNear);
  ray.tfar = static_cast<float>(tFar);
  ray.mask = ~0u;
  return ray;
}

/// Möller and Trumbore without a tolerance: a ray through an edge hits.
bool hitsTriangle(
  const glm::dvec3& origin, const glm::dvec3& direction, const glm::dvec3 corner[3], double& t)
{
  const glm::dvec3 a = corner[0] - origin, b = corner[1] - origin, c = corner[2] - origin;
  const double u = glm::dot(direction, glm::cross(c, b));
  const double v = glm::dot(direction, glm::cross(a, c));
  const double w = glm::dot(direction, glm::cross(b, a));
  if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0))
  {
    return false;
  }
  const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double along = glm::dot(normal, direction);
  t = glm::dot(normal, a) / along;
  return along != 0.0;
}
}

struct Reference::Internals
{
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  struct Solid
  {
    std::shared_ptr<const Shape> shape; // for its triangles
    std::vector<glm::dvec3> points;     // world
    void corners(unsigned triangle, glm::dvec3 corner[3]) const
    {
      const glm::uvec3 ids = this->shape->mesh.triangles[triangle];
      for (int i = 0; i < 3; ++i)
      {
        corner[i] = this->points[ids[i]];
      }
    }
  };
  std::vector<Solid> solids; // as the stage's objects
};

Reference::Reference(const Stage& stage)
  : Impl(std::make_unique<Internals>())
{
  Internals& self = *this->Impl;
  self.device = rtcNewDevice("threads=1");
  self.scene = rtcNewScene(self.device);
  rtcSetSceneFlags(self.scene, RTC_SCENE_FLAG_ROBUST);
  for (const Object& object : stage.objects)
  {
    const Mesh& mesh = object.shape->mesh;
    RTCGeometry geometry = rtcNewGeometry(self.device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
      RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.points.size()));
    auto* ids = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
      RTC_FORMAT_UINT3, 3 * sizeof(unsigned), mesh.triangles.size()));
    Internals::Solid solid{ object.shape, {} };
    for (const glm::dvec3& p : mesh.points)
    {
      const glm::dvec3 world(object.toWorld * glm::dvec4(p, 1.0));
      solid.points.push_back(world);
      for (int a = 0; a < 3; ++a)
      {
        *points++ = static_cast<float>(world[a]);
      }
    }
    for (const glm::uvec3& t : mesh.triangles)
    {
      for (int i = 0; i < 3; ++i)
      {
        *ids++ = t[i];
      }
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(self.scene, geometry, static_cast<unsigned>(self.solids.size()));
    rtcReleaseGeometry(geometry);
    self.solids.push_back(std::move(solid));
  }
  rtcCommitScene(self.scene);
}

Reference::~Reference()
{
  rtcReleaseScene(this->Impl->scene);
  rtcReleaseDevice(this->Impl->device);
}

ExactHit Reference::onPlane(
  const svo::View& view, double x, double y, int object, unsigned triangle) const
{
  const glm::dvec3 origin = view.rayOrigin(x, y), direction = view.rayDirection(x, y);
  glm::dvec3 corner[3];
  this->Impl->solids[object].corners(triangle, corner);
  ExactHit hit;
  hit.object = object;
  hit.triangle = triangle;
  hit.normal = glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
  hit.t = glm::dot(hit.normal, corner[0] - origin) / glm::dot(hit.normal, direction);
  hit.normal = glm::dot(hit.normal, direction) < 0.0 ? hit.normal : -hit.normal;
  hit.point = origin + hit.t * direction;
  return hit;
}

ExactHit Reference::first(const svo::View& view, double x, double y) const
{
  RTCRayHit query{};
  query.ray = rayOf(view.rayOrigin(x, y), view.rayDirection(x, y), view.tNear, view.tFar);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  svobench::EmbreeQuery(false).intersect(this->Impl->scene, query);
  return query.hit.geomID == RTC_INVALID_GEOMETRY_ID
    ? ExactHit()
    : this->onPlane(view, x, y, static_cast<int>(query.hit.geomID), query.hit.primID);
}

ExactHit Reference::settle(const svo::View& view, double x, double y) const
{
  const glm::dvec3 origin = view.rayOrigin(x, y), direction = view.rayDirection(x, y);
  ExactHit nearest;
  for (std::size_t o = 0; o < this->Impl->solids.size(); ++o)
  {
    const Internals::Solid& solid = this->Impl->solids[o];
    for (unsigned i = 0; i < solid.shape->mesh.triangles.size(); ++i)
    {
      glm::dvec3 corner[3];
      solid.corners(i, corner);
      double t;
      if (hitsTriangle(origin, direction, corner, t) && t >= view.tNear && t <= view.tFar &&
        (!nearest || t < nearest.t))
      {
        nearest = this->onPlane(view, x, y, static_cast<int>(o), i);
      }
    }
  }
  return nearest;
}

glm::dvec3 towards(const svo::Light& light, const glm::dvec3& point)
{
  return light.kind == svo::Light::Kind::Directional ? -light.direction
                                                     : glm::normalize(light.position - point);
}

bool reaches(const svo::Light& light, const glm::dvec3& point)
{
  return light.kind != svo::Light::Kind::Spot ||
    glm::dot(-towards(light, point), light.direction) >
    std::cos(light.coneAngle * 3.14159265358979323846 / 180.0);
}

bool Reference::blocked(
  const glm::dvec3& point, const glm::dvec3& normal, const svo::Light& light) const
{
  const glm::dvec3 direction = towards(light, point);
  const double far = light.kind == svo::Light::Kind::Directional
    ? std::numeric_limits<float>::infinity()
    : glm::length(light.position - point);
  const glm::dvec3 side = glm::dot(normal, direction) < 0.0 ? -normal : normal;
  RTCRay ray = rayOf(point + Beside * side, direction, 0.0, far);
  svobench::EmbreeQuery(false).occlude(this->Impl->scene, ray);
  return ray.tfar < 0.0f;
}

namespace
{
/// Linear depth at which the ray of a pixel meets the plane of a hit.
double onPlaneOf(const ExactHit& hit, const svo::View& view, double x, double y)
{
  return glm::dot(hit.normal, hit.point - view.rayOrigin(x, y)) /
    glm::dot(hit.normal, view.rayDirection(x, y));
}

/// A step in depth that the plane of neither surface explains, or another surface altogether.
bool discontinuous(
  const svo::View& view, const ExactHit& a, int ax, int ay, const ExactHit& b, int bx, int by)
{
  if (a.object != b.object)
  {
    return true;
  }
  if (!a)
  {
    return false;
  }
  const double pixel = StepInPixels * a.t * glm::length(view.directionX);
  return std::abs(onPlaneOf(a, view, bx + 0.5, by + 0.5) - b.t) > pixel &&
    std::abs(onPlaneOf(b, view, ax + 0.5, ay + 0.5) - a.t) > pixel;
}
}

std::vector<TruePixel> exactPicture(
  const Reference& reference, const Stage& stage, const svo::View& view, bool shadows)
{
  const int width = view.width, height = view.height;
  std::vector<TruePixel> pixels(static_cast<std::size_t>(width) * height);
  const svo::ParallelFor parallel = svo::smpParallelFor();
  const auto eachPixel = [&](const auto& body)
  {
    parallel(0, height, 8,
      [&](std::size_t begin, std::size_t end)
      {
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
        {
          for (int x = 0; x < width; ++x)
          {
            body(x, y, pixels[static_cast<std::size_t>(y) * width + x]);
          }
        }
      });
  };
  eachPixel(
    [&](int x, int y, TruePixel& p)
    {
      p.hit = reference.first(view, x + 0.5, y + 0.5);
      if (!p.hit)
      {
        return;
      }
      p.facing = static_cast<float>(
        -glm::dot(p.hit.normal, glm::normalize(view.rayDirection(x + 0.5, y + 0.5))));
      if (shadows && reaches(stage.lights[0], p.hit.point))
      {
        p.lit = static_cast<float>(glm::dot(p.hit.normal, towards(stage.lights[0], p.hit.point)));
        p.dark = p.lit > 0.0f && reference.blocked(p.hit.point, p.hit.normal, stage.lights[0]);
      }
    });
  eachPixel(
    [&](int x, int y, TruePixel& p)
    {
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j)
      {
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i)
        {
          p.atEdge = p.atEdge ||
            discontinuous(
              view, p.hit, x, y, pixels[static_cast<std::size_t>(j) * width + i].hit, i, j);
        }
      }
    });
  return pixels;
}
}
