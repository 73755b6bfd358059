#include "svoBuild.h"

#include "svoAssemble.h"
#include "svoLattice.h"
#include "svoWork.h"

#include <algorithm>
#include <cmath>
#include <new>

namespace svo
{
namespace
{
/// Why a level is too deep, and which one is not. `limit` is in bytes.
std::string tooLargeMessage(const MeshMeasure& measure, int level, double limit)
{
  const auto fits = [&](int l)
  { return measure.expectedMemory(l) <= limit && measure.fitsIndices(l); };
  std::string text = "level " + std::to_string(level) + " would need about " +
    bytesAsText(measure.expectedMemory(level));
  text += measure.expectedMemory(level) > limit
    ? ", more than the limit of " + bytesAsText(limit)
    : std::string(", with more nodes than an index can name");
  int deepest = level - 1;
  while (deepest >= 1 && !fits(deepest))
  {
    --deepest;
  }
  return text +
    (deepest >= 1 ? "; level " + std::to_string(deepest) + " would need about " +
          bytesAsText(measure.expectedMemory(deepest))
                  : std::string("; no level fits"));
}

void buildStages(
  const TriangleMesh& mesh, const BuildOptions& options, MeshMeasure& measure, BuildResult& result)
{
  Executor executor(options.parallelFor, options.progress);
  executor.report();
  const Cube cube = boundingCube(mesh, options, result.droppedTriangles);
  executor.report();
  RawArray<float> recordsOfTriangle(mesh.triangleCount);
  measure = measureMesh(mesh, cube, options.parallelFor, options.level, recordsOfTriangle);
  const double limit = options.memoryLimit > 0 ? static_cast<double>(options.memoryLimit) : 1e300;
  if (measure.expectedMemory(options.level) > limit || !measure.fitsIndices(options.level))
  {
    result.status = BuildStatus::TooLarge;
    result.message = tooLargeMessage(measure, options.level, limit);
    return;
  }
  executor.report();
  const std::vector<WorkPiece> pieces = cutWork(recordsOfTriangle);
  recordsOfTriangle = {};
  RawArray<TriangleShape> shapes(mesh.triangleCount);
  Header header = makeHeader(options, cube);
  header.triangleCount = mesh.triangleCount;
  SortedRecords records = sortRecords(
    voxelizeMesh(mesh, cube, options.level, pieces, shapes, executor), options.level, executor);
  result.data = assemble(std::move(records), shapes, header, result.size, executor);
  result.status = BuildStatus::Built;
}
}

std::size_t estimateBuildMemory(const TriangleMesh& mesh, int level)
{
  level = std::clamp(level, 1, MaximumLevel);
  RawArray<float> none;
  const double bytes =
    measureMesh(mesh, boundingCube(mesh, level), serialFor, level, none).expectedMemory(level);
  return static_cast<std::size_t>(std::min(bytes, 1e18));
}

BuildResult build(const TriangleMesh& mesh, const BuildOptions& options)
{
  BuildResult result;
  if (options.level < 1 || options.level > MaximumLevel)
  {
    result.message = "the level must be 1 to 20, and is " + std::to_string(options.level);
    return result;
  }
  if (mesh.triangleCount > 0x7fffffffu)
  {
    result.message = "there are more triangles than the octree has ids for";
    return result;
  }
  MeshMeasure measure;
  const std::string level = "level " + std::to_string(options.level);
  try
  {
    buildStages(mesh, options, measure, result);
  }
  catch (const BuildAborted&)
  {
    result.status = BuildStatus::Aborted;
    result.message = "the build was aborted";
  }
  catch (const LayoutOverflow& overflow)
  {
    result.status = BuildStatus::TooLarge;
    result.message =
      level + " would need more " + overflow.what + " than an index can name; choose a lower level";
  }
  catch (const std::bad_alloc&)
  {
    result.status = BuildStatus::TooLarge;
    result.message = level + " would need about " +
      bytesAsText(measure.expectedMemory(options.level)) +
      ", more than there is; choose a lower level";
  }
  if (result.status != BuildStatus::Built)
  {
    result.data.reset();
    result.size = 0;
  }
  return result;
}

std::shared_ptr<const Surface> makeSurface(const TriangleMesh& mesh,
  std::vector<std::uint32_t> cells, const Header& header, const ParallelFor& parallelFor)
{
  auto surface = std::make_shared<Surface>();
  surface->points.reserve(mesh.pointCount + 1); // room for svoLaneTriples-inl.h
  surface->points.resize(mesh.pointCount);
  surface->triangles.reserve(mesh.triangleCount + 1);
  surface->triangles.assign(mesh.triangles, mesh.triangles + mesh.triangleCount);
  surface->cells = std::move(cells);
  const glm::dvec3 origin(header.origin[0], header.origin[1], header.origin[2]);
  const double scale =
    1.0 / std::ldexp(header.voxelSize, static_cast<int>(NodeLevels * header.depthCount));
  parallelFor(0, mesh.pointCount, 16384,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        const glm::dvec3& p = mesh.points[i];
        surface->points[i] = usable(p) ? glm::vec3(1.0 + (p - origin) * scale) : glm::vec3(1.0f);
      }
    });
  return surface;
}
}
