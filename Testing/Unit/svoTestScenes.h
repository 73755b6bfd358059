// Meshes, octrees and rays that the unit tests of the octree share.
#ifndef svoTestScenes_h
#define svoTestScenes_h

#include "svoBuild.h"
#include "svoMorton.h"
#include "svoNode.h"
#include "svoOctree.h"
#include "svoRay.h"
#include "svoTestMesh.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace svotest
{
constexpr double Pi = 3.14159265358979323846;

/// A closed grid of `rows` x `columns` quads wrapped both ways, placed by f(u, v), u, v in [0, 1).
template <class F>
Mesh wrappedGrid(unsigned rows, unsigned columns, F&& f)
{
  Mesh mesh;
  for (unsigned i = 0; i < rows; ++i)
  {
    for (unsigned j = 0; j < columns; ++j)
    {
      mesh.points.push_back(f(double(i) / rows, double(j) / columns));
      const unsigned i1 = (i + 1) % rows;
      const unsigned j1 = (j + 1) % columns;
      const unsigned a = i * columns + j, b = i1 * columns + j;
      const unsigned c = i1 * columns + j1, d = i * columns + j1;
      mesh.triangles.push_back({ a, b, c });
      mesh.triangles.push_back({ a, c, d });
    }
  }
  return mesh;
}

/// Radii 1 and 0.4 around the z axis; closed.
inline Mesh torus(unsigned rows, unsigned columns)
{
  return wrappedGrid(rows, columns,
    [](double u, double v)
    {
      const double r = 1.0 + 0.4 * std::cos(2 * Pi * v);
      return glm::dvec3(
        r * std::cos(2 * Pi * u), r * std::sin(2 * Pi * u), 0.4 * std::sin(2 * Pi * v));
    });
}

/// Unit sphere with poles, 2 (rows - 1) columns triangles; closed.
inline Mesh sphere(unsigned rows, unsigned columns)
{
  Mesh mesh;
  mesh.points.push_back({ 0.0, 0.0, 1.0 });
  for (unsigned i = 1; i < rows; ++i)
  {
    for (unsigned j = 0; j < columns; ++j)
    {
      const double u = Pi * i / rows, v = 2 * Pi * j / columns;
      mesh.points.push_back({ std::sin(u) * std::cos(v), std::sin(u) * std::sin(v), std::cos(u) });
    }
  }
  mesh.points.push_back({ 0.0, 0.0, -1.0 });
  const unsigned last = static_cast<unsigned>(mesh.points.size()) - 1;
  for (unsigned j = 0; j < columns; ++j)
  {
    const unsigned k = (j + 1) % columns;
    mesh.triangles.push_back({ 0, 1 + j, 1 + k });
    for (unsigned i = 0; i + 2 < rows; ++i)
    {
      const unsigned a = 1 + i * columns, b = a + columns;
      mesh.triangles.push_back({ a + j, b + j, b + k });
      mesh.triangles.push_back({ a + j, b + k, a + k });
    }
    mesh.triangles.push_back({ last, last - columns + k, last - columns + j });
  }
  return mesh;
}

/// Of a mesh around the origin: its point normals, towards the outside.
inline std::vector<float> radialNormals(const Mesh& mesh)
{
  std::vector<float> normals;
  for (const glm::dvec3& x : mesh.points)
  {
    const glm::vec3 n(glm::normalize(x));
    normals.insert(normals.end(), { n.x, n.y, n.z });
  }
  return normals;
}

/// Triangles anywhere in the unit cube, of edges up to `size`.
inline Mesh soup(unsigned count, double size, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Mesh mesh;
  for (unsigned i = 0; i < count; ++i)
  {
    const glm::dvec3 at(unit(random), unit(random), unit(random));
    for (unsigned k = 0; k < 3; ++k)
    {
      mesh.points.push_back(
        at + size * (glm::dvec3(unit(random), unit(random), unit(random)) - 0.5));
    }
    mesh.triangles.push_back({ 3 * i, 3 * i + 1, 3 * i + 2 });
  }
  return mesh;
}

/// The octree of a mesh with its surface. Empty if anything goes wrong.
inline svo::Octree makeOctree(const Mesh& mesh, int level)
{
  svo::BuildOptions options;
  options.level = level;
  const svo::BuildResult built = svo::build(mesh.view(), options);
  if (built.status != svo::BuildStatus::Built)
  {
    return {};
  }
  const auto& header = *reinterpret_cast<const svo::Header*>(built.data.get());
  auto surface = svo::makeSurface(mesh.view(), {}, header, svo::serialFor);
  std::string error;
  return svo::Octree::open(built.data, built.size, surface, error);
}

/// A buffer in the layout of svoLayout.h with exactly these voxels, every brick naming triangle 0.
/// Half of the bricks name it inline, half by a list.
inline std::vector<std::uint64_t> makeBuffer(const std::vector<glm::ivec3>& voxels, int level)
{
  svo::Header header{};
  std::memcpy(header.magic, svo::LayoutMagic, sizeof(svo::LayoutMagic));
  header.version = svo::LayoutVersion;
  header.level = level;
  header.depthCount = (level + 1) / 2;
  header.triangleCount = 1;
  header.voxelSize = 1.0;
  // masks[depth][Morton key of the block] -> mask
  std::vector<std::map<std::uint64_t, std::uint64_t>> masks(header.depthCount);
  std::set<std::uint64_t> keys;
  for (const glm::ivec3& v : voxels)
  {
    keys.insert(svo::mortonKey(v.x, v.y, v.z));
  }
  for (std::uint64_t key : keys)
  {
    for (int depth = header.depthCount - 1; depth >= 0; --depth, key >>= 6)
    {
      masks[depth][key >> 6] |= 1ull << (key & 63);
    }
  }
  if (keys.empty())
  {
    masks[0][0] = 0;
  }
  std::vector<svo::Node> nodes;
  std::vector<std::uint32_t> lists;
  std::uint32_t next = 1;
  for (std::uint32_t depth = 0; depth < header.depthCount; ++depth)
  {
    header.depthBegin[depth] = static_cast<std::uint32_t>(nodes.size());
    for (const auto& [key, mask] : masks[depth])
    {
      std::uint32_t first = next;
      if (depth + 1 < header.depthCount)
      {
        next += svo::countBits(mask);
      }
      else if (nodes.size() % 2 == 0)
      {
        first = svo::InlineTriangle;
      }
      else
      {
        first = static_cast<std::uint32_t>(lists.size());
        lists.insert(lists.end(), { 1u, 0u });
      }
      nodes.push_back({ mask, first, 0 });
    }
  }
  for (std::size_t d = header.depthCount; d <= svo::MaximumDepths; ++d)
  {
    header.depthBegin[d] = static_cast<std::uint32_t>(nodes.size());
  }
  header.nodeCount = nodes.size();
  header.listWords = lists.size();
  header.voxelCount = keys.size();
  std::vector<std::uint64_t> buffer((sizeof(header) + nodes.size() * 16 + lists.size() * 4) / 8);
  auto* bytes = reinterpret_cast<char*>(buffer.data());
  std::memcpy(bytes, &header, sizeof(header));
  std::memcpy(bytes + sizeof(header), nodes.data(), nodes.size() * 16);
  if (!lists.empty())
  {
    std::memcpy(bytes + sizeof(header) + nodes.size() * 16, lists.data(), lists.size() * 4);
  }
  return buffer;
}

inline svo::Octree openBuffer(const std::vector<std::uint64_t>& buffer, std::string& error)
{
  auto words = std::make_shared<std::vector<std::uint64_t>>(buffer);
  std::shared_ptr<const std::byte> data(words, reinterpret_cast<const std::byte*>(words->data()));
  return svo::Octree::open(data, buffer.size() * 8, nullptr, error);
}

inline svo::Octree makeOctree(const std::vector<glm::ivec3>& voxels, int level)
{
  std::string error;
  return openBuffer(makeBuffer(voxels, level), error);
}

/// Random rays in octree coordinates: from around the octree's cube, and from inside it, to points
/// in it. Coordinates are floats, so that every precision traces the same ray.
class RandomRays
{
public:
  RandomRays(const svo::Octree& octree, unsigned seed)
    : Random(seed)
    , Edge(octree.level() % 2 == 0 ? 1.0 : 0.5)
  {
  }
  svo::Ray next()
  {
    const auto inside = [this]
    { return 1.0 + this->Edge * glm::dvec3(this->unit(), this->unit(), this->unit()); };
    const glm::dvec3 target = inside();
    glm::dvec3 origin = inside();
    if (this->unit() < 0.75)
    {
      const glm::dvec3 centre(1.0 + 0.5 * this->Edge);
      origin = centre + 3.0 * (origin - centre);
    }
    svo::Ray ray;
    ray.origin = glm::dvec3(glm::vec3(origin));
    ray.direction = glm::dvec3(glm::vec3(target - origin));
    ray.tMax = 10.0;
    return ray;
  }
  double unit() { return this->Uniform(this->Random); }

private:
  std::mt19937_64 Random;
  std::uniform_real_distribution<double> Uniform{ 0.0, 1.0 };
  double Edge;
};

/// True if the ray passes the box within `slack` of its surface only: it meets the box grown by
/// slack and misses the box shrunk by it.
inline bool grazes(const svo::Ray& ray, const glm::dvec3& low, const glm::dvec3& high, double slack)
{
  const auto meets = [&](double grow)
  {
    double t0 = ray.tMin, t1 = ray.tMax;
    for (int a = 0; a < 3; ++a)
    {
      const double l = low[a] - grow - ray.origin[a], h = high[a] + grow - ray.origin[a];
      if (ray.direction[a] == 0.0)
      {
        if (l > 0.0 || h < 0.0)
        {
          return false;
        }
        continue;
      }
      t0 = std::max(t0, std::min(l / ray.direction[a], h / ray.direction[a]));
      t1 = std::min(t1, std::max(l / ray.direction[a], h / ray.direction[a]));
    }
    return t0 <= t1;
  };
  return meets(slack) && !meets(-slack);
}
}

#endif
