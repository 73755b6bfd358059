#include "svoSource.h"

#include "svoAssemble.h"
#include "svoBuildStopped.h"
#include "svoExecutor.h"
#include "svoExpectedCells.h"
#include "svoMorton.h"
#include "svoNode.h"
#include "svoOctree.h"
#include "svoPlane.h"
#include "svoWork.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <cstring>
#include <new>
#include <vector>

#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

namespace svo
{
namespace
{
constexpr float Sqrt3 = 1.7320508f;

/// Cells are handed out at this many levels above the voxels: some milliseconds of work each.
constexpr int TaskLevels = 6;

/// Peak bytes of a brick and of a voxel: what a task has noted, and the buffer and its parts, of
/// which both are there at once.
constexpr std::size_t BrickBytes =
  2 * (sizeof(Node) + sizeof(std::uint64_t) + sizeof(SurfaceMoment)) + sizeof(Node);
constexpr std::size_t VoxelBytes = 3 * sizeof(std::uint32_t);

/// What one task has found, in Morton order.
struct Found
{
  std::vector<std::uint64_t> keys;
  std::vector<std::uint64_t> masks;
  std::vector<SurfaceMoment> moments;
  std::vector<std::uint32_t> planes; // of all voxels
};

class Subdivision
{
public:
  Subdivision(const SurfaceSource& source, const BuildOptions& options, const Cube& cube)
    : Source(source)
    , Low(options.modelLow)
    , High(options.modelHigh)
    , Origin(cube.origin)
    , Edge(cube.edge)
    , Level(options.level)
    , Limit(options.memoryLimit)
  {
  }

  bool mayPass(const glm::ivec3& cell, int level) const
  {
    const double half = this->half(level);
    const glm::dvec3 centre = this->centre(cell, level);
    return this->touchesBox(centre, half) && this->Source.mayPass(centre, half);
  }

  /// Visits what lies below a cell of `level` that mayPass().
  void visit(const glm::ivec3& cell, int level, Found& found)
  {
    if (level >= this->Level - NodeLevels)
    {
      assert(level == std::max(this->Level - NodeLevels, 0));
      this->visitBrick(cell, found);
      return;
    }
    for (int i = 0; i < 8; ++i)
    {
      const glm::ivec3 child = 2 * cell + glm::ivec3(i & 1, i >> 1 & 1, i >> 2);
      if (this->mayPass(child, level + 1))
      {
        this->visit(child, level + 1, found);
      }
    }
  }

private:
  double half(int level) const { return std::ldexp(this->Edge, -level - 1); }
  glm::dvec3 centre(const glm::ivec3& cell, int level) const
  {
    return this->Origin + (2.0 * glm::dvec3(cell) + 1.0) * this->half(level);
  }
  bool touchesBox(const glm::dvec3& centre, double half) const
  {
    return glm::all(glm::lessThanEqual(this->Low, centre + half)) &&
      glm::all(glm::lessThanEqual(centre - half, this->High));
  }

  /// A brick is a cell NodeLevels above the voxels; where there are fewer levels, its lower corner
  /// is the cube.
  void visitBrick(const glm::ivec3& cell, Found& found)
  {
    const double half = this->half(this->Level);
    const double edge = 2 * NodeEdge * half;
    SourceBrick brick{ this->Origin + edge * glm::dvec3(cell), half,
      maskBelow(std::min(this->Level, NodeLevels)) };
    if (!this->isInBox(brick.low, brick.low + edge))
    {
      brick.asked &= this->voxelsInBox(brick);
    }
    SourcePlane planes[NodeCells];
    const std::uint64_t mask = this->Source.planesIn(brick, planes);
    assert((mask & ~brick.asked) == 0);
    if (mask == 0)
    {
      return;
    }
    SurfaceMoment moment{ glm::vec3(0.0f), 0.0f, glm::vec3(0.0f) };
    for (std::uint64_t left = mask; left != 0; left &= left - 1)
    {
      const int i = lowestBit(left);
      this->add(planes[i], half, cellOfIndex(i), moment, found);
    }
    moment.centre /= moment.area;
    found.keys.push_back(mortonKey(static_cast<std::uint32_t>(cell.x),
      static_cast<std::uint32_t>(cell.y), static_cast<std::uint32_t>(cell.z)));
    found.masks.push_back(mask);
    found.moments.push_back(moment);
    const std::size_t bytes = BrickBytes + VoxelBytes * static_cast<std::size_t>(countBits(mask));
    if (this->Taken.fetch_add(bytes, std::memory_order_relaxed) + bytes > this->Limit &&
      this->Limit > 0)
    {
      throw std::bad_alloc();
    }
  }

  bool isInBox(const glm::dvec3& low, const glm::dvec3& high) const
  {
    return glm::all(glm::lessThanEqual(this->Low, low)) &&
      glm::all(glm::lessThanEqual(high, this->High));
  }
  std::uint64_t voxelsInBox(const SourceBrick& brick) const
  {
    std::uint64_t mask = 0;
    for (int i = 0; i < NodeCells; ++i)
    {
      const glm::dvec3 centre = brick.low + brick.half * (2.0 * glm::dvec3(cellOfIndex(i)) + 1.0);
      mask |= this->touchesBox(centre, brick.half) ? cellBit(i) : 0;
    }
    return mask;
  }

  /// `inBrick`: its cell there.
  static void add(const SourcePlane& plane, double half, const glm::ivec3& inBrick,
    SurfaceMoment& moment, Found& found)
  {
    const glm::vec3 normal(plane.normal);
    const float offset = static_cast<float>(plane.offset * 0.5 / half); // in voxels
    found.planes.push_back(encodePlane({ normal, std::clamp(offset * 2.0f / Sqrt3, -1.0f, 1.0f) }));
    // The area of a plane through the middle of a voxel, about.
    const glm::vec3 along = glm::abs(normal);
    const float area = 1.0f / std::max({ along.x, along.y, along.z });
    moment.normal += area * normal;
    moment.area += area;
    moment.centre += area * (glm::vec3(inBrick) - 0.5f * (NodeEdge - 1) + offset * normal);
  }

  const SurfaceSource& Source;
  const glm::dvec3 Low, High, Origin;
  const double Edge;
  const int Level;
  const std::size_t Limit;
  std::atomic<std::size_t> Taken{ 0 };
};

/// The cells that tasks start from, in Morton order; `level` gets less deep where they are many.
std::vector<glm::ivec3> startCells(const Subdivision& cut, int& level, Executor& executor)
{
  constexpr std::size_t Many = 1 << 17;
  const double share = 0.1 / std::max(level, 1);
  std::vector<glm::ivec3> cells{ glm::ivec3(0) };
  for (int l = 1; l <= level; ++l)
  {
    if (cells.size() > Many)
    {
      level = l - 1;
      break;
    }
    std::vector<glm::ivec3> children(8 * cells.size());
    std::vector<char> passes(children.size());
    executor.run(
      children.size(), 64, share, 4096.0, [](std::size_t) { return 1.0; },
      [&](std::size_t i)
      {
        children[i] = 2 * cells[i / 8] + glm::ivec3(i & 1, i >> 1 & 1, i >> 2 & 1);
        passes[i] = cut.mayPass(children[i], l);
      });
    cells.clear();
    for (std::size_t i = 0; i < children.size(); ++i)
    {
      if (passes[i])
      {
        cells.push_back(children[i]);
      }
    }
  }
  return cells;
}

/// Throws where the octree would certainly take more than there is, instead of after minutes.
void refuseTooLarge(const Subdivision& cut, const std::vector<glm::ivec3>& starts, int startLevel,
  const BuildOptions& options, Executor& executor)
{
  // Fewer than that fit for certain, or are counted quickly enough as they are built.
  constexpr double Doubtful = 1.0 / 16.0;
  constexpr double Certain = 1.5; // what is expected is about a tenth off
  const double limit = static_cast<double>(options.memoryLimit);
  const double smooth =
    std::ldexp(static_cast<double>(starts.size()), 2 * (options.level - startLevel));
  if (limit == 0.0 || smooth * VoxelBytes < Doubtful * limit)
  {
    return;
  }
  const std::vector<double> cells = expectedCells(
    starts, startLevel, options.level,
    [&](const glm::ivec3& cell, int l) { return cut.mayPass(cell, l); }, 0.05, executor);
  const auto expected = [&](int l)
  { return VoxelBytes * cells[l] + BrickBytes * cells[std::max(l - NodeLevels, 0)]; };
  if (expected(options.level) > Certain * limit)
  {
    throw BuildStopped{ BuildStatus::TooLarge,
      tooLargeMessage(options.level, limit, expected, [](int) { return true; }) };
  }
}

/// All that was found in one; frees the parts.
NodeDepth joinBricks(std::vector<Found>& parts, Header& header, RawArray<std::uint32_t>& planes)
{
  std::size_t bricks = 0, voxels = 0;
  for (const Found& part : parts)
  {
    bricks += part.keys.size();
    voxels += part.planes.size();
  }
  checkIndices(header, bricks, "nodes");
  checkIndices(header, voxels * PlaneWords, "planes");
  header.voxelCount = voxels;
  header.leafWords = PlaneWords;
  header.listWords = voxels * PlaneWords;
  NodeDepth all(bricks);
  planes = RawArray<std::uint32_t>(voxels);
  std::size_t brick = 0;
  std::uint32_t first = 0;
  for (Found& part : parts)
  {
    std::copy(part.planes.begin(), part.planes.end(), planes.data() + first);
    for (std::size_t i = 0; i < part.keys.size(); ++i, ++brick)
    {
      all.keys[brick] = part.keys[i];
      all.moments[brick] = part.moments[i];
      all.nodes[brick] = { part.masks[i], first, planeOfMoment(part.moments[i], NodeEdge) };
      first += static_cast<std::uint32_t>(countBits(part.masks[i]));
    }
    part = Found();
  }
  assert(first == voxels);
  return all;
}

/// In a cube of its own choice, if none is given.
void buildStages(
  const SurfaceSource& source, const Cube* given, const BuildOptions& options, BuildResult& result)
{
  const glm::dvec3 size = options.modelHigh - options.modelLow;
  if (!glm::all(glm::greaterThanEqual(size, glm::dvec3(0.0))) || size == glm::dvec3(0.0) ||
    !std::isfinite(size.x + size.y + size.z))
  {
    throw BuildStopped{ BuildStatus::BadInput,
      "the box to look for a surface in is empty, or not finite" };
  }
  if (!isTransform(options.transform))
  {
    throw BuildStopped{ BuildStatus::BadInput,
      "the octree's transform is not affine, or nearly singular" };
  }
  const Cube cube =
    given ? *given : boundingCube(options.modelLow, options.modelHigh, options.level);
  Executor executor(options.parallelFor, options.progress);
  executor.report();
  Subdivision cut(source, options, cube);
  int level = std::max(options.level - TaskLevels, 0);
  const std::vector<glm::ivec3> starts = startCells(cut, level, executor);
  refuseTooLarge(cut, starts, level, options, executor);
  std::vector<Found> parts(starts.size());
  executor.run(
    starts.size(), 1, 0.75, 16.0, [](std::size_t) { return 1.0; },
    [&](std::size_t i) { cut.visit(starts[i], level, parts[i]); });
  Header header = makeHeader(options, cube);
  header.transformed = options.transform != glm::dmat4(1.0);
  header.planeReach = source.planeReach(0.5 * header.voxelSize);
  RawArray<std::uint32_t> planes;
  NodeDepth bricks = joinBricks(parts, header, planes);
  result.data = assemble(std::move(bricks), planes, header, executor);
  result.size = bufferSize(header);
  if (header.transformed != 0)
  {
    const glm::dmat4 rows = glm::transpose(options.transform);
    std::memcpy(result.data.get() + transformOffset(header), &rows[0][0], TransformBytes);
  }
}

BuildResult buildIn(const SurfaceSource& source, const Cube* cube, const BuildOptions& options)
{
  return runBuild(
    options, [&](BuildResult& result) { buildStages(source, cube, options, result); },
    [] { return " needs more memory than there is"; });
}
}

std::uint64_t SurfaceSource::planesIn(const SourceBrick& brick, SourcePlane planes[NodeCells]) const
{
  std::uint64_t mask = 0;
  const double half = brick.half;
  constexpr int GroupSize = cellsBelow(1); // asked of together first
  for (int g = 0; g < NodeCells; g += GroupSize)
  {
    const glm::dvec3 group = brick.low + half * (2.0 * glm::dvec3(cellOfIndex(g)) + 2.0);
    if ((brick.asked >> g & maskBelow(1)) == 0 || !this->mayPass(group, 2.0 * half))
    {
      continue;
    }
    for (int i = g; i < g + GroupSize; ++i)
    {
      const glm::dvec3 centre = brick.low + half * (2.0 * glm::dvec3(cellOfIndex(i)) + 1.0);
      if ((brick.asked & cellBit(i)) != 0 && this->planeIn(centre, half, planes[i]))
      {
        mask |= cellBit(i);
      }
    }
  }
  return mask;
}

BuildResult build(const SurfaceSource& source, const BuildOptions& options)
{
  return buildIn(source, nullptr, options);
}

BuildResult build(const SurfaceSource& source, const Cube& cube, const BuildOptions& options)
{
  return buildIn(source, &cube, options);
}
}
