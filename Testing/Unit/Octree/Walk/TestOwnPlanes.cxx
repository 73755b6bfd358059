// Rays through octrees of planes: against the surface itself, and blocks against single rays.
#include "svoIntersect.h"
#include "svoPlane.h"
#include "svoTestFields.h"
#include "svoTestScenes.h"

#define HWY_WANT_AVX3_DL 1 // as svoIntersectBlock.cxx does
#include "svoInstructionSets.h"

#include <cstring>

namespace
{
using namespace svotest;
using svo::LeafGeometry;

const glm::dvec3 Centre(0.013, -0.021, 0.034);
constexpr double Radius = 0.77;

svo::Octree sphereAt(int level)
{
  return octreeOfField(SphereField(Radius, Centre), boxOfInterest(level));
}

/// The sphere in octree coordinates.
struct OctreeSphere
{
  glm::dvec3 centre;
  double radius;
  explicit OctreeSphere(const svo::Octree& octree)
    : centre(octree.localToOctree() * glm::dvec4(Centre, 1.0))
    , radius(Radius / octree.rootEdge())
  {
  }
  /// Distance of the ray's line from the centre.
  double distance(const svo::Ray& ray) const
  {
    return glm::length(glm::cross(ray.origin - centre, glm::normalize(ray.direction)));
  }
};
}

TEST(OwnPlanes, RaysMeetTheSphere)
{
  for (const int level : { 7, 8 })
  {
    const svo::Octree octree = sphereAt(level);
    const OctreeSphere sphere(octree);
    const double voxel = octree.header().voxelSize / octree.rootEdge();
    // A hit lies on a tangent plane, at most a voxel along each axis from its voxel's middle.
    const double bulge = 3.0 * voxel * voxel / (2.0 * sphere.radius) + 2.5e-3 * voxel;
    RandomRays random(octree, 5);
    int hits = 0;
    for (int i = 0; i < 20000; ++i)
    {
      const svo::Ray ray = random.next();
      const double radius = glm::length(ray.origin - sphere.centre);
      if (radius < sphere.radius + 2.0 * voxel)
      {
        continue; // from outside
      }
      const double distance = sphere.distance(ray);
      const bool ahead = glm::dot(ray.direction, sphere.centre - ray.origin) > 0.0;
      const svo::Hit hit = svo::intersect(octree, ray, { LeafGeometry::Plane });
      ASSERT_EQ(svo::occluded(octree, ray, { LeafGeometry::Plane }), static_cast<bool>(hit));
      if (ahead && distance < sphere.radius - 2.0 * bulge)
      {
        ASSERT_TRUE(hit) << "no holes";
      }
      if (hit)
      {
        ++hits;
        ASSERT_LT(distance, sphere.radius + 2.0 * bulge) << "no wider than the sphere";
        const glm::dvec3 at = ray.origin + hit.t * ray.direction;
        ASSERT_NEAR(glm::length(at - sphere.centre), sphere.radius, bulge);
        ASSERT_LT(hit.primitive, octree.header().listWords);
        const svo::MeanPlane plane = svo::decodePlane(octree.lists()[hit.primitive]);
        ASSERT_GT(glm::dot(glm::dvec3(plane.normal), glm::normalize(at - sphere.centre)),
          1.0 - 8.0 * voxel * voxel / (sphere.radius * sphere.radius) - 1e-5);
      }
    }
    EXPECT_GT(hits, 3000);
  }
}

TEST(OwnPlanes, AllLeavesButVoxelsAreThePlanes)
{
  const svo::Octree octree = sphereAt(6);
  RandomRays random(octree, 6);
  int cubes = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const svo::Ray ray = random.next();
    const svo::Hit plane = svo::intersect(octree, ray, { LeafGeometry::Plane });
    for (const LeafGeometry geometry : { LeafGeometry::Triangle, LeafGeometry::Automatic })
    {
      const svo::Hit hit = svo::intersect(octree, ray, { geometry });
      ASSERT_EQ(hit.primitive, plane.primitive);
      ASSERT_EQ(hit.t, plane.t);
    }
    const svo::Hit cube = svo::intersect(octree, ray, { LeafGeometry::Voxel });
    ASSERT_TRUE(cube || !plane);
    cubes += cube && cube.t < plane.t;
    // Rays that reach bricks go on to their voxels.
    for (const int level : { 4, 5 })
    {
      const svo::Hit hit = svo::intersect(octree, ray, { LeafGeometry::Plane, level });
      ASSERT_EQ(hit.primitive, plane.primitive);
      ASSERT_EQ(hit.t, plane.t);
    }
    const svo::Hit node = svo::intersect(octree, ray, { LeafGeometry::Plane, 3 });
    ASSERT_TRUE(!node || node.primitive & svo::NodePrimitive);
  }
  EXPECT_GT(cubes, 100);
}

TEST(OwnPlanes, BlocksGiveTheSameBits)
{
  for (const int level : { 1, 2, 5, 8 })
  {
    const svo::Octree octree = sphereAt(level);
    RandomRays random(octree, 7);
    for (int b = 0; b < 40; ++b)
    {
      svo::RayBlock block;
      for (int i = 0; i < svo::RayBlock::Size; ++i)
      {
        const svo::Ray ray = random.next();
        block.aim(i, ray.origin, ray.direction);
        block.tMin[i] = 0.0f;
        block.tMax[i] = random.unit() < 0.3 ? 0.7f : 10.0f;
      }
      for (const LeafGeometry geometry : { LeafGeometry::Voxel, LeafGeometry::Plane })
      {
        for (int stop = 0; stop <= level; ++stop)
        {
          const svo::TraceOptions options{ geometry, stop };
          svo::HitBlock expected;
          svo::intersectBlockScalar(octree, block, options, expected);
          onEveryInstructionSet(
            [&]
            {
              svo::HitBlock hits;
              svo::intersect(octree, block, options, hits);
              for (int i = 0; i < svo::RayBlock::Size; ++i)
              {
                ASSERT_EQ(hits.primitive[i], expected.primitive[i]);
                if (hits.primitive[i] != svo::NoPrimitive)
                {
                  ASSERT_EQ(std::memcmp(&hits.t[i], &expected.t[i], sizeof(float)), 0);
                }
              }
            });
        }
      }
    }
  }
}
