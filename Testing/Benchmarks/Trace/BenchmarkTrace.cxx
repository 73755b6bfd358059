// How fast rays are: primary rays a second on one core, per leaf geometry and level, from far and
// near, beside Embree where it was found. "whole tiles" is what the eye's part of a frame does with
// such a mesh, from finding its triangles to depths in double. Every kernel that is timed is
// checked in the same run: block queries against the scalar walk bit for bit and against the double
// reference, triangle leaves against Embree in robust mode. Times are the thread's own CPU time,
// medians. Built with VTKSVO_COUNTERS it says what each kernel did as well; then times mean
// nothing.
//
//   BenchmarkTrace [--levels 8,10,12] [--size 640x360] [--repeat n] [--scalar] [--json file]
//                  [--isa AVX-512|AVX2|SSE4|scalar] [--instances n] [--a dragon.off]
//                  [--b sydney.md2] [mesh ...]
//
// --isa: of both, where Embree has it. --instances: a crowd of the mesh besides, as the eye's part
// of a frame and through Embree's instances. Where NanoVDB was found it marches through the same
// voxels.
#include "svoBenchmarkMesh.h"
#include "svoEmbreeScene.h"
#include "svoInstructionSet.h"
#include "svoTraceInstances.h"
#include "svoTraceReport.h"
#include "svoTraceSettings.h"
#include "svoTraceTiles.h"
#include "svoVDBScene.h"

#include "svoBuild.h"
#include "svoCounters.h"
#include "svoIntersect.h"
#include "svoTileIntervals.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

namespace
{
using namespace svo;

/// The tiles of an image as blocks in octree coordinates, row by row.
struct Tiles
{
  View view;
  int columns = 0;
  int rows = 0;
  double base = 0.0; // t of a block's rays is linear depth minus this
  std::vector<RayBlock> blocks;
};

Tiles makeTiles(const Octree& octree, double distance, const svobench::TraceSettings& settings)
{
  const Header& h = octree.header();
  const double edge = h.voxelSize * (1 << octree.level());
  const glm::dvec3 centre = glm::dvec3(h.origin[0], h.origin[1], h.origin[2]) + 0.5 * edge;
  const glm::dvec3 eye = centre + distance * edge * glm::normalize(glm::dvec3(0.4, 0.3, 1.0));
  Tiles tiles;
  const double aspect = double(settings.width) / settings.height;
  makeView(glm::lookAt(eye, centre, glm::dvec3(0, 1, 0)),
    glm::perspective(0.5236, aspect, 1e-3 * edge, 10.0 * edge), settings.width, settings.height,
    tiles.view);
  tiles.columns = (settings.width + 7) / 8;
  tiles.rows = (settings.height + 7) / 8;
  tiles.base = std::max(distance - 1.0, 0.0) * edge;
  const glm::dmat4 m = octree.localToOctree();
  for (int b = 0; b < tiles.columns * tiles.rows; ++b)
  {
    RayBlock block;
    for (int i = 0; i < RayBlock::Size; ++i)
    {
      const double x = 8 * (b % tiles.columns) + i % 8 + 0.5;
      const double y = 8 * (b / tiles.columns) + i / 8 + 0.5;
      const glm::dvec3 d = tiles.view.rayDirection(x, y);
      const glm::dvec3 o(m * glm::dvec4(tiles.view.rayOrigin(x, y) + tiles.base * d, 1.0));
      const glm::dvec3 direction(m * glm::dvec4(d, 0.0));
      block.aim(i, o, direction);
      block.tMin[i] = static_cast<float>(std::max(tiles.view.tNear - tiles.base, 0.0));
      block.tMax[i] = static_cast<float>(tiles.view.tFar - tiles.base);
    }
    tiles.blocks.push_back(block);
  }
  return tiles;
}

void traceWithIntervals(const Octree& octree, const Tiles& tiles, const TraceOptions& options,
  std::vector<HitBlock>& hits)
{
  TileIntervals intervals;
  computeTileIntervals(octree, glm::dmat4(1.0), tiles.view,
    { 0, 0, tiles.view.width, tiles.view.height }, options, tiles.base, serialFor, intervals);
  for (std::size_t b = 0; b < tiles.blocks.size(); ++b)
  {
    if (intervals.tNear[b] > intervals.tFar[b])
    {
      std::fill_n(hits[b].primitive, RayBlock::Size, NoPrimitive);
      continue;
    }
    RayBlock block = tiles.blocks[b];
    for (int i = 0; i < RayBlock::Size; ++i)
    {
      block.tMin[i] = std::max(block.tMin[i], intervals.tNear[b]);
      block.tMax[i] = std::min(block.tMax[i], intervals.tFar[b]);
    }
    intersect(octree, block, options, hits[b]);
  }
}

/// Rays whose answers differ in being a hit at all, or by more than `tolerance` in depth.
std::size_t countDifferent(
  const std::vector<HitBlock>& a, const std::vector<HitBlock>& b, double tolerance)
{
  std::size_t count = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
  {
    for (int i = 0; i < RayBlock::Size; ++i)
    {
      const bool hitA = a[k].primitive[i] != NoPrimitive;
      const bool hitB = b[k].primitive[i] != NoPrimitive;
      count += hitA != hitB || (hitA && !(std::abs(a[k].t[i] - b[k].t[i]) <= tolerance));
    }
  }
  return count;
}

std::vector<HitBlock> traceInDouble(
  const Octree& octree, const Tiles& tiles, const TraceOptions& options)
{
  std::vector<HitBlock> hits(tiles.blocks.size());
  for (std::size_t b = 0; b < hits.size(); ++b)
  {
    const RayBlock& block = tiles.blocks[b];
    for (int i = 0; i < RayBlock::Size; ++i)
    {
      Ray ray;
      ray.origin = { block.originX[i], block.originY[i], block.originZ[i] };
      ray.direction = { block.directionX[i], block.directionY[i], block.directionZ[i] };
      ray.tMin = block.tMin[i];
      ray.tMax = block.tMax[i];
      const Hit hit = intersect(octree, ray, options);
      hits[b].t[i] = static_cast<float>(hit.t);
      hits[b].primitive[i] = hit.primitive;
    }
  }
  return hits;
}

/// Forgets what was counted so far.
void startCounting()
{
#ifdef VTKSVO_COUNTERS
  takeCounts();
#endif
}

/// Prints what was counted since, for each of `rays`.
void printCounts([[maybe_unused]] double rays)
{
#ifdef VTKSVO_COUNTERS
  const Counts counts = takeCounts();
  for (std::size_t i = 0; i < CounterCount; ++i)
  {
    if (counts[i] != 0)
    {
      std::printf("      %-32s %9.4f a ray\n", counterName(i), counts[i] / rays);
    }
  }
#endif
}

void benchmark(const svobench::Mesh& mesh, const Octree& octree, const char* camera,
  double distance, const svobench::TraceSettings& settings, svobench::TraceReport& report)
{
  constexpr const char* names[] = { "voxel", "plane", "triangle", "automatic" };
  const Tiles tiles = makeTiles(octree, distance, settings);
  const std::size_t rays = tiles.blocks.size() * RayBlock::Size;
  const Header& header = octree.header();
  const double voxel = header.voxelSize; // t is depth in local units
  std::vector<HitBlock> hits(tiles.blocks.size());
  const svobench::EmbreeScene embree(mesh, settings.isa);
  const svobench::VDBScene vdb(octree);
  for (int g = 0; g < 4; ++g)
  {
    TraceOptions options;
    options.leafGeometry = static_cast<LeafGeometry>(g);
    std::vector<HitBlock> scalar(tiles.blocks.size());
    for (std::size_t b = 0; b < hits.size(); ++b)
    {
      intersectBlockScalar(octree, tiles.blocks[b], options, scalar[b]);
    }
    const std::vector<HitBlock> reference = traceInDouble(octree, tiles, options);
    if (g == 0)
    {
      std::size_t hitCount = 0;
      for (const HitBlock& h : reference)
      {
        hitCount += RayBlock::Size - std::count(h.primitive, h.primitive + 64, NoPrimitive);
      }
      std::printf("  level %d, %s, %.1f %% of the rays hit\n", octree.level(), camera,
        100.0 * hitCount / rays);
    }
    const auto time = [&](const std::string& kernel, const std::function<void()>& run)
    {
      startCounting();
      const double seconds = svobench::medianSeconds(settings.repeat, run);
      report.add(mesh.name, mesh.triangles.size(), octree.level(), camera, names[g] + kernel,
        rays / seconds);
      printCounts(static_cast<double>(rays) * (settings.repeat + 1)); // once to warm up
    };
    if (settings.scalar)
    {
      time(", scalar",
        [&]
        {
          for (std::size_t b = 0; b < hits.size(); ++b)
          {
            intersectBlockScalar(octree, tiles.blocks[b], options, hits[b]);
          }
        });
    }
    time(", blocks",
      [&]
      {
        for (std::size_t b = 0; b < hits.size(); ++b)
        {
          intersect(octree, tiles.blocks[b], options, hits[b]);
        }
      });
    report.check("blocks against the scalar walk", countDifferent(hits, scalar, 0.0), rays, 0.0);
    // Boundary ties name a neighbouring cell now and then; a hit is never lost but at a silhouette.
    report.check("blocks against the double reference",
      countDifferent(hits, reference, 0.01 * voxel), rays, 2e-3);
    time(", blocks in tile intervals", [&] { traceWithIntervals(octree, tiles, options, hits); });
    report.check(
      "tile intervals against full rays", countDifferent(hits, scalar, 0.01 * voxel), rays, 2e-3);
    if (options.leafGeometry == LeafGeometry::Voxel && vdb.available())
    {
      time(", NanoVDB", [&] { vdb.trace(tiles.blocks, hits); });
      // Where a ray grazes a voxel, roundings of another place decide.
      report.check(
        "NanoVDB against the scalar walk", countDifferent(hits, scalar, voxel), rays, 0.02);
    }
    if (options.leafGeometry != LeafGeometry::Triangle)
    {
      continue;
    }
    svobench::TracedTiles traced(octree, tiles.view);
    time(", whole tiles", [&] { traced.trace(); });
    // They begin and are placed elsewhere, so roundings decide where a ray passes along an edge.
    report.check("whole tiles against the scalar walk",
      countDifferent(traced.hits(tiles.base), scalar, 0.01 * voxel), rays, 1e-4);
    if (embree.available())
    {
      const std::vector<HitBlock> exact = embree.trace(tiles.view, tiles.base, 0);
      // Both are exact but for their float depths, whatever the level.
      report.check("triangle leaves against Embree's robust mode",
        countDifferent(hits, exact, 1e-5 * voxel * (1 << octree.level())), rays, 1e-4);
    }
  }
  for (const int width : { 1, 8, 16 })
  {
    if (embree.available())
    {
      const double seconds = svobench::medianSeconds(
        settings.repeat, [&] { embree.time(tiles.view, tiles.base, width, hits); });
      report.add(mesh.name, mesh.triangles.size(), octree.level(), camera,
        "Embree, " + std::to_string(width) + (width == 1 ? " ray" : " rays"), rays / seconds);
    }
  }
}
}

int main(int argc, char** argv)
{
  svobench::TraceSettings settings;
  if (!svobench::readSettings(argc, argv, settings))
  {
    std::fprintf(stderr,
      "usage: BenchmarkTrace [--levels 8,10,12] [--size 640x360] [--repeat n] "
      "[--scalar] [--json file] [--isa set] [--instances n] [--a file] [--b file] [mesh ...]\n");
    return 2;
  }
  if (settings.meshes.empty())
  {
    settings.meshes.push_back(svobench::torus(200, 120));
  }
  if (!svobench::useInstructionSet(settings.isa))
  {
    std::fprintf(stderr, "BenchmarkTrace: this machine has no %s\n", settings.isa.c_str());
    return 2;
  }
  svobench::TraceReport report(
    settings.isa.empty() ? instructionSet() : settings.isa, settings.json);
  std::printf("%s, %d lanes, %dx%d rays, one thread\n", instructionSet(), vectorLanes(),
    settings.width, settings.height);
  for (const svobench::Mesh& mesh : settings.meshes)
  {
    std::printf("%s, %zu triangles\n", mesh.name.c_str(), mesh.triangles.size());
    for (const int level : settings.levels)
    {
      BuildOptions options;
      options.level = level;
      const BuildResult built = build(mesh.view(), options);
      if (built.status != BuildStatus::Built)
      {
        std::fprintf(stderr, "level %d: %s\n", level, built.message.c_str());
        return 1;
      }
      const Header& header = *reinterpret_cast<const Header*>(built.data.get());
      std::string error;
      const Octree octree = Octree::open(
        built.data, built.size, makeSurface(mesh.view(), {}, header, serialFor), error);
      benchmark(mesh, octree, "far", 2.2, settings, report);
      benchmark(mesh, octree, "near", 1.05, settings, report);
      if (settings.instances > 0)
      {
        svobench::traceInstances(mesh, octree, settings.instances, settings.width, settings.height,
          settings.repeat, report);
      }
    }
  }
  return report.good() ? 0 : 1;
}
