#include "svoBuild.h"

#include "svoAssemble.h"
#include "svoBuildStopped.h"
#include "svoExecutor.h"
#include "svoLattice.h"
#include "svoWork.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace svo
{
namespace
{
void buildStages(
  const TriangleMesh& mesh, const BuildOptions& options, MeshMeasure& measure, BuildResult& result)
{
  if (mesh.triangleCount > 0x7fffffffu)
  {
    throw BuildStopped{ BuildStatus::BadInput,
      "there are more triangles than the octree has ids for" };
  }
  Executor executor(options.parallelFor, options.progress);
  executor.report();
  const Cube cube = boundingCube(mesh, options, result.droppedTriangles);
  executor.report();
  RawArray<float> recordsOfTriangle(mesh.triangleCount);
  measure = measureMesh(mesh, cube, options.parallelFor, options.level, &recordsOfTriangle);
  const double limit = options.memoryLimit > 0 ? static_cast<double>(options.memoryLimit) : 1e300;
  const auto expected = [&](int level) { return measure.expectedMemory(level); };
  const auto fitsIndices = [&](int level) { return measure.fitsIndices(level); };
  if (expected(options.level) > limit || !fitsIndices(options.level))
  {
    throw BuildStopped{ BuildStatus::TooLarge,
      tooLargeMessage(options.level, limit, expected, fitsIndices) };
  }
  executor.report();
  const std::vector<WorkPiece> pieces = cutWork(recordsOfTriangle);
  recordsOfTriangle = {};
  RawArray<TriangleShape> shapes(mesh.triangleCount);
  Header header = makeHeader(options, cube);
  header.triangleCount = mesh.triangleCount;
  RawArray<std::uint32_t> lists;
  std::vector<RecordList> records =
    voxelizeMesh(mesh, cube, options.level, pieces, shapes, executor);
  NodeDepth bricks = makeBricks(
    sortRecords(std::move(records), options.level, executor), shapes, header, lists, executor);
  result.data = assemble(std::move(bricks), lists, header, executor);
  result.size = bufferSize(header);
}
}

std::size_t estimateBuildMemory(const TriangleMesh& mesh, int level)
{
  level = std::clamp(level, 1, MaximumLevel);
  const double bytes =
    measureMesh(mesh, boundingCube(mesh, level), serialFor, level, nullptr).expectedMemory(level);
  return static_cast<std::size_t>(std::min(bytes, 1e18));
}

BuildResult build(const TriangleMesh& mesh, const BuildOptions& options)
{
  MeshMeasure measure;
  return runBuild(
    options, [&](BuildResult& result) { buildStages(mesh, options, measure, result); },
    [&]
    {
      return " would need about " + bytesAsText(measure.expectedMemory(options.level)) +
        ", more than there is";
    });
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
  std::atomic<bool> whole{ true };
  forEach(parallelFor, mesh.pointCount, 16384,
    [&](std::size_t i)
    {
      const glm::dvec3& p = mesh.points[i];
      const bool there = usable(p);
      surface->points[i] = there ? glm::vec3(1.0 + (p - origin) * scale) : glm::vec3(1.0f);
      if (!there)
      {
        whole = false;
      }
    });
  if (!whole)
  {
    // What the octree leaves out is nothing, for who draws all triangles.
    for (glm::uvec3& t : surface->triangles)
    {
      const auto there = [&mesh](std::uint32_t id) { return usable(mesh.points[id]); };
      if (!there(t.x) || !there(t.y) || !there(t.z))
      {
        t = glm::uvec3(there(t.x) ? t.x : there(t.y) ? t.y : t.z);
      }
    }
  }
  return surface;
}
}
