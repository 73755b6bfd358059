#include "svoMeshEdges.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
/// Cells of a side of the cube of directions, along an edge.
constexpr int BundlesAlongEdge = 8;
constexpr int BundleCount = 6 * BundlesAlongEdge * BundlesAlongEdge;

/// By point: the least one at the same place.
std::vector<std::uint32_t> weld(const Surface& surface)
{
  std::vector<std::uint32_t> order(surface.points.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&surface](std::uint32_t id)
  {
    std::uint32_t words[3];
    std::memcpy(words, &surface.points[id], sizeof(words));
    return std::make_pair(
      std::uint64_t(words[0]) << 32 | words[1], std::uint64_t(words[2]) << 32 | id);
  };
  std::sort(order.begin(), order.end(),
    [&key](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> first(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const bool same = i > 0 && surface.points[order[i]] == surface.points[order[i - 1]];
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

int bundleOf(const glm::dvec3& normal)
{
  const glm::dvec3 size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto cell = [&](int other)
  {
    const double at = 0.5 * BundlesAlongEdge * (1.0 + normal[other] / size[axis]);
    return std::clamp(static_cast<int>(at), 0, BundlesAlongEdge - 1);
  };
  const int side = 2 * axis + (normal[axis] < 0.0);
  return (side * BundlesAlongEdge + cell((axis + 1) % 3)) * BundlesAlongEdge + cell((axis + 2) % 3);
}

/// Sets that are united. (Union by halving paths.)
std::uint32_t rootOf(std::vector<std::uint32_t>& parents, std::uint32_t i)
{
  while (parents[i] != i)
  {
    parents[i] = parents[parents[i]];
    i = parents[i];
  }
  return i;
}

struct Side // of a triangle
{
  std::uint32_t low, high; // welded points
  std::uint32_t corner;    // at which it begins
  bool reversed;           // the triangle goes from high to low
  bool operator<(const Side& o) const
  {
    return std::tie(low, high, corner) < std::tie(o.low, o.high, o.corner);
  }
};

std::vector<Side> sidesOf(const Surface& surface)
{
  const std::vector<std::uint32_t> point = weld(surface);
  std::vector<Side> sides;
  sides.reserve(3 * surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      const std::uint32_t a = point[surface.triangles[t][k]];
      const std::uint32_t b = point[surface.triangles[t][(k + 1) % 3]];
      if (a != b)
      {
        sides.push_back(
          { std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(3 * t + k), a > b });
      }
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

std::uint32_t nextCorner(std::uint32_t corner)
{
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

/// Makes the edges, and says which parts of the mesh are solid.
void join(const Surface& surface, MeshEdges& mesh)
{
  const std::vector<Side> sides = sidesOf(surface);
  std::vector<std::uint32_t> part(mesh.faces.size()); // a forest
  std::iota(part.begin(), part.end(), 0u);
  std::vector<std::uint32_t> open; // faces
  for (std::size_t i = 0; i < sides.size();)
  {
    const Side& first = sides[i];
    const auto edge = static_cast<std::uint32_t>(mesh.edges.size());
    const std::uint32_t begins = first.corner, ends = nextCorner(first.corner);
    mesh.edges.push_back(
      first.reversed ? MeshEdges::Edge{ ends, begins } : MeshEdges::Edge{ begins, ends });
    int balance = 0;
    for (; i < sides.size() && sides[i].low == first.low && sides[i].high == first.high; ++i)
    {
      const Side& side = sides[i];
      mesh.faces[side.corner / 3].edges[side.corner % 3] = 2 * edge + side.reversed;
      balance += side.reversed ? -1 : 1;
      part[rootOf(part, side.corner / 3)] = rootOf(part, first.corner / 3);
    }
    if (balance != 0)
    {
      open.push_back(first.corner / 3);
    }
  }
  std::vector<double> volume(mesh.faces.size()); // by part, six times
  for (std::uint32_t face = 0; face < mesh.faces.size(); ++face)
  {
    const TrianglePlane plane(surface, face);
    volume[rootOf(part, face)] += glm::dot(plane.normal, plane.p - mesh.centre);
  }
  for (const std::uint32_t face : open)
  {
    volume[rootOf(part, face)] = 0.0;
  }
  for (std::uint32_t face = 0; face < mesh.faces.size(); ++face)
  {
    mesh.faces[face].solid = volume[rootOf(part, face)] > 0.0;
  }
}

void bundle(const Surface& surface, MeshEdges& mesh)
{
  std::vector<int> of(mesh.faces.size());
  std::vector<std::uint32_t> count(BundleCount + 2); // and of those without a normal
  for (std::uint32_t face = 0; face < of.size(); ++face)
  {
    const glm::dvec3 normal = TrianglePlane(surface, face).normal;
    of[face] = glm::dot(normal, normal) > 0.0 ? bundleOf(normal) : BundleCount;
    ++count[of[face] + 1];
  }
  std::partial_sum(count.begin(), count.end(), count.begin());
  std::vector<std::uint32_t> next(count);
  mesh.bundled.resize(of.size());
  for (std::uint32_t face = 0; face < of.size(); ++face)
  {
    mesh.bundled[next[of[face]]++] = face;
  }
  for (int i = 0; i < BundleCount; ++i)
  {
    MeshEdges::Bundle made{ count[i], count[i + 1], glm::dvec3(0.0), 0.0 };
    if (made.first == made.end)
    {
      continue;
    }
    const auto direction = [&](std::uint32_t k)
    { return glm::normalize(TrianglePlane(surface, mesh.bundled[k]).normal); };
    for (std::uint32_t k = made.first; k < made.end; ++k)
    {
      made.axis += direction(k);
    }
    made.axis = glm::normalize(made.axis);
    for (std::uint32_t k = made.first; k < made.end; ++k)
    {
      const double cosine = glm::dot(made.axis, direction(k));
      made.angle = std::max(made.angle, std::acos(std::clamp(cosine, -1.0, 1.0)));
    }
    mesh.bundles.push_back(made);
  }
}
}

MeshEdges::MeshEdges(const Surface& surface)
  : faces(surface.triangles.size(), Face{ { None, None, None }, false })
{
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::uvec3& triangle : surface.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const glm::dvec3 point(surface.points[triangle[k]]);
      low = glm::min(low, point);
      high = glm::max(high, point);
    }
  }
  if (!this->faces.empty())
  {
    this->centre = 0.5 * (low + high);
    this->radius = 0.5 * glm::distance(low, high);
  }
  join(surface, *this);
  bundle(surface, *this);
}
}
