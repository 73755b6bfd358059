// A frame is made again where bodies that copies share are not what they were.
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

using namespace svotest;

namespace
{
/// Copies of a smooth ball above a ground, which is the first instance.
struct Copies
{
  Mesh mesh = sphere(7, 9);
  svo::Octree octree = makeOctree(mesh, 7), deep = makeOctree(mesh, 8);
  std::vector<float> normals = radialNormals(mesh), others = normals;
  svo::Scene scene;
  svo::View view = lookAt({ 3, -5, 4 }, 160, 120);
  svo::FrameSettings settings;

  Copies()
  {
    for (float& n : others)
    {
      n = -0.8f * n + 0.1f;
    }
    svo::Instance ball = instanceOf(octree, 2);
    ball.body.own().attributes.normals = normals.data();
    ball.body.own().attributes.normalAssociation = svo::Association::Point;
    scene.instances = { instanceOf(makeOctree(square(3.0), 6), 1, movedTo(0, 0, -1)) };
    for (int i = 0; i < 9; ++i)
    {
      scene.instances.push_back(ball);
      scene.instances.back().id = 10 + static_cast<std::uint64_t>(i);
      scene.instances.back().localToWorld =
        movedTo(i % 3 - 1.0, i / 3 - 1.0, 0.0) * glm::scale(glm::dmat4(1.0), glm::dvec3(0.4));
    }
    scene.lights = { lightOf(svo::Light::Kind::Point, { 2, -2, 6 }) };
  }
};
}

TEST(KeptFrame, ChangesOfABodyThatCopiesShareAreSeen)
{
  Copies copies;
  std::vector<svo::Instance>& all = copies.scene.instances;
  ASSERT_EQ(all[1].body.holders(), 9u);
  const svo::Shared<svo::Body> first = all[1].body;
  const std::vector<std::pair<std::string, std::function<void()>>> changes{
    { "where it is, for all", [&] { all[4].body.all().octree = copies.deep; } },
    { "for one in the middle", [&] { all[4].body.own().leafGeometry = svo::LeafGeometry::Voxel; } },
    { "for the last one", [&] { all[9].body.own().leafGeometry = svo::LeafGeometry::Voxel; } },
    { "for the one in the middle, where it is",
      [&] { all[4].body.own().leafGeometry = svo::LeafGeometry::Plane; } },
    { "that of another one", [&] { all[6].body = all[4].body; } },
    { "in turn", [&] { std::swap(all[5].body, all[6].body); } },
    { "for those that still share it", [&] { all[1].body.all().octree = copies.octree; } },
    { "for those that have others, that of the first one",
      [&]
      {
        for (std::size_t i = 2; i < all.size(); ++i)
        {
          all[i].body = all[1].body;
        }
      } },
    { "for all, another one",
      [&]
      {
        svo::Shared<svo::Body> other = first;
        other.own().attributes.normals = copies.others.data();
        for (std::size_t i = 1; i < all.size(); ++i)
        {
          all[i].body = other;
        }
      } },
  };
  svo::CPUTracer tracer;
  const svo::Frame& frame = tracer.frame();
  const auto render = [&]
  { tracer.render(stamped(copies.scene), copies.view, copies.settings, svo::serialFor); };
  render();
  for (const auto& [name, change] : changes)
  {
    SCOPED_TRACE(name);
    const std::uint64_t version = frame.version;
    change();
    render();
    EXPECT_NE(version, frame.version);
    EXPECT_TRUE(identical(rendered(copies.scene, copies.view, copies.settings), frame));
  }
}
