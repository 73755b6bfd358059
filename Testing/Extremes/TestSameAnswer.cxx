// The same picture, bit for bit, however it is come by: with any number of threads, on every
// instruction set of the machine, with layers kept or not, and after any sequence of edits.
#include "svoExtremes.h"

#include "svoIntersect.h"

#include <gtest/gtest.h>

#define HWY_WANT_AVX3_DL 1 // as svoIntersectBlock.cxx does
#include <hwy/targets.h>

#include <functional>

using namespace svotest;

namespace
{
const std::vector<svo::Octree>& octrees()
{
  static const std::vector<svo::Octree> all = { makeOctree(square(3.0), 7),
    makeOctree(sphere(24, 40), 7), makeOctree(torus(40, 24), 8), makeOctree(soup(300, 0.4, 5), 6),
    makeOctree(torus(300, 150), 5) };
  return all;
}

glm::dmat4 randomPlace(Chance& chance)
{
  const double kind = chance.unit();
  const glm::dmat3 linear = kind < 0.5 ? chance.rotation()
    : kind < 0.9                       ? chance.linear(std::pow(10.0, chance.unit()))
                                       : chance.linear(1e4);
  return affine(linear, 1.5 * chance.direction() + glm::dvec3(0, 0, 1));
}

svo::Instance randomInstance(Chance& chance, std::uint64_t id)
{
  const auto& all = octrees();
  svo::Instance instance = instanceOf(all[chance.below(static_cast<int>(all.size()))], id,
    randomPlace(chance), static_cast<svo::LeafGeometry>(chance.below(4)));
  instance.material.diffuseColor = { 0.3f + 0.7f * chance.unit(), 0.8f, 0.5f };
  return instance;
}

svo::Light randomLight(Chance& chance, std::uint64_t id)
{
  svo::Light light = lightOf(static_cast<svo::Light::Kind>(chance.below(3)),
    chance.between(3.0, 9.0) * glm::normalize(chance.direction() + glm::dvec3(0, 0, 1.5)));
  light.color = glm::vec3(0.6f);
  light.id = id;
  return light;
}

svo::View randomView(Chance& chance)
{
  const glm::dvec3 eye =
    chance.between(3.0, 8.0) * glm::normalize(chance.direction() + glm::dvec3(0, 0, 0.7));
  const int width = 40 + chance.below(60), height = 30 + chance.below(50);
  return chance.unit() < 0.7 ? lookAt(eye, width, height, chance.between(10.0, 110.0))
                             : lookAtParallel(eye, width, height, chance.between(1.0, 4.0));
}

/// A scene, a view and settings that are edited at random; the edit is said in words.
struct World
{
  Chance& chance;
  svo::Scene scene;
  svo::View view;
  svo::FrameSettings settings;
  std::uint64_t nextId = 1;

  explicit World(Chance& c)
    : chance(c)
    , view(randomView(c))
  {
    for (int i = 0; i < 4; ++i)
    {
      scene.instances.push_back(randomInstance(chance, nextId++));
    }
    scene.lights = { randomLight(chance, 1000), randomLight(chance, 1001) };
    settings.shadowResolution = 96;
  }

  svo::Instance& any()
  {
    return scene.instances[chance.below(static_cast<int>(scene.instances.size()))];
  }

  std::string edit()
  {
    const int what = chance.below(16);
    switch (scene.instances.size() < 2 ? 0 : what)
    {
      case 0:
        scene.instances.push_back(randomInstance(chance, nextId++));
        return "add an instance";
      case 1:
        scene.instances.erase(
          scene.instances.begin() + chance.below(static_cast<int>(scene.instances.size())));
        return "remove an instance";
      case 2:
        std::swap(any(), any());
        return "swap two instances";
      case 3:
      case 4:
        any().localToWorld = randomPlace(chance);
        return "move an instance";
      case 5:
        any().body.own().octree = octrees()[chance.below(static_cast<int>(octrees().size()))];
        return "another octree";
      case 6:
        any().body.own().leafGeometry = static_cast<svo::LeafGeometry>(chance.below(4));
        return "another leaf geometry";
      case 7:
      {
        svo::Instance& i = any();
        i.visible = !i.visible;
        return "show or hide";
      }
      case 8:
      {
        svo::Instance& i = any();
        i.castShadow = !i.castShadow;
        return "cast or not";
      }
      case 9:
        view = randomView(chance);
        return "another view";
      case 10:
        scene.lights[chance.below(2)] = randomLight(chance, 1000 + chance.below(2));
        return "another light";
      case 11:
        settings.pixelError = chance.below(3);
        return "another pixel error";
      case 12:
        settings.shadowTechnique = static_cast<svo::ShadowTechnique>(chance.below(3));
        return "another shadow technique";
      case 13:
        settings.layerMemoryLimit =
          chance.unit() < 0.5 ? static_cast<std::size_t>(chance.below(400000)) : 512u << 20;
        return "another memory limit";
      case 14:
        settings.antiAliasing = !settings.antiAliasing;
        settings.filterShadows = settings.antiAliasing;
        return "anti-aliasing on or off";
      default:
        return "nothing";
    }
  }
};

/// Calls f with the name of each instruction set that was compiled and that the machine has.
void onEveryInstructionSet(const std::function<void(const std::string&)>& f)
{
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
  {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    f(hwy::TargetName(target));
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}
}

TEST(SameAnswer, AfterAnySequenceOfEdits)
{
  for (long sequence = 0; sequence < scaled(8); ++sequence)
  {
    Chance chance(100 + sequence);
    World world(chance);
    svo::CPUTracer keeping;
    std::string story;
    for (int step = 0; step < 40; ++step)
    {
      story += "\n  " + world.edit();
      const svo::Frame frame = rendered(keeping, world.scene, world.view, world.settings);
      ASSERT_TRUE(identical(frame, rendered(world.scene, world.view, world.settings)))
        << "sequence " << sequence << ":" << story;
      svo::FrameSettings forgetful = world.settings;
      forgetful.frameCoherence = false;
      ASSERT_TRUE(identical(frame, rendered(world.scene, world.view, forgetful)))
        << "without coherence, sequence " << sequence << ":" << story;
    }
  }
}

TEST(SameAnswer, WithOneTwoAndSevenThreads)
{
  for (long k = 0; k < scaled(20); ++k)
  {
    Chance chance(500 + k);
    World world(chance);
    for (int i = 0; i < 10; ++i)
    {
      world.edit();
    }
    const svo::Frame expected = rendered(world.scene, world.view, world.settings);
    for (const unsigned threads : { 1u, 2u, 7u })
    {
      svo::CPUTracer tracer;
      for (int again = 0; again < 2; ++again) // traced, and from kept layers
      {
        EXPECT_TRUE(identical(
          expected, rendered(tracer, world.scene, world.view, world.settings, raggedFor(threads))))
          << "world " << k << ", " << threads << " threads, frame " << again;
      }
    }
  }
}

TEST(SameAnswer, OnEveryInstructionSet)
{
  for (long k = 0; k < scaled(20); ++k)
  {
    Chance chance(900 + k);
    World world(chance);
    for (int i = 0; i < 10; ++i)
    {
      world.edit();
    }
    const svo::Frame expected = rendered(world.scene, world.view, world.settings);
    onEveryInstructionSet(
      [&](const std::string& name)
      {
        EXPECT_TRUE(identical(expected, rendered(world.scene, world.view, world.settings)))
          << "world " << k << ", " << name;
      });
  }
}

// The octree's very bytes, too.
TEST(SameAnswer, BuiltWithOneTwoAndSevenThreads)
{
  for (const Mesh& mesh : { torus(200, 100), soup(2000, 0.3, 3), square(1.0) })
  {
    for (const int level : { 3, 8 })
    {
      svo::BuildOptions options;
      options.level = level;
      const svo::BuildResult expected = svo::build(mesh.view(), options);
      for (const unsigned threads : { 1u, 2u, 7u })
      {
        options.parallelFor = raggedFor(threads);
        const svo::BuildResult built = svo::build(mesh.view(), options);
        ASSERT_EQ(built.size, expected.size);
        EXPECT_EQ(std::memcmp(built.data.get(), expected.data.get(), built.size), 0)
          << "level " << level << ", " << threads << " threads";
      }
    }
  }
}
