// All records of a mesh, sorted by brick.
#ifndef svoRecords_h
#define svoRecords_h

#include "svoExecutor.h"
#include "svoMeanPlanes.h"
#include "svoRawArray.h"
#include "svoVoxelize.h"
#include "svoWork.h"

#include <vector>

namespace svo
{
/// Sorted by key, then by triangle. Bucket i, [bucketBegin[i], bucketBegin[i + 1]), has all records
/// whose keys agree in their highest bits: buckets can be worked on without each other.
struct SortedRecords
{
  RawArray<BrickRecord> records;
  std::vector<std::size_t> bucketBegin;

  std::size_t bucketCount() const { return this->bucketBegin.size() - 1; }
  std::size_t bucketSize(std::size_t i) const
  {
    return this->bucketBegin[i + 1] - this->bucketBegin[i];
  }
};

/// Voxelises the pieces. `shapes` has an element for each triangle, written for those that are
/// usable.
std::vector<RecordList> voxelizeMesh(const TriangleMesh& mesh, const Cube& cube, int level,
  const std::vector<WorkPiece>& pieces, RawArray<TriangleShape>& shapes, Executor& executor);

/// Sorts the pieces' records and frees the pieces.
SortedRecords sortRecords(std::vector<RecordList>&& pieces, int level, Executor& executor);
}

#endif
