// From sorted records, or from bricks, to the buffer of svoLayout.h.
#ifndef svoAssemble_h
#define svoAssemble_h

#include "svoRecords.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace svo
{
constexpr std::size_t LargestIndex = 0x7fffffffu; // of nodes and of words of lists

/// Thrown, and caught by build(), where an index of the layout would overflow.
struct LayoutOverflow
{
  const char* what;
};

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

/// Fills the counts of the header and returns the whole buffer, of `size` bytes. The level, the
/// depths and the cube must be in the header already. Frees the records.
std::shared_ptr<std::byte> assemble(SortedRecords&& records, const RawArray<TriangleShape>& shapes,
  Header& header, std::size_t& size, Executor& executor);

/// The same from the nodes of the last depth and what they refer to, whose words and voxels the
/// header counts already.
std::shared_ptr<std::byte> assembleBricks(NodeDepth&& bricks, const RawArray<std::uint32_t>& lists,
  Header& header, std::size_t& size, Executor& executor);
}

#endif
