#include "svoRecords.h"

#include "svoLattice.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <numeric>

#include <glm/geometric.hpp>

namespace svo
{
namespace
{
constexpr int MostBucketBits = 12;

/// Few enough buckets that each has some hundred records.
int bucketBitsFor(std::size_t records)
{
  int bits = 3;
  while (bits < MostBucketBits && records >> (bits + 8) != 0)
  {
    ++bits;
  }
  return bits;
}

/// Any direction across `edge`, which may be 0.
glm::dvec3 across(const glm::dvec3& edge)
{
  const glm::dvec3 a = glm::abs(edge);
  const glm::dvec3 axis = a.z <= a.x && a.z <= a.y ? glm::dvec3(0.0, 0.0, 1.0)
    : a.y <= a.x                                   ? glm::dvec3(0.0, 1.0, 0.0)
                                                   : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 n = axis - edge * (glm::dot(axis, edge) / std::max(glm::dot(edge, edge), 1e-30));
  return n / glm::length(n);
}

/// Snaps a triangle; `shape` gets its normal and, instead of the share of a voxel, its whole area.
LatticeTriangle placeTriangle(
  const TriangleMesh& mesh, const Lattice& lattice, std::uint32_t id, TriangleShape& shape)
{
  const glm::uvec3& ids = mesh.triangles[id];
  const glm::dvec3 p = lattice.place(mesh.points[ids.x]);
  const glm::dvec3 q = lattice.place(mesh.points[ids.y]);
  const glm::dvec3 r = lattice.place(mesh.points[ids.z]);
  const glm::dvec3 normal = glm::cross(q - p, r - p);
  const double length = glm::length(normal);
  LatticeTriangle t;
  t.id = id;
  const glm::ivec3 snapped[3] = { lattice.snap(p), lattice.snap(q), lattice.snap(r) };
  std::memcpy(t.vertices, snapped, sizeof(t.vertices));
  t.normal = length > 1e-9 ? normal / length
                           : across(glm::length(q - p) > glm::length(r - p) ? q - p : r - p);
  t.offset = glm::dot(t.normal, p) / LatticeUnits;
  shape.normal = glm::vec3(t.normal);
  shape.areaPerVoxel = static_cast<float>(length * (0.5 / LatticeUnits / LatticeUnits));
  return t;
}

/// Stable, by the lowest `bits` bits of the key. `scratch` has room for as many.
void sortBucket(BrickRecord* records, BrickRecord* scratch, std::size_t count, int bits)
{
  if (count < 2 || bits == 0)
  {
    return;
  }
  const int passes = 2 * ((bits + 19) / 20); // even: the result ends where it came from
  const int digit = (bits + passes - 1) / passes;
  if (count < std::size_t(1) << digit >> 1)
  {
    std::sort(records, records + count,
      [](const BrickRecord& a, const BrickRecord& b)
      { return a.key != b.key ? a.key < b.key : a.triangle < b.triangle; });
    return;
  }
  assert(digit <= 10);
  std::uint32_t place[1 << 10];
  for (int pass = 0; pass < passes; ++pass)
  {
    const int shift = pass * digit;
    const std::uint64_t digits = (1ull << digit) - 1;
    std::fill_n(place, digits + 1, 0u);
    for (std::size_t i = 0; i < count; ++i)
    {
      ++place[records[i].key >> shift & digits];
    }
    std::exclusive_scan(place, place + digits + 1, place, 0u);
    for (std::size_t i = 0; i < count; ++i)
    {
      scratch[place[records[i].key >> shift & digits]++] = records[i];
    }
    std::swap(records, scratch);
  }
}

/// True if no brick is out of order, and no triangle of a brick, or there twice.
[[maybe_unused]] bool isSorted(const RawArray<BrickRecord>& records)
{
  const BrickRecord* const end = records.data() + records.size();
  return std::adjacent_find(records.data(), end,
           [](const BrickRecord& a, const BrickRecord& b)
           { return a.key > b.key || (a.key == b.key && a.triangle >= b.triangle); }) == end;
}
}

std::vector<RecordList> voxelizeMesh(const TriangleMesh& mesh, const Cube& cube, int level,
  const std::vector<WorkPiece>& pieces, RawArray<TriangleShape>& shapes, Executor& executor)
{
  const Lattice lattice(cube, level);
  std::vector<RecordList> records(pieces.size());
  std::vector<std::uint64_t> voxelsOfPart(pieces.size());
  executor.run(
    pieces.size(), 1, 0.6, 2e5, [&](std::size_t i) { return pieces[i].records; },
    [&](std::size_t i)
    {
      const WorkPiece& piece = pieces[i];
      RecordList& out = records[i];
      out.reserve(static_cast<std::size_t>(piece.records * 1.125) + 64);
      for (std::uint32_t id = piece.first; id < piece.last; ++id)
      {
        if (!usable(mesh, mesh.triangles[id]))
        {
          continue;
        }
        TriangleShape shape;
        const LatticeTriangle t = placeTriangle(mesh, lattice, id, shape);
        const std::uint64_t voxels = voxelizeTriangle(t, level, out, piece.part, piece.parts);
        if (piece.parts == 1)
        {
          assert(voxels > 0);
          shape.areaPerVoxel /= static_cast<float>(voxels);
          shapes[id] = shape;
        }
        else
        {
          voxelsOfPart[i] = voxels;
        }
      }
    });
  for (std::size_t i = 0; i < pieces.size(); i += pieces[i].parts)
  {
    if (pieces[i].parts > 1)
    {
      std::uint64_t voxels = 0;
      for (std::size_t k = i; k < i + pieces[i].parts; ++k)
      {
        voxels += voxelsOfPart[k];
      }
      assert(voxels > 0);
      TriangleShape& shape = shapes[pieces[i].first];
      placeTriangle(mesh, lattice, pieces[i].first, shape);
      shape.areaPerVoxel /= static_cast<float>(voxels);
    }
  }
  return records;
}

SortedRecords sortRecords(std::vector<RecordList>&& pieces, int level, Executor& executor)
{
  // Scatter into buckets by the highest bits, from a few blocks of pieces so that their histograms
  // stay small; then each bucket is sorted where it lies, in the cache.
  const std::size_t blocks = std::min<std::size_t>(pieces.size(), 32);
  const auto blockBegin = [&](std::size_t block) { return pieces.size() * block / blocks; };
  std::vector<std::size_t> blockSize(blocks);
  std::size_t total = 0;
  for (std::size_t block = 0; block < blocks; ++block)
  {
    for (std::size_t i = blockBegin(block); i < blockBegin(block + 1); ++i)
    {
      blockSize[block] += pieces[i].size();
    }
    total += blockSize[block];
  }
  const int keyBits = 3 * NodeLevels * (depthsOf(level) - 1);
  const int bucketBits = std::min(keyBits, bucketBitsFor(total));
  const int shift = keyBits - bucketBits;
  const std::size_t buckets = std::size_t(1) << bucketBits;
  std::vector<std::size_t> places(blocks * buckets);
  const auto cost = [&](std::size_t block) { return static_cast<double>(blockSize[block]); };
  executor.run(blocks, 1, 0.02, 5e6, cost,
    [&](std::size_t block)
    {
      std::size_t* count = places.data() + block * buckets;
      for (std::size_t i = blockBegin(block); i < blockBegin(block + 1); ++i)
      {
        for (const BrickRecord& record : pieces[i])
        {
          assert(record.key >> keyBits == 0);
          ++count[record.key >> shift];
        }
      }
    });
  SortedRecords sorted;
  sorted.bucketBegin.resize(buckets + 1);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    sorted.bucketBegin[(i & (buckets - 1)) + 1] += places[i];
  }
  std::partial_sum(
    sorted.bucketBegin.begin(), sorted.bucketBegin.end(), sorted.bucketBegin.begin());
  std::vector<std::size_t> next(sorted.bucketBegin.begin(), sorted.bucketBegin.end() - 1);
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const std::size_t count = places[i];
    places[i] = next[i & (buckets - 1)];
    next[i & (buckets - 1)] += count;
  }
  sorted.records = RawArray<BrickRecord>(total);
  executor.run(blocks, 1, 0.08, 2e6, cost,
    [&](std::size_t block)
    {
      std::size_t* place = places.data() + block * buckets;
      for (std::size_t i = blockBegin(block); i < blockBegin(block + 1); ++i)
      {
        for (const BrickRecord& record : pieces[i])
        {
          sorted.records[place[record.key >> shift]++] = record;
        }
        pieces[i] = RecordList();
      }
    });
  executor.runRanges(
    buckets, 16, 0.1, 1e6,
    [&](std::size_t bucket) { return static_cast<double>(sorted.bucketSize(bucket)); },
    [&](std::size_t first, std::size_t last)
    {
      std::size_t largest = 0;
      for (std::size_t bucket = first; bucket < last; ++bucket)
      {
        largest = std::max(largest, sorted.bucketSize(bucket));
      }
      RawArray<BrickRecord> scratch(largest);
      for (std::size_t bucket = first; bucket < last; ++bucket)
      {
        sortBucket(sorted.records.data() + sorted.bucketBegin[bucket], scratch.data(),
          sorted.bucketSize(bucket), shift);
      }
    });
  assert(sorted.bucketBegin.back() == total);
  assert(isSorted(sorted.records));
  return sorted;
}
}
