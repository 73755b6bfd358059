// Opening a layout buffer: what is damaged is refused, what is opened can be trusted.
#include "svoIntersect.h"
#include "svoLeafTraits.h"
#include "svoReference.h"
#include "svoTestScenes.h"

#include <gtest/gtest.h>

using namespace svotest;

namespace
{
std::vector<std::uint64_t> sample()
{
  return makeBuffer({ { 0, 0, 0 }, { 1, 2, 3 }, { 9, 4, 7 }, { 15, 15, 15 }, { 14, 15, 15 } }, 4);
}

svo::Header& headerOf(std::vector<std::uint64_t>& buffer)
{
  return *reinterpret_cast<svo::Header*>(buffer.data());
}

svo::Node* nodesOf(std::vector<std::uint64_t>& buffer)
{
  return reinterpret_cast<svo::Node*>(buffer.data() + sizeof(svo::Header) / 8);
}

std::uint32_t* listsOf(std::vector<std::uint64_t>& buffer)
{
  return reinterpret_cast<std::uint32_t*>(nodesOf(buffer) + headerOf(buffer).nodeCount);
}

/// Refused with a reason, and nothing is left open.
bool refused(const std::vector<std::uint64_t>& buffer)
{
  std::string error;
  return !openBuffer(buffer, error) && !error.empty();
}
}

TEST(Octree, OpensWhatTheLayoutDescribes)
{
  std::string error;
  const svo::Octree octree = openBuffer(sample(), error);
  ASSERT_TRUE(octree) << error;
  EXPECT_EQ(octree.level(), 4);
  EXPECT_EQ(octree.depthCount(), 2);
  EXPECT_EQ(octree.header().voxelCount, 5u);
  EXPECT_FALSE(octree.empty());
  EXPECT_TRUE(octree.occupied({ 9, 4, 7 }, 4));
  EXPECT_FALSE(octree.occupied({ 9, 4, 6 }, 4));
}

TEST(Octree, OccupancyOfEveryLevelIsThatOfItsVoxels)
{
  for (int level = 1; level <= 5; ++level)
  {
    std::mt19937 random(level);
    std::uniform_int_distribution<int> coordinate(0, (1 << level) - 1);
    std::vector<glm::ivec3> voxels(1 << level);
    for (glm::ivec3& v : voxels)
    {
      v = { coordinate(random), coordinate(random), coordinate(random) };
    }
    const svo::Octree octree = makeOctree(voxels, level);
    ASSERT_TRUE(octree);
    for (int stop = 0; stop <= level; ++stop)
    {
      std::set<int> expected;
      for (const glm::ivec3& v : voxels)
      {
        const glm::ivec3 c = v >> (level - stop);
        expected.insert(c.x | c.y << 8 | c.z << 16);
      }
      for (int z = 0; z < 1 << stop; ++z)
      {
        for (int y = 0; y < 1 << stop; ++y)
        {
          for (int x = 0; x < 1 << stop; ++x)
          {
            ASSERT_EQ(octree.occupied({ x, y, z }, stop), expected.count(x | y << 8 | z << 16) > 0);
          }
        }
      }
    }
  }
}

TEST(Octree, OutsideIsNotOccupied)
{
  std::string error;
  const svo::Octree octree = openBuffer(sample(), error);
  EXPECT_FALSE(octree.occupied({ -1, 0, 0 }, 4));
  EXPECT_FALSE(octree.occupied({ 0, 16, 0 }, 4));
  EXPECT_FALSE(octree.occupied({ 0, 0, 0 }, -1));
  EXPECT_FALSE(octree.occupied({ 0, 0, 0 }, 5));
  EXPECT_FALSE(octree.occupied({ 1 << 30, 0, 0 }, 4));
}

TEST(Octree, LocalFrameMapsToOctreeCoordinates)
{
  auto buffer = makeBuffer({ { 0, 0, 0 } }, 3); // odd: the root cube is twice the octree's
  svo::Header& header = headerOf(buffer);
  header.origin[0] = -4.0;
  header.origin[1] = 10.0;
  header.voxelSize = 0.5;
  std::string error;
  const svo::Octree octree = openBuffer(buffer, error);
  ASSERT_TRUE(octree) << error;
  EXPECT_EQ(octree.rootEdge(), 8.0);
  EXPECT_EQ(octree.localToOctree() * glm::dvec4(-4.0, 10.0, 0.0, 1.0), glm::dvec4(1, 1, 1, 1));
  EXPECT_EQ(octree.localToOctree() * glm::dvec4(0.0, 14.0, 4.0, 1.0), glm::dvec4(1.5, 1.5, 1.5, 1));
}

TEST(Octree, KeepsItsMemoryAlive)
{
  svo::Octree octree;
  {
    std::string error;
    octree = openBuffer(sample(), error);
  }
  const svo::Octree copy = octree;
  octree = {};
  EXPECT_FALSE(octree);
  EXPECT_TRUE(copy.occupied({ 15, 15, 15 }, 4));
  EXPECT_GE(copy.bytes(), 256u);
}

TEST(Octree, IsAHandleThatIsFoundAgainAsLongAsThereIsACopy)
{
  static_assert(sizeof(svo::Octree) == 24 && sizeof(svo::WeakOctree) == 16, "copies are cheap");
  svo::Octree octree = makeOctree(sphere(9, 12), 4);
  const svo::Octree copy = octree;
  EXPECT_EQ(copy.key(), octree.key());
  EXPECT_EQ(copy.id(), octree.id());
  EXPECT_EQ(copy.surface(), octree.surface());
  EXPECT_EQ(&copy.representatives(), &octree.representatives());
  EXPECT_EQ(copy.longestList(), octree.longestList());
  EXPECT_GT(copy.longestList(), 0u);
  EXPECT_NE(makeOctree(sphere(9, 12), 4).id(), octree.id());

  svo::WeakOctree weak(copy);
  const svo::Octree found = weak.lock();
  ASSERT_TRUE(found);
  EXPECT_EQ(found.id(), copy.id());
  EXPECT_EQ(&found.header(), &copy.header());
  EXPECT_EQ(found.surface(), copy.surface());

  svo::Octree other = makeOctree(sphere(9, 12), 4);
  const std::shared_ptr<const std::byte> data = other.data(); // somebody else may keep that
  weak = svo::WeakOctree(other);
  svo::Octree moved = std::move(other);
  EXPECT_FALSE(other);
  EXPECT_EQ(other.key(), nullptr);
  EXPECT_EQ(moved.key(), data.get());
  EXPECT_TRUE(weak.lock());
  moved = svo::Octree();
  EXPECT_TRUE(weak.expired());
  EXPECT_FALSE(weak.lock());

  const svo::Octree none;
  EXPECT_EQ(none.id(), 0u);
  EXPECT_EQ(none.key(), nullptr);
  EXPECT_EQ(none.surface(), nullptr);
  EXPECT_EQ(none.bytes(), 0u);
  EXPECT_FALSE(svo::WeakOctree(none).lock());
}

TEST(Octree, OneWithNeitherASurfaceNorPlanesIsNotFoundAgain)
{
  std::string error;
  const svo::Octree octree = openBuffer(sample(), error);
  ASSERT_TRUE(octree) << error;
  EXPECT_EQ(octree.surface(), nullptr);
  EXPECT_FALSE(svo::WeakOctree(octree).lock());
}

TEST(Octree, ATruncatedBufferIsRefused)
{
  const auto whole = sample();
  for (std::size_t words = 0; words < whole.size(); ++words)
  {
    ASSERT_TRUE(refused({ whole.begin(), whole.begin() + words })) << words;
  }
  auto longer = whole;
  longer.push_back(0);
  EXPECT_TRUE(refused(longer));
  std::string error;
  EXPECT_FALSE(svo::Octree::open(nullptr, 0, nullptr, error));
  EXPECT_FALSE(error.empty());
}

TEST(Octree, ADamagedHeaderIsRefused)
{
  const auto damage = [](auto&& change)
  {
    auto buffer = sample();
    change(headerOf(buffer));
    return refused(buffer);
  };
  EXPECT_TRUE(damage([](svo::Header& h) { h.magic[0] = 'x'; }));
  EXPECT_TRUE(damage([](svo::Header& h) { h.version = svo::LayoutVersion + 1; }));
  EXPECT_TRUE(damage([](svo::Header& h) { h.level = 0; }));
  EXPECT_TRUE(damage([](svo::Header& h) { h.level = 21; }));
  EXPECT_TRUE(damage([](svo::Header& h) { h.level = 5; }));
  EXPECT_TRUE(damage([](svo::Header& h) { h.depthCount = 1; }));
  EXPECT_TRUE(damage([](svo::Header& h) { h.leafGeometry = svo::LeafGeometries; }));
  EXPECT_TRUE(damage([](svo::Header& h) { h.nodeCount = 0; }));
  EXPECT_TRUE(damage([](svo::Header& h) { h.nodeCount += 1ull << 60; })); // 16 nodeCount overflows
  EXPECT_TRUE(damage([](svo::Header& h) { h.listWords += 1ull << 62; }));
  EXPECT_TRUE(damage([](svo::Header& h) { h.triangleCount = 0; }));
  EXPECT_TRUE(damage([](svo::Header& h) { h.voxelSize = 0.0; }));
  EXPECT_TRUE(damage([](svo::Header& h) { h.voxelSize = std::nan(""); }));
  EXPECT_TRUE(damage([](svo::Header& h) { h.voxelSize = 5e-324; })); // its inverse is infinite
  EXPECT_TRUE(damage([](svo::Header& h) { h.voxelSize = 1e308; }));  // the cube's edge is
  EXPECT_TRUE(damage([](svo::Header& h) { h.origin[2] = HUGE_VAL; }));
  EXPECT_TRUE(damage([](svo::Header& h) { h.voxelCount = ~0ull; }));
  EXPECT_TRUE(damage([](svo::Header& h) { h.depthBegin[1] = 0; }));
  EXPECT_TRUE(damage([](svo::Header& h) { h.depthBegin[1] = 2; }));
  EXPECT_TRUE(damage([](svo::Header& h) { h.depthBegin[1] = 1000; }));
  EXPECT_TRUE(damage([](svo::Header& h) { h.depthBegin[2] = 1000; }));
}

TEST(Octree, DamagedNodesAndListsAreRefused)
{
  const auto damage = [](auto&& change)
  {
    auto buffer = sample();
    change(buffer);
    return refused(buffer);
  };
  const auto inlineBrick = [](auto& buffer)
  {
    svo::Node* node = nodesOf(buffer) + 1;
    while (!(node->first & svo::InlineTriangle))
    {
      ++node;
    }
    return node;
  };
  EXPECT_TRUE(damage([](auto& b) { nodesOf(b)[0].mask = 0; }));
  EXPECT_TRUE(damage([](auto& b) { nodesOf(b)[0].mask = ~0ull; }));
  EXPECT_TRUE(damage([](auto& b) { nodesOf(b)[0].first = 0; })); // a node that is its own child
  EXPECT_TRUE(damage([](auto& b) { nodesOf(b)[0].first = 2; }));
  EXPECT_TRUE(damage([](auto& b) { nodesOf(b)[1].mask = 0; }));
  EXPECT_TRUE(damage([](auto& b) { nodesOf(b)[1].first = 1000; }));
  EXPECT_TRUE(damage([&](auto& b) { inlineBrick(b)->first |= 1; })); // triangle 1 of 1
  EXPECT_TRUE(damage([](auto& b) { listsOf(b)[0] = 0; }));
  EXPECT_TRUE(damage([](auto& b) { listsOf(b)[0] = 0xffffffff; }));
  EXPECT_TRUE(damage([](auto& b) { listsOf(b)[1] = 1; }));
}

// Bricks that share a long list would make a file of a megabyte take hours to check and to trace.
TEST(Octree, AListThatTwoBricksShareIsRefused)
{
  auto buffer = sample();
  std::string error;
  ASSERT_TRUE(openBuffer(buffer, error)) << error;
  std::vector<svo::Node*> listed;
  for (svo::Node* node = nodesOf(buffer) + 1; node < nodesOf(buffer) + 4; ++node)
  {
    if (!(node->first & svo::InlineTriangle))
    {
      listed.push_back(node);
    }
  }
  ASSERT_GE(listed.size(), 1u);
  svo::Node* inlined = nodesOf(buffer) + 1;
  while (!(inlined->first & svo::InlineTriangle))
  {
    ++inlined;
  }
  inlined->first = listed[0]->first;
  EXPECT_TRUE(refused(buffer));
}

TEST(Octree, ListsThatNobodyNamesAreRefused)
{
  auto buffer = sample();
  nodesOf(buffer)[headerOf(buffer).nodeCount - 1].first = svo::InlineTriangle;
  nodesOf(buffer)[headerOf(buffer).nodeCount - 2].first = svo::InlineTriangle;
  EXPECT_TRUE(refused(buffer));
}

TEST(Octree, VoxelsOutsideOfTheCubeOfAnOddLevelAreRefused)
{
  auto buffer = makeBuffer({ { 0, 0, 0 }, { 9, 0, 0 } }, 3); // the second one is outside
  EXPECT_TRUE(refused(buffer));
}

TEST(Octree, ASurfaceOfAnotherMeshIsRefused)
{
  auto words = std::make_shared<std::vector<std::uint64_t>>(sample());
  std::shared_ptr<const std::byte> data(words, reinterpret_cast<const std::byte*>(words->data()));
  auto surface = std::make_shared<svo::Surface>();
  std::string error;
  EXPECT_FALSE(svo::Octree::open(data, words->size() * 8, surface, error)); // no triangles for one
  EXPECT_FALSE(error.empty());
  surface->points.resize(3);
  surface->triangles.push_back({ 0, 1, 3 }); // a point that is not there
  EXPECT_FALSE(svo::Octree::open(data, words->size() * 8, surface, error));
  surface->triangles[0] = { 0, 1, 2 };
  EXPECT_FALSE(svo::Octree::open(data, words->size() * 8, surface, error)); // no room behind it
  surface->points.reserve(4);
  surface->triangles.reserve(2);
  EXPECT_TRUE(svo::Octree::open(data, words->size() * 8, surface, error));
}

// Whatever a byte is changed to, the buffer is either refused or safe to trace.
TEST(Octree, ARandomlyDamagedBufferIsRefusedOrHarmless)
{
  const auto whole = sample();
  std::mt19937 random(17);
  int opened = 0;
  for (int i = 0; i < 20000; ++i)
  {
    auto buffer = whole;
    auto* bytes = reinterpret_cast<unsigned char*>(buffer.data());
    for (unsigned k = 0; k < 1 + random() % 3; ++k)
    {
      bytes[random() % (buffer.size() * 8)] ^= 1u << random() % 8;
    }
    std::string error;
    const svo::Octree octree = openBuffer(buffer, error);
    ASSERT_EQ(bool(octree), error.empty());
    if (octree)
    {
      ++opened;
      for (int level = 0; level <= octree.level(); ++level)
      {
        for (const glm::dvec3& d : { glm::dvec3(1.0, 0.9, 0.8), glm::dvec3(1.0, 0.0, 0.0) })
        {
          const svo::Ray ray{ { 0.9, 1.01, 1.01 }, d };
          const svo::Hit hit = svo::intersect(octree, ray, { svo::LeafGeometry::Voxel, level });
          if (hit && !(hit.primitive & svo::NodePrimitive))
          {
            ASSERT_LT(hit.primitive, octree.header().triangleCount);
          }
        }
      }
    }
  }
  EXPECT_GT(opened, 100); // signature, planes and the like may be anything
}
