// An instance is a value though copies of it share what they have in common.
#include "svoTracerScenes.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

using namespace svotest;

TEST(Shared, CopiesShareAValueUntilOneIsWrittenTo)
{
  svo::Shared<int> a(1);
  EXPECT_EQ(a.holders(), 1u);
  const int* where = &*a;
  EXPECT_EQ(&a.own(), where); // nobody else has it

  svo::Shared<int> b = a, c = a;
  EXPECT_EQ(a.holders(), 3u);
  EXPECT_TRUE(b.same(a) && c.same(a));
  b.own() = 2;
  EXPECT_EQ(*a, 1);
  EXPECT_EQ(*b, 2);
  EXPECT_EQ(*c, 1);
  EXPECT_FALSE(b.same(a));
  EXPECT_TRUE(c.same(a));
  EXPECT_EQ(a.holders(), 2u);

  c.all() = 3;
  EXPECT_EQ(*a, 3);
  EXPECT_EQ(*b, 2);
  a = b;
  EXPECT_EQ(c.holders(), 1u);
  EXPECT_EQ(&c.own(), where);
  const svo::Shared<int> moved = std::move(a);
  EXPECT_EQ(*moved, 2);
  EXPECT_EQ(moved.holders(), 2u);
}

TEST(Shared, InitialValuesAreSharedAndStay)
{
  svo::Shared<svo::Body> a, b;
  EXPECT_TRUE(a.same(b));
  a.own().deepestLevel = 7;
  EXPECT_EQ(b->deepestLevel, 0);
  EXPECT_EQ(svo::Shared<svo::Body>()->deepestLevel, 0);
}

TEST(Instance, IsSmallAndCopiesShareTheirBody)
{
  static_assert(sizeof(svo::Instance) == 248, "there are very many");
  const svo::Octree octree = makeOctree(sphere(7, 9), 5);
  std::vector<svo::Instance> copies(1000, instanceOf(octree, 1));
  EXPECT_EQ(copies[0].body.holders(), 1000u);
  copies[3].localToWorld = movedTo(1, 2, 3);
  EXPECT_TRUE(copies[3].body.same(copies[0].body));

  copies[5].body.own().octree = svo::Octree();
  EXPECT_FALSE(copies[5].body->octree);
  EXPECT_EQ(copies[4].body->octree.id(), octree.id());
  EXPECT_EQ(copies[0].body.holders(), 999u);
}
