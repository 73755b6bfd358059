// Rays from inside closed meshes, and at shared edges and vertices, never get through: not one of
// a million, with any leaf geometry, in double and in blocks of floats. VTKSVO_EXTREMES=100 is the
// long run's 10^8.
#include "svoExtremes.h"

#include "svoIntersect.h"

#include <gtest/gtest.h>

#include <thread>

using namespace svotest;

namespace
{
struct Closed
{
  const char* name;
  Mesh mesh;
  int level;
};

/// A box with many triangles whose vertices and edges lie on planes of voxels: ties everywhere.
Mesh gridBox(unsigned n)
{
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double side : { -1.0, 1.0 })
    {
      const auto first = static_cast<unsigned>(mesh.points.size());
      for (unsigned j = 0; j <= n; ++j)
      {
        for (unsigned i = 0; i <= n; ++i)
        {
          glm::dvec3 p;
          p[axis] = side;
          p[(axis + 1) % 3] = 2.0 * i / n - 1.0;
          p[(axis + 2) % 3] = 2.0 * j / n - 1.0;
          mesh.points.push_back(p);
        }
      }
      for (unsigned j = 0; j < n; ++j)
      {
        for (unsigned i = 0; i < n; ++i)
        {
          const unsigned a = first + j * (n + 1) + i, b = a + 1, c = a + n + 2, d = a + n + 1;
          mesh.triangles.push_back({ a, b, c });
          mesh.triangles.push_back({ a, c, d });
        }
      }
    }
  }
  return mesh;
}

/// A star: a sphere with deep dents, so that triangles are long and lists mixed.
Mesh star()
{
  Mesh mesh = sphere(40, 60);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    mesh.points[i] *= i % 3 == 0 ? 1.0 : 0.55;
  }
  return mesh;
}

std::vector<Closed> closedMeshes()
{
  return { { "a sphere", sphere(60, 80), 9 }, { "a box on the grid", gridBox(16), 8 },
    { "a box off the grid", gridBox(7), 7 }, { "a star", star(), 10 },
    { "a coarse sphere", sphere(5, 6), 10 } };
}

/// One ray of a suite: from well inside, at anything, at an edge or at a vertex.
svo::Ray nextRay(const Closed& c, const svo::Octree& octree, Chance& chance)
{
  const svo::Header& h = octree.header();
  const glm::dvec3 corner(h.origin[0], h.origin[1], h.origin[2]);
  const double scale = 1.0 / octree.rootEdge();
  glm::dvec3 from = 0.35 * chance.unit() * chance.direction();
  glm::dvec3 towards = chance.direction();
  const int choice = chance.below(8);
  const glm::uvec3 t = c.mesh.triangles[chance.below(static_cast<int>(c.mesh.triangles.size()))];
  const auto place = [&](unsigned i) // what is traced: the float vertex
  { return glm::dvec3(glm::vec3(1.0 + (c.mesh.points[i] - corner) * scale)); };
  svo::Ray ray;
  ray.origin = 1.0 + (from - corner) * scale;
  ray.direction = towards * scale;
  if (choice < 2)
  {
    ray.direction = place(t.x) - ray.origin;
  }
  else if (choice < 5)
  {
    const glm::dvec3 a = place(t.x), b = place(t.y);
    ray.direction = a + (choice == 2 ? 0.5 : chance.unit()) * (b - a) - ray.origin;
  }
  else if (choice == 5) // along an axis or a diagonal, from a voxel's corner
  {
    const double n = std::ldexp(1.0, octree.level());
    ray.origin = glm::round(ray.origin * n) / n;
    for (int a = 0; a < 3; ++a)
    {
      ray.direction[a] = chance.below(3) - 1.0;
    }
    if (ray.direction == glm::dvec3(0.0))
    {
      ray.direction.x = 1.0;
    }
  }
  ray.tMax = 1e30;
  return ray;
}

/// Rays of one thread; returns the misses and notes the first in `example`.
long leaks(
  const Closed& c, const svo::Octree& octree, long blocks, std::uint64_t seed, std::string& example)
{
  Chance chance(seed);
  long misses = 0;
  for (long b = 0; b < blocks; ++b)
  {
    svo::RayBlock block;
    svo::Ray rays[64];
    for (int i = 0; i < 64; ++i)
    {
      rays[i] = nextRay(c, octree, chance);
      block.aim(i, rays[i].origin, rays[i].direction);
      block.tMin[i] = 0.0f;
      block.tMax[i] = 1e30f;
    }
    const auto leaf = static_cast<svo::LeafGeometry>(b % 4);
    svo::HitBlock hits;
    svo::intersect(octree, block, { leaf }, hits);
    for (int i = 0; i < 64; ++i)
    {
      const bool alone = bool(svo::intersect(octree, rays[i], { leaf }));
      const bool hit = hits.primitive[i] != svo::NoPrimitive;
      if (!alone || !hit)
      {
        if (misses++ == 0)
        {
          std::ostringstream out;
          out.precision(17);
          out << c.name << ", leaves " << b % 4 << (alone ? "" : ", in double")
              << (hit ? "" : ", in a block") << ": from " << rays[i].origin.x << " "
              << rays[i].origin.y << " " << rays[i].origin.z << " along " << rays[i].direction.x
              << " " << rays[i].direction.y << " " << rays[i].direction.z;
          example = out.str();
        }
      }
    }
  }
  return misses;
}
}

TEST(Watertight, NoRayGetsOutOfAClosedMesh)
{
  const std::vector<Closed> meshes = closedMeshes();
  const unsigned threads = std::max(1u, std::min(16u, std::thread::hardware_concurrency()));
  const long blocks =
    std::max(1l, scaled(1000000) / 64 / static_cast<long>(meshes.size() * threads) + 1);
  long total = 0;
  for (const Closed& c : meshes)
  {
    const svo::Octree octree = makeOctree(c.mesh, c.level);
    ASSERT_TRUE(octree);
    std::vector<std::thread> workers;
    std::vector<std::string> examples(threads);
    std::vector<long> misses(threads);
    for (unsigned i = 0; i < threads; ++i)
    {
      workers.emplace_back([&, i] { misses[i] = leaks(c, octree, blocks, 1000 + i, examples[i]); });
    }
    for (std::thread& worker : workers)
    {
      worker.join();
    }
    for (unsigned i = 0; i < threads; ++i)
    {
      total += 64 * blocks;
      EXPECT_EQ(misses[i], 0) << "seed " << 1000 + i << ", " << examples[i];
    }
  }
  std::printf("%ld rays, each in a block of floats and alone in double\n", total);
}

// Rays from outside at the very edges and vertices of a sphere, where it faces them: what is hit is
// there, not the sphere's far side.
TEST(Watertight, NoRayPassesBetweenTwoTriangles)
{
  for (const Closed& c : { Closed{ "a sphere", sphere(60, 80), 9 },
         Closed{ "a sphere, coarse octree", sphere(60, 80), 4 } })
  {
    const svo::Octree octree = makeOctree(c.mesh, c.level);
    const svo::Surface& surface = *octree.surface();
    const glm::dvec3 centre(octree.localToOctree() * glm::dvec4(0.0, 0.0, 0.0, 1.0));
    Chance chance(31);
    long rays = 0, passed = 0;
    for (long i = 0; i < scaled(200000); ++i)
    {
      const glm::uvec3 t =
        surface.triangles[chance.below(static_cast<int>(surface.triangles.size()))];
      const glm::dvec3 a(surface.points[t.x]), b(surface.points[t.y]);
      const double share = i % 3 == 0 ? 0.0 : i % 3 == 1 ? 0.5 : chance.unit();
      const glm::dvec3 target = a + share * (b - a);
      svo::Ray ray;
      ray.origin = centre + 3.0 * chance.direction();
      ray.direction = target - ray.origin;
      const double facing = -glm::dot(glm::normalize(target - centre), ray.direction);
      if (facing < 0.2 * glm::length(ray.direction))
      {
        continue;
      }
      ++rays;
      const svo::Hit hit = svo::intersect(octree, ray, { svo::LeafGeometry::Triangle });
      if (!hit || hit.t > 1.0 + 1e-6)
      {
        ++passed;
        ADD_FAILURE() << c.name << ", ray " << i << ", triangle " << t.x << " " << t.y << " " << t.z
                      << ", share " << share;
      }
    }
    std::printf("%s: %ld rays at edges and vertices, %ld passed\n", c.name, rays, passed);
    EXPECT_GT(rays, scaled(200000) / 4);
  }
}

// The walk's loop has a bound so that no proof is needed. No ray comes near it: none through
// surfaces, noise, a full cube or single voxels, in double or float, along axes, in planes between
// voxels, of any length.
TEST(Watertight, NoWalkReachesItsBound)
{
  std::vector<glm::ivec3> full;
  for (int i = 0; i < 4096; ++i)
  {
    full.push_back({ i & 15, i >> 4 & 15, i >> 8 });
  }
  std::vector<glm::ivec3> chess;
  for (const glm::ivec3& v : full)
  {
    if ((v.x + v.y + v.z) % 2 == 0)
    {
      chess.push_back(v);
    }
  }
  const std::vector<svo::Octree> octrees = { makeOctree(sphere(60, 80), 9), makeOctree(star(), 10),
    makeOctree(full, 4), makeOctree(chess, 4), makeOctree(noise(11, 20000, 3), 11),
    makeOctree(std::vector<glm::ivec3>{ glm::ivec3(0), glm::ivec3((1 << 20) - 1) }, 20) };
  for (std::size_t o = 0; o < octrees.size(); ++o)
  {
    const svo::Octree& octree = octrees[o];
    ASSERT_TRUE(octree);
    RandomRays random(octree, 77);
    Chance chance(5);
    long most = 0;
    for (long i = 0; i < scaled(20000); ++i)
    {
      svo::Ray ray = random.next();
      const double grid = std::ldexp(1.0, 1 + chance.below(octree.level()));
      for (int a = 0; a < 3; ++a)
      {
        ray.origin[a] =
          chance.unit() < 0.3 ? std::round(ray.origin[a] * grid) / grid : ray.origin[a];
        const double choice = chance.unit();
        ray.direction[a] = choice < 0.2 ? 0.0
          : choice < 0.3                ? std::copysign(1.0, ray.direction[a])
          : choice < 0.35               ? 1e-18
          : choice < 0.4                ? -1e-7
                                        : ray.direction[a];
      }
      const double length = std::pow(10.0, chance.between(-20.0, 20.0));
      ray.direction *= length;
      ray.tMax = 1e35;
      const int level = chance.below(octree.level() + 1);
      long visited = 0;
      const auto count = [&](const auto&, auto&)
      {
        ++visited;
        return svo::Visit::Continue;
      };
      svo::ClippedRay<double> inDouble;
      svo::ClippedRay<float> inFloat;
      if (svo::clip(octree, ray.origin, ray.direction, 0.0, ray.tMax, inDouble))
      {
        EXPECT_NE(svo::walk(octree, inDouble, level, count), svo::WalkEnd::Bound)
          << "octree " << o << ", ray " << i;
      }
      if (svo::clip(octree, glm::vec3(ray.origin), glm::vec3(ray.direction), 0.0f,
            static_cast<float>(ray.tMax), inFloat))
      {
        EXPECT_NE(svo::walk(octree, inFloat, level, count), svo::WalkEnd::Bound)
          << "octree " << o << ", ray " << i;
      }
      most = std::max(most, visited / 2);
    }
    // Cells that a ray can pass: three for each step along an edge.
    EXPECT_LE(most, 3l << octree.level()) << "octree " << o;
  }
}

// The same in pictures, where a tile's rays go through the octree together: no pixel is a hole that
// an eye inside of a closed mesh sees.
TEST(Watertight, NoPixelIsAHoleForAnEyeInside)
{
  long pixels = 0;
  Chance chance(41);
  for (const Closed& c : closedMeshes())
  {
    const svo::Octree octree = makeOctree(c.mesh, c.level);
    for (long k = 0; k < scaled(48); ++k)
    {
      const auto leaf = static_cast<svo::LeafGeometry>(k % 4);
      const glm::dvec3 eye =
        k % 3 == 0 ? glm::dvec3(0.0) : 0.3 * chance.unit() * chance.direction();
      glm::dvec3 ahead = chance.direction();
      if (k % 2 == 0) // along an axis
      {
        ahead = glm::dvec3(0.0);
        ahead[chance.below(3)] = chance.unit() < 0.5 ? 1.0 : -1.0;
      }
      const glm::dvec3 up = std::abs(ahead.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
      const double angle = chance.between(1.0, 160.0);
      svo::View view;
      ASSERT_TRUE(svo::makeView(glm::lookAt(eye, eye + ahead, up),
        glm::perspective(glm::radians(angle), 1.0, 1e-4, 10.0), 64, 64, view));
      svo::Scene scene;
      scene.instances = { instanceOf(octree, 1, glm::dmat4(1.0), leaf) };
      svo::FrameSettings settings;
      settings.shadowTechnique = svo::ShadowTechnique::None;
      settings.pixelError = 0.0;
      const svo::Frame frame = rendered(scene, view, settings);
      const auto holes = std::count(frame.instance.begin(), frame.instance.end(), ~0u);
      pixels += 64 * 64;
      EXPECT_EQ(holes, 0) << c.name << ", picture " << k << ", leaves " << int(leaf) << ", angle "
                          << angle << ", eye " << eye.x << " " << eye.y << " " << eye.z
                          << ", ahead " << ahead.x << " " << ahead.y << " " << ahead.z;
    }
  }
  std::printf("%ld pixels\n", pixels);
}
