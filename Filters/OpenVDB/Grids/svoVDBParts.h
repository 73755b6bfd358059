// Parts of one surface on several processes, as the grids of the whole.
#ifndef svoVDBParts_h
#define svoVDBParts_h

#include "svoProcesses.h"
#include "vtkSVOOpenVDBModule.h"

#include <cstdint>
#include <string>

#include <openvdb/Grid.h>

namespace svo
{
/// What a process has to write.
enum class PartState : std::int32_t
{
  Nothing, // neither a surface nor an octree
  Octree,
  Wrong // a surface whose octree is missing, damaged or another's
};

struct Part
{
  PartState state = PartState::Nothing;
  std::uint64_t voxels = 0;
};

/// Process 0 gets the grids of all processes in `grids`, masks of leaves (of bools) joined; the
/// others' are as they were. Why they are not those of one octree: `message`, on process 0; then
/// nothing is joined. Collective.
VTKSVOOPENVDB_EXPORT void joinGrids(
  Processes& processes, openvdb::GridCPtrVec& grids, std::string& message);
}

#endif
