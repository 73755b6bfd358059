// A frame that is made of what the last one was made of is not made again; any other is.
#include "svoRandomScenes.h"
#include "svoSilhouettes.h"
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace svotest;

namespace
{
/// A smooth ball with colours over a ground, and all that a frame is made of.
struct Stage
{
  Mesh ballMesh = sphere(7, 9), groundMesh = square(3.0);
  svo::Octree ball = makeOctree(ballMesh, 7), deepBall = makeOctree(ballMesh, 8);
  svo::Octree ground = makeOctree(groundMesh, 6);
  std::vector<float> normals = radialNormals(ballMesh), others = normals;
  std::vector<unsigned char> colors;
  svo::Scene scene;
  svo::View view = lookAt({ 3, -5, 4 }, 160, 120);
  svo::FrameSettings settings;

  Stage()
  {
    for (std::size_t i = 0; i < 4 * ballMesh.points.size(); ++i)
    {
      colors.push_back(i % 4 == 3 ? 255 : static_cast<unsigned char>(50 + i % 199));
    }
    for (float& n : others)
    {
      n = -0.8f * n + 0.1f;
    }
    scene.instances = { instanceOf(ground, 1, movedTo(0, 0, -1)), instanceOf(ball, 2) };
    svo::Instance& smooth = scene.instances[1];
    smooth.body.own().attributes.normals = normals.data();
    smooth.body.own().attributes.normalAssociation = svo::Association::Point;
    smooth.material.specular = 0.3f;
    smooth.material.specularPower = 10.0f;
    smooth.material.ambient = 0.1f;
    scene.lights = { lightOf(svo::Light::Kind::Spot, { 2, -2, 6 }) };
    scene.lights[0].coneAngle = 60.0;
    settings.shadowResolution = 500;
  }
};

struct Change
{
  std::string name;
  std::function<void(Stage&)> make;
};

/// Changes of all that a frame depends on.
std::vector<Change> everyChange()
{
  const auto ball = [](Stage& s) -> svo::Instance& { return s.scene.instances[1]; };
  const auto light = [](Stage& s) -> svo::Light& { return s.scene.lights[0]; };
  return {
    { "matrix", [=](Stage& s) { ball(s).localToWorld = movedTo(0.1, 0, 0); } },
    { "octree", [=](Stage& s) { ball(s).body.own().octree = s.deepBall; } },
    { "caster's octree", [=](Stage& s) { ball(s).body.own().casterOctree = s.deepBall; } },
    { "leaves", [=](Stage& s) { ball(s).body.own().leafGeometry = svo::LeafGeometry::Voxel; } },
    { "points",
      [=](Stage& s)
      {
        ball(s).body.own().points.doubles = &s.ballMesh.points.data()->x;
        ball(s).body.own().points.count = s.ballMesh.points.size();
      } },
    { "deepest level", [=](Stage& s) { ball(s).body.own().deepestLevel = 12; } },
    { "needed level", [=](Stage& s) { ball(s).body.own().neededLevel = 9; } },
    { "ambient colour", [=](Stage& s) { ball(s).material.ambientColor.g = 0.2f; } },
    { "diffuse colour", [=](Stage& s) { ball(s).material.diffuseColor.r = 0.4f; } },
    { "specular colour", [=](Stage& s) { ball(s).material.specularColor.b = 0.1f; } },
    { "ambient", [=](Stage& s) { ball(s).material.ambient = 0.4f; } },
    { "diffuse", [=](Stage& s) { ball(s).material.diffuse = 0.5f; } },
    { "specular", [=](Stage& s) { ball(s).material.specular = 0.9f; } },
    { "power", [=](Stage& s) { ball(s).material.specularPower = 2.0f; } },
    { "unlit", [=](Stage& s) { ball(s).material.lighting = false; } },
    { "flat", [=](Stage& s) { ball(s).material.flat = true; } },
    { "normals at another place",
      [=](Stage& s) { ball(s).body.own().attributes.normals = s.others.data(); } },
    { "normals in their place",
      [=](Stage& s)
      {
        s.normals = s.others;
        ball(s).body.own().attributes.normals = s.normals.data();
        ball(s).body.own().attributes.version = 5;
      } },
    { "colours",
      [=](Stage& s)
      {
        ball(s).body.own().attributes.colors = s.colors.data();
        ball(s).body.own().attributes.colorAssociation = svo::Association::Point;
      } },
    { "invisible", [=](Stage& s) { ball(s).visible = false; } },
    { "casts not", [=](Stage& s) { ball(s).castShadow = false; } },
    { "receives not", [=](Stage& s) { s.scene.instances[0].receiveShadow = false; } },
    { "pixel error", [=](Stage& s) { ball(s).pixelError = 3.0; } },
    { "depth offset", [=](Stage& s) { ball(s).depthOffset.units = 1e-3f; } },
    { "depth offset by slopes", [=](Stage& s) { ball(s).depthOffset.factor = -2.0f; } },
    { "gives way", [=](Stage& s) { ball(s).coincidentOrder = 1; } },
    { "identity", [=](Stage& s) { ball(s).id = 3; } },
    { "order", [=](Stage& s) { std::swap(s.scene.instances[0], s.scene.instances[1]); } },
    { "one less", [=](Stage& s) { s.scene.instances.pop_back(); } },
    { "one more",
      [=](Stage& s) { s.scene.instances.push_back(instanceOf(s.ball, 4, movedTo(1.5, 0, 0))); } },
    { "receiver",
      [=](Stage& s)
      {
        s.scene.receivers.emplace_back();
        s.scene.receivers.back().add(glm::dvec3(-3, -3, -4));
        s.scene.receivers.back().add(glm::dvec3(3, 3, -3));
      } },
    { "kind of light", [=](Stage& s) { light(s).kind = svo::Light::Kind::Directional; } },
    { "light's position", [=](Stage& s) { light(s).position.x += 0.5; } },
    { "light's direction",
      [=](Stage& s) { light(s).direction = glm::normalize(glm::dvec3(0.1, 0.3, -1)); } },
    { "cone", [=](Stage& s) { light(s).coneAngle = 14.0; } },
    { "exponent", [=](Stage& s) { light(s).exponent = 9.0; } },
    { "attenuation",
      [=](Stage& s) {
        light(s).attenuation = { 0.5f, 0.1f, 0.0f };
      } },
    { "light's colour", [=](Stage& s) { light(s).color.b = 0.3f; } },
    { "light casts not", [=](Stage& s) { light(s).castShadow = false; } },
    { "another light",
      [=](Stage& s) {
        s.scene.lights.push_back(lightOf(svo::Light::Kind::Directional, { -2, -1, 3 }));
      } },
    { "headlight", [=](Stage& s) { s.scene.onlyHeadlight = true; } },
    { "camera",
      [=](Stage& s) {
        s.view = lookAt({ 3, -5, 4.1 }, 160, 120);
      } },
    { "window",
      [=](Stage& s) {
        s.view = lookAt({ 3, -5, 4 }, 200, 120);
      } },
    { "technique", [=](Stage& s) { s.settings.shadowTechnique = svo::ShadowTechnique::None; } },
    { "rays", [=](Stage& s) { s.settings.shadowTechnique = svo::ShadowTechnique::Rays; } },
    { "resolution", [=](Stage& s) { s.settings.shadowResolution = 256; } },
    { "coarser maps", [=](Stage& s) { s.settings.shadowCoarseness = 2.5; } },
    { "bias",
      [=](Stage& s)
      {
        s.settings.automaticBias = false;
        s.settings.bias = 8.0;
      } },
    { "intensity", [=](Stage& s) { s.settings.shadowIntensity = 0.5; } },
    { "frame's pixel error", [=](Stage& s) { s.settings.pixelError = 4.0; } },
    { "anti-aliasing", [=](Stage& s) { s.settings.antiAliasing = true; } },
    { "filtered shadows", [=](Stage& s) { s.settings.filterShadows = true; } },
    { "normals wanted", [=](Stage& s) { s.settings.writeNormals = true; } },
    { "slopes wanted", [=](Stage& s) { s.settings.writeSlopes = true; } },
    { "light wanted", [=](Stage& s) { s.settings.writeLight = true; } },
    { "whole buffers", [=](Stage& s) { s.settings.wholeShadowBuffers = true; } },
  };
}

void render(svo::Tracer& tracer, Stage& stage)
{
  stamp(stage.scene);
  tracer.render(stage.scene, stage.view, stage.settings, svo::serialFor);
}
}

TEST(KeptFrame, NothingIsDoneTwice)
{
  Stage stage;
  svo::CPUTracer tracer;
  const svo::Frame& frame = tracer.frame();
  render(tracer, stage);
  const svo::Frame first = frame;
  EXPECT_GT(tracer.statistics().primaryRays, 0u);
  EXPECT_GT(tracer.statistics().shadowRays, 0u);
  for (int i = 0; i < 3; ++i)
  {
    render(tracer, stage);
    EXPECT_EQ(first.version, frame.version);
    EXPECT_TRUE(identical(first, frame));
    EXPECT_EQ(0u, tracer.statistics().primaryRays);
    EXPECT_EQ(0u, tracer.statistics().shadowRays);
    EXPECT_EQ(0u, tracer.statistics().retracedLayers);
    EXPECT_GT(tracer.statistics().layerMemory, 0u);
  }
}

TEST(KeptFrame, EveryChangeIsSeen)
{
  for (const Change& change : everyChange())
  {
    SCOPED_TRACE(change.name);
    Stage stage;
    svo::CPUTracer tracer;
    const svo::Frame& frame = tracer.frame();
    render(tracer, stage);
    const std::uint64_t version = frame.version;
    change.make(stage);
    render(tracer, stage);
    EXPECT_NE(version, frame.version);
    EXPECT_TRUE(identical(rendered(stage.scene, stage.view, stage.settings), frame));
  }
}

// A ground that nothing lies below casts nothing.
TEST(KeptFrame, MapsAreFittedToReceiversThatHaveCome)
{
  Stage stage;
  auto& ground = const_cast<svo::Header&>(stage.ground.header());
  ground.pointCount = stage.groundMesh.points.size();
  std::copy_n(std::begin({ -3.0, 3.0, -3.0, 3.0, 0.0, 0.0 }), 6, ground.meshBounds);
  stage.scene.instances[0].localToWorld = movedTo(0, 0, -2);
  stage.scene.lights[0].kind = svo::Light::Kind::Directional;
  stage.settings.receiverMaps = true;
  svo::CPUTracer tracer, fresh;
  const auto width = [](const svo::Tracer& of)
  { return of.shadowMaps().size() == 1 ? 2.0 / of.shadowMaps()[0].view.viewToClip[0][0] : 0.0; };
  render(tracer, stage);
  EXPECT_LT(width(tracer), 4.0); // the ball's
  stage.scene.receivers = { { glm::dvec3(-3, -3, -4), glm::dvec3(3, 3, -3) } };
  render(tracer, stage);
  render(fresh, stage);
  EXPECT_GT(width(fresh), 5.0);
  EXPECT_EQ(width(fresh), width(tracer));
}

TEST(KeptFrame, IsMadeAgainWhereThatIsAskedFor)
{
  Stage stage;
  stage.settings.frameCoherence = false;
  svo::CPUTracer tracer;
  render(tracer, stage);
  const std::uint64_t version = tracer.frame().version;
  render(tracer, stage);
  EXPECT_EQ(version + 1, tracer.frame().version);
  EXPECT_GT(tracer.statistics().primaryRays, 0u);
}

namespace
{
const std::vector<glm::vec2> Positions{ { 0.4f, 0.1f }, { 0.9f, 0.4f }, { 0.1f, 0.6f },
  { 0.6f, 0.9f } };

void expectSame(const svo::Silhouettes& first, const svo::Silhouettes& second)
{
  ASSERT_GT(first.parts.size(), 50u);
  ASSERT_EQ(first.parts.size(), second.parts.size());
  for (std::size_t i = 0; i < first.parts.size(); ++i)
  {
    const svo::PixelPart &a = first.parts[i], &b = second.parts[i];
    EXPECT_TRUE(a.samples == b.samples && a.x == b.x && a.y == b.y && a.depth == b.depth &&
      std::equal(a.color, a.color + 4, b.color));
  }
  EXPECT_EQ(first.pixels.size(), second.pixels.size());
}
}

TEST(KeptFrame, EdgesAreDividedAllTheSame)
{
  svo::CPUTracer tracer;
  svo::Silhouettes first, second;
  {
    Stage stage;
    render(tracer, stage);
    tracer.divideEdges(stage.scene, stage.view, Positions, svo::serialFor, first);
    render(tracer, stage);
    // Somebody else's copy of the same scene, as every frame of a renderer has it.
    const svo::Scene copy = stage.scene;
    render(tracer, stage);
    tracer.divideEdges(copy, stage.view, Positions, svo::serialFor, second);
  }
  expectSame(first, second);
}

TEST(KeptFrame, EdgesAreDividedAfterTheLayersWereReleased)
{
  for (const svo::ShadowTechnique technique :
    { svo::ShadowTechnique::Buffer, svo::ShadowTechnique::Rays })
  {
    svo::CPUTracer tracer;
    svo::Silhouettes first, second;
    Stage stage;
    stage.settings.shadowTechnique = technique;
    render(tracer, stage);
    tracer.divideEdges(stage.scene, stage.view, Positions, svo::serialFor, first);
    tracer.releaseLayers();
    tracer.divideEdges(stage.scene, stage.view, Positions, svo::serialFor, second);
    expectSame(first, second);
  }
}

namespace
{
/// The ground, the smooth ball and more balls in the corners stay where they are, so that the
/// lights' maps do, too.
constexpr int Posts = 6;

/// Changes one thing of a scene of balls over a ground.
void changeAnything(std::mt19937& random, const svo::Octree& ball, Stage& stage)
{
  const auto number = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto somewhere = [&]
  { return movedTo(number(50) * 0.1 - 2.5, number(50) * 0.1 - 2.5, 0.5); };
  std::vector<svo::Instance>& all = stage.scene.instances;
  const auto anyIndex = [&] { return Posts + number(static_cast<int>(all.size()) - Posts); };
  const auto any = [&]() -> svo::Instance& { return all[anyIndex()]; };
  switch (number(15))
  {
    case 0:
    case 1:
    case 2:
      any().localToWorld = somewhere() * glm::scale(glm::dmat4(1.0), glm::dvec3(0.25));
      break;
    case 3:
      if (all.size() > Posts + 3)
      {
        all.erase(all.begin() + anyIndex());
      }
      break;
    case 4:
      all.push_back(
        instanceOf(ball, random(), somewhere() * glm::scale(glm::dmat4(1.0), glm::dvec3(0.3))));
      if (number(2) != 0) // has a terminator
      {
        all.back().body.own().attributes = all[1].body->attributes;
      }
      break;
    case 5:
      std::swap(any(), any());
      break;
    case 6:
      any().material.diffuseColor = { 0.3f + 0.1f * number(7), 0.5f, 0.7f };
      break;
    case 7:
      any().castShadow = number(2) != 0;
      break;
    case 8:
      any().receiveShadow = number(2) != 0;
      break;
    case 9:
      any().depthOffset.units = 1e-4f * static_cast<float>(number(2));
      any().depthOffset.factor = number(4) == 0 ? 2.0f : 0.0f;
      break;
    case 10:
      if (number(3) == 0)
      {
        stage.scene.lights[0].position += glm::dvec3(0.1 * number(3), 0, 0);
      }
      break;
    case 11:
      if (number(3) == 0)
      {
        constexpr svo::ShadowTechnique all[] = { svo::ShadowTechnique::Buffer,
          svo::ShadowTechnique::Rays, svo::ShadowTechnique::None };
        stage.settings.shadowTechnique = all[number(3)];
      }
      break;
    case 12:
    {
      glm::dmat4& matrix = any().localToWorld; // of another scale, by rounding
      matrix = matrix * glm::rotate(glm::dmat4(1.0), 0.035, glm::dvec3(0.2, 0.3, 1.0));
      break;
    }
    case 13:
      if (number(3) == 0) // other maps
      {
        all[Posts - 1].localToWorld = movedTo(3.0 + number(9), 3.0, 1.0);
      }
      break;
    default:
      if (number(6) == 0)
      {
        stage.view = lookAt({ 4, -7, 6.0 + 0.1 * number(3) }, 320 + 8 * number(2), 240);
      }
  }
}
}

TEST(KeptFrame, AnySequenceOfChanges)
{
  std::vector<svo::FrameSettings> settings(5);
  settings[1].shadowTechnique = svo::ShadowTechnique::Rays;
  settings[2].antiAliasing = settings[2].filterShadows = true;
  settings[3].wholeShadowBuffers = settings[3].writeNormals = true;
  settings[4].layerMemoryLimit = 200000; // of a few layers
  for (std::size_t s = 0; s < settings.size(); ++s)
  {
    Stage stage;
    stage.view = lookAt({ 4, -7, 6 }, 320, 240);
    stage.scene.instances[1].localToWorld = movedTo(0.5, 0.5, 0.2);
    for (int i = 0; i < 7; ++i)
    {
      const glm::dmat4 corner = movedTo(i & 1 ? -3.2 : 3.2, i & 2 ? -3.2 : 3.2, 1.4);
      stage.scene.instances.push_back(
        instanceOf(stage.ball, 100 + i, corner * glm::scale(glm::dmat4(1.0), glm::dvec3(0.3))));
      stage.scene.instances.back().body.own().attributes =
        stage.scene.instances[1].body->attributes;
    }
    stage.scene.lights[0] = everyLight()[s % 4].light;
    stage.settings = settings[s];
    stage.settings.shadowResolution = 500;
    std::mt19937 random(static_cast<unsigned>(s));
    svo::CPUTracer tracer;
    const svo::Frame& frame = tracer.frame();
    for (unsigned step = 0; step < scenesOr(60); ++step)
    {
      render(tracer, stage);
      ASSERT_TRUE(identical(rendered(stage.scene, stage.view, stage.settings), frame))
        << "settings " << s << ", step " << step;
      changeAnything(random, stage.ball, stage);
    }
  }
}
