// From sorted records to bricks, and from bricks to the buffer of svoLayout.h.
#ifndef svoAssemble_h
#define svoAssemble_h

#include "svoRecords.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace svo
{
/// Stops the build where more of `what`, nodes or words of lists, are needed than an index of the
/// layout can name.
void checkIndices(const Header& header, std::size_t count, const char* what);

/// The nodes of one depth, in ascending order of their keys.
struct NodeDepth
{
  RawArray<std::uint64_t> keys; // Morton keys of the blocks
  RawArray<Node> nodes;         // `first` of an inner node: index in the next depth's own array
  RawArray<SurfaceMoment> moments;

  explicit NodeDepth(std::size_t size)
    : keys(size)
    , nodes(size)
    , moments(size)
  {
  }
  std::size_t size() const { return this->nodes.size(); }
};

/// A header without counts.
Header makeHeader(const BuildOptions& options, const Cube& cube);

/// The nodes of the last depth and the lists that they refer to, whose words and voxels are counted
/// in the header.
NodeDepth makeBricks(const SortedRecords& sorted, const RawArray<TriangleShape>& shapes,
  Header& header, RawArray<std::uint32_t>& lists, Executor& executor);

/// Fills the other counts of the header and returns the whole buffer. The level, the depths and the
/// cube must be in the header already.
std::shared_ptr<std::byte> assemble(
  NodeDepth&& bricks, const RawArray<std::uint32_t>& lists, Header& header, Executor& executor);
}

#endif
