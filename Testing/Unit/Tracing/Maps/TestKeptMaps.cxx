// Random scenes on wide grounds, of which the eye sees a part, while it and they move: pictures of
// a tracer that keeps what is still true of its lights' maps, and of one that has seen nothing, are
// the same to the bit.
#include "svoRandomScenes.h"
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace svotest;

namespace
{
class Walk
{
public:
  explicit Walk(unsigned seed)
    : Random(seed)
  {
    static const svo::Octree shapes[] = { makeOctree(sphere(24, 40), 7),
      makeOctree(torus(40, 24), 7), makeOctree(sphere(200, 200), 8) };
    Mesh ground = square(std::pow(10.0, 1.5 + 1.2 * this->any()));
    ground.points.push_back({ 0.0, 0.0, -0.3 }); // no flat one, which would not cast
    ground.triangles.push_back({ 0, 1, 4 });
    this->Scene.instances = { instanceOf(makeOctree(ground, 6 + this->pick(2)), 1) };
    for (int i = 2 + this->pick(8); i > 0; --i)
    {
      glm::dmat4 place = movedTo(4.0 * this->any(), 4.0 * this->any(), 0.5 + this->any());
      place = glm::rotate(place, 3.0 * this->any(), { this->any(), this->any(), 1.2 });
      place = glm::scale(place, glm::dvec3(0.5 + 0.3 * this->any()));
      svo::Instance instance = instanceOf(shapes[this->pick(3)], this->Scene.instances.size() + 1,
        place, static_cast<svo::LeafGeometry>(this->pick(4)));
      instance.castShadow = this->pick(6) > 0;
      instance.visible = this->pick(4) > 0;
      instance.opacity = instance.visible ? 1.0f : 0.5f;
      this->Scene.instances.push_back(instance);
    }
    for (int i = 1 + this->pick(3); i > 0; --i)
    {
      const svo::Light::Kind kinds[] = { svo::Light::Kind::Directional, svo::Light::Kind::Point,
        svo::Light::Kind::Spot };
      this->Scene.lights.push_back(lightOf(
        kinds[this->pick(3)], { 3.0 * this->any(), 3.0 * this->any(), 4.0 + 2.0 * this->any() }));
      this->Scene.lights.back().id = static_cast<std::uint64_t>(i);
    }
    this->Settings.shadowResolution = 16 + this->pick(900);
    this->Settings.filterShadows = this->pick(2) > 0;
    this->Settings.antiAliasing = this->pick(4) == 0;
    this->Settings.wholeShadowBuffers = this->pick(3) == 0;
    this->Settings.pixelError = this->pick(3);
    this->Eye = { 6.0 * this->any(), -5.0 + this->any(), 3.0 + 1.5 * this->any() };
  }

  /// Most steps move the eye, few move something, take it away, or move a light.
  void step()
  {
    const double length = std::pow(10.0, -1.0 + this->any());
    if (this->pick(3) > 0)
    {
      this->Eye += length * glm::dvec3(this->any(), this->any(), 0.3 * this->any());
      this->Eye.z = std::max(this->Eye.z, 0.3);
      this->At += length * glm::dvec3(this->any(), this->any(), 0.0);
    }
    std::vector<svo::Instance>& instances = this->Scene.instances;
    const int other = 1 + this->pick(static_cast<int>(instances.size()) - 1);
    if (this->pick(3) == 0)
    {
      instances[static_cast<std::size_t>(other)].localToWorld[3].x += 0.3 * this->any();
    }
    if (this->pick(6) == 0 && instances.size() > 3)
    {
      instances.erase(instances.begin() + other);
    }
    if (this->pick(12) == 0)
    {
      this->Scene.lights[0].position += 0.1 * this->any();
    }
  }

  svo::Frame picture(svo::Tracer& tracer) const
  {
    return rendered(
      tracer, this->Scene, lookAt(this->Eye, 160, 120, 50.0, this->At), this->Settings);
  }

private:
  double any() { return std::uniform_real_distribution<double>(-1.0, 1.0)(this->Random); }
  int pick(int count) { return static_cast<int>(this->Random() % static_cast<unsigned>(count)); }

  std::mt19937 Random;
  svo::Scene Scene;
  svo::FrameSettings Settings;
  glm::dvec3 Eye, At{ 0.0 };
};

void expectSameMaps(const svo::Tracer& a, const svo::Tracer& b)
{
  ASSERT_EQ(a.shadowMaps().size(), b.shadowMaps().size());
  for (std::size_t m = 0; m < a.shadowMaps().size(); ++m)
  {
    const svo::ShadowMap &mine = a.shadowMaps()[m], &other = b.shadowMaps()[m];
    EXPECT_TRUE(svo::sameRays(mine.view, other.view)) << m;
    EXPECT_EQ(mine.texels->tiles, other.texels->tiles) << m;
    EXPECT_EQ(mine.texels->numbers, other.texels->numbers) << m;
  }
}
}

TEST(KeptMaps, AreThoseThatWouldBeTracedAnew)
{
  const unsigned scenes = scenesOr(6);
  std::uint64_t keptTexels = 0, texels = 0;
  for (unsigned seed = 0; seed < scenes; ++seed)
  {
    Walk walk(seed);
    svo::CPUTracer kept;
    for (int frame = 0; frame < 8; ++frame)
    {
      SCOPED_TRACE(testing::Message() << "scene " << seed << ", frame " << frame);
      svo::CPUTracer fresh;
      ASSERT_TRUE(identical(walk.picture(kept), walk.picture(fresh)));
      expectSameMaps(kept, fresh);
      if (HasFailure())
      {
        return;
      }
      keptTexels += kept.statistics().shadowRays;
      texels += fresh.statistics().shadowRays;
      walk.step();
    }
  }
  EXPECT_LT(keptTexels, texels * 3 / 4);
}
