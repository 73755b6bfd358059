// What VTK's shaders write, computed by hand for points whose geometry is simple.
#include "svoReferenceShading.h"
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace svotest;

namespace
{
/// View space is the world: the eye at the origin looks along -z.
svo::View identityView()
{
  svo::View view;
  svo::makeView(glm::dmat4(1.0), glm::perspective(1.0, 1.0, 0.1, 100.0), 8, 8, view);
  return view;
}

/// A point 4 in front of the eye with this normal.
svo::SurfacePoint pointFacing(const glm::vec3& normal)
{
  svo::SurfacePoint point{};
  point.position = { 0.0, 0.0, -4.0 };
  point.normal = glm::normalize(normal);
  point.facet = point.normal;
  return point;
}

svo::Instance shiny()
{
  svo::Instance instance;
  instance.material.ambient = 0.2f;
  instance.material.ambientColor = { 0.5f, 0.25f, 1.0f };
  instance.material.diffuse = 0.7f;
  instance.material.diffuseColor = { 0.8f, 0.4f, 0.2f };
  instance.material.specular = 0.5f;
  instance.material.specularColor = { 1.0f, 0.5f, 0.25f };
  instance.material.specularPower = 3.0f;
  return instance;
}

svo::Light lightTowards(const glm::dvec3& direction)
{
  svo::Light light;
  light.direction = glm::normalize(direction);
  light.color = { 1.0f, 0.5f, 0.75f };
  return light;
}

glm::vec3 colorOf(const svo::Scene& scene, const svo::Instance& instance,
  const svo::SurfacePoint& point, float remaining = 0.0f, bool dark = false)
{
  const svo::Lighting lighting(scene, identityView());
  return svo::shade(lighting, instance, point, remaining, [&](std::size_t) { return dark; });
}

void expectColor(const glm::vec3& found, const glm::vec3& expected)
{
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(found[i], expected[i], 1e-5) << "channel " << i;
  }
}

/// ambient + df diffuse light + sf specular light, as all of VTK's formulas end.
glm::vec3 sum(const svo::Instance& i, float df, float sf, const glm::vec3& light)
{
  const svo::Material& m = i.material;
  return m.ambient * m.ambientColor + df * light * (m.diffuse * m.diffuseColor) +
    sf * light * (m.specular * m.specularColor);
}
}

TEST(Shading, WithoutLightsOrLightingTheColourIsAmbientPlusDiffuse)
{
  svo::Scene scene;
  svo::Instance instance = shiny();
  const glm::vec3 expected(
    0.2f * 0.5f + 0.7f * 0.8f, 0.2f * 0.25f + 0.7f * 0.4f, 0.2f + 0.7f * 0.2f);
  expectColor(colorOf(scene, instance, pointFacing({ 0, 0, 1 })), expected);
  scene.lights.push_back(lightTowards({ 0, 0, -1 }));
  instance.material.lighting = false;
  expectColor(colorOf(scene, instance, pointFacing({ 0, 0, 1 })), expected);
}

// One headlight alone: df = n.z, and the highlight is a power of it.
TEST(Shading, AHeadlightAloneUsesTheNormalsZ)
{
  svo::Scene scene;
  scene.lights.push_back(lightTowards({ 0, 0, -1 }));
  scene.onlyHeadlight = true;
  const svo::Instance instance = shiny();
  // normal (0.6, 0, 0.8): df = 0.8, sf = 0.8^3 = 0.512
  expectColor(colorOf(scene, instance, pointFacing({ 0.6f, 0.0f, 0.8f })),
    sum(instance, 0.8f, 0.512f, scene.lights[0].color));
}

// With a second light the headlight takes the formula of the light kit: the highlight is a power
// of the reflected light's cosine with the viewer.
TEST(Shading, AHeadlightInCompanyUsesTheReflection)
{
  svo::Scene scene;
  scene.lights.push_back(lightTowards({ 0, 0, -1 }));
  scene.lights.push_back(lightTowards({ 0, 0, 1 }));
  scene.lights[0].headlight = true;
  const svo::Instance instance = shiny();
  // reflect((0,0,-1), n) = (0.96, 0, 0.28); towards the viewer is +z: 0.28^3. The second light
  // shines from behind.
  expectColor(colorOf(scene, instance, pointFacing({ 0.6f, 0.0f, 0.8f })),
    sum(instance, 0.8f, 0.28f * 0.28f * 0.28f, scene.lights[0].color));
}

TEST(Shading, ADirectionalLightIsLambertPlusPhong)
{
  svo::Scene scene;
  scene.lights.push_back(lightTowards({ 0.6, 0.0, -0.8 }));
  const svo::Instance instance = shiny();
  // n = z: df = 0.8; the reflected direction (0.6, 0, 0.8) has 0.8 with the viewer.
  expectColor(colorOf(scene, instance, pointFacing({ 0, 0, 1 })),
    sum(instance, 0.8f, 0.512f, scene.lights[0].color));
}

TEST(Shading, APointLightFallsOffWithDistance)
{
  svo::Scene scene;
  scene.lights.push_back(lightTowards({ 0, 0, -1 }));
  scene.lights[0].kind = svo::Light::Kind::Point;
  scene.lights[0].position = { 3.0, 0.0, 0.0 }; // 5 from the point, direction (-0.6, 0, -0.8)
  scene.lights[0].attenuation = { 0.5f, 0.1f, 0.04f }; // 1 / (0.5 + 0.5 + 1) = 0.5
  const svo::Instance instance = shiny();
  expectColor(colorOf(scene, instance, pointFacing({ 0, 0, 1 })),
    sum(instance, 0.5f * 0.8f, 0.5f * 0.512f, scene.lights[0].color));
}

TEST(Shading, ASpotFadesTowardsItsConeAndEndsThere)
{
  svo::Scene scene;
  scene.lights.push_back(lightTowards({ 0, 0, -1 }));
  scene.lights[0].kind = svo::Light::Kind::Spot;
  scene.lights[0].position = { 3.0, 0.0, 0.0 };
  scene.lights[0].exponent = 2.0;
  scene.lights[0].coneAngle = 40.0; // the point is at acos(0.8) = 36.9 degrees
  const svo::Instance instance = shiny();
  expectColor(colorOf(scene, instance, pointFacing({ 0, 0, 1 })),
    sum(instance, 0.64f * 0.8f, 0.64f * 0.512f, scene.lights[0].color));
  scene.lights[0].coneAngle = 36.0;
  expectColor(colorOf(scene, instance, pointFacing({ 0, 0, 1 })),
    sum(instance, 0.0f, 0.0f, scene.lights[0].color));
}

TEST(Shading, MappedScalarsReplaceAmbientAndDiffuseColour)
{
  svo::Scene scene;
  scene.lights.push_back(lightTowards({ 0, 0, -1 }));
  svo::Instance instance = shiny();
  svo::SurfacePoint point = pointFacing({ 0, 0, 1 });
  point.hasColor = true;
  point.color = { 0.1f, 0.9f, 0.4f };
  const glm::vec3 found = colorOf(scene, instance, point);
  instance.material.ambientColor = instance.material.diffuseColor = point.color;
  expectColor(found, sum(instance, 1.0f, 1.0f, scene.lights[0].color));
}

// Of two lights only the casting one that is hidden goes, diffuse and specular, by the intensity.
TEST(Shading, AShadowTakesItsShareOfItsLightAlone)
{
  svo::Scene scene;
  scene.lights.push_back(lightTowards({ 0.6, 0.0, -0.8 }));
  scene.lights.push_back(lightTowards({ 0, 0, -1 }));
  scene.lights[1].castShadow = false;
  const svo::Instance instance = shiny();
  const glm::vec3 found = colorOf(scene, instance, pointFacing({ 0, 0, 1 }), 0.25f, true);
  const glm::vec3 ambient = instance.material.ambient * instance.material.ambientColor;
  expectColor(found,
    0.25f * (sum(instance, 0.8f, 0.512f, scene.lights[0].color) - ambient) +
      sum(instance, 1.0f, 1.0f, scene.lights[1].color));
}

// Both sides of a surface are shaded with the normal that faces the viewer; point normals are
// interpolated unless the look is flat.
TEST(Shading, NormalsFollowTheMeshAndFaceTheViewer)
{
  const svo::Octree ball = makeOctree(sphere(20, 30), 6);
  const Mesh mesh = sphere(20, 30);
  std::vector<float> normals;
  for (const glm::dvec3& p : mesh.points)
  {
    normals.insert(normals.end(), { float(p.x), float(p.y), float(p.z) });
  }
  svo::Scene scene;
  scene.instances = { instanceOf(ball, 1) };
  scene.lights.push_back(lightTowards({ 0, 1, 0 }));
  svo::FrameSettings settings;
  settings.shadowTechnique = svo::ShadowTechnique::None;
  settings.writeNormals = true;
  const svo::View view = lookAtParallel({ 0, -5, 0 }, 48, 48, 1.2);
  for (bool smooth : { false, true })
  {
    scene.instances[0].body.own().attributes.normals = smooth ? normals.data() : nullptr;
    scene.instances[0].body.own().attributes.normalAssociation =
      smooth ? svo::Association::Point : svo::Association::None;
    const svo::Frame frame = rendered(scene, view, settings);
    double worst = 0.0;
    for (std::size_t i = 0; i < frame.instance.size(); ++i)
    {
      if (frame.instance[i] == ~0u)
      {
        continue;
      }
      const glm::dvec3 normal(
        frame.normals[3 * i], frame.normals[3 * i + 1], frame.normals[3 * i + 2]);
      EXPECT_NEAR(glm::length(normal), 1.0, 1e-5);
      EXPECT_GT(normal.z, -1e-3);
      const double x = (i % 48 + 0.5) / 20.0 - 1.2;
      const double y = (i / 48 + 0.5) / 20.0 - 1.2;
      if (x * x + y * y < 0.8)
      {
        worst =
          std::max(worst, glm::length(normal - glm::dvec3(x, y, std::sqrt(1.0 - x * x - y * y))));
      }
    }
    if (smooth)
    {
      EXPECT_LT(worst, 0.03);
    }
    else
    {
      EXPECT_GT(worst, 0.05);
      EXPECT_LT(worst, 0.3);
    }
  }
  // From inside: the other side, still facing the viewer, so still lit.
  scene.instances[0].body.own().attributes = svo::Attributes();
  const svo::Frame inside = rendered(scene, lookAt({ 0.0, -0.5, 0.0 }, 16, 16, 30.0), settings);
  EXPECT_GT(inside.color[4 * (8 * 16 + 8)], 200);
}

TEST(Shading, CellAndPointColoursAreLookedUpByCellAndInterpolatedByPoint)
{
  // One triangle pair; colours red, green by cell; then a ramp by point.
  svo::BuildOptions options;
  options.level = 6;
  const Mesh mesh = square(1.0);
  const svo::BuildResult built = svo::build(mesh.view(), options);
  const auto& header = *reinterpret_cast<const svo::Header*>(built.data.get());
  std::string error;
  const svo::Octree octree = svo::Octree::open(
    built.data, built.size, svo::makeSurface(mesh.view(), { 1, 0 }, header, svo::serialFor), error);
  ASSERT_TRUE(bool(octree)) << error;
  svo::Scene scene;
  scene.instances = { instanceOf(octree, 1) };
  scene.instances[0].material.lighting = false;
  svo::View view;
  svo::makeView(glm::lookAt(glm::dvec3(0, 0, 3), glm::dvec3(0), glm::dvec3(0, 1, 0)),
    glm::ortho(-1.0, 1.0, -1.0, 1.0, 0.1, 9.0), 32, 32, view);
  const auto pixel = [](const svo::Frame& frame, int x, int y)
  { return frame.color.data() + 4 * (32 * y + x); };
  svo::Attributes& attributes = scene.instances[0].body.own().attributes;

  const unsigned char cells[] = { 255, 0, 0, 255, 0, 255, 0, 255 };
  attributes.colors = cells;
  attributes.colorAssociation = svo::Association::Cell;
  const svo::Frame byCell = rendered(scene, view, svo::FrameSettings());
  EXPECT_EQ(pixel(byCell, 24, 8)[1], 255); // lower right: triangle 0 is cell 1
  EXPECT_EQ(pixel(byCell, 8, 24)[0], 255);

  const unsigned char points[] = { 0, 0, 0, 255, 255, 0, 0, 255, 255, 0, 0, 255, 0, 0, 0, 255 };
  attributes.colors = points;
  attributes.colorAssociation = svo::Association::Point;
  const svo::Frame byPoint = rendered(scene, view, svo::FrameSettings());
  for (int x = 0; x < 32; ++x)
  {
    EXPECT_NEAR(pixel(byPoint, x, 5)[0], (x + 0.5) / 32 * 255, 1.0);
  }

  // Interpolated before mapping: each texel has its third of the way, and nothing is blended.
  const float coordinates[] = { 0.0f, 0.49f, 1.0f, 0.49f, 1.0f, 0.49f, 0.0f, 0.49f };
  const unsigned char texels[] = { 0, 0, 255, 255, 0, 255, 0, 255, 255, 0, 0, 255, //
    90, 90, 90, 255, 90, 90, 90, 255, 90, 90, 90, 255 };
  attributes = svo::Attributes();
  attributes.colorCoordinates = coordinates;
  attributes.colorTexture = texels;
  attributes.colorTextureSize = 3;
  const svo::Frame mapped = rendered(scene, view, svo::FrameSettings());
  for (int x = 0; x < 32; ++x)
  {
    EXPECT_EQ(pixel(mapped, x, 16)[2], x < 11 ? 255 : 0) << x;
    EXPECT_EQ(pixel(mapped, x, 16)[1], x >= 11 && x < 21 ? 255 : 0) << x;
    EXPECT_EQ(pixel(mapped, x, 16)[0], x >= 21 ? 255 : 0) << x;
  }

  // A point without a value takes the colour of NaN almost to its neighbours; no value is safe.
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float odd[] = { 0.5f, 1.0f, 1.0f, 0.49f, nan, 0.49f, 0.0f, 0.49f };
  attributes.colorCoordinates = odd;
  const svo::Frame partly = rendered(scene, view, svo::FrameSettings());
  EXPECT_EQ(pixel(partly, 1, 1)[0], 90);
  EXPECT_EQ(pixel(partly, 30, 1)[0], 90);
  EXPECT_EQ(pixel(partly, 31, 16)[2], 255);
}
