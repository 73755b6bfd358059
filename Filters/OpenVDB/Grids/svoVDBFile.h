// .vdb files: what is in them, and one grid of them.
#ifndef svoVDBFile_h
#define svoVDBFile_h

#include "vtkSVOOpenVDBModule.h"

#include <string>
#include <vector>

#include <openvdb/Grid.h>

namespace svo
{
struct VDBContents
{
  std::vector<std::string> grids;    // names; several of one name are "name[0]", "name[1]"
  std::vector<std::string> metadata; // of the file, a "name: value" each
};

/// The reason of both functions below for a file that is not whole.
inline constexpr char EndsTooEarly[] = "it ends too early";

/// The name by which OpenVDB has a grid; of several with the same name the first one's, if the
/// name is asked for without a number; that of the first grid if the name is empty. Empty if there
/// is none.
VTKSVOOPENVDB_EXPORT std::string uniqueName(const VDBContents& contents, const std::string& name);

/// Why the contents could not be read; empty if they were. Throws nothing.
VTKSVOOPENVDB_EXPORT std::string readVDBContents(
  const std::string& fileName, VDBContents& contents);

/// Reads one grid, all of it: by its name (see uniqueName()). Why it could not be read; empty if it
/// was. Throws nothing.
VTKSVOOPENVDB_EXPORT std::string readVDBGrid(const std::string& fileName, const std::string& name,
  openvdb::GridBase::ConstPtr& grid, VDBContents& contents);

/// Of a grid, a "name: value" each: its type, class and transform, and its own.
VTKSVOOPENVDB_EXPORT std::vector<std::string> metadataOf(const openvdb::GridBase& grid);

/// Writes grids in the place of a file, which stays as it was if this fails. Why it failed; empty
/// if it did not. Throws nothing.
VTKSVOOPENVDB_EXPORT std::string writeVDBFile(
  const std::string& fileName, const openvdb::GridCPtrVec& grids, const openvdb::MetaMap& metadata);
}

#endif
