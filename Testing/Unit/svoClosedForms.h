// Planes seen from above, what of the light arrives at their pixels with soft shadows and ambient
// occlusion, and closed forms of it.
#ifndef svoClosedForms_h
#define svoClosedForms_h

#include "svoTracerScenes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace svotest
{
/// The plane z = 0 around `at`, from 50 above.
inline svo::View fromAbove(double halfWidth, double halfHeight, int width, int height,
  const glm::dvec3& at = glm::dvec3(0.0))
{
  svo::View view;
  svo::makeView(glm::lookAt(at + glm::dvec3(0, 0, 50), at, glm::dvec3(0, 1, 0)),
    glm::ortho(-halfWidth, halfWidth, -halfHeight, halfHeight, 1.0, 100.0), width, height, view);
  return view;
}

/// Where pixel i of such a view is.
inline glm::dvec3 onPlane(const svo::View& view, std::size_t i, double z = 0.0)
{
  const auto width = static_cast<std::size_t>(view.width);
  const double x = static_cast<double>(i % width) + 0.5, y = static_cast<double>(i / width) + 0.5;
  const glm::dvec3 o = view.rayOrigin(x, y), d = view.rayDirection(x, y);
  return o + (z - o.z) / d.z * d;
}

/// A plane that is seen and casts nothing, under casters that are not seen.
inline svo::Scene planeUnder(const std::vector<svo::Instance>& casters, double half = 30.0)
{
  svo::Scene scene;
  scene.instances = { instanceOf(makeOctree(square(half), 4), 1) };
  scene.instances[0].castShadow = false;
  for (svo::Instance caster : casters)
  {
    caster.id = 1 + scene.instances.size();
    caster.visible = caster.receiveShadow = false;
    scene.instances.push_back(caster);
  }
  return scene;
}

inline svo::Light disc(const glm::dvec3& towards, double angle)
{
  svo::Light light = lightOf(svo::Light::Kind::Directional, towards);
  light.size = angle;
  return light;
}

inline svo::Light ballLight(const glm::dvec3& position, double radius)
{
  svo::Light light = lightOf(svo::Light::Kind::Point, position);
  light.size = radius;
  return light;
}

/// Each point by its own samples alone.
inline svo::FrameSettings sampled(int samples)
{
  svo::FrameSettings settings;
  settings.lightSamples = samples;
  settings.filterLightSamples = false;
  settings.writeLight = true;
  return settings;
}

/// Of each pixel, what arrives of the scene's first light, 0..1; 1 where it would not arrive
/// anyway.
inline std::vector<double> lightShares(
  svo::Scene scene, const svo::View& view, const svo::FrameSettings& settings)
{
  const svo::Frame shadowed = rendered(scene, view, settings);
  scene.lights[0].castShadow = false;
  const svo::Frame plain = rendered(scene, view, settings);
  std::vector<double> shares;
  for (std::size_t i = 0; i < plain.instance.size(); ++i)
  {
    const bool lit = plain.instance[i] != ~0u && plain.light[3 * i] > 0.0f;
    shares.push_back(lit ? double(shadowed.light[3 * i]) / plain.light[3 * i] : 1.0);
  }
  return shares;
}

/// Of each pixel, which share of its hemisphere is closed. No lights: white surfaces are 1.
inline std::vector<double> closedShares(
  svo::Scene scene, const svo::View& view, svo::FrameSettings settings, double distance)
{
  scene.lights.clear();
  settings.ambientOcclusion = true;
  settings.ambientOcclusionDistance = distance;
  const svo::Frame frame = rendered(scene, view, settings);
  std::vector<double> shares;
  for (std::size_t i = 0; i < frame.instance.size(); ++i)
  {
    shares.push_back(frame.instance[i] != ~0u ? 1.0 - double(frame.light[3 * i]) : 0.0);
  }
  return shares;
}

/// The share of a disc of radius 1 that lies beyond a line at distance c from its middle.
inline double segmentShare(double c)
{
  c = std::clamp(c, -1.0, 1.0);
  return (std::acos(c) - c * std::sqrt(1.0 - c * c)) / Pi;
}

/// The share, by solid angle, of a cone of directions with this cosine of its half angle that lies
/// beyond a plane; `sine`: of the plane's normal with the cone's axis. The mean, over rings of
/// equal solid angle, of the ring's part there: to 1e-5.
inline double capShare(double sine, double cosine)
{
  constexpr int Rings = 4000;
  const double across = std::sqrt(1.0 - sine * sine);
  double sum = 0.0;
  for (int ring = 0; ring < Rings; ++ring)
  {
    const double z = 1.0 - (ring + 0.5) / Rings * (1.0 - cosine);
    const double k = sine * z / (across * std::sqrt(1.0 - z * z));
    sum += std::acos(std::clamp(k, -1.0, 1.0)) / Pi;
  }
  return sum / Rings;
}

inline svo::Instance caster(
  const Mesh& mesh, const glm::dmat4& place = glm::dmat4(1.0), int level = 4)
{
  return instanceOf(makeOctree(mesh, level), 0, place);
}

inline std::vector<double> onPixels(
  const svo::View& view, const std::function<double(const glm::dvec3&)>& f)
{
  std::vector<double> all;
  for (std::size_t i = 0; i < static_cast<std::size_t>(view.width * view.height); ++i)
  {
    all.push_back(f(onPlane(view, i)));
  }
  return all;
}

constexpr double Unlimited = 1e20;

/// A vertical wall at x, from the plane up to `height`, and `length` to both sides.
inline svo::Instance wall(double x, double height, double length)
{
  Mesh mesh;
  mesh.points = { { x, -length, 0 }, { x, length, 0 }, { x, length, height },
    { x, -length, height } };
  mesh.triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  return caster(mesh);
}

/// A box with walls, floor and lid from (-1, -1, -0.5) to (1, 1, 2).
inline Mesh closedBox()
{
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
  {
    mesh.points.push_back({ i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 2.0 : -0.5 });
  }
  mesh.triangles = { { 0, 2, 1 }, { 1, 2, 3 }, { 4, 5, 6 }, { 5, 7, 6 }, { 0, 1, 4 }, { 1, 5, 4 },
    { 2, 6, 3 }, { 3, 6, 7 }, { 0, 4, 2 }, { 2, 4, 6 }, { 1, 3, 5 }, { 3, 7, 5 } };
  return mesh;
}

/// Of a point at `distance` from a wall, what a part of the wall closes that reaches `length` to
/// one side: the form factor of a rectangle on the edge of which a surface stands upright (Howell,
/// "A Catalog of Radiation Heat Transfer Configuration Factors", B-4).
inline double besideWall(double distance, double height, double length)
{
  const double across = std::hypot(distance, height);
  return (std::atan(length / distance) - distance / across * std::atan(length / across)) /
    (2.0 * Pi);
}
}

#endif
