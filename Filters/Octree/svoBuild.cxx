#include "svoBuild.h"

#include "svoMorton.h"
#include "svoPlane.h"
#include "svoVoxelize.h"

#include <cstring>
#include <new>

namespace svo
{
namespace
{
std::uint32_t trianglePlane(
  const TriangleMesh& mesh, std::uint32_t id, const glm::dvec3& centre, double halfDiagonal)
{
  const glm::uvec3& t = mesh.triangles[id];
  const glm::dvec3& a = mesh.points[t.x];
  const glm::dvec3 n = glm::cross(mesh.points[t.y] - a, mesh.points[t.z] - a);
  const double length = glm::length(n);
  MeanPlane plane{ glm::vec3(0.0f, 0.0f, 1.0f), 0.0f };
  if (length > 0.0)
  {
    plane.normal = glm::vec3(n / length);
    plane.offset = static_cast<float>(glm::dot(a - centre, n / length) / halfDiagonal);
  }
  return encodePlane(plane);
}
}

std::size_t estimateBuildMemory(const TriangleMesh& mesh, int level)
{
  return mesh.triangleCount * 64 + (std::size_t(1) << level);
}

BuildResult build(const TriangleMesh& mesh, const BuildOptions& options)
{
  BuildResult result;
  const int level = options.level;
  if (level < 1 || level > MaximumLevel || mesh.triangleCount > 0x7fffffffu)
  {
    result.message = "the level must be 1 to 20 and there may be at most 2^31 - 1 triangles";
    return result;
  }
  const Cube cube = boundingCube(mesh, level);
  const Lattice lattice(cube, level);
  std::vector<BrickRecord> records;
  for (std::size_t i = 0; i < mesh.triangleCount; ++i)
  {
    const glm::uvec3& t = mesh.triangles[i];
    if (!usable(mesh.points[t.x]) || !usable(mesh.points[t.y]) || !usable(mesh.points[t.z]))
    {
      ++result.droppedTriangles;
      continue;
    }
    const glm::ivec3 v[3] = { lattice.snap(mesh.points[t.x]), lattice.snap(mesh.points[t.y]),
      lattice.snap(mesh.points[t.z]) };
    voxelizeTriangle(v, static_cast<std::uint32_t>(i), level, records);
    if (options.progress && (i & 1023) == 0 && !options.progress(0.8 * i / mesh.triangleCount))
    {
      result.status = BuildStatus::Aborted;
      return result;
    }
  }
  std::sort(records.begin(), records.end(),
    [](const BrickRecord& a, const BrickRecord& b)
    { return a.key != b.key ? a.key < b.key : a.triangle < b.triangle; });
  struct KeyedNode
  {
    std::uint64_t key;
    Node node;
    std::uint32_t triangle;
  };
  const int depths = (level + 1) / 2;
  std::vector<std::vector<KeyedNode>> levels(depths);
  std::vector<std::uint32_t> lists;
  std::uint64_t voxels = 0;
  for (std::size_t i = 0, end = 0; i < records.size(); i = end)
  {
    KeyedNode brick{ records[i].key, { 0, 0, 0 }, records[i].triangle };
    for (end = i; end < records.size() && records[end].key == brick.key; ++end)
    {
      brick.node.mask |= records[end].mask;
    }
    if (end - i == 1)
    {
      brick.node.first = records[i].triangle | InlineTriangle;
    }
    else
    {
      brick.node.first = static_cast<std::uint32_t>(lists.size());
      lists.push_back(static_cast<std::uint32_t>(end - i));
      for (std::size_t k = i; k < end; ++k)
      {
        lists.push_back(records[k].triangle);
      }
    }
    voxels += __builtin_popcountll(brick.node.mask);
    levels[depths - 1].push_back(brick);
  }
  for (int d = depths - 1; d > 0; --d)
  {
    for (const KeyedNode& child : levels[d])
    {
      auto& parents = levels[d - 1];
      if (parents.empty() || parents.back().key != child.key >> 6)
      {
        parents.push_back({ child.key >> 6, { 0, 0, 0 }, child.triangle });
      }
      parents.back().node.mask |= 1ull << (child.key & 63);
    }
  }
  if (levels[0].empty())
  {
    levels[0].push_back({ 0, { 0, 0, 0 }, 0 });
    if (depths == 1)
    {
      levels[0][0].node.first = InlineTriangle;
    }
  }
  Header header{};
  std::memcpy(header.magic, LayoutMagic, sizeof(LayoutMagic));
  header.version = LayoutVersion;
  header.level = level;
  header.depthCount = depths;
  header.leafGeometry = static_cast<std::uint32_t>(options.leafGeometry);
  header.voxelCount = voxels;
  header.listWords = lists.size();
  header.triangleCount = mesh.triangleCount;
  header.voxelSize = std::ldexp(cube.edge, -level);
  for (int i = 0; i < 3; ++i)
  {
    header.origin[i] = cube.origin[i];
  }
  for (int d = 0; d < depths; ++d)
  {
    header.depthBegin[d + 1] = header.depthBegin[d] + static_cast<std::uint32_t>(levels[d].size());
  }
  header.nodeCount = header.depthBegin[depths];
  std::uint32_t next = 1;
  std::vector<Node> nodes;
  for (int d = 0; d < depths; ++d)
  {
    const double edge = std::ldexp(header.voxelSize, 2 * (depths - d));
    for (KeyedNode& k : levels[d])
    {
      if (d + 1 < depths)
      {
        k.node.first = next;
        next += __builtin_popcountll(k.node.mask);
      }
      if (voxels > 0)
      {
        const glm::dvec3 centre = cube.origin + (glm::dvec3(mortonCell(k.key)) + 0.5) * edge;
        k.node.plane = trianglePlane(mesh, k.triangle, centre, edge * std::sqrt(0.75));
      }
      nodes.push_back(k.node);
    }
  }
  result.size = sizeof(Header) + nodes.size() * sizeof(Node) + lists.size() * sizeof(std::uint32_t);
  result.data = std::shared_ptr<std::byte>(static_cast<std::byte*>(::operator new(result.size)),
    [](std::byte* p) { ::operator delete(p); });
  std::memcpy(result.data.get(), &header, sizeof(Header));
  std::memcpy(result.data.get() + sizeof(Header), nodes.data(), nodes.size() * sizeof(Node));
  std::memcpy(result.data.get() + sizeof(Header) + nodes.size() * sizeof(Node), lists.data(),
    lists.size() * sizeof(std::uint32_t));
  result.status = BuildStatus::Built;
  return result;
}
}
