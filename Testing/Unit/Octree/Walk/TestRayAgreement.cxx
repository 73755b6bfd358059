// A million random rays against the reference octree, in double and in float; as many millions as
// the environment variable SVO_TEST_MILLIONS says where it is set.
#include "svoTestTracers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

using namespace svotest;

namespace
{
struct Scene
{
  Scene(const svo::Octree& o, int rayCount)
    : octree(o)
    , reference(svo::makeReference(o, o.level()))
    , rays(rayCount)
  {
  }
  svo::Octree octree;
  svo::ReferenceOctree reference;
  int rays;
};

int millions()
{
  const char* text = std::getenv("SVO_TEST_MILLIONS");
  return text ? std::max(std::atoi(text), 1) : 1;
}

/// All rays, or every `part`-th of them.
template <class Tracer>
Agreement compareScenes(int part, Tracer&& tracer)
{
  static const Scene scenes[] = { { makeOctree(sphere(40, 40), 10), 300000 },
    { makeOctree(torus(40, 40), 9), 300000 }, { makeOctree(soup(200, 0.3, 5), 8), 300000 },
    { makeOctree(noise(7, 10000, 6), 7), 80000 }, { makeOctree(noise(12, 10000, 7), 12), 20000 } };
  Agreement agreement;
  for (const Scene& scene : scenes)
  {
    compare(scene.octree, scene.reference, millions() * (scene.rays / part),
      10 + scene.octree.level(), tracer, agreement);
  }
  return agreement;
}
}

TEST(RayTraversal, AMillionRaysInDoubleHitTheReferencesVoxel)
{
  const Agreement a = compareScenes(1, traceDouble);
  std::cout << "double: of " << a.rays << " rays " << a.hits << " hit, " << a.ties
            << " named a neighbour; depth within " << a.worstT << " of the cube\n";
  RecordProperty("ties", a.ties);
  EXPECT_EQ(a.rays, 1000000 * millions());
  EXPECT_GT(a.hits, 300000 * millions());
  EXPECT_EQ(a.wrong, 0);
  EXPECT_EQ(a.missTies, 0);
  EXPECT_LE(a.ties, 10 * millions()); // 1e-5 of all
  EXPECT_LT(a.worstT, 1e-12);
}

TEST(RayTraversal, RaysInFloatHitTheReferencesVoxelButForTies)
{
  const Agreement a = compareScenes(4, traceFloat);
  std::cout << "float: of " << a.rays << " rays " << a.ties << " named a neighbour, " << a.missTies
            << " differed on a grazing miss; depth within " << a.worstT << " of the cube\n";
  RecordProperty("ties", a.ties);
  EXPECT_GT(a.hits, 75000 * millions());
  EXPECT_EQ(a.wrong, 0);
  EXPECT_LT(a.worstT, 1e-5);
}
