// The walk through octrees in GLSL meets what the processor meets in double precision, ray by ray:
// of random rays through instances of several octrees, moved, stretched and mirrored, some of them
// translucent, all over or by the alpha of their colours, near the world's origin and far from it.
// Asked by fragments, and for a shadow mask.
#include "svoFragments.h"
#include "svoTestPicture.h"

#include "svoIntersect.h"
#include "svoLeafError.h"
#include "svoLightCode.h"
#include "svoMeshOctree.h"
#include "svoOpenGLTracer.h"
#include "svoShadowMask.h"
#include "svoShadowReceivers.h"
#include "svoSurface.h"
#include "svoSurfaceAlpha.h"
#include "svoWorldToOctree.h"

#include "vtkImplicitFunctionToSVO.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkPolyData.h"
#include "vtkPolyDataToSVO.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSphere.h"
#include "vtkSphereSource.h"
#include "vtkSuperquadricSource.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <iostream>
#include <random>
#include <string>
#include <vector>

namespace
{
using namespace svotest;

constexpr int Across = 192; // rays, squared
/// Steps of a share in a mask.
constexpr float Step = 1.0f / 255.0f;
/// How far shares may be off, and in a mask: likewise of alpha between a triangle's corners, which
/// comes from weights in floats and may lie anywhere between two steps, of which OpenGL takes about
/// the nearest.
constexpr float ShareError = 1e-5f, MaskError = 0.51f * Step;
constexpr float AlphaError = 1e-4f, AlphaMaskError = 0.6f * Step;
/// Rays that pass an edge as closely as floats tell may go either way: the project's bound.
constexpr double MostOther = 3e-4;

svo::Octree octreeIn(vtkDataObject* carrier)
{
  svo::Octree octree;
  std::string message;
  svo::openAttachedOctree(vtkPolyData::SafeDownCast(carrier), octree, message);
  return octree;
}

svo::Octree octreeOf(vtkAlgorithm* source, int level)
{
  vtkNew<vtkPolyDataToSVO> filter;
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetMaximumLevel(level);
  filter->Update();
  return octreeIn(filter->GetOutput());
}

/// Of a ball's planes; a part of it, so that its box matters.
svo::Octree octreeOfPlanes(int level)
{
  vtkNew<vtkSphere> ball;
  ball->SetRadius(0.5);
  vtkNew<vtkImplicitFunctionToSVO> filter;
  filter->SetImplicitFunction(ball);
  filter->SetModelBounds(-0.6, 0.6, -0.6, 0.3, -0.45, 0.6);
  filter->SetMaximumLevel(level);
  filter->Update();
  return octreeIn(filter->GetOutput());
}

/// Colours whose alpha differs from point to point, cell to cell, texel to texel, voxel to voxel.
class Colors
{
public:
  explicit Colors(const svo::Octree& octree)
  {
    const svo::Surface* surface = octree.surface();
    const std::size_t points = surface ? surface->points.size() : 0;
    this->Any.resize(4 *
      std::max<std::size_t>(
        octree.header().listWords, surface ? points + surface->triangles.size() : 0));
    std::mt19937 random(5);
    std::generate(this->Any.begin(), this->Any.end(),
      [&] { return static_cast<unsigned char>(random() & 255); });
    for (std::size_t i = 0; i < points; ++i)
    {
      this->Coordinates.push_back(3.0f * surface->points[i].x - 4.0f);
      this->Coordinates.push_back(i % 7 == 0 ? 1.0f : 0.0f); // NaN
    }
  }

  svo::Attributes of(const svo::Octree& octree, int kind) const
  {
    svo::Attributes colors;
    colors.colors = this->Any.data();
    colors.colorAssociation = !octree.surface() ? svo::Association::Leaf
      : kind % 3 == 0                           ? svo::Association::Cell
                                                : svo::Association::Point;
    if (octree.surface() && kind % 3 == 2)
    {
      colors.colorCoordinates = this->Coordinates.data();
      colors.colorTexture = this->Any.data();
      colors.colorTextureSize = 8;
    }
    return colors;
  }

private:
  std::vector<unsigned char> Any;
  std::vector<float> Coordinates;
};

svo::Scene sceneAt(const glm::dvec3& centre, double size, int copies)
{
  vtkNew<vtkSphereSource> coarse;
  vtkNew<vtkSphereSource> fine;
  fine->SetThetaResolution(120);
  fine->SetPhiResolution(90);
  vtkNew<vtkSuperquadricSource> ring;
  ring->ToroidalOn();
  ring->SetThetaResolution(60);
  ring->SetPhiResolution(40);
  const svo::Octree octrees[] = { octreeOf(coarse, 3), octreeOf(fine, 7), octreeOf(ring, 6),
    octreeOfPlanes(6), octreeOfPlanes(9) };
  static const Colors colors[] = { Colors(octrees[0]), Colors(octrees[1]), Colors(octrees[2]),
    Colors(octrees[3]), Colors(octrees[4]) };
  svo::Scene scene;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < copies; ++i)
  {
    svo::Instance instance;
    instance.body.own().octree = octrees[i % 5];
    const double spread = i == 0 ? 0.0 : size;
    glm::dmat4 matrix = glm::translate(
      glm::dmat4(1.0), centre + spread * glm::dvec3(any(random), any(random), any(random)));
    matrix = glm::rotate(matrix, 3.0 * any(random), { any(random), any(random), 1.0 });
    const double scale = size / std::cbrt(static_cast<double>(copies));
    matrix = glm::scale(matrix, scale * glm::dvec3(1.0, 0.4 + 0.3 * any(random), -1.3));
    instance.localToWorld = matrix;
    instance.visible = false;
    instance.opacity = i % 4 == 3 ? 0.25f : 1.0f;
    if (i % 4 > 1)
    {
      instance.mappedOpacity = true;
      instance.body.own().attributes = colors[i % 5].of(octrees[i % 5], i / 5);
    }
    scene.instances.push_back(instance);
  }
  svo::Light sun;
  sun.direction = glm::normalize(glm::dvec3(0.3, -0.4, -1.0));
  svo::Light bulb;
  bulb.kind = svo::Light::Kind::Point;
  bulb.position = centre + 0.6 * size * glm::dvec3(1.0, -0.7, 0.8);
  svo::Light idle = sun;
  idle.castShadow = false;
  scene.lights = { idle, sun, bulb };
  return scene;
}

/// True if a ray from a surface with a normal meets planes, and not only those of its own surface:
/// what it meets before it has left a voxel's height is met from there, too. Octree coordinates.
bool meetsPlanes(const svo::Octree& octree, svo::Ray ray, const glm::dvec3& normal)
{
  const svo::TraceOptions options{ svo::LeafGeometry::Plane, svo::MaximumLevel };
  const double above = svo::CubeError * octree.header().voxelSize / octree.rootEdge();
  const double near =
    above / std::max(glm::dot(normal, ray.direction), 0.05 * glm::length(ray.direction));
  const svo::Hit hit = svo::intersect(octree, ray, options);
  if (!hit || hit.t >= near)
  {
    return static_cast<bool>(hit);
  }
  const svo::Ray farther{ ray.origin, ray.direction, near, ray.tMax };
  ray.origin += above * normal;
  return svo::occluded(octree, farther, options) || svo::occluded(octree, ray, options);
}

/// What a caster whose colours have alpha takes of a ray that meets it: where that is first, seen
/// from the light.
double takenByColors(const svo::Instance& instance, const svo::Ray& ray, const glm::dvec3& normal)
{
  const svo::Octree& octree = instance.body->octree;
  const bool planes = octree.hasPlanes();
  const double far = std::min(
    ray.tMax, (glm::distance(ray.origin, glm::dvec3(1.5)) + 1.0) / glm::length(ray.direction));
  const double above = svo::CubeError * octree.header().voxelSize / octree.rootEdge();
  for (const double side : { planes ? above : 0.0, 0.0 })
  {
    const glm::dvec3 end = ray.origin + side * normal;
    const svo::Hit hit =
      svo::intersect(octree, { end + far * ray.direction, -ray.direction, 0.0, far },
        { planes ? svo::LeafGeometry::Plane : svo::LeafGeometry::Triangle, svo::MaximumLevel });
    if (hit)
    {
      const svo::SurfaceMatrices matrices(instance);
      const glm::dvec3 at = end + (far - hit.t) * ray.direction;
      return instance.opacity *
        (planes ? svo::detail::alphaOfPlane(matrices, hit.primitive, at)
                : svo::detail::alphaOfTriangle(matrices, hit.primitive, at));
    }
  }
  return 0.0;
}

struct Left
{
  float share = 1.0f;
  bool colors = false; // some have taken by the alpha of theirs
};

/// What casters leave of a light at a point of a surface with a normal, by rays in double.
Left expectedAt(const svo::Scene& scene, const svo::Light& light, const glm::dvec3& point,
  const glm::dvec3& normal)
{
  Left left;
  for (const svo::Instance& instance : scene.instances)
  {
    const svo::Octree& octree = instance.body->octree;
    const svo::WorldToOctree toOctree(octree, instance.localToWorld);
    const svo::Ray ray{ toOctree.point(point), toOctree.vector(-light.along(point)), 0.0,
      light.atInfinity() ? 1e300 : 1.0 };
    const glm::dvec3 side = glm::normalize(toOctree.vector(normal));
    if (octree.hasPlanes()
        ? meetsPlanes(octree, ray, side)
        : svo::occluded(octree, ray, { svo::LeafGeometry::Triangle, svo::MaximumLevel }))
    {
      left.colors = left.colors || instance.mappedOpacity;
      left.share *= 1.0f -
        (instance.mappedOpacity ? static_cast<float>(takenByColors(instance, ray, side))
                                : instance.opacity);
    }
  }
  return left;
}

void compare(vtkOpenGLRenderWindow* window, const std::string& name, const glm::dvec3& centre,
  double size, int copies, Checks& checks)
{
  const svo::Scene scene = sceneAt(centre, size, copies);
  const glm::dmat4 worldToView =
    glm::lookAt(centre + size * glm::dvec3(1.5, -3.0, 2.0), centre, glm::dvec3(0.0, 0.0, 1.0));
  svo::View view;
  svo::makeView(worldToView, glm::perspective(0.6, 1.0, 0.1 * size, 10.0 * size), 64, 64, view);
  svo::FrameSettings settings;
  settings.shadowTechnique = svo::ShadowTechnique::Rays;
  settings.lightCode = true;
  const std::unique_ptr<svo::Tracer> tracer = svo::makeOpenGLTracer(svo::makeCPUTracer());
  tracer->render(scene, view, settings, svo::ParallelFor());
  const svo::LightCode& code = tracer->lightCode();
  checks.expect(code.complaint.empty(), name + ": " + code.complaint);
  checks.expect(code.lights == std::vector<int>({ 1, 2 }), name + ": the lights that cast");

  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-1.2, 1.2);
  std::vector<std::vector<FourFloats>> inputs(1);
  std::vector<glm::dvec3> points;
  const glm::dmat4 viewToWorld = glm::inverse(worldToView);
  for (int i = 0; i < Across * Across; ++i)
  {
    const glm::dvec3 at = centre + size * glm::dvec3(any(random), any(random), any(random));
    const glm::vec3 seen(worldToView * glm::dvec4(at, 1.0));
    inputs[0].push_back({ seen.x, seen.y, seen.z, 1.0f });
    points.emplace_back(viewToWorld * glm::dvec4(seen, 1.0));
  }
  // A plane towards both lights, but for points between them.
  const std::string facet =
    "  vec3 position = texelFetch(input0, at, 0).xyz;\n"
    "  vec3 towards[2];\n"
    "  for (int i = 0; i < 2; ++i)\n"
    "  {\n"
    "    towards[i] = normalize(svoLights[i].xyz - svoLights[i].w * position);\n"
    "  }\n"
    "  vec3 facet = normalize(towards[0] + towards[1]);\n";
  svo::ShadowReceivers receivers;
  receivers.update(window, code, 1.0, false);
  const auto prepare = [&](vtkShaderProgram* program)
  { receivers.setUniforms(program, true, false); };
  receivers.activate();
  const std::vector<FourFloats> found =
    runFragments(window, Across, inputs, receivers.declarations(),
      facet +
        "  float left[2];\n"
        "  for (int i = 0; i < 2; ++i)\n"
        "  {\n"
        "    left[i] = svoShown(svoLeft(i, position, towards[i], towards[i], vec3(0.0), 0.0));\n"
        "  }\n"
        "  gl_FragData[0] = vec4(left[0], left[1], dot(facet, towards[0]), 1.0);\n",
      prepare);
  checks.expect(found.size() == points.size(), name + ": the shader runs");
  std::vector<FourFloats> masks[2];
  const svo::ShadowMask::Method ways[] = { svo::ShadowMask::Method::Fragments,
    svo::ShadowMask::Method::Compute };
  for (int i = 0; i < 2; ++i)
  {
    svo::ShadowMask mask;
    mask.setMethod(ways[i]);
    svo::ShadowReceivers looking;
    looking.update(window, mask.lookUp(code, Across, Across, false, 1 << 24), 1.0, false);
    checks.expect(looking.gathers() && mask.computes() == (i == 1), name + ": a mask");
    mask.find(window->GetState(), code, false,
      [&](int, int)
      {
        drawFragments(window, Across, inputs, receivers.declarations(),
          facet +
            "  gl_FragData[0] = svoPlaceOf(position, vec3(0.0), 0.0);\n"
            "  gl_FragData[1] = svoPlanesOf(facet, facet);\n",
          prepare);
      });
    looking.activate();
    masks[i] = runFragments(window, Across, inputs, looking.declarations(),
      "  vec3 zero = vec3(0.0);\n"
      "  gl_FragData[0] = vec4(svoLeft(0, zero, zero, zero, zero, 0.0),\n"
      "    svoLeft(1, zero, zero, zero, zero, 0.0), svoShown(0.0), at.x);\n",
      [&](vtkShaderProgram* program) { looking.setUniforms(program, true, false); });
    looking.deactivate();
    checks.expect(masks[i].size() == points.size(), name + ": a mask's shader runs");
    checks.expect(mask.bytes() > 0, name + ": a mask takes memory");
    mask.release();
    checks.expect(mask.bytes() == 0, name + ": and gives it back");
  }
  receivers.deactivate();
  std::size_t dark = 0, dimmed = 0, other = 0, masked = 0, unequal = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const glm::dvec3 towards[] = { glm::normalize(-scene.lights[1].along(points[i])),
      glm::normalize(-scene.lights[2].along(points[i])) };
    for (int k = 0; k < 2; ++k)
    {
      const svo::Light& light = scene.lights[k + 1];
      const Left expected = expectedAt(scene, light, points[i], towards[k]);
      const Left inMask = expectedAt(scene, light, points[i], towards[0] + towards[1]);
      dark += expected.share == 0.0f;
      dimmed += expected.share > 0.0f && expected.share < 1.0f;
      other += std::abs(expected.share - found[i][k]) > (expected.colors ? AlphaError : ShareError);
      const bool faces = found[i][2] > 0.01f;
      masked += faces &&
        std::abs(inMask.share - masks[0][i][k]) > (inMask.colors ? AlphaMaskError : MaskError);
    }
    unequal += masks[0][i] != masks[1][i];
  }
  std::cout << name << ": " << 2 * found.size() << " rays, " << dark << " dark, " << dimmed
            << " dimmed, " << other << " others, " << masked << " in a mask, " << unequal
            << " otherwise in computed ones\n";
  checks.expect(dark > found.size() / 10, name + ": some are dark");
  checks.expect(copies < 4 || dimmed > found.size() / 100, name + ": some are dimmed");
  checks.expect(other <= MostOther * 2.0 * found.size(), name + ": as in double precision");
  checks.expect(masked <= MostOther * 2.0 * found.size(), name + ": and in a mask");
  checks.expect(unequal <= MostOther * found.size(), name + ": and in one that was computed");
  tracer->releaseGraphicsResources();
  checks.expect(tracer->lightCode().empty(), name + ": nothing is left in the context");
}
}

int TestSVORayWalk(int, char*[])
{
  Checks checks;
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(true);
  window->SetSize(64, 64);
  vtkNew<vtkRenderer> renderer;
  window->AddRenderer(renderer);
  window->Render();
  auto* context = vtkOpenGLRenderWindow::SafeDownCast(window);
  compare(context, "one", { 0.0, 0.0, 0.0 }, 1.0, 1, checks);
  compare(context, "forty", { 0.0, 0.0, 0.0 }, 1.0, 40, checks);
  compare(context, "far away", { 1e6, -3e5, 2e6 }, 1.0, 12, checks);
  compare(context, "tiny", { 0.1, 0.2, 0.3 }, 1e-6, 12, checks);
  compare(context, "huge", { 0.0, 0.0, 1e9 }, 1e9, 12, checks);
  return checks.exitCode();
}
