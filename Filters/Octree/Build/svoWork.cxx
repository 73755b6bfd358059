#include "svoWork.h"

#include "svoBox.h"
#include "svoLattice.h"
#include "svoMeanPlanes.h"

#include <cassert>
#include <cstdio>
#include <limits>
#include <numeric>

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
constexpr std::size_t Block = 4096; // triangles

std::size_t blocksOf(std::size_t triangles)
{
  return (triangles + Block - 1) / Block;
}

double bricksOfEdge(int level)
{
  return std::ldexp(1.0, std::max(level - NodeLevels, 0));
}
}

std::string bytesAsText(double bytes)
{
  char text[64];
  std::snprintf(text, sizeof(text), bytes < 0.095 * (1 << 30) ? "%.1f MiB" : "%.1f GiB",
    bytes < 0.095 * (1 << 30) ? bytes / (1 << 20) : bytes / (1 << 30));
  return text;
}

std::string tooLargeMessage(int level, double limit, const std::function<double(int)>& expected,
  const std::function<bool(int)>& fitsIndices)
{
  const auto need = [&](int l)
  { return "level " + std::to_string(l) + " would need about " + bytesAsText(expected(l)); };
  int deepest = level - 1;
  while (deepest >= 1 && !(expected(deepest) <= limit && fitsIndices(deepest)))
  {
    --deepest;
  }
  return need(level) +
    (expected(level) > limit ? ", more than the limit of " + bytesAsText(limit)
                             : std::string(", with more nodes than an index can name")) +
    "; " + (deepest >= 1 ? need(deepest) : std::string("no level fits"));
}

Cube boundingCube(const glm::dvec3& low, const glm::dvec3& high, int level)
{
  if (!(low.x <= high.x))
  {
    return { glm::dvec3(0.0), 1.0 };
  }
  const glm::dvec3 extents = high - low;
  const double extent = std::max({ extents.x, extents.y, extents.z });
  const glm::dvec3 magnitudes = glm::max(glm::abs(low), glm::abs(high));
  const double magnitude = std::max({ magnitudes.x, magnitudes.y, magnitudes.z });
  // A voxel is never smaller than the steps between doubles at the mesh's distance, nor so small
  // that its inverse overflows.
  const double resolvable = std::ldexp(magnitude, level - 52);
  const double units = std::ldexp(1.0, level + LatticeBits);
  double edge = std::max({ extent * (units / (units - 4.0)), resolvable, SmallestEdge });
  if (extent == 0.0)
  {
    edge = magnitude > 0.0 ? std::max(edge, std::ldexp(magnitude, -20)) : 1.0;
  }
  glm::dvec3 origin = low + (extents * 0.5 - edge * 0.5);
  for (int i = 0; i < 3; ++i)
  {
    // Rounding may eat the margin where a lattice unit is below a double's step.
    while (low[i] - origin[i] < edge / units)
    {
      origin[i] = std::nextafter(origin[i], -std::numeric_limits<double>::infinity());
    }
    edge = std::max(edge, (high[i] - origin[i]) * (units / (units - 1.0)));
  }
  for (int i = 0; i < 3; ++i)
  {
    // A flat mesh in the very middle would lie between two layers of voxels and fill both.
    if (low[i] == high[i])
    {
      origin[i] -= std::ldexp(edge, -level - 1);
    }
  }
  return { origin, edge };
}

Cube boundingCube(
  const TriangleMesh& mesh, const BuildOptions& options, std::size_t& droppedTriangles)
{
  struct Bounds
  {
    Box box;
    std::size_t dropped = 0;
  };
  const std::size_t blocks = blocksOf(mesh.triangleCount);
  std::vector<Bounds> bounds(blocks);
  forEach(options.parallelFor, blocks, 4,
    [&](std::size_t block)
    {
      Bounds b;
      const std::size_t end = std::min((block + 1) * Block, mesh.triangleCount);
      for (std::size_t i = block * Block; i < end; ++i)
      {
        const glm::uvec3& t = mesh.triangles[i];
        if (!usable(mesh, t))
        {
          ++b.dropped;
          continue;
        }
        for (int k = 0; k < 3; ++k)
        {
          b.box.add(mesh.points[t[k]]);
        }
      }
      bounds[block] = b;
    });
  Box all{ options.modelLow, options.modelHigh };
  all = all.known() ? all : Box();
  droppedTriangles = 0;
  for (const Bounds& b : bounds)
  {
    all.add(b.box);
    droppedTriangles += b.dropped;
  }
  return boundingCube(all.low, all.high, options.level);
}

Cube boundingCube(const TriangleMesh& mesh, int level)
{
  BuildOptions options;
  options.level = level;
  std::size_t dropped = 0;
  return boundingCube(mesh, options, dropped);
}

double MeshMeasure::expectedRecords(int level) const
{
  const double n = bricksOfEdge(level);
  return (this->areas * n + this->widths) * n + static_cast<double>(this->triangles);
}

double MeshMeasure::expectedMemory(int level) const
{
  const double records = this->expectedRecords(level);
  // Triangles are taken to be neighbours on a surface, whose bricks they share.
  const double n = bricksOfEdge(level);
  const double bricks = std::min({ n * n * n, this->areas * n * n * 1.25 + 8.0 * n, records });
  const double lists = 4.0 * (records - 0.5 * bricks);
  const double mesh = static_cast<double>(this->triangles) * sizeof(TriangleShape);
  // The records of the pieces and of the buckets; the buckets, the bricks with keys and moments and
  // the lists; the same without the records but with the result.
  const double scatter = 2.0 * sizeof(BrickRecord) * records;
  const double brick = sizeof(Node) + sizeof(std::uint64_t) + sizeof(SurfaceMoment);
  const double fill = sizeof(BrickRecord) * records + brick * bricks + lists;
  const double write = (brick + 2.0 * sizeof(Node)) * bricks + 2.0 * lists;
  const double histograms = std::min(records / 4096.0 + 1.0, 32.0) *
    std::clamp(records / 128.0, 8.0, 4096.0) * sizeof(std::size_t);
  return histograms + mesh + std::max({ scatter, fill, write });
}

bool MeshMeasure::fitsIndices(int level) const
{
  // Each record is a brick of its own or a word of a list.
  return this->expectedRecords(level) < 1.05 * 4294967296.0;
}

MeshMeasure measureMesh(const TriangleMesh& mesh, const Cube& cube, const ParallelFor& parallelFor,
  int level, RawArray<float>* recordsOfTriangle)
{
  const std::size_t blocks = blocksOf(mesh.triangleCount);
  std::vector<MeshMeasure> measures(blocks);
  const double n = bricksOfEdge(level);
  const double scale = 1.0 / cube.edge;
  float* const each = recordsOfTriangle ? recordsOfTriangle->data() : nullptr;
  forEach(parallelFor, blocks, 4,
    [&](std::size_t block)
    {
      MeshMeasure m;
      const std::size_t end = std::min((block + 1) * Block, mesh.triangleCount);
      for (std::size_t i = block * Block; i < end; ++i)
      {
        const glm::uvec3& t = mesh.triangles[i];
        double records = 0.0;
        if (usable(mesh, t))
        {
          const glm::dvec3 a = (mesh.points[t.x] - cube.origin) * scale;
          const glm::dvec3 b = (mesh.points[t.y] - cube.origin) * scale;
          const glm::dvec3 c = (mesh.points[t.z] - cube.origin) * scale;
          const glm::dvec3 normal = glm::abs(glm::cross(b - a, c - a));
          const glm::dvec3 width = glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c));
          const double areas = 0.5 * (normal.x + normal.y + normal.z);
          const double widths = width.x + width.y + width.z;
          m.areas += areas;
          m.widths += widths;
          ++m.triangles;
          records = (areas * n + widths) * n + 1.0;
        }
        if (each)
        {
          each[i] = static_cast<float>(records);
        }
      }
      measures[block] = m;
    });
  MeshMeasure sum;
  for (const MeshMeasure& m : measures)
  {
    sum.areas += m.areas;
    sum.widths += m.widths;
    sum.triangles += m.triangles;
  }
  return sum;
}

std::vector<WorkPiece> cutWork(const RawArray<float>& recordsOfTriangle)
{
  const float* const each = recordsOfTriangle.data();
  const double total = std::accumulate(each, each + recordsOfTriangle.size(), 0.0);
  // Small enough to balance threads and to abort between them, not too many for huge meshes.
  const double target = std::max(4096.0, total / 4096.0);
  std::vector<WorkPiece> pieces;
  WorkPiece piece;
  for (std::uint32_t i = 0; i < recordsOfTriangle.size(); ++i)
  {
    const double records = recordsOfTriangle[i];
    if (piece.records > 0.0 && piece.records + records > target)
    {
      piece.last = i;
      pieces.push_back(piece);
      piece = {};
      piece.first = i;
    }
    piece.records += records;
    if (records > 2.0 * target)
    {
      piece.last = i + 1;
      piece.parts = static_cast<std::uint32_t>(records / target);
      piece.records = records / piece.parts;
      for (piece.part = 0; piece.part < piece.parts; ++piece.part)
      {
        pieces.push_back(piece);
      }
      piece = {};
      piece.first = i + 1;
    }
  }
  if (piece.first < recordsOfTriangle.size())
  {
    piece.last = static_cast<std::uint32_t>(recordsOfTriangle.size());
    pieces.push_back(piece);
  }
  assert(pieces.empty() ? recordsOfTriangle.size() == 0
                        : pieces.back().last == recordsOfTriangle.size());
  return pieces;
}
}
