// How much work and memory a mesh will take at a level, and the pieces it is cut into.
#ifndef svoWork_h
#define svoWork_h

#include "svoBuild.h"
#include "svoRawArray.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace svo
{
/// As people read it, in MiB or GiB.
VTKSVOOCTREE_EXPORT std::string bytesAsText(double bytes);

/// Why a level is too deep, and which one is not. `limit`, and what is expected of a level, are in
/// bytes; `fitsIndices`: whether indices can name all nodes of a level.
std::string tooLargeMessage(int level, double limit, const std::function<double(int)>& expected,
  const std::function<bool(int)>& fitsIndices);

/// What the expected number of bricks depends on. By Steiner's formula a triangle at a random
/// place meets, of a unit grid's cells, as many as the sum of its three projected areas, its three
/// widths and one.
struct MeshMeasure
{
  double areas = 0.0;  // sum of the projected areas of all triangles, in squares of the cube's edge
  double widths = 0.0; // sum of the widths of their bounding boxes, in edges of the cube
  std::size_t triangles = 0; // that are not dropped

  double expectedRecords(int level) const;
  /// Peak bytes of build().
  double expectedMemory(int level) const;
  /// False where nodes or list words will certainly be more than 31 bits can name.
  bool fitsIndices(int level) const;
};

/// A run of triangles, or a part of one.
struct WorkPiece
{
  std::uint32_t first = 0;
  std::uint32_t last = 0;
  std::uint32_t part = 0;
  std::uint32_t parts = 1;
  double records = 0.0; // expected
};

/// Sums are taken in blocks of a fixed size, so that they are the same for any executor. What is
/// expected of each triangle goes to `recordsOfTriangle`, as long as the mesh has triangles, or
/// null.
MeshMeasure measureMesh(const TriangleMesh& mesh, const Cube& cube, const ParallelFor& parallelFor,
  int level, RawArray<float>* recordsOfTriangle);

/// Cuts the mesh into pieces of about equal work, in ascending order of triangles.
std::vector<WorkPiece> cutWork(const RawArray<float>& recordsOfTriangle);

/// boundingCube() in parallel; also counts the triangles that are not usable.
Cube boundingCube(
  const TriangleMesh& mesh, const BuildOptions& options, std::size_t& droppedTriangles);
}

#endif
